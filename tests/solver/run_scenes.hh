// Two small 2-D scenes for the tool lgiw-run, and a run of it that a test can interrupt.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

#include "../tools/tool_runner.hh"

namespace lgiw::test {

/// A wedge of soil slides down 45 degrees into 0.4 m of water; tests/robustness use it as well.
const std::string slide_case = read_bytes(LGIW_TEST_DATA "/slide.yaml");

/// A column of water, 0.2 m by 0.2 m, breaks over a dry bed with an open end.
const std::string dam_case = R"(name: dam
dimension: 2
particle_spacing: 0.01
terrain: {profile: [[0, 0], [1.5, 0]], sides: {east: open}}
water: {level: 0.2, bodies: [[[0, 0], [0.2, 0], [0.2, 0.2], [0, 0.2]]]}
gauges:
- {name: G1, x: 0.1}
- {name: P1, x: 0, z: 0.05, quantity: pressure}
- {name: P2, x: 0.5, z: 0, quantity: pressure}
output: {end_time: 0.6, frame_interval: 0.2, surface_interval: 0.01}
)";

/// Makes NAME.h5 of a case; true on success.
inline bool make_particles(const Workshop& shop, const std::string& name, const std::string& text) {
  write_bytes(shop / (name + ".yaml"), text);
  const Outcome made = shop.run("dem2particles " + name + ".yaml -o " + name + ".h5 -q");
  EXPECT_EQ(made.status, 0) << made.err;
  return made.status == 0;
}

inline long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

/// A command of the shell in the workshop's folder, running beside the test. Killed with the object.
class Background {
 public:
  Background(const Workshop& shop, const std::string& command) : err_(shop / "background.err") {
    fs::remove(err_);
    const std::string line = "cd '" + (shop / "").string() +
                             "' && PATH='" LGIW_BIN_DIR "':\"$PATH\" && export OMP_NUM_THREADS=2 && exec " + command +
                             " >/dev/null 2>background.err";
    child_ = fork();
    if (child_ == 0) {
      execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
  }
  ~Background() {
    if (child_ > 0) kill(child_, SIGKILL), waitpid(child_, nullptr, 0);
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  std::string err() const { return read_bytes(err_); }
  /// Whether `ready` came true before the command ended, within a minute.
  bool reached(const std::function<bool()>& ready) {
    for (int k = 0; k < 30000; ++k) {
      if (ready()) return true;
      siginfo_t info{};
      if (waitid(P_PID, id_t(child_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == child_) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }
  /// The progress has come to more than its first line, or says `word`.
  bool under_way(const std::string& word = "10 %") {
    return reached([&] { return err().find(word) != std::string::npos; });
  }
  void send(int signal) { kill(child_, signal); }
  /// The exit status, 128 + signal when a signal ended the command.
  int wait() {
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  fs::path err_;
  pid_t child_ = -1;
};

}  // namespace lgiw::test
