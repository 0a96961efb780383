// A workshop with the basin's run in it, in which the measuring tools are called as a user calls them.
#pragma once

#include <ogr_spatialref.h>

#include "../tools/tool_runner.hh"
#include "basin.hh"

namespace lgiw::test {

inline std::string utm_wkt() {
  OGRSpatialReference crs;
  crs.importFromEPSG(32611);
  char* text = nullptr;
  crs.exportToWkt(&text);
  const std::string wkt = text;
  CPLFree(text);
  return wkt;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A workshop with run.h5 in it.
class MeasuringTools : public testing::Test {
 protected:
  MeasuringTools() { write_basin_run((shop / "run.h5").string(), true, utm_wkt()); }

  void expect_refused(const std::string& command, const std::string& message) {
    const auto before = shop.contents();
    const Outcome outcome = shop.run(command);
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_EQ(outcome.err, message + "\n") << command;
    EXPECT_EQ(outcome.out, "") << command;
    EXPECT_EQ(shop.contents(), before) << command << " left something behind";
  }

  void make(const std::string& command) {
    const Outcome outcome = shop.run(command);
    expect_quiet_success(outcome, command);
    EXPECT_EQ(outcome.out, "") << command;
  }

  Workshop shop;
};

}  // namespace lgiw::test
