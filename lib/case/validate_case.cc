#include "case/validate_case.hh"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "base/error.hh"
#include "case/dotted_key.hh"

namespace lgiw {
namespace {

/// Where things may lie in plan; unbounded where the case does not say.
struct Extent {
  double x_min = -HUGE_VAL, y_min = -HUGE_VAL, x_max = HUGE_VAL, y_max = HUGE_VAL;
  std::string name = "terrain.window";
};

std::string point_text(const Point2& p) { return "(" + number_text(p[0], 10) + ", " + number_text(p[1], 10) + ")"; }

class Validator {
 public:
  explicit Validator(const Case& c) : c_(c) {}
  void run() {
    check_top();
    check_terrain();
    check_water();
    check_slide();
    check_moving_bodies();
    check_soil();
    check_numerics();
    check_output();
    check_gauges();
    check_sections();
  }

 private:
  bool given(const std::string& key) const { return c_.places.count(key) > 0; }
  bool rasters() const { return !c_.terrain.sources.empty(); }

  [[noreturn]] void refuse(const std::string& key, const std::string& problem, const std::string& why,
                           const std::string& suggestion) const {
    throw InputError(c_.where(key) + ": " + problem, why, suggestion);
  }
  void refuse_if(bool wrong, const std::string& key, const std::string& problem, const std::string& why,
                 const std::string& suggestion) const {
    if (wrong) refuse(key, problem, why, suggestion);
  }
  void refuse_given(const std::vector<std::string>& keys, const std::string& why) const {
    for (const std::string& key : keys) refuse_if(given(key), key, key + " has no meaning here", why, "leave it out");
  }

  /// Names become names of files and of columns.
  void check_name(const std::string& key, const std::string& name) const {
    const bool sound =
        std::isalnum(static_cast<unsigned char>(name[0])) &&
        std::all_of(name.begin(), name.end(), [](unsigned char ch) {
          return std::isalnum(ch) || std::string("_.'-").find(static_cast<char>(ch)) != std::string::npos;
        });
    refuse_if(!sound || name.size() > 100, key, "the name \"" + name.substr(0, 60) + "\" cannot be used",
              "it becomes part of file names", "use a letter or digit, then letters, digits and _ . ' -");
  }

  void check_top() const {
    check_name("name", c_.name);
    refuse_if(!c_.water.present && !c_.slide.present, "", "neither water nor slide", "nothing would move",
              "add a water or a slide section");
    refuse_if(!c_.water.present && !c_.has_soil(), "slide.motion", "a rigid slide without water",
              "nothing but the slide itself would move", "add a water section");
    const auto& [gx, gy, gz] = c_.gravity;
    refuse_if(gz >= 0, "gravity", "gravity does not point down", "z points up, so its third component is negative",
              "write [0, 0, -9.81]");
    refuse_if(c_.dimension == 2 && gy != 0, "gravity", "gravity has a y component", "a 2-D scene lies in (x, z)",
              "write [0, 0, -9.81]");
    refuse_if(c_.water.present && (gx != 0 || gy != 0), "gravity", "gravity is tilted",
              "the still water level is horizontal in z", "tilt the bed instead");
  }

  void check_terrain() const {
    const Terrain& t = c_.terrain;
    refuse_if(!rasters() && t.profile.empty(), "terrain", "terrain has neither sources nor a profile",
              "a case needs a bed", "add sources (rasters) or a profile ([x, z] points)");
    refuse_if(rasters() && !t.profile.empty(), "terrain.profile", "terrain has both sources and a profile",
              "there is one bed", "leave one of them out");
    check_crs();
    if (rasters()) {
      refuse_if(c_.dimension == 2, "terrain.sources", "rasters in a 2-D scene", "a 2-D scene has a profile for its bed",
                "set dimension: 3 or give terrain.profile");
      refuse_given({"terrain.width"}, "the window bounds a scene with rasters");
    } else {
      refuse_given({"terrain.window", "terrain.voids", "terrain.spikes", "terrain.spike_threshold"},
                   "the bed is a profile, bounded by its ends and by width");
      refuse_if(t.profile.size() < 2, "terrain.profile", "terrain.profile has one point", "a line needs two",
                "add points from west to east");
      for (std::size_t i = 1; i < t.profile.size(); ++i)
        refuse_if(t.profile[i][0] <= t.profile[i - 1][0], "terrain.profile." + std::to_string(i),
                  "terrain.profile goes back at x = " + number_text(t.profile[i][0]),
                  "the bed has one height at each x", "sort by x; move a vertical step by a little");
      refuse_if(c_.dimension == 3 && t.width <= 0, "terrain.profile", "terrain.width is missing",
                "a 3-D scene with a profile reaches from y = 0 to width", "add width, in m, or set dimension: 2");
      if (c_.dimension == 2)
        refuse_given({"terrain.width", "terrain.sides.south", "terrain.sides.north"}, "a 2-D scene has no y");
    }
    if (t.window) {
      const auto [x0, y0, x1, y1] = *t.window;
      refuse_if(x1 <= x0 || y1 <= y0, "terrain.window", "terrain.window is empty", "its ends are not in order",
                "write [x_min, y_min, x_max, y_max]");
      const bool degrees = std::abs(x0) <= 180 && std::abs(x1) <= 180 && std::abs(y0) <= 90 && std::abs(y1) <= 90;
      refuse_if(std::min(x1 - x0, y1 - y0) < 10 * c_.dp, "terrain.window",
                "terrain.window is " + number_text(x1 - x0) + " m by " + number_text(y1 - y0) + " m",
                "that is less than ten particles of " + number_text(c_.dp) + " m" +
                    (degrees ? "; it looks like degrees" : ""),
                degrees ? "give it in the metres of terrain.crs" : "widen it or refine particle_spacing");
    }
    const bool absorbs = t.west == Side::absorbing || t.east == Side::absorbing || t.south == Side::absorbing ||
                         t.north == Side::absorbing;
    refuse_if(!absorbs && t.absorbing_width > 0, "terrain.absorbing_width", "no side is absorbing",
              "terrain.absorbing_width has no effect", "set one of terrain.sides to absorbing");
  }

  /// Only what the text tells; whoever opens the rasters asks PROJ.
  void check_crs() const {
    std::string crs = c_.terrain.crs;
    std::transform(crs.begin(), crs.end(), crs.begin(), [](unsigned char ch) { return std::toupper(ch); });
    const std::set<std::string> geographic{"EPSG:4326", "EPSG:4979", "EPSG:4258", "EPSG:4269", "EPSG:4267", "EPSG:4283",
                                           "EPSG:4490", "EPSG:4617", "EPSG:4674", "EPSG:6318", "EPSG:7844", "EPSG:4612",
                                           "WGS84",     "WGS 84",    "CRS84",     "OGC:CRS84"};
    const auto begins = [&crs](const std::string& text) { return crs.compare(0, text.size(), text) == 0; };
    refuse_if(geographic.count(crs) || begins("GEOGC") || begins("GEOGRAPHIC") || begins("GEODCRS") ||
                  crs.find("+PROJ=LONGLAT") != std::string::npos || crs.find("+PROJ=LATLONG") != std::string::npos,
              "terrain.crs", "terrain.crs is geographic", "its coordinates are degrees, the case's are metres",
              "name a projected one, such as the UTM zone: EPSG:32611");
    refuse_if(crs == "EPSG:3857" || crs == "EPSG:900913" || crs == "EPSG:3785", "terrain.crs",
              "terrain.crs is Web Mercator", "its metres are too long by 1/cos(latitude)",
              "name the UTM zone, such as EPSG:32611");
  }

  Extent extent() const {
    Extent e;
    const Terrain& t = c_.terrain;
    if (t.window) {
      e.x_min = (*t.window)[0], e.y_min = (*t.window)[1], e.x_max = (*t.window)[2], e.y_max = (*t.window)[3];
    } else if (!t.profile.empty()) {
      e.name = "terrain.profile";
      e.x_min = t.profile.front()[0], e.x_max = t.profile.back()[0];
      if (c_.dimension == 3) e.y_min = 0, e.y_max = t.width;
    }
    return e;
  }

  /// `in_plan` false: the point is (x, z) and only x counts.
  void check_inside(const std::string& key, const std::string& what, const Point2& p, bool in_plan = true) const {
    const Extent e = extent();
    const bool inside = p[0] >= e.x_min && p[0] <= e.x_max && (!in_plan || (p[1] >= e.y_min && p[1] <= e.y_max));
    refuse_if(!inside, key, what + " lies outside the domain", point_text(p) + " is beyond " + e.name,
              "move it or widen the domain");
  }

  void check_polygon(const std::string& key, const std::vector<Point2>& polygon) const {
    refuse_if(polygon.size() < 3, key, key + " has " + std::to_string(polygon.size()) + " points",
              "an outline needs three", "add points around it");
    const int edge = self_intersection(polygon);
    if (edge >= 0) {
      refuse(key, key + " crosses or touches itself", "its edge from " + point_text(polygon[edge]) + " meets another",
             "list the points once around, in order");
    }
  }

  void check_bodies(const std::string& key, const std::vector<std::vector<Point2>>& bodies) const {
    refuse_if(!bodies.empty() && rasters(), key, key + " with rasters", "bodies are (x, z) outlines of analytic scenes",
              key == "slide.bodies" ? "use a polygon and a failure surface" : "use level and seed");
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const std::string body = key + "." + std::to_string(i);
      check_polygon(body, bodies[i]);
      for (const Point2& p : bodies[i]) check_inside(body, body, p, false);
    }
  }

  void check_water() const {
    if (!c_.water.present) return;
    check_bodies("water.bodies", c_.water.bodies);
    refuse_if(rasters() && !c_.water.seed, "water", "water.seed is missing",
              "not every hollow below the level is the reservoir", "add seed: [x, y], a point in the reservoir");
    if (c_.water.seed) check_inside("water.seed", "water.seed", *c_.water.seed);
    if (c_.water.wave) check_wave(*c_.water.wave);
  }

  void check_wave(const Wave& wave) const {
    refuse_if(rasters(), "water.wave", "water.wave with rasters", "initial waves are those of laboratory tanks",
              "use terrain.profile");
    refuse_if(!c_.water.bodies.empty(), "water.wave", "water.wave with water.bodies", "a wave runs on still water",
              "leave one of the two out");
    const bool solitary = wave.kind == WaveKind::solitary;
    const std::vector<std::string> solitary_keys{"height", "crest", "direction"}, standing_keys{"amplitude", "mode"};
    for (const std::string& key : solitary ? solitary_keys : standing_keys)
      refuse_if(!given("water.wave." + key), "water.wave", "water.wave." + key + " is missing",
                solitary ? "a solitary wave has a height, a crest and a direction"
                         : "a standing wave has an amplitude and a mode",
                "add " + key);
    for (const std::string& key : solitary ? standing_keys : solitary_keys)
      refuse_if(given("water.wave." + key), "water.wave." + key, "water.wave." + key + " has no meaning here",
                solitary ? "the wave is solitary" : "the wave is standing", "leave it out");
    if (solitary) check_inside("water.wave.crest", "water.wave.crest", {wave.crest, 0}, false);
    refuse_if(c_.slide.present || !c_.bodies.empty(), "water.wave",
              std::string("water.wave with ") + (c_.slide.present ? "a slide" : "bodies"),
              "initial waves are those of undisturbed water", "leave one of the two out");
    refuse_if(settles(), "water.wave", std::string("water.wave with ") + settling_key(),
              "the scene settles to rest before the run", "leave one of the two out");
  }

  bool settles() const {
    return c_.numerics.settle_time > 0 || (c_.slide.present && c_.soil.initial_stress == InitialStress::settled);
  }
  const char* settling_key() const {
    return c_.numerics.settle_time > 0 ? "numerics.settle_time" : "soil.initial_stress: settled";
  }

  void check_slide() const {
    const Slide& slide = c_.slide;
    if (!slide.present) return;
    const SlideSurface& s = slide.surface;
    refuse_if(s.before.empty() != s.after.empty(), s.before.empty() ? "slide.after" : "slide.before",
              std::string("slide has only the ground ") + (s.before.empty() ? "after" : "before") + " the event",
              "the soil lies between the two", "give both before and after");
    std::vector<std::string> ways;
    for (const char* way :
         {"before", "thickness", "failure_surface", "depth", "plane", "base_elevation", "slbl", "bodies"})
      if (given("slide." + std::string(way))) ways.push_back(way);
    const std::string all =
        "before and after, thickness, failure_surface, depth, plane, base_elevation, slbl or bodies";
    refuse_if(ways.empty(), "slide", "slide has no failure surface", "the soil reaches down to it",
              "add one of " + all);
    refuse_if(ways.size() > 1, ways.size() > 1 ? "slide." + ways[1] : "slide",
              "slide has two failure surfaces, " + ways[0] + " and " + (ways.size() > 1 ? ways[1] : ""),
              "the soil reaches down to one", "leave one of them out");
    const std::string way = ways[0];
    check_bodies("slide.bodies", slide.bodies);
    refuse_if(c_.dimension == 2 && way != "bodies", "slide." + way, "slide." + way + " in a 2-D scene",
              "its soil is given as (x, z) outlines", "use bodies");
    refuse_if(!rasters() && way != "bodies", "slide." + way, "slide." + way + " without terrain rasters",
              "it cuts into a terrain of rasters; soil on a profile is given as (x, z) outlines", "use bodies");
    refuse_if(!slide.polygon.empty() && !slide.polygon_file.empty(), "slide.polygon_file",
              "slide has both polygon and polygon_file", "there is one outline", "leave one of them out");
    const bool outlined = !slide.polygon.empty() || !slide.polygon_file.empty();
    if (way == "bodies") refuse_given({"slide.polygon", "slide.polygon_file"}, "bodies are whole outlines themselves");
    refuse_if(!outlined && way != "bodies" && way != "before" && way != "thickness", "slide", "slide has no outline",
              way + " reaches everywhere", "add polygon or polygon_file");
    if (given("slide.polygon")) {
      check_polygon("slide.polygon", slide.polygon);
      for (const Point2& p : slide.polygon) check_inside("slide.polygon", "slide.polygon", p);
    }
    if (slide.motion) check_motion(*slide.motion);
    const bool moves = slide.velocity != std::array<double, 3>{0, 0, 0};
    refuse_if(moves && settles(), "slide.velocity", std::string("slide.velocity with ") + settling_key(),
              "the scene settles to rest before the run", "leave one of the two out");
    if (s.slbl)
      refuse_if(s.slbl->neighbours != 4 && s.slbl->neighbours != 8, "slide.slbl.neighbours",
                "slide.slbl.neighbours is " + std::to_string(s.slbl->neighbours),
                "a cell has four neighbours, eight with diagonals", "write 4 or 8");
  }

  void check_motion(const SlideMotion& motion) const {
    refuse_given({"soil", "slide.velocity"}, "the slide is rigid and moves as slide.motion says");
    refuse_if(c_.dimension == 2 && motion.heading != 90 && motion.heading != 270, "slide.motion.heading",
              "slide.motion.heading is " + number_text(motion.heading), "a 2-D scene lies in (x, z)",
              "write 90 (+x) or 270 (-x)");
  }

  void check_moving_bodies() const {
    std::set<std::string> names;
    refuse_if(!c_.bodies.empty() && rasters(), "bodies", "bodies with rasters",
              "bodies are (x, z) outlines of analytic scenes", "use a slide with slide.motion");
    refuse_if(c_.bodies.size() > 250, "bodies", std::to_string(c_.bodies.size()) + " bodies",
              "at most 250 can be numbered", "join those that move alike");
    for (std::size_t i = 0; i < c_.bodies.size(); ++i) {
      const MovingBody& body = c_.bodies[i];
      const std::string key = "bodies." + std::to_string(i);
      check_name(key + ".name", body.name);
      refuse_if(body.name == "slide", key + ".name", "a body is named slide", "that is the slide's own name",
                "rename it");
      refuse_if(!names.insert(body.name).second, key + ".name", "two bodies are named " + body.name,
                "their results would be mixed up", "rename one of them");
      check_polygon(key + ".outline", body.outline);
      const Extent e = extent();
      const auto [west, east] = std::minmax_element(body.outline.begin(), body.outline.end());  // by x first
      refuse_if((*east)[0] <= e.x_min || (*west)[0] >= e.x_max, key + ".outline",
                "body " + body.name + " lies outside the domain",
                "x from " + number_text((*west)[0]) + " to " + number_text((*east)[0]) + " is beyond " + e.name,
                "move it or widen the domain");
    }
  }

  void check_soil() const {
    const Soil& soil = c_.soil;
    refuse_if(soil.dilatancy_angle > soil.friction_angle, "soil.dilatancy_angle",
              "soil.dilatancy_angle exceeds the friction angle",
              number_text(soil.dilatancy_angle) + " is more than " + number_text(soil.friction_angle) +
                  " degrees; shearing would create energy",
              "write at most " + number_text(soil.friction_angle) + "; 0 is usual");
    refuse_if(soil.rate.present && soil.rate.friction_angle_fast <= soil.friction_angle,
              "soil.rate.friction_angle_fast", "soil.rate.friction_angle_fast is not above the friction angle",
              number_text(soil.rate.friction_angle_fast) + " is not more than " + number_text(soil.friction_angle) +
                  " degrees; strength grows with the rate",
              "write a larger angle, or leave soil.rate out");
    refuse_if(soil.rate.present && !c_.numerics.return_mapping, "soil.rate", "soil.rate with the rate form",
              "mu(I) is part of the return mapping", "write numerics.constitutive: return_mapping");
    for (const auto& [key, friction] : {std::pair("soil.bed", soil.bed), std::pair("soil.sides", soil.sides)})
      refuse_if(friction == WallFriction::coulomb && soil.bed_friction_angle <= 0, key,
                std::string(key) + " is coulomb without soil.bed_friction_angle", "the friction has no limit",
                "add bed_friction_angle, in degrees");
    refuse_if(soil.friction_angle == 0 && soil.cohesion == 0 && c_.has_soil(), "soil.friction_angle",
              "the soil has no strength", "friction_angle and cohesion are both 0",
              "give a friction angle, or the undrained strength as cohesion");
  }

  void check_numerics() const {
    refuse_if(c_.numerics.integrator == Integrator::verlet && c_.numerics.cfl > 0.3, "numerics.cfl",
              "numerics.cfl is " + number_text(c_.numerics.cfl) + " with the verlet integrator",
              "it diverges at 0.4 and is unsafe above 0.3", "write 0.1");
  }

  void check_output() const {
    const Output& o = c_.output;
    const std::string key = given("output.frame_interval") ? "output.frame_interval" : "output.end_time";
    refuse_if(o.frame_interval > o.end_time, key,
              "output.frame_interval is " + number_text(o.frame_interval) + " s, longer than the run",
              "output.end_time is " + number_text(o.end_time) + " s", "write " + number_text(o.end_time / 60));
    refuse_if(o.end_time / o.frame_interval > 1e5, key,
              "output asks for " + number_text(o.end_time / o.frame_interval) + " frames", "each holds every particle",
              "lengthen frame_interval");
    refuse_if(o.surface_interval > o.end_time, "output.surface_interval",
              "output.surface_interval is longer than the run", "output.end_time is " + number_text(o.end_time) + " s",
              "leave it out for 0.3 sqrt(particle_spacing / g)");
  }

  void check_gauges() const {
    std::set<std::string> names;
    for (std::size_t i = 0; i < c_.gauges.size(); ++i) {
      const Gauge& gauge = c_.gauges[i];
      const std::string key = "gauges." + std::to_string(i);
      check_name(key + ".name", gauge.name);
      refuse_if(!names.insert(gauge.name).second, key + ".name", "two gauges are named " + gauge.name,
                "their results would be mixed up", "rename one of them");
      if (c_.dimension == 2)
        refuse_if(gauge.y != 0, key + ".y", "gauge " + gauge.name + " has a y", "a 2-D scene lies in (x, z)",
                  "leave y out");
      else
        refuse_if(!given(key + ".y"), key, "gauge " + gauge.name + " has no y", "a gauge is a place in plan",
                  "write {name: " + gauge.name + ", x: ..., y: ...}");
      check_inside(key, "gauge " + gauge.name, {gauge.x, gauge.y});
      check_quantity(key, gauge);
    }
  }

  void check_quantity(const std::string& key, const Gauge& gauge) const {
    if (gauge.quantity == GaugeQuantity::surface) {
      refuse_if(given(key + ".z"), key + ".z", "gauge " + gauge.name + " has a z",
                "it measures the surface, wherever that is", "leave z out or add quantity: pressure");
      return;
    }
    refuse_if(!given(key + ".z"), key, "pressure gauge " + gauge.name + " has no z",
              "pressure is measured at a point in the water", "add z, its elevation in m");
    refuse_if(!c_.water.present, key + ".quantity", "gauge " + gauge.name + " measures pressure without water",
              "it is that of the water", "add water or leave quantity out");
    refuse_if(gauge.name == "time", key + ".name", "a pressure gauge is named time",
              "the times of its series have that name", "rename it");
  }

  void check_sections() const {
    std::set<std::string> names;
    for (std::size_t i = 0; i < c_.sections.size(); ++i) {
      const Section& section = c_.sections[i];
      const std::string key = "sections." + std::to_string(i);
      check_name(key + ".name", section.name);
      refuse_if(!names.insert(section.name).second, key + ".name", "two sections are named " + section.name,
                "their results would be mixed up", "rename one of them");
      refuse_if(section.points.size() < 2, key + ".points", "section " + section.name + " has one point",
                "a line needs two", "add points from the slide to the opposite bank");
      for (std::size_t k = 0; k < section.points.size(); ++k) {
        const Point2& p = section.points[k];
        refuse_if(k > 0 && p == section.points[k - 1], key + ".points", "section " + section.name + " repeats a point",
                  "a piece of it has no direction", "leave one of the two out");
        refuse_if(c_.dimension == 2 && p[1] != 0, key + ".points", "section " + section.name + " has a y",
                  "a 2-D scene lies in (x, z)", "write 0 for y");
        check_inside(key + ".points", "section " + section.name, p);
      }
    }
  }

  const Case& c_;
};

double cross(const Point2& o, const Point2& a, const Point2& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

bool within(double value, double a, double b) { return value >= std::min(a, b) && value <= std::max(a, b); }

/// Whether the closed segments ab and cd share a point.
bool segments_meet(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const auto sign = [](double v) { return (v > 0) - (v < 0); };
  const int c_side = sign(cross(a, b, c)), d_side = sign(cross(a, b, d));
  const int a_side = sign(cross(c, d, a)), b_side = sign(cross(c, d, b));
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  const auto on = [](int side, const Point2& p, const Point2& from, const Point2& to) {
    return side == 0 && within(p[0], from[0], to[0]) && within(p[1], from[1], to[1]);
  };
  return on(c_side, c, a, b) || on(d_side, d, a, b) || on(a_side, a, c, d) || on(b_side, b, c, d);
}

}  // namespace

int self_intersection(const std::vector<Point2>& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 &a = polygon[i], &b = polygon[(i + 1) % n], &after = polygon[(i + 2) % n];
    const double along = (b[0] - a[0]) * (after[0] - b[0]) + (b[1] - a[1]) * (after[1] - b[1]);
    if (a == b || (cross(a, b, after) == 0 && along < 0)) return static_cast<int>(i);
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // neighbours around the end
      if (segments_meet(a, b, polygon[j], polygon[(j + 1) % n])) return static_cast<int>(i);
    }
  }
  return -1;
}

void validate_case(const Case& c) { Validator(c).run(); }

}  // namespace lgiw
