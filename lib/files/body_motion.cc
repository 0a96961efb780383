#include "files/body_motion.hh"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>

#include "base/error.hh"

namespace lgiw {

namespace {

constexpr double at_rest = 1e-6;  // m and rad: what may be left of the motion at t = 0

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  for (std::size_t begin = 0, comma = 0; comma != std::string::npos; begin = comma + 1) {
    comma = line.find(',', begin);
    fields.push_back(trimmed(line.substr(begin, comma == std::string::npos ? comma : comma - begin)));
  }
  return fields;
}

double interpolated(const std::vector<double>& times, double time, const std::vector<double>& values) {
  const auto after = std::size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  if (after == 0) return values.front();
  if (after == times.size()) return values.back();
  const double part = (time - times[after - 1]) / (times[after] - times[after - 1]);
  return values[after - 1] + part * (values[after] - values[after - 1]);
}

}  // namespace

BodyMotion read_motion_csv(const std::string& path, int dimension) {
  std::ifstream file(path);
  LGIW_VALIDATE(file.good(), path + " cannot be opened", "a motion file is needed", "check its name and permissions");
  const std::vector<std::vector<std::string>> headers{{"t_s", "dx_m", "dz_m"},
                                                      {"t_s", "dx_m", "dz_m", "pitch_deg"},
                                                      {"t_s", "dx_m", "dy_m", "dz_m"},
                                                      {"t_s", "dx_m", "dy_m", "dz_m", "pitch_deg"}};
  BodyMotion motion;
  std::vector<std::string> header;
  int number = 0;
  std::string line;
  const auto refuse = [&](const std::string& problem, const std::string& why, const std::string& suggestion) {
    throw InputError(path + ":" + std::to_string(number) + ": " + problem, why, suggestion);
  };
  while (std::getline(file, line)) {
    ++number;
    if (trimmed(line).empty() || trimmed(line)[0] == '#') continue;
    const std::vector<std::string> fields = fields_of(line);
    if (header.empty()) {
      if (std::find(headers.begin(), headers.end(), fields) == headers.end())
        refuse("not the header of a motion", "the columns are told by their names",
               "write t_s,dx_m,dz_m[,pitch_deg] or t_s,dx_m,dy_m,dz_m[,pitch_deg]");
      header = fields;
      continue;
    }
    if (fields.size() != header.size())
      refuse("the row has " + std::to_string(fields.size()) + " columns",
             "the header has " + std::to_string(header.size()), "give each row all columns");
    double time = 0, pitch = 0;
    std::array<double, 3> place{0, 0, 0};
    for (std::size_t k = 0; k < fields.size(); ++k) {
      double value = 0;
      const char *begin = fields[k].data(), *end = begin + fields[k].size();
      if (fields[k].size() > 1 && begin[0] == '+' && begin[1] != '-') ++begin;  // from_chars takes no plus sign
      const auto [stop, error] = std::from_chars(begin, end, value);
      if (error != std::errc() || stop != end || !std::isfinite(value))
        refuse(header[k] + " is \"" + fields[k].substr(0, 40) + "\"", "a finite number is wanted", "write a number");
      if (header[k] == "t_s") time = value;
      if (header[k] == "pitch_deg") pitch = value * std::numbers::pi / 180;
      if (header[k].size() == 4 && header[k][0] == 'd') place[std::size_t(header[k][1] - 'x')] = value;
    }
    if (motion.time.empty() && time > 0)
      refuse("the first time is " + fields[0] + " s", "the motion must be known from t = 0 on",
             "begin with a row at t_s = 0 or before");
    if (!motion.time.empty() && time <= motion.time.back())
      refuse("the time " + fields[0] + " s does not rise", "a body is at one place at a time", "sort the rows by t_s");
    if (dimension == 2 && place[1] != 0)
      refuse("dy_m is " + fields[2], "a 2-D scene lies in (x, z)", "leave the column dy_m out");
    motion.time.push_back(time), motion.pitch.push_back(pitch), motion.displacement.push_back(place);
  }
  // getline() also ends for folders and failing disks.
  LGIW_VALIDATE(file.eof() && !file.bad(), path + " cannot be read", "it is no text file or the disk fails",
                "name a CSV file");
  if (motion.time.empty())
    refuse("the motion has no rows", "a body moves from row to row", "add rows with t_s,dx_m,dz_m");
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
