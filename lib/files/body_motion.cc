#include "files/body_motion.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hh"
#include "files/csv_table.hh"

namespace lgiw {

namespace {

constexpr double at_rest = 1e-6;  // m and rad: what may be left of the motion at t = 0

double interpolated(const std::vector<double>& times, double time, const std::vector<double>& values) {
  const auto after = std::size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  if (after == 0) return values.front();
  if (after == times.size()) return values.back();
  const double part = (time - times[after - 1]) / (times[after] - times[after - 1]);
  return values[after - 1] + part * (values[after] - values[after - 1]);
}

}  // namespace

BodyMotion read_motion_csv(const std::string& path, int dimension) {
  const CsvText table = read_csv(path);
  const std::vector<std::vector<std::string>> headers{{"t_s", "dx_m", "dz_m"},
                                                      {"t_s", "dx_m", "dz_m", "pitch_deg"},
                                                      {"t_s", "dx_m", "dy_m", "dz_m"},
                                                      {"t_s", "dx_m", "dy_m", "dz_m", "pitch_deg"}};
  LGIW_VALIDATE(std::find(headers.begin(), headers.end(), table.header) != headers.end(),
                path + ":" + std::to_string(table.header_line) + ": not the header of a motion",
                "the columns are told by their names",
                "write t_s,dx_m,dz_m[,pitch_deg] or t_s,dx_m,dy_m,dz_m[,pitch_deg]");
  BodyMotion motion;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto number = [&](const char* heading) {
      const std::size_t column = table.column(heading);
      return column < table.header.size() ? table.given_number(row, column) : 0.0;
    };
    const double time = number("t_s");
    const std::array<double, 3> place{number("dx_m"), number("dy_m"), number("dz_m")};
    LGIW_VALIDATE(row > 0 || time <= 0, table.place(row) + ": the first time is " + table.rows[row][0] + " s",
                  "the motion must be known from t = 0 on", "begin with a row at t_s = 0 or before");
    LGIW_VALIDATE(row == 0 || time > motion.time.back(),
                  table.place(row) + ": the time " + table.rows[row][0] + " s does not rise",
                  "a body is at one place at a time", "sort the rows by t_s");
    LGIW_VALIDATE(dimension == 3 || place[1] == 0, table.place(row) + ": dy_m is " + table.rows[row][2],
                  "a 2-D scene lies in (x, z)", "leave the column dy_m out");
    motion.time.push_back(time), motion.displacement.push_back(place);
    motion.pitch.push_back(number("pitch_deg") * std::numbers::pi / 180);
  }
  for (int axis = 0; axis < 4; ++axis) {
    std::vector<double> values = motion.pitch;
    if (axis < 3)
      std::transform(motion.displacement.begin(), motion.displacement.end(), values.begin(),
                     [axis](const std::array<double, 3>& d) { return d[std::size_t(axis)]; });
    const double start = interpolated(motion.time, 0, values);
    const std::string quantity = axis < 3 ? std::string("d") + "xyz"[axis] + "_m" : "the pitch in radians";
    LGIW_VALIDATE(std::abs(start) <= at_rest, path + ": at t = 0 " + quantity + " is " + std::to_string(start),
                  "displacement and pitch count from where the case has the body at t = 0",
                  "subtract it from all rows");
  }
  return motion;
}

std::string fault_of(const BodyMotion& motion) {
  const std::size_t n = motion.time.size();
  if (motion.name.empty()) return "it has no name";
  if (n == 0) return "it has no times";
  if (motion.pitch.size() != n || motion.displacement.size() != n) return "its lists differ in length";
  const auto finite = [](double value) { return std::isfinite(value); };
  bool sound = finite(motion.heading) && std::all_of(motion.pivot.begin(), motion.pivot.end(), finite) &&
               std::all_of(motion.time.begin(), motion.time.end(), finite) &&
               std::all_of(motion.pitch.begin(), motion.pitch.end(), finite);
  for (const auto& d : motion.displacement) sound = sound && std::all_of(d.begin(), d.end(), finite);
  if (!sound) return "a number is not finite";
  if (motion.time[0] > 0) return "its times begin after 0";
  for (std::size_t k = 1; k < n; ++k)
    if (motion.time[k] <= motion.time[k - 1]) return "its times do not rise";
  return "";
}

}  // namespace lgiw
