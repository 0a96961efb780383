// Errors as a user meets them: one line, `PROBLEM (WHY IT IS ONE) SUGGESTION`.
// Four checks with four meanings: LGIW_EXPECT (on entry), LGIW_ASSERT (inside) and LGIW_ENSURE (on exit) are for the
// programmer and vanish in release builds; LGIW_VALIDATE is for what a user hands in and never vanishes.
#pragma once

#include <cassert>
#include <stdexcept>
#include <string>

namespace lgiw {

/// The call or an input is wrong; nothing has been started. Exit status 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
  InputError(const std::string& problem, const std::string& why, const std::string& suggestion)
      : std::runtime_error(problem + " (" + why + ") " + suggestion) {}
};

/// The work itself failed (disk full, diverged run). Exit status 1.
struct WorkError : std::runtime_error {
  using std::runtime_error::runtime_error;
  WorkError(const std::string& problem, const std::string& why, const std::string& suggestion)
      : std::runtime_error(problem + " (" + why + ") " + suggestion) {}
};

/// The backend asked for is not on this machine. Exit status 3.
struct BackendError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lgiw

#define LGIW_VALIDATE(condition, problem, why, suggestion)                \
  do {                                                                    \
    if (!(condition)) throw ::lgiw::InputError(problem, why, suggestion); \
  } while (false)
#define LGIW_EXPECT(condition) assert(condition)
#define LGIW_ASSERT(condition) assert(condition)
#define LGIW_ENSURE(condition) assert(condition)
