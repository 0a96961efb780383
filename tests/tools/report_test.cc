// report.html and the styles for QGIS, made by the pipeline: one page that needs no other file, is well-formed, holds
// the numbers of the tools and escapes what a case says; what a scene lacks is left out.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <vector>

#include "bowl.hh"
#include "tool_runner.hh"

namespace lgiw::test {
namespace {

using nlohmann::json;

/// The first thing wrong with the tags of an XML text; empty where there is nothing.
std::string malformed(const std::string& xml) {
  static const std::regex entity("&(amp|lt|gt|quot|apos|#[0-9]+);");
  std::vector<std::string> open;
  for (std::size_t at = 0; at < xml.size(); ++at) {
    if (xml[at] == '&' &&
        !std::regex_search(xml.begin() + long(at), xml.end(), entity, std::regex_constants::match_continuous))
      return "a bare & at " + xml.substr(at, 40);
    if (xml[at] != '<') continue;
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return "a tag without end: " + xml.substr(at, 40);
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.empty() || std::string("!?").find(tag[0]) != std::string::npos) continue;
    const std::string name = tag.substr(tag[0] == '/', tag.find_first_of(" \n/", 1) - (tag[0] == '/'));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != name)
        return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> stays open";
}

/// A number as the report's tables have it: three digits, at least one of them behind the point.
std::string printed(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", std::max(2 - int(std::floor(std::log10(std::abs(value)))), 1), value);
  return text;
}

class Report : public testing::Test {
 protected:
  void write_case(const std::string& text) {
    fs::create_directories(shop / "scene");
    write_bytes(shop / "scene/case.yaml", text);
    write_bytes(shop / "scene/dem.asc", ascii_grid());
  }
  void make(const std::string& flags = "") {
    const std::string out = (shop / "out").string();
    const Outcome outcome = shop.run(
        "env -u MAKEFLAGS -u MAKELEVEL make -j 2 -C '" LGIW_SOURCE_DIR "/pipelines' BIN='" LGIW_BIN_DIR "' CASE_DIR='" +
        (shop / "scene").string() + "' out='" + out + "' '" + out + "/report.html' styles " + flags);
    ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
    page = read_bytes(shop / "out/report.html");
    expect_one_sound_page();
  }
  void expect_one_sound_page() const {
    EXPECT_EQ(malformed(page), "");
    for (const char* foreign : {"http://", "https://", "<script", "<link", "@import", "url("})
      EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
    for (std::size_t at = page.find("src="); at != std::string::npos; at = page.find("src=", at + 1))
      EXPECT_EQ(page.substr(at, 27), "src=\"data:image/png;base64,");
  }
  std::set<std::string> headings() const {
    std::set<std::string> found;
    const std::regex heading("<h2>([^<]*)</h2>");
    // Pictures are long lines that a regex need not see.
    std::string text = page.substr(page.find("<body>")), without;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t picture = text.find("base64,", at);
      without += text.substr(at, picture - at);
      at = picture == std::string::npos ? text.size() : text.find('"', picture);
    }
    for (std::sregex_iterator it(without.begin(), without.end(), heading), end; it != end; ++it) found.insert((*it)[1]);
    return found;
  }
  bool has(const std::string& text) const { return page.find(text) != std::string::npos; }
  json result(const std::string& file) const { return json::parse(read_bytes(shop / ("out/" + file))); }
  Workshop shop;
  std::string page;
};

TEST_F(Report, OfABowlHoldsItsNumbersAndEscapesWhatItIsTold) {
  write_case("# A synthetic bowl; 1 < 2 & <script>alert(\"x\")</script>.\n" +
             replaced(replaced(replaced(bowl_case, "end_time: 1\n", "end_time: 15\n"), "friction_angle: 20",
                               "friction_angle: 5"),
                      "- file: dem.asc", "- {file: dem.asc, attribution: \"Survey <b> & Co, CC BY 4.0\"}"));
  make("THRESHOLDS=1");
  EXPECT_EQ(headings(), (std::set<std::string>{"Wave", "Hazard classes", "Run-up", "Gauges", "Slide",
                                               "How far to trust these numbers", "Empirical cross-check", "Provenance",
                                               "Left out"}));
  EXPECT_TRUE(has("<strong>Not an assessment of a real site.</strong>"));
  EXPECT_TRUE(has("&lt;script&gt;alert(&quot;x&quot;)&lt;/script&gt;"));
  EXPECT_TRUE(has("smoothed by medians of 5 x 5 cells. Terrain: Survey &lt;b&gt; &amp; Co, CC BY 4.0.</figcaption>"));
  EXPECT_TRUE(has("<td>terrain</td><td>Survey &lt;b&gt; &amp; Co, CC BY 4.0</td>"));
  const json gauges = result("gauges.json"), slide = result("slide.json");
  const auto cell = [&](double value) { return has("<td class=\"number\">" + printed(value) + "</td>"); };
  EXPECT_TRUE(cell(gauges["gauges"][0]["max_height_m"])) << gauges["gauges"][0];
  EXPECT_TRUE(cell(slide["max_slide_speed_m_s"])) << slide;
  EXPECT_TRUE(cell(result(".work/shores.json")[0]["runup_m"]));
  EXPECT_NEAR(result(".work/shores.json")[0]["runup_m"].get<double>(), gauges["shore_runup_m"].get<double>(), 1e-6);
  EXPECT_TRUE(has("arrival at 5 m (s)") && has("arrival at 1 m (s)"));
  const json provenance = gauges["provenance"]["gauges"];
  EXPECT_TRUE(has(provenance["inputs"][0]["sha256"].get<std::string>()));
  EXPECT_TRUE(has("dem2particles " + provenance["version"].get<std::string>()));

  // A row a formula and quantity in sight, each place and each limit folded away, and nothing lost.
  const json places = result("impulse.json")["impulse_wave"]["places"];
  std::set<std::string> families;
  std::size_t estimates = 0;
  for (const json& place : places)
    for (const json& e : place["estimates"]) {
      families.insert(e["quantity"].get<std::string>() + e["formula"].get<std::string>());
      EXPECT_TRUE(cell(e["predicted"])) << e;
      ++estimates;
    }
  ASSERT_GT(families.size(), 4u);
  const std::size_t check = page.find("<h2>Empirical cross-check</h2>"), fold = page.find("<details>", check),
                    end = page.find("</section>", check);
  const auto rows = [&](const std::string& start, std::size_t from, std::size_t to) {
    std::size_t count = 0;
    for (std::size_t at = page.find(start, from); at < to; at = page.find(start, at + 1)) ++count;
    return count;
  };
  ASSERT_LT(fold, end);
  EXPECT_EQ(rows("<tr><td>", check, fold), families.size());
  const std::size_t each = page.find("<summary>Each formula at each place</summary>", fold);
  EXPECT_EQ(rows("<tr><td>", each, page.find("</details>", each)), estimates);
  EXPECT_EQ(rows("<td>Mohammed-Fritz*</td>", check, fold), 1u);
  EXPECT_NE(page.find("<td>not known</td>", check), std::string::npos)
      << "Mohammed-Fritz has no limits, and is not within any";

  // Names that a case may not have but --gauge may.
  const std::string out = (shop / "out").string();
  const std::string gauge = "gauges " + out + "/run.h5 -q -O --gauge '<b>&,500000,3700000' --summary " + out +
                            "/gauges.json --long -o " + out + "/gauges.csv --peaks " + out + "/peaks.csv";
  expect_quiet_success(shop.run(gauge), gauge);
  make("THRESHOLDS=1");
  EXPECT_TRUE(has("<td>&lt;b&gt;&amp;</td>") && !has("<b>"));
}

TEST_F(Report, StylesSpanTheDataAndLieWhereQgisLooks) {
  write_case(bowl_case);  // within a second nothing moves, and the maps have little to show
  make();
  for (const char* name : {"ground", "max_elevation", "max_depth", "max_speed", "arrival", "hazard", "thickness"})
    EXPECT_EQ(malformed(read_bytes(shop / (std::string("out/") + name + ".qml"))), "") << name;
  // From the still water level to the highest surface.
  const Outcome info = shop.run("gdalinfo -json -mm out/max_elevation.tif");
  const double highest = json::parse(info.out)["bands"][0]["computedMax"];
  const std::string style = read_bytes(shop / "out/max_elevation.qml");
  std::smatch range;
  ASSERT_TRUE(
      std::regex_search(style, range, std::regex("classificationMin=\"([^\"]*)\" classificationMax=\"([^\"]*)\"")));
  EXPECT_EQ(std::stod(range[1]), 110);
  EXPECT_NEAR(std::stod(range[2]), highest, 1e-6);

  const Outcome rows = shop.run("ogr2ogr -f GeoJSON /vsistdout/ out/wave.gpkg layer_styles");
  ASSERT_EQ(rows.status, 0) << rows.err;
  std::set<std::string> layers;
  const json styles = json::parse(rows.out);
  for (const json& row : styles["features"]) {
    layers.insert(row["properties"]["f_table_name"]);
    EXPECT_EQ(malformed(row["properties"]["styleQML"]), "") << row;
    EXPECT_TRUE(row["properties"]["useAsDefault"].get<bool>());
  }
  EXPECT_EQ(layers, (std::set<std::string>{"gauges", "shoreline", "shore_runup", "inundation", "hazard"}));
  const Outcome layer = shop.run("ogrinfo -so out/wave.gpkg shore_runup");
  EXPECT_NE(layer.out.find("ID[\"EPSG\",32611]"), std::string::npos) << layer.out;
}

TEST_F(Report, WithoutSlideGaugesAndSectionsLeavesThemOut) {
  std::string text = bowl_case.substr(0, bowl_case.find("slide:")) + "output: {end_time: 0.5, frame_interval: 0.5}\n";
  write_case(text);
  make();
  const std::set<std::string> found = headings();
  EXPECT_FALSE(found.count("Slide") || found.count("Gauges")) << page.size();
  EXPECT_TRUE(found.count("Wave") && found.count("Provenance"));
  EXPECT_FALSE(has("Not an assessment"));
}

TEST_F(Report, DoesNotCallAMapOfTheUsersOwnInvented) {
  write_case(
      "# The terrain is synthetic, and the soil assumed (README.md): what comes out is none of a real site.\n#\n" +
      replaced(bowl_case, "slide:", "slide:  # An invented slide in a valley."));
  write_bytes(shop / "scene/README.md",
              "# A synthetic gorge: a bowl\n\nThe lake is **hypothetical**, its\nbed invented.\n");
  fs::create_directory(shop / "scene/terrain");
  write_bytes(shop / "scene/terrain/README.md", "Heights are invented.\n");
  write_bytes(shop / "own.asc", ascii_grid());
  const auto told = [&](const std::string& map) {
    const std::string out = (shop / "out").string(),
                      file = out + (map.empty() ? "" : "/on-own") + "/.work/invented.txt";
    const Outcome outcome = shop.run("env -u MAKEFLAGS -u MAKELEVEL -u called_from make -C '" LGIW_SOURCE_DIR
                                     "/pipelines' BIN='" LGIW_BIN_DIR "' CASE_DIR='" +
                                     (shop / "scene").string() + "' OUT='" + out + "' " + map + " '" + file + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read_bytes(file);
  };
  const std::string slide = "An invented slide in a valley.\n", lake = "The lake is hypothetical, its bed invented.\n",
                    all =
                        "The terrain is synthetic, and the soil assumed (README.md): what comes out is none of a real "
                        "site.\n" +
                        slide + "A synthetic gorge: a bowl.\n" + lake + "Heights are invented.\n";
  EXPECT_EQ(told(""), all);
  EXPECT_EQ(told("TERRAIN=own.asc"), slide + lake) << "the slide and the lake are still the case's";
  fs::remove_all(shop / "out");
  EXPECT_EQ(told("SITE=own.asc"), all) << "around the site the terrain is the case's";
}

TEST_F(Report, OfAFlumeHasNoMaps) {
  write_case(
      "name: flume\ndimension: 2\nparticle_spacing: 0.01\nterrain: {profile: [[-0.3, 0.3], [0, 0], [0.5, 0]]}\n"
      "water: {level: 0.1}\noutput: {end_time: 0.05, frame_interval: 0.05}\ngauges:\n  - {name: far, x: 0.3}\n");
  make();
  const std::set<std::string> found = headings();
  EXPECT_FALSE(found.count("Wave") || found.count("Hazard classes") || found.count("Slide"));
  EXPECT_TRUE(found.count("How far to trust these numbers"));
}

}  // namespace
}  // namespace lgiw::test
