#include "base/make_rule.hh"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace lgiw {
namespace {

// As make itself reads it: all that would run after an edit of any input, and nothing else.
TEST(MakeRule, MakeSeesAnEditOfAnyInputWhateverItsName) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("lgiw-make-rule-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::vector<std::string> inputs;
  for (const char* name : {"plain.tif", "with space.tif", "price$.tif", "number#1.tif", "a:b.tif", "level=1,x=2.tif"}) {
    inputs.push_back((folder / name).string());
    std::ofstream(inputs.back()) << name;
  }
  std::vector<std::string> named = inputs;
  named.push_back("/vsicurl/https://nowhere/dem.tif");
  const std::string target = (folder / "run=1" / "particles.h5").string();
  fs::create_directories(folder / "run=1");
  std::ofstream(folder / "makefile") << "target := " << target << "\nall: $(target)\n$(target):\n\techo made\n"
                                     << make_rule(target, named);
  const auto runs = [&] {
    const std::string command = "env -u MAKEFLAGS -u MAKELEVEL make -n -C " + folder.string() + " all 2>&1";
    FILE* const pipe = popen(command.c_str(), "r");
    std::string text;
    for (int c; (c = fgetc(pipe)) != EOF;) text += char(c);
    EXPECT_EQ(pclose(pipe), 0) << text;
    return text.find("echo made") != std::string::npos;
  };
  EXPECT_TRUE(runs());
  const auto now = fs::file_time_type::clock::now();
  for (const std::string& input : inputs) fs::last_write_time(input, now - std::chrono::hours(2));
  std::ofstream(target) << "made";
  fs::last_write_time(target, now - std::chrono::hours(1));
  EXPECT_FALSE(runs());
  for (const std::string& input : inputs) {
    fs::last_write_time(input, now);
    EXPECT_TRUE(runs()) << input;
    fs::last_write_time(input, now - std::chrono::hours(2));
  }
  EXPECT_FALSE(runs());
  fs::remove(inputs[0]);
  EXPECT_TRUE(runs()) << "one that is gone stops nothing";
  fs::remove_all(folder);
}

}  // namespace
}  // namespace lgiw
