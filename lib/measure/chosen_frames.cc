#include "measure/chosen_frames.hh"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "base/error.hh"

namespace lgiw {

std::vector<std::size_t> chosen_frames(const std::string& option, const std::vector<std::string>& words,
                                       const RunReader& run) {
  std::vector<std::size_t> frames;
  const std::size_t last = run.frame_count() - 1;
  for (const std::string& word : words) {
    if (word == "first" || word == "last") {
      frames.push_back(word == "first" ? 0 : last);
      continue;
    }
    char* end = nullptr;
    const double time = std::strtod(word.c_str(), &end);
    LGIW_VALIDATE(!word.empty() && *end == '\0' && std::isfinite(time), option + " has '" + word + "'",
                  "it is neither first, last nor a time in s", "write for example " + option + " first,20,last");
    std::ostringstream range;
    range << "the run's frames are from " << run.frame_time(0) << " s to " << run.frame_time(last) << " s";
    LGIW_VALIDATE(time >= run.frame_time(0) && time <= run.frame_time(last), "there is no frame at " + word + " s",
                  range.str(), "name a time between them");
    std::size_t nearest = 0;
    for (std::size_t k = 1; k <= last; ++k)
      if (std::abs(run.frame_time(k) - time) < std::abs(run.frame_time(nearest) - time)) nearest = k;
    frames.push_back(nearest);
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

}  // namespace lgiw
