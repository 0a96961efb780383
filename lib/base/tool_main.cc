#include "base/tool_main.hh"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <new>

#include "base/error.hh"

namespace lgiw {
namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

bool stderr_is_terminal() { return isatty(STDERR_FILENO) == 1; }

/// Libraries (HDF5, GDAL) put line breaks into their messages; an error here is one line.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  text.erase(std::unique(text.begin(), text.end(), [](char a, char b) { return a == ' ' && b == ' '; }), text.end());
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

int report(const std::string& tool, const std::string& message, int status) {
  std::cerr << tool << ": " << one_line(message) << std::endl;
  return status;
}

std::string shell_quoted(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || std::string("_-./=:,+@%").find(c) != std::string::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

bool CommonOptions::show_progress() const { return !quiet && (progress || stderr_is_terminal()); }

void add_common_options(CLI::App& app, CommonOptions& options, const std::string& library_versions) {
  const std::string group = "Common options";
  app.add_flag("-O,--overwrite", options.overwrite, "Replace outputs that exist")->group(group);
  app.add_flag("-q,--quiet", options.quiet, "Nothing on stderr but errors")->group(group);
  app.add_flag("-v,--verbose", options.verbose, "More on stderr; may be repeated")->group(group);
  app.add_flag("--progress", options.progress, "Progress even where stderr is no terminal")->group(group);
  app.add_flag_callback(
         "--no-provenance", [&options] { options.provenance = false; },
         "Leave command line and versions out of the outputs")
      ->group(group);
  app.add_flag("--json", options.json, "Summary on stdout as JSON")->group(group);
  app.set_version_flag("--version", app.get_name() + " " + version_string() + "\n" + library_versions)->group(group);
}

int tool_main(CLI::App& app, int argc, char** argv, const std::function<int()>& run) {
  const std::string tool = app.get_name();
  try {
    app.parse(argc, argv);
    const int status = run();
    // The shell tells of a full disk behind stdout only here.
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0)
      throw WorkError("stdout was not written", "the pipe or disk behind it took no more", "make room, then run again");
    return status;
  } catch (const CLI::Success& e) {  // --help, --version
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return report(tool, std::string(e.what()) + " (the command line is not understood) try " + tool + " --help", 2);
  } catch (const InputError& e) {
    return report(tool, e.what(), 2);
  } catch (const BackendError& e) {
    return report(tool, e.what(), 3);
  } catch (const std::bad_alloc&) {
    return report(tool, "out of memory (the machine has less than the case needs) take a larger particle spacing", 1);
  } catch (const std::exception& e) {
    return report(tool, e.what(), 1);
  }
}

std::string command_line(int argc, char** argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) line += (i ? " " : "") + shell_quoted(argv[i]);
  return line;
}

std::string format_duration(double seconds) {
  if (!std::isfinite(seconds)) return "unknown";
  const long long s = std::llround(std::clamp(seconds, 0.0, 1e12));
  char text[64];
  if (s < 60)
    std::snprintf(text, sizeof text, "%lld s", s);
  else if (s < 3600)
    std::snprintf(text, sizeof text, "%lld min %02lld s", s / 60, s % 60);
  else if (s < 86400)
    std::snprintf(text, sizeof text, "%lld h %02lld min", s / 3600, s % 3600 / 60);
  else
    std::snprintf(text, sizeof text, "%lld d %02lld h", s / 86400, s % 86400 / 3600);
  return text;
}

std::string progress_line(const std::string& what, double fraction, double elapsed_seconds, const std::string& note) {
  const double f = std::clamp(fraction, 0.0, 1.0);
  std::string line = what + "  " + std::to_string(static_cast<int>(100 * f)) + " %";
  if (f >= 1)
    line += "  done in " + format_duration(elapsed_seconds);
  else if (f >= 0.01 && elapsed_seconds >= 2)  // earlier the estimate is mostly start-up
    line += "  ETA " + format_duration(elapsed_seconds * (1 - f) / f);
  if (!note.empty()) line += "  " + note;
  return line;
}

Progress::Progress(bool shown, std::string what)
    : shown_(shown), terminal_(stderr_is_terminal()), what_(std::move(what)), start_(now()) {}

Progress::~Progress() {
  if (shown_ && terminal_ && last_ >= 0) std::fputc('\n', stderr);  // leaves the line for what follows
}

void Progress::update(double fraction, const std::string& note) {
  if (!shown_ || last_fraction_ >= 1) return;
  const double time = now();
  const bool due = terminal_ ? time - last_ >= 0.2 : std::floor(10 * fraction) > std::floor(10 * last_fraction_);
  if (last_ >= 0 && !due && fraction < 1) return;
  const std::string line = progress_line(what_, fraction, time - start_, note);
  std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", line.c_str());
  std::fflush(stderr);
  last_ = time;
  last_fraction_ = fraction;
}

}  // namespace lgiw
