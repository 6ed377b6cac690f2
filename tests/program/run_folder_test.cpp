// Folders of runs: nothing in one is replaced without being asked to, written through a link, or left behind.
#include "ringlet/run/run_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "ringlet/base/whole_file.h"
#include "ringlet/output/animation_writer.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::run_folder_test {
namespace {

namespace fs = std::filesystem;
using test::readText;
using test::runProgram;

// "hair.usda" and so on.
std::vector<std::string> animations() {
  std::vector<std::string> names;
  for (const AnimationFormat& format : animationFormats())
    names.push_back(std::string("hair") + format.extension);
  return names;
}

class Folders : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "groom.obj") << "v 0 0 0\nv 0 -1 0\nv 0 -2 0\nl 1 2 3\n";
    std::ofstream(folder_ / "victim") << kSecret;
  }
  // Every file that a run can write.
  test::ProgramResult simulate(const std::vector<std::string>& more, const char* frames = "3") const {
    std::vector<std::string> all{"simulate", "groom.obj", "--backend", "reference", "--frames", frames,
                                 "--quiet",  "-o",        "out",       "--cache",   "float32"};
    for (const std::string& name : animations()) {
      if (name != "hair.usda" && name != "hair.rgc") all.insert(all.end(), {"--also", name});
    }
    all.insert(all.end(), more.begin(), more.end());
    return runProgram(folder_, all);
  }
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out"))
      if (entry.is_regular_file()) all[entry.path().filename()] = readText(entry.path());
    return all;
  }
  std::string victim() const { return readText(folder_ / "victim"); }

  static constexpr const char* kSecret = "not to be replaced";
  const fs::path folder_ = test::scratchFolder("run_folder");
};

TEST_F(Folders, AFinishedRunIsNotReplacedUnasked) {
  ASSERT_EQ(simulate({}).exitCode, 0);
  const auto finished = files();
  EXPECT_EQ(finished.size(), animations().size() + 3) << "last.obj, sheet.png, hair.obj of hair.pc2";
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{}, {"--resume"}, {"--checkpoint", "1"}}) {
    const auto refused = simulate(how, "2");
    EXPECT_EQ(refused.exitCode, 5);
    EXPECT_NE(refused.err.find("holds a run's files: hair.usda"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("--overwrite replaces them"), std::string::npos) << refused.err;
    EXPECT_TRUE(files() == finished);
  }
  EXPECT_EQ(runProgram(folder_, {"scene", "hanging_curl", "--seconds", "0.1", "-o", "out"}).exitCode, 5);
  EXPECT_TRUE(files() == finished);
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"--overwrite"}, {"--overwrite", "--resume"}}) {
    EXPECT_EQ(simulate(how, "2").exitCode, 0);
    EXPECT_FALSE(files() == finished);
    EXPECT_EQ(simulate(how).exitCode, 0);
    EXPECT_TRUE(files() == finished) << "the same run has the same bits";
  }
}

// Each of them alone, whoever made it.
TEST_F(Folders, NoFileIsReplacedUnasked) {
  std::vector<std::string> names = animations();
  names.insert(names.end(), {"last.obj", "sheet.png"});
  for (const std::string& name : names) {
    fs::remove_all(folder_ / "out");
    fs::create_directory(folder_ / "out");
    std::ofstream(folder_ / "out" / name) << kSecret;
    const auto refused = simulate({});
    EXPECT_EQ(refused.exitCode, 5) << name;
    EXPECT_NE(refused.err.find(name), std::string::npos) << refused.err;
    EXPECT_TRUE(files() == (std::map<std::string, std::string>{{name, kSecret}})) << name;
  }
  // A link under such a name is there too, wherever it leads: to nothing, as when another disk is away.
  for (const std::string& name : names) {
    fs::remove_all(folder_ / "out");
    fs::create_directory(folder_ / "out");
    fs::create_symlink("../away/" + name, folder_ / "out" / name);
    const auto refused = simulate({});
    EXPECT_EQ(refused.exitCode, 5) << name;
    EXPECT_NE(refused.err.find(name), std::string::npos) << refused.err;
    EXPECT_TRUE(fs::is_symlink(folder_ / "out" / name)) << name;
  }
  // What a run does not write is nobody's concern.
  fs::remove_all(folder_ / "out");
  fs::create_directory(folder_ / "out");
  std::ofstream(folder_ / "out/notes.txt") << kSecret;
  EXPECT_EQ(simulate({}).exitCode, 0);
  EXPECT_EQ(files()["notes.txt"], kSecret);
}

// However it is named: as the groom, as what a scene names, through a link, through a folder on the way.
TEST_F(Folders, ARunReplacesNothingThatItReads) {
  ASSERT_EQ(simulate({}).exitCode, 0);
  const auto before = files();
  fs::create_directory(folder_ / "in");
  fs::create_hard_link(folder_ / "out/last.obj", folder_ / "in/hard.obj");
  fs::create_symlink("../out/last.obj", folder_ / "in/soft.obj");
  const auto scene = [&](const char* name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return std::string(name);
  };
  const std::string groom = "[groom]\nfile = \"groom.obj\"\n";
  for (const std::string& input :
       {std::string("out/last.obj"), (folder_ / "out/last.obj").string(), std::string("in/../out/last.obj"),
        std::string("in/hard.obj"), std::string("in/soft.obj"), std::string("out/hair.usda"),
        std::string("out/hair.usdc"), scene("groom.toml", "[groom]\nfile = \"out/last.obj\"\n"),
        scene("body.toml", groom + "[[body]]\nname = \"b\"\nshape = \"mesh\"\nfile = \"out/last.obj\"\n"),
        scene("goal.toml", groom + "[goal]\nfile = \"out/hair.rgc\"\n"),
        scene("hairs.toml", groom + "[output]\nhairs = 9\nhair_scalp_file = \"out/last.obj\"\n")}) {
    std::vector<std::string> all{"simulate", input,     "--backend", "reference",  "--frames",
                                 "2",        "--quiet", "-o",        "out",        "--cache",
                                 "float32",  "--also",  "hair.usdc", "--overwrite"};
    const auto refused = runProgram(folder_, all);
    EXPECT_EQ(refused.exitCode, 5) << input;
    EXPECT_NE(refused.err.find("is read by this run and would be overwritten"), std::string::npos)
        << input << ": " << refused.err;
    EXPECT_TRUE(files() == before) << input;
  }
}

TEST_F(Folders, NothingIsWrittenThroughALink) {
  std::vector<std::string> names = animations();
  for (std::string& name : names) name += ".partial";
  for (const std::string& name : names) {
    fs::remove_all(folder_ / "out");
    fs::create_directory(folder_ / "out");
    fs::create_symlink("../victim", folder_ / "out" / name);
    const auto refused = simulate({"--overwrite"});
    EXPECT_EQ(refused.exitCode, 5) << name;
    EXPECT_NE(refused.err.find("is a symbolic link; remove it"), std::string::npos) << refused.err;
    EXPECT_EQ(victim(), kSecret) << name;
  }
  for (std::string& name : names) name.resize(name.rfind('.'));
  names.insert(names.end(), {"last.obj", "sheet.png", "checkpoint.rgk", "hair.obj"});
  fs::remove_all(folder_ / "out");
  fs::create_directory(folder_ / "out");
  for (const std::string& name : names) fs::create_symlink("../victim", folder_ / "out" / name);
  EXPECT_EQ(simulate({"--overwrite", "--checkpoint", "1"}).exitCode, 0);
  EXPECT_EQ(victim(), kSecret) << "links under final names are replaced";
  for (const auto& [name, text] : files()) EXPECT_NE(text, kSecret) << name;
}

// What is written at once has a name of its own until it is whole.
TEST_F(Folders, WhatAKilledRunLeavesIsClearedAway) {
  ASSERT_EQ(simulate({}).exitCode, 0);
  std::vector<std::string> written{"checkpoint.rgk", "hair.usda.cuts.csv"};
  for (const auto& [name, text] : files()) written.push_back(name);
  const auto leave = [&] {
    for (const std::string& name : written)
      std::ofstream(folder_ / "out" / (name + ".18a3f-0.partial")) << "half";
    for (const char* others : {"notes.18a3f-0.partial", "last.obj.partial", "last.obj.old-0.partial"})
      std::ofstream(folder_ / "out" / others) << kSecret;
  };
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"--overwrite"}, {"--overwrite", "--resume"}}) {
    leave();
    EXPECT_EQ(simulate(how).exitCode, 0);
    for (const auto& [name, text] : files()) {
      if (text != kSecret) {
        EXPECT_FALSE(name.ends_with(".partial")) << name;
      }
    }
    EXPECT_EQ(std::ranges::count(files(), kSecret, [](const auto& file) { return file.second; }), 3);
  }
}

TEST(WholeFile, KnowsItsTemporaries) {
  EXPECT_EQ(fileOfTemporary("a/last.obj.18a3f-0.partial"), fs::path("a/last.obj"));
  EXPECT_EQ(fileOfTemporary("hair.usda.cuts.csv.1-ff.partial"), fs::path("hair.usda.cuts.csv"));
  for (const char* other :
       {"hair.usda.partial", "hair.usda", "x.18a3f-0", "x.18a3f-.partial", "x.-0.partial", "x.18g-0.partial",
        "x.18-0g.partial", "x.18g0.partial", "x.18_0.partial", ".partial", ""})
    EXPECT_FALSE(fileOfTemporary(other)) << other;
}

TEST_F(Folders, ARunThatWritesNothingSaysSo) {
  const auto run = [&](const std::vector<std::string>& more) {
    fs::remove_all(folder_ / "out");
    std::vector<std::string> all{"simulate", "groom.obj", "--backend", "reference",
                                 "--frames", "2",         "-o",        "out"};
    all.insert(all.end(), more.begin(), more.end());
    return runProgram(folder_, all).err.find("nothing will be written into out") != std::string::npos;
  };
  EXPECT_TRUE(run({"--no-usd", "--no-last", "--no-sheet"}));
  EXPECT_FALSE(run({"--no-usd", "--no-last", "--no-sheet", "--json"})) << "its numbers are what it is for";
  EXPECT_FALSE(run({"--no-usd", "--no-last"}));
  EXPECT_FALSE(run({}));
}

// A frame of this takes a minute.
TEST_F(Folders, ASecondSignalOfAnyKindEndsAtOnce) {
  ASSERT_EQ(runProgram(folder_, {"make", "head", "--strands", "3000", "--particles", "64", "-o", "head.hair"})
                .exitCode,
            0);
  for (const int first : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    for (const int second : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
      fs::remove_all(folder_ / "out");
      test::RunningProgram program(folder_, {"simulate", "head.hair", "--backend", "reference", "--frames",
                                             "2", "--steps-per-frame", "340", "--quiet", "-o", "out"});
      EXPECT_TRUE(program.waitUntil([&] { return fs::exists(folder_ / "out/.ringlet.lock"); }));
      program.send(first);
      // A second one of the same kind is one with the first until that is handled.
      if (first == second) {
        EXPECT_TRUE(program.waitUntil([&] { return program.handles(first) == false; }));
      }
      program.send(second);
      EXPECT_EQ(program.wait().exitCode, -1) << first << " then " << second;
    }
  }
}

}  // namespace
}  // namespace ringlet::run_folder_test
