// What the world does to a run: nobody hears it, memory ends, signals come, folders vanish. Each has its
// message and its exit status. Full disks and lost devices: resume_test.cpp.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::fault_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::readText;
using test::RunningProgram;
using test::runProgram;
using test::scratchFolder;

class Fault : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(runProgram(folder_, {"make", "curl", "--particles", "32", "-o", "curl.obj"}).exitCode, 0);
  }
  // With a shell's redirections.
  int shell(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder_.string() + "' && '" RINGLET_BUILD_DIR "/ringlet' " + arguments;
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  fs::path folder_ = scratchFolder("fault");
  const std::string small_ = "simulate curl.obj --backend reference --frames 2 --steps-per-frame 1 ";
};

// With one step a frame there is a warning to be said.
TEST_F(Fault, ARunIsDoneThoughNobodyHearsOfIt) {
  for (const char* deaf : {"2>/dev/full", "2>&-"}) {
    fs::remove_all(folder_ / "out");
    EXPECT_EQ(shell(small_ + "--json -o out >json.txt " + deaf), 0) << deaf;
    const json report = json::parse(readText(folder_ / "json.txt"), nullptr, false);
    ASSERT_TRUE(report.is_object()) << deaf;
    EXPECT_FALSE(report["warnings"].empty());
    EXPECT_EQ(shell(std::string("simulate none.obj -o out ") + deaf), 4) << deaf;
    EXPECT_EQ(shell(std::string("simulate --nosuch ") + deaf), 2) << deaf;
  }
}

TEST_F(Fault, OutputThatCannotBePrintedIsAFailure) {
  for (const char* command : {"--help", "--version", "material --list", "scene --list", "devices"})
    EXPECT_EQ(shell(std::string(command) + " >/dev/full 2>/dev/null"), 5) << command;
  EXPECT_EQ(shell(small_ + "--json -o out >/dev/full 2>/dev/null"), 5);
  EXPECT_TRUE(fs::exists(folder_ / "out/hair.usda")) << "its files are whole all the same";
}

// A reader of --json-progress that goes away ends nothing.
TEST_F(Fault, AClosedPipeEndsNoRun) {
  EXPECT_EQ(shell("simulate curl.obj --backend reference --frames 40 --json-progress --quiet -o out | head "
                  "-c 1 >/dev/null; "
                  "sleep 0; true"),
            0);
  EXPECT_TRUE(fs::exists(folder_ / "out/sheet.png"));
}

TEST_F(Fault, MemoryThatEndsIsSaid) {
  ASSERT_EQ(runProgram(folder_, {"make", "head", "--strands", "4000", "--particles", "64", "-o", "head.hair"})
                .exitCode,
            0);
  struct rlimit before {};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  int refusals = 0;
  for (const rlim_t mebibytes : {50, 70, 90}) {
    fs::remove_all(folder_ / "out");
    struct rlimit small = before;
    small.rlim_cur = mebibytes << 20;
    ASSERT_EQ(setrlimit(RLIMIT_AS, &small), 0);
    RunningProgram running(folder_, {"simulate", "head.hair", "--backend", "reference", "--frames", "1",
                                     "--steps-per-frame", "1", "-o", "out"});
    ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
    const auto result = running.wait();
    if (result.exitCode == 0) continue;
    ++refusals;
    EXPECT_EQ(result.exitCode, 8) << mebibytes << " MiB: " << result.err;
    EXPECT_NE(result.err.find("not enough memory"), std::string::npos) << result.err;
  }
  EXPECT_GE(refusals, 1);
}

TEST_F(Fault, EverySignalThatEndsARunKeepsItsFrames) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    fs::remove_all(folder_ / "out");
    RunningProgram program(folder_, {"simulate", "curl.obj", "--backend", "reference", "--frames", "100000",
                                     "--quiet", "--json-progress", "-o", "out"});
    EXPECT_TRUE(program.waitUntil([&] { return !readText(folder_ / "stdout.txt").empty(); }));
    program.send(signal);
    const auto result = program.wait();
    EXPECT_EQ(result.exitCode, 130) << signal;
    EXPECT_TRUE(fs::exists(folder_ / "out/hair.usda")) << signal;
    EXPECT_FALSE(fs::exists(folder_ / "out/.ringlet.lock")) << signal;
  }
}

// The layer stands for a driver that compiles for minutes, or a device that takes as long for its first
// frame.
TEST_F(Fault, ASignalIsHeardWhileTheDriverIsAtWork) {
  RINGLET_NEEDS_DEVICE(folder_);
  setenv("VK_LAYER_PATH", RINGLET_LAYER_DIR, 1);
  setenv("VK_INSTANCE_LAYERS", "VK_LAYER_RINGLET_fault", 1);
  for (const char* fault : {"vkCreateComputePipelines:1:hang", "vkWaitForFences:1:hang"}) {
    fs::remove_all(folder_ / "out");
    setenv("RINGLET_FAULT", fault, 1);
    RunningProgram program(
        folder_, {"simulate", "curl.obj", "--frames", "2", "--checkpoint", "1", "--quiet", "-o", "out"});
    EXPECT_TRUE(program.waitUntil([&] { return fs::exists(folder_ / "out"); }));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    program.send(SIGTERM);
    // A program that does not hear it would be waited for until the test's own end.
    std::jthread late([&](const std::stop_token& over) {
      for (int i = 0; i < 600 && !over.stop_requested(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
      if (!over.stop_requested()) program.send(SIGKILL);
    });
    const auto result = program.wait();
    late.request_stop();
    EXPECT_EQ(result.exitCode, 130) << fault << result.err;
    EXPECT_NE(result.err.find("while the driver was at work"), std::string::npos) << result.err;
    unsetenv("RINGLET_FAULT");
    // The folder is free.
    const auto again = runProgram(folder_, {"simulate", "curl.obj", "--frames", "2", "--checkpoint", "1",
                                            "--resume", "--quiet", "-o", "out"});
    EXPECT_EQ(again.exitCode, 0) << again.err;
    EXPECT_TRUE(fs::exists(folder_ / "out/hair.usda"));
  }
  unsetenv("VK_INSTANCE_LAYERS");
}

TEST_F(Fault, AFolderThatVanishesIsSaid) {
  RunningProgram program(folder_, {"simulate", "curl.obj", "--backend", "reference", "--frames", "200",
                                   "--quiet", "--json-progress", "-o", "out"});
  EXPECT_TRUE(program.waitUntil([&] { return !readText(folder_ / "stdout.txt").empty(); }));
  fs::remove_all(folder_ / "out");
  const auto result = program.wait();
  EXPECT_EQ(result.exitCode, 5) << result.err;
  EXPECT_EQ(result.err.find("are kept"), std::string::npos) << "nothing is: " << result.err;
}

// A file system of 300 KiB, of which the run needs some 450.
TEST_F(Fault, AFullFileSystemKeepsItsFrames) {
  if (std::system("unshare -m true 2>/dev/null") != 0) GTEST_SKIP() << "SKIPPED: may not mount a file system";
  std::ofstream(folder_ / "full.sh")
      << "mkdir -p out && mount -t tmpfs -o size=300k none out || exit 77\n'" RINGLET_BUILD_DIR
         "/ringlet' simulate curl.obj --backend reference --frames 400 --quiet -o out\n"
         "echo $? >status.txt\ncp out/hair.usda.partial kept.usda.partial\n";
  const std::string command = "cd '" + folder_.string() + "' && unshare -m sh full.sh 2>err.txt";
  ASSERT_EQ(std::system(command.c_str()), 0) << readText(folder_ / "err.txt");
  EXPECT_EQ(readText(folder_ / "status.txt"), "6\n") << readText(folder_ / "err.txt");
  EXPECT_NE(readText(folder_ / "err.txt").find("free some space"), std::string::npos);
  const auto kept = runProgram(folder_, {"convert", "kept.usda.partial", "kept.rgc"});
  EXPECT_EQ(kept.exitCode, 0) << kept.err;
  EXPECT_EQ(kept.err.find("torn"), std::string::npos) << kept.err;
}

TEST_F(Fault, NothingWaitsForAFifo) {
  fs::create_directory(folder_ / "out");
  ASSERT_EQ(mkfifo((folder_ / "out/hair.usda.partial").c_str(), 0644), 0);
  ASSERT_EQ(mkfifo((folder_ / "hair.usda").c_str(), 0644), 0);
  for (const char* how : {"", "--overwrite"})
    EXPECT_EQ(shell(small_ + "-o out 2>/dev/null " + how), 5) << how;
  EXPECT_NE(shell("convert hair.usda hair.rgc 2>/dev/null"), 0);
}

}  // namespace
}  // namespace ringlet::fault_test
