// --confined: scenes of strangers, in every command that reads one.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::confined_test {
namespace {

namespace fs = std::filesystem;
using test::runProgram;

class Confined : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(folder_ / "scene");
    std::ofstream(folder_ / "groom.obj") << "v 0 0 0\nv 0 -1 0\nv 0 -2 0\nl 1 2 3\n";
    fs::copy_file(folder_ / "groom.obj", folder_ / "scene/groom.obj");
  }
  void writeScene(const std::string& groom, const std::string& output) const {
    std::ofstream(folder_ / "scene/s.toml")
        << "[groom]\nfile = '" << groom << "'\n[simulation]\nframes = 2\n[output]\nfolder = '" << output
        << "'\n";
  }
  const fs::path folder_ = test::scratchFolder("confined");
};

TEST_F(Confined, EveryCommandThatReadsScenesRefusesFilesElsewhere) {
  writeScene("../groom.obj", "out");
  ASSERT_EQ(
      runProgram(folder_, {"simulate", "groom.obj", "--backend", "reference", "--frames", "2", "-o", "run"})
          .exitCode,
      0);
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"simulate", "scene/s.toml", "--backend", "reference"},
           {"sweep", "scene/s.toml", "--backend", "reference", "--vary", "material.dials.hold=1,2", "-o",
            "swept"},
           {"render", "scene/s.toml", "-o", "drawn"},
           {"render", "run", "--scene", "scene/s.toml", "-o", "drawn"},
           {"convert", "run/hair.usda", "full.usdc", "--hairs", "9", "--scene", "scene/s.toml"},
           {"view", "scene/s.toml"}}) {
    std::vector<std::string> all = command;
    all.push_back("--confined");
    const auto refused = runProgram(folder_, all);
    EXPECT_NE(refused.exitCode, 0) << command[0];
    EXPECT_NE(refused.err.find("a path in or below the scene's folder, to which it is confined"),
              std::string::npos)
        << command[0] << ": " << refused.err;
    for (const char* made : {"scene/out", "swept", "drawn", "full.usdc"})
      EXPECT_FALSE(fs::exists(folder_ / made));
  }
  EXPECT_EQ(runProgram(folder_, {"simulate", "scene/s.toml", "--backend", "reference"}).exitCode, 0);
}

TEST_F(Confined, ResultsStayBelowTheScene) {
  writeScene("groom.obj", "out");
  const std::vector<std::string> simulate{"simulate", "scene/s.toml", "--backend", "reference", "--confined"};
  EXPECT_EQ(runProgram(folder_, simulate).exitCode, 0);
  EXPECT_TRUE(fs::exists(folder_ / "scene/out/hair.usda"));
  for (const char* outside : {"../out", "link", "link/deeper"}) {
    writeScene("groom.obj", outside);
    fs::remove(folder_ / "scene/link");
    fs::create_directory_symlink("../elsewhere", folder_ / "scene/link");
    fs::create_directory(folder_ / "elsewhere");
    EXPECT_NE(runProgram(folder_, simulate).exitCode, 0) << outside;
    EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
  // A folder within the results that leads elsewhere.
  writeScene("groom.obj", "parts");
  fs::create_directory(folder_ / "scene/parts");
  fs::create_directory_symlink("../../elsewhere", folder_ / "scene/parts/hair_clips");
  std::vector<std::string> clips = simulate;
  clips.insert(clips.end(), {"--clips", "1"});
  const auto refused = runProgram(folder_, clips);
  EXPECT_EQ(refused.exitCode, 5);
  EXPECT_NE(refused.err.find("parts/hair_clips is a symbolic link"), std::string::npos) << refused.err;
  EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
  // Further down too.
  fs::remove(folder_ / "scene/parts/hair_clips");
  fs::create_directories(folder_ / "scene/parts/hair_clips/older");
  fs::create_directory_symlink("../../../../elsewhere", folder_ / "scene/parts/hair_clips/older/link");
  const auto deeper = runProgram(folder_, clips);
  EXPECT_EQ(deeper.exitCode, 5);
  EXPECT_NE(deeper.err.find("hair_clips/older/link is a symbolic link"), std::string::npos) << deeper.err;
  EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
  // What is typed is the user's.
  std::vector<std::string> typed = simulate;
  typed.insert(typed.end(), {"-o", "mine", "--motion", "still"});
  EXPECT_EQ(runProgram(folder_, typed).exitCode, 0);
  EXPECT_TRUE(fs::exists(folder_ / "mine/hair.usda"));
}

}  // namespace
}  // namespace ringlet::confined_test
