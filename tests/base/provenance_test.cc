#include "base/provenance.hh"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "base/error.hh"

namespace lgiw {
namespace {

std::string written(const std::string& text) {
  std::string name = (std::filesystem::temp_directory_path() / "lgiw-provenance-XXXXXX").string();
  close(mkstemp(name.data()));
  std::ofstream(name, std::ios::binary) << text;
  return name;
}

// FIPS 180-2, appendix B.
TEST(Sha256, KnownVectors) {
  EXPECT_EQ(sha256_of_text("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_text("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_of_text(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Sha256, OfAFileLongerThanTheBuffer) {
  // A million times "a" is FIPS 180-2's third vector; three times as many do not fit one buffer.
  const std::string million(1000000, 'a');
  std::string path = written(million);
  EXPECT_EQ(sha256_of_file(path), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  std::filesystem::remove(path);
  path = written(million + million + million);
  EXPECT_EQ(sha256_of_file(path), sha256_of_text(million + million + million));
  std::filesystem::remove(path);
}

TEST(Sha256, UnreadableFilesAreNamed) {
  try {
    sha256_of_file("/no/such/dem.tif");
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "/no/such/dem.tif cannot be read (No such file or directory) check the name and its permissions");
  }
  try {
    sha256_of_file("/");
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "/ cannot be read (Is a directory) check the name and its permissions");
  }
}

TEST(Provenance, SaysWhatWasRunOnWhat) {
  const std::string path = written("abc");
  Provenance provenance{"gauges", "0.1.0 (git 1a2b3c4)", "gauges 'my run.h5' -o g.csv", {}, true};
  provenance.add_input(path);
  provenance.add_text("stdin", "");
  std::filesystem::remove(path);
  const auto json = nlohmann::json::parse(provenance.to_json());
  EXPECT_EQ(json["tool"], "gauges");
  EXPECT_EQ(json["version"], "0.1.0 (git 1a2b3c4)");
  EXPECT_EQ(json["command_line"], "gauges 'my run.h5' -o g.csv");
  ASSERT_EQ(json["inputs"].size(), 2u);
  EXPECT_EQ(json["inputs"][0]["path"], path);
  EXPECT_EQ(json["inputs"][0]["sha256"], "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(json["inputs"][1]["path"], "stdin");
  EXPECT_EQ(json["inputs"][1]["sha256"], "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(json.size(), 4u) << "no time, no host: reruns are byte-identical";
}

TEST(Provenance, APipeIsNamedWithoutAHash) {
  Provenance provenance{"gauges", "0.1.0", "gauges -", {}, true};
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const std::string name = "/dev/fd/" + std::to_string(ends[0]);
  provenance.add_input(name);
  provenance.add_input("-");
  close(ends[0]), close(ends[1]);
  const nlohmann::json inputs = nlohmann::json::parse(provenance.to_json()).at("inputs");
  EXPECT_EQ(inputs[0].at("path"), name);
  EXPECT_TRUE(inputs[0].at("sha256").is_null());
  EXPECT_EQ(inputs[1].at("path"), "stdin");
  EXPECT_TRUE(inputs[1].at("sha256").is_null());
}

TEST(Provenance, DisabledIsEmpty) {
  Provenance provenance{"gauges", "0.1.0", "gauges run.h5", {}, false};
  provenance.add_text("stdin", "abc");
  EXPECT_EQ(provenance.to_json(), "{}");
  EXPECT_TRUE(provenance.inputs.empty());
  // make is told of a file all the same, of which no hash is taken.
  provenance.add_input("there is no such file");
  EXPECT_EQ(provenance.inputs.size(), 1u);
  EXPECT_EQ(provenance.to_json(), "{}");
}

TEST(Provenance, NamesThatAreNoUtf8AreStillJson) {
  Provenance provenance{"gauges", "0.1.0", "gauges \xff.h5", {}, true};
  EXPECT_EQ(nlohmann::json::parse(provenance.to_json())["command_line"], "gauges \xEF\xBF\xBD.h5");
}

TEST(Version, NamesProjectVersionAndCommit) {
  EXPECT_TRUE(std::regex_match(version_string(), std::regex(R"(\d+\.\d+\.\d+ \((git \S+|no git)\))")))
      << version_string();
}

}  // namespace
}  // namespace lgiw
