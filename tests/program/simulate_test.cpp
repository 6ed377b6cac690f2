// `ringlet simulate`, from a file to files: what it writes, what it prints, how it fails and how it stops.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ringlet/gpu/device.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/output/groom_writer.h"
#include "ringlet/solver/compute_device.h"
#include "tests/program/run_program.h"
#include "tests/support/strict_usd.h"
#include "tests/support/test_support.h"

namespace ringlet::simulate_test {
namespace {

using nlohmann::json;
using test::readText;
using test::readUsd;
using test::RunningProgram;
using test::runProgram;
using test::scratchFolder;

// A groom of two strands of different lengths: 5 and 3 particles, a few centimetres long.
void writeSmallGroom(const std::filesystem::path& path) {
  std::ofstream(path) << "v 0 0 0\nv 0 -1 0.2\nv 0.1 -2 0\nv 0 -3 0.1\nv 0 -4 0\n"
                         "v 2 0 0\nv 2 -1 0\nv 2.1 -2 0\nl 1 2 3 4 5\nl 6 7 8\n";
}

// Runs with --json; standard output is one JSON object and nothing else.
json simulate(const std::filesystem::path& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "simulate");
  arguments.insert(arguments.end(), {"-o", "out", "--overwrite", "--json"});
  const auto result = runProgram(folder, arguments);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

class Backends : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    folder_ = scratchFolder(std::string("simulate_") + GetParam());
    if (GetParam() == std::string("gpu")) RINGLET_NEEDS_DEVICE(folder_);
    writeSmallGroom(folder_ / "groom.obj");
  }
  std::filesystem::path folder_;
};
INSTANTIATE_TEST_SUITE_P(Both, Backends, testing::Values("reference", "gpu"),
                         [](const testing::TestParamInfo<const char*>& backend) { return backend.param; });

// The first frame after two seconds is the 49th without them. A part of a frame is a whole one: 0.05 s
// are 1.2.
TEST_P(Backends, PreRollBeginsEarlier) {
  const std::vector<std::string> motion{"groom.obj", "--motion",  "still",   "--preload",
                                        "0",         "--backend", GetParam()};
  for (const auto& [seconds, frames] : {std::pair{"2", "49"}, {"0.05", "3"}}) {
    std::vector<std::string> whole = motion, rolled = motion;
    whole.insert(whole.end(), {"--frames", frames});
    rolled.insert(rolled.end(), {"--frames", "1", "--pre-roll", seconds});
    const json expected = simulate(folder_, whole), found = simulate(folder_, rolled);
    EXPECT_EQ(found["frames"], 1);
    EXPECT_EQ(found["positions_hash"], expected["positions_hash"]) << seconds << " s";
  }
}

// Two strands of 1e-4 and 1e-7 m among four of 5 cm, a metre from the origin: they keep their shape in the
// file.
TEST_P(Backends, StrandsThatFloatCannotHoldAreCarriedAndToldOf) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (float length : {0.05f, 1e-4f, 0.05f, 0.05f, 1e-7f, 0.05f}) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 8; ++i) strand.push_back({0, 1 - length * static_cast<float>(i) / 7, 0.25f * length});
    groom.addStrand(strand);
  }
  ASSERT_TRUE(writeGroom(folder_ / "fine.hair", groom));
  const json out = simulate(folder_, {"fine.hair", "--unit", "1", "--frames", "2", "--backend", GetParam()});
  EXPECT_EQ(out["strands"], 6);
  EXPECT_EQ(out["rigid_strands"], 2);
  ASSERT_EQ(out["warnings"].size(), 2u) << out["warnings"];
  EXPECT_EQ(out["warnings"].dump().find("5 repeated particles, the first in strand 4"), 2u);
  EXPECT_EQ(out["warnings"][1].get<std::string>().find("2 of 6 strands are carried rigidly by the root"), 0u);
  EXPECT_NE(out["warnings"].dump().find("strands 1 and 4"), std::string::npos);
  EXPECT_LE(out["max_edge_stretch"].get<double>(), 1.1 * (1 + 1e-3));
  const auto last = readGroom(folder_ / "out/last.obj");
  ASSERT_TRUE(last);
  for (std::size_t s : {1u, 4u}) {  // the head only moves, by what the root does
    const auto found = last->groom.strand(s), rest = groom.strand(s);
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_LE(length((found[i] - found[0]) - (rest[i] - rest[0])), 2.5e-7f) << "strand " << s;
  }
}

TEST_P(Backends, WritesAllFilesAndAllNumbers) {
  const json out = simulate(folder_, {"groom.obj", "--frames", "7", "--fps", "30", "--backend", GetParam()});
  ASSERT_TRUE(out.is_object());
  EXPECT_EQ(out["frames"], 7);
  EXPECT_EQ(out["strands"], 2);
  EXPECT_EQ(out["particles"], 8);
  EXPECT_EQ(out["nonfinite"], 0);
  EXPECT_EQ(out["backend"], GetParam());
  EXPECT_EQ(out["integrator"], "jacobi");
  EXPECT_GE(out["steps_per_frame"].get<int>(), 7) << "1/192 s and less at 30 frames a second";
  EXPECT_EQ(out["warnings"], json::array()) << "steps chosen for the groom need no warning";
  EXPECT_EQ(out["fps"], 30);
  EXPECT_EQ(out["interrupted"], false);
  EXPECT_GT(out["ms_per_frame"].get<double>(), 0);
  EXPECT_GE(out["max_edge_stretch"].get<double>(), 1 - 1e-4);
  EXPECT_LE(out["max_edge_stretch"].get<double>(), 1.1 + 1e-4);
  EXPECT_TRUE(out["limited_share"].is_number());
  EXPECT_TRUE(out["warnings"].is_array());
  for (const char* stage : {"strand_step", "readback", "write"})
    EXPECT_TRUE(out["stages_ms"][stage].is_number()) << stage;
  for (const char* part : {"start", "frames", "finish"})
    EXPECT_GE(out["wall_s"][part].get<double>(), 0) << part;
  const bool isOnDevice = GetParam() == std::string("gpu");
  for (const char* whom : {"device", "writer", "copy"})
    EXPECT_GE(out["waits_ms"][whom].get<double>(), 0) << whom;
  for (const char* whom : {"submit", "fence"})
    EXPECT_EQ(out["waits_ms"][whom].is_number(), isOnDevice) << whom;
  EXPECT_EQ(out["stages_ms"].contains("copy_out"), isOnDevice);
  EXPECT_NEAR(out["ms_per_frame"].get<double>(), out["stages_ms"]["strand_step"].get<double>(), 1e-9);
  EXPECT_GT(out["frame_ms"]["least"].get<double>(), 0);
  EXPECT_GE(out["frame_ms"]["median"].get<double>(), out["frame_ms"]["least"].get<double>());
  EXPECT_GE(out["frame_ms"]["first"].get<double>(), out["frame_ms"]["least"].get<double>());
  EXPECT_GE(7 * out["ms_per_frame"].get<double>(),
            out["frame_ms"]["first"].get<double>() + 6 * out["frame_ms"]["least"].get<double>() - 1e-9);
  const double computed = 7 * out["ms_per_frame"].get<double>() / 1000;
  EXPECT_NEAR(out["compute_share"].get<double>(), computed / out["wall_s"]["frames"].get<double>(), 1e-9);
  for (const char* key : {"device", "driver", "kernel"})
    EXPECT_FALSE(out[key].get<std::string>().empty()) << key;
  // 8 particles, 2 strands, and the head's poses and numbers: docs/memory.md.
  const auto device = ComputeDevice::open();
  const int ofParticle = device && device->gpu().properties().isCpu ? 64 + 56 : 68 + 24;
  EXPECT_EQ(out["device_bytes"], isOnDevice ? json(8 * ofParticle + 2 * 136 + 3 * (341 * 48 + 88)) : json());
  EXPECT_EQ(out["positions_hash"].get<std::string>().size(), 16u);
  EXPECT_EQ(out["outputs"], (json{"out/hair.usda", "out/last.obj", "out/sheet.png"}));

  const auto usd = readUsd(folder_ / "out/hair.usda");
  EXPECT_EQ(usd.points.size(), 7u);
  EXPECT_EQ(usd.counts, (std::vector<int>{5, 3}));
  EXPECT_EQ(usd.metadata.at("timeCodesPerSecond"), "30");
  EXPECT_EQ(usd.metadata.at("endTimeCode"), "7");
  auto last = readGroom(folder_ / "out/last.obj");
  ASSERT_TRUE(last);
  EXPECT_EQ(last->groom.points, usd.points.at(7)) << "last.obj is the last sample";
  EXPECT_EQ(readText(folder_ / "out/sheet.png").substr(1, 3), "PNG");
}

// With one step a frame the longest edge of all steps is that of the frames that are written.
TEST_P(Backends, TheLongestEdgeIsThatOfTheFrames) {
  for (const char* limit : {"1.5", "1.02"}) {
    const json out = simulate(
        folder_, {"groom.obj", "--frames", "24", "--fps", "192", "--steps-per-frame", "1", "--preload", "0",
                  "--motion", "jump", "--max-stretch", limit, "--backend", GetParam()});
    const auto groom = readGroom(folder_ / "groom.obj");
    ASSERT_TRUE(groom);
    double longest = 0;
    for (const auto& [frame, points] : readUsd(folder_ / "out/hair.usda").points) {
      for (std::size_t s = 0; s < groom->groom.strandCount(); ++s) {
        for (std::size_t i = groom->groom.firstPoint[s]; i + 1 < groom->groom.firstPoint[s + 1]; ++i) {
          const double rest = length(groom->groom.points[i + 1] - groom->groom.points[i]);
          longest = std::max(longest, length(points[i + 1] - points[i]) / rest);
        }
      }
    }
    ASSERT_GT(longest, 1.001);
    EXPECT_NEAR(out["max_edge_stretch"].get<double>(), longest, 1e-5) << "limit " << limit;
  }
}

TEST_P(Backends, HairAtRestStaysInItsOrderAndUnit) {
  simulate(folder_,
           {"groom.obj", "--frames", "2", "--motion", "still", "--gravity", "0", "--backend", GetParam()});
  auto before = readGroom(folder_ / "groom.obj"), after = readGroom(folder_ / "out/last.obj");
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->groom.firstPoint, before->groom.firstPoint);
  for (std::size_t i = 0; i < before->groom.points.size(); ++i) {
    EXPECT_LT(length(after->groom.points[i] - before->groom.points[i]), 4e-5f)
        << "particle " << i << " of a strand 4 long";
  }
}

TEST_P(Backends, TheSameRunGivesTheSameBits) {
  const std::vector<std::string> arguments{"groom.obj", "--frames",  "3",       "--motion",
                                           "nod",       "--backend", GetParam()};
  const json one = simulate(folder_, arguments), other = simulate(folder_, arguments);
  EXPECT_EQ(one["positions_hash"], other["positions_hash"]);
}

TEST_P(Backends, EveryIntegratorRuns) {
  for (const char* integrator : {"jacobi", "point_jacobi", "paper"}) {
    const json out = simulate(
        folder_, {"groom.obj", "--frames", "2", "--integrator", integrator, "--backend", GetParam()});
    EXPECT_EQ(out["integrator"], integrator);
    EXPECT_GE(out["steps_per_frame"].get<int>(), integrator == std::string("paper") ? 30 : 8);
    EXPECT_EQ(out["nonfinite"], 0) << integrator;
    const bool measured = GetParam() == std::string("gpu") && integrator != std::string("paper");
    ASSERT_TRUE(out.contains("velocity_residual"));
    EXPECT_EQ(out["velocity_residual"].is_number(), measured) << integrator;
    if (measured) {
      EXPECT_LT(out["velocity_residual"].get<double>(), 1e-2) << integrator;
    }
  }
}

TEST(Simulate, TheHeadCarriesTheRoots) {
  // Gliding at 1 m/s, 24 frames a second: after a frame every particle is 1/24 m further along X, in
  // centimetres.
  const auto folder = scratchFolder("simulate_glide");
  writeSmallGroom(folder / "groom.obj");
  simulate(folder,
           {"groom.obj", "--frames", "24", "--motion", "glide", "--gravity", "0", "--backend", "reference"});
  auto groom = readGroom(folder / "groom.obj");
  ASSERT_TRUE(groom);
  const auto usd = readUsd(folder / "out/hair.usda");
  for (int frame : {1, 24}) {
    for (std::size_t i = 0; i < groom->groom.points.size(); ++i) {
      const Vec3f expected = groom->groom.points[i] + Vec3f{100.0f * static_cast<float>(frame) / 24, 0, 0};
      EXPECT_LT(length(usd.points.at(frame)[i] - expected), 1e-3f) << "frame " << frame << " particle " << i;
    }
  }
}

TEST(Simulate, ZUpFallsAlongZ) {
  const auto folder = scratchFolder("simulate_z");
  std::ofstream(folder / "groom.obj") << "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nl 1 2 3 4\n";
  simulate(folder, {"groom.obj", "--frames", "4", "--motion", "still", "--preload", "0", "--up", "Z",
                    "--backend", "reference"});
  const auto usd = readUsd(folder / "out/hair.usda");
  EXPECT_EQ(usd.metadata.at("upAxis"), "\"Z\"");
  EXPECT_LT(usd.points.at(4)[3].z, -0.01f);
  EXPECT_NEAR(usd.points.at(4)[3].y, 0, 1e-4);
}

TEST(Simulate, SummaryNamesTheFilesAndQuietSaysNothing) {
  const auto folder = scratchFolder("simulate_text");
  writeSmallGroom(folder / "groom.obj");
  const std::vector<std::string> arguments{"simulate",  "groom.obj", "--frames", "1",
                                           "--backend", "reference", "-o",       "a/b/out"};
  auto result = runProgram(folder, arguments);
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(test::withoutCompileNotes(result.err), "")
      << "no progress bar where standard error is no terminal";
  for (const char* part : {"1 frame of 2 strands, 8 particles", "a/b/out/hair.usda", "a/b/out/last.obj",
                           "a/b/out/sheet.png", " ms "}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " is missing in:\n" << result.out;
  }
  auto quiet = arguments;
  quiet.insert(quiet.end(), {"--quiet", "--overwrite"});
  result = runProgram(folder, quiet);
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.out + result.err, "");
}

TEST(Simulate, FailuresAreOneSentenceAndHaveAnExitStatus) {
  const auto folder = scratchFolder("simulate_failures");
  writeSmallGroom(folder / "groom.obj");
  std::ofstream(folder / "broken.obj") << "v 0 0 0\nl 1 7\n";
  std::ofstream(folder / "groom.fbx") << "x";
  std::ofstream(folder / "file") << "x";
  struct Case {
    std::string groom, output, message;
    int exitCode;
  };
  for (const Case& c : {Case{"none.obj", "out", "none.obj", 4}, Case{"broken.obj", "out", "broken.obj", 1},
                        Case{"groom.fbx", "out", ".hair", 1}, Case{"groom.obj", "file", "file", 5},
                        Case{"groom.obj", "/proc/out", "/proc/out", 5}}) {
    const auto result = runProgram(
        folder, {"simulate", c.groom, "--backend", "reference", "--frames", "1000000", "-o", c.output});
    EXPECT_EQ(result.exitCode, c.exitCode) << c.message;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err.substr(0, 18), "ringlet simulate: ");
    EXPECT_NE(result.err.find(c.message), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST(Simulate, AReadOnlyFolderIsFoundOutFirst) {
  if (geteuid() == 0) GTEST_SKIP() << "SKIPPED: root may write everywhere";
  const auto folder = scratchFolder("simulate_readonly");
  writeSmallGroom(folder / "groom.obj");
  std::filesystem::create_directory(folder / "out");
  std::filesystem::permissions(folder / "out",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const auto result = runProgram(
      folder, {"simulate", "groom.obj", "--backend", "reference", "--frames", "1000000", "-o", "out"});
  EXPECT_EQ(result.exitCode, 5);
  EXPECT_NE(result.err.find("choose a folder you may write to"), std::string::npos) << result.err;
}

TEST(Simulate, ARunThatBlowsUpSaysSoAndItsFilesCanStillBeRead) {
  // The paper's explicit scheme at a step far beyond its limit.
  const auto folder = scratchFolder("simulate_nonfinite");
  ASSERT_EQ(runProgram(folder, {"make", "swatch", "-o", "groom.hair"}).exitCode, 0);
  const auto result =
      runProgram(folder, {"simulate", "groom.hair", "--integrator", "paper", "--steps-per-frame", "1",
                          "--frames", "6", "--backend", "reference", "--json", "-o", "out"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.err.find("have no finite position"), std::string::npos) << result.err;
  const json out = json::parse(result.out, nullptr, false);
  ASSERT_TRUE(out.is_object());
  EXPECT_GT(out["nonfinite"], 0);
  EXPECT_EQ(readUsd(folder / "out/hair.usda").points.size(), 6u);
  EXPECT_TRUE(readGroom(folder / "out/last.obj"));
}

TEST(Simulate, ContactsAreForTheAsking) {
  const auto folder = scratchFolder("simulate_contacts");
  writeSmallGroom(folder / "groom.obj");
  struct Case {
    std::vector<std::string> arguments;
    int exitCode;
    std::string message;
  };
  for (const Case& c : {
           Case{{"--contacts", "maybe"},
                2,
                "--contacts: there is no 'maybe' (only off, on, auto, explicit, volume)"},
           Case{{"--prune", "8"}, 2, "--prune: only with --contacts on or --measure-contacts"},
           Case{{"--no-crossings"}, 2, "--no-crossings: only with --contacts on or --measure-contacts"},
           Case{{"--contacts", "on", "--prune", "8.5"}, 2, "not '8.5', or none"},
           Case{{"--contacts", "on", "--prune", "none", "--max-neighbours", "4"},
                2,
                "--max-neighbours: --prune"},
           Case{{"--contacts", "on", "--integrator", "point_jacobi"}, 1, "contacts need jacobi"},
       }) {
    std::vector<std::string> arguments{"simulate", "groom.obj", "--frames", "1", "-o", "out"};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << c.message;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find(c.message), std::string::npos) << result.err;
  }

  // What can be measured without contacts is, by the reference too.
  const json measured =
      simulate(folder, {"groom.obj", "--frames", "2", "--backend", "reference", "--measure-contacts"});
  EXPECT_TRUE(measured["contacts"].is_null());
  EXPECT_EQ(measured["crossings"], 0);
  EXPECT_TRUE(measured["deepest_overlap_all"].is_number());
  const std::string help = runProgram(folder, {"simulate", "--help"}).out;
  for (const char* key :
       {"contacts", "pairs_unpruned", "pairs", "pair_tests", "raw_recall", "overlap_beyond_rest_sum",
        "deepest_overlap_all", "crossings", "momentum_error", "rebuilds"}) {
    EXPECT_TRUE(measured.contains(key)) << key;
    EXPECT_NE(help.find(key), std::string::npos) << key;
  }
}

// A file that may grow no further is as a full disk. The thread that writes finds out, the run ends with its
// sentence, and what was finished can be read.
TEST(Simulate, AFullDiskEndsTheRunAndKeepsItsFrames) {
  const auto folder = scratchFolder("simulate_full");
  writeSmallGroom(folder / "groom.obj");
  struct rlimit before {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  struct rlimit small = before;
  small.rlim_cur = 1 << 20;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto result = runProgram(
      folder, {"simulate", "groom.obj", "--backend", "reference", "--frames", "7000", "-o", "out"});
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(result.exitCode, 6);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  const auto usd = readUsd(folder / "out/hair.usda.partial");
  EXPECT_GE(usd.points.size(), 1u);
  EXPECT_LT(usd.points.size(), 7000u);
  const std::string kept =
      "(the first " + std::to_string(usd.points.size()) + " frames are kept in out/hair.usda.partial)";
  EXPECT_NE(result.err.find(kept), std::string::npos) << result.err;
}

TEST(Simulate, LanesAndRunsAreStatedOrRefused) {
  const auto folder = scratchFolder("simulate_lanes");
  writeSmallGroom(folder / "groom.obj");
  struct Case {
    std::vector<std::string> arguments;
    int exitCode;
    std::string message;
  };
  for (const Case& c : {
           Case{{"--lanes", "3"}, 1, "3 lanes a strand were asked for; this device can have 1, 2"},
           Case{{"--lanes", "0"}, 2, "--lanes: must be a whole number from 1 to 128"},
           Case{{"--run", "3"}, 2, "--run: must be a whole number from 4 to 1024"},
           Case{{"--lanes", "1", "--run", "4"},
                1,
                "a strand of 5 particles does not fit: 1 lanes of 4 hold 4"},
           Case{{"--lanes", "2", "--kernel", "serial"},
                2,
                "--lanes: only --backend gpu with --kernel auto, lanes or memory"},
           Case{{"--run", "65"}, 1, "65 particles per lane was asked for; 4 to "},
           Case{{"--run", "8", "--backend", "reference"}, 2, "--run: only --backend gpu"},
       }) {
    std::vector<std::string> arguments{"simulate", "groom.obj", "--frames", "1", "-o", "out"};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << c.message;
    EXPECT_NE(result.err.find(c.message), std::string::npos) << result.err;
  }
  const json stated = simulate(folder, {"groom.obj", "--frames", "1", "--lanes", "2", "--run", "5"});
  EXPECT_EQ(stated["kernel"].get<std::string>().substr(0, 11), "lanes 2 x 5");
  const json inMemory = simulate(folder, {"groom.obj", "--frames", "1", "--kernel", "memory", "--lanes", "2",
                                          "--run", "70", "--overwrite"});
  EXPECT_EQ(inMemory["kernel"].get<std::string>().substr(0, 13), "memory 2 x 70");
  EXPECT_GT(stated["compile_ms"].get<double>(), 0);
}

// Tests of kernels run code that lavapipe has not optimised (tests/CMakeLists.txt); what users run has its
// bits. Other drivers do not know the variable, and run the same code twice.
TEST(Simulate, CodeThatIsNotOptimisedHasTheSameBits) {
  const auto folder = scratchFolder("simulate_unoptimised");
  ASSERT_EQ(
      runProgram(folder, {"make", "head", "--strands", "60", "--particles", "32", "-o", "head.obj"}).exitCode,
      0);
  for (const char* method : {"explicit", "volume"}) {
    std::ofstream(folder / "scene.toml")
        << "[groom]\nfile = \"head.obj\"\n[motion]\nkind = \"shake\"\n[simulation]\nframes = 4\n"
           "[air]\nfall_speed = 2\n[[body]]\nshape = \"sphere\"\nradius = 0.088\n[contacts]\nmethod = \""
        << method << "\"\n";
    std::vector<json> found;
    for (const char* perf : {"none", "nopt"}) {
      setenv("GALLIVM_PERF", perf, 1);
      found.push_back(simulate(folder, {"scene.toml", "--overwrite"}));
    }
    unsetenv("GALLIVM_PERF");
    EXPECT_EQ(found[0]["positions_hash"], found[1]["positions_hash"]) << method;
    EXPECT_GT(found[0][method == std::string("volume") ? "volume_strands" : "contacts"], 0);
  }
}

TEST(Simulate, UnknownDeviceIsNamed) {
  const auto folder = scratchFolder("simulate_device");
  writeSmallGroom(folder / "groom.obj");
  const auto result = runProgram(folder, {"simulate", "groom.obj", "--device", "Voodoo 2", "-o", "out"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.err.find("--backend reference"), std::string::npos) << result.err;
  EXPECT_TRUE(std::filesystem::is_empty(folder / "out")) << "nothing half-written remains";
}

// A run that would take long, and the moment its first frame is in the file.
class Interruption : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(runProgram(folder_, {"make", "swatch", "-o", "groom.hair"}).exitCode, 0);
  }
  std::vector<std::string> arguments_{"simulate",  "groom.hair", "--frames", "100000", "--backend",
                                      "reference", "--json",     "-o",       "out"};
  std::filesystem::path folder_ = scratchFolder("interruption");

  bool waitForFrames(const RunningProgram& program) const {
    return program.waitUntil([this] {
      const std::string key = "endTimeCode = ";
      std::string text(200, ' ');
      std::ifstream(folder_ / "out/hair.usda.partial").read(text.data(), 200);
      const std::size_t at = text.find(key);
      return at != std::string::npos && text.compare(at + key.size(), 1, "0") != 0;
    });
  }

  // Two frames, with a variable in the environment.
  auto simulateWith(const char* variable, const char* value) {
    setenv(variable, value, 1);
    const auto result = runProgram(
        folder_, {"simulate", "groom.hair", "--frames", "2", "--json", "--overwrite", "-o", "out"});
    unsetenv(variable);
    return result;
  }
};

// $RINGLET_WITHOUT: the same bits by another way.
TEST_F(Interruption, ADeviceDoesWithoutWhatIsNamed) {
  RINGLET_NEEDS_DEVICE(folder_);
  const auto simulated = [&](const char* without) {
    const auto result = simulateWith("RINGLET_WITHOUT", without);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return json::parse(result.out, nullptr, false);
  };
  const json all = simulated(""), few = simulated("texels,timestamps");
  EXPECT_TRUE(all["stages_ms"].contains("copy_out"));
  EXPECT_FALSE(few["stages_ms"].contains("copy_out"));
  EXPECT_GT(few["stages_ms"]["strand_step"].get<double>(), 0) << "by the host's clock";
  EXPECT_EQ(few["positions_hash"], all["positions_hash"]);
  EXPECT_EQ(all["warnings"].dump().find("RINGLET_WITHOUT"), std::string::npos);
  EXPECT_NE(few["warnings"].dump().find("without texels,timestamps"), std::string::npos) << few["warnings"];
  const auto wrong = simulateWith("RINGLET_WITHOUT", "texels,luck");
  EXPECT_EQ(wrong.exitCode, 1);
  EXPECT_NE(wrong.err.find("there is no luck"), std::string::npos) << wrong.err;
}

// $RINGLET_GROUP_SIZE: the same bits in other workgroups.
TEST_F(Interruption, WorkgroupsOfAnySizeHaveTheSameBits) {
  RINGLET_NEEDS_DEVICE(folder_);
  const auto simulated = [&](const char* size) { return simulateWith("RINGLET_GROUP_SIZE", size); };
  const auto hashOf = [&](const char* size) {
    const auto result = simulated(size);
    EXPECT_EQ(result.exitCode, 0) << size << ": " << result.err;
    return json::parse(result.out, nullptr, false)["positions_hash"];
  };
  const json usual = hashOf("");
  for (const char* size : {"32", "64", "128"}) EXPECT_EQ(hashOf(size), usual) << size;
  for (const char* size : {"48", "256", "1"}) {
    const auto result = simulated(size);
    EXPECT_EQ(result.exitCode, 1) << size;
    EXPECT_NE(result.err.find("powers of two from"), std::string::npos) << result.err;
  }
  for (const char* size : {"many", "-64", "64.0", "0"}) {
    const auto result = simulated(size);
    EXPECT_EQ(result.exitCode, 1) << size;
    EXPECT_NE(result.err.find("expected a whole number above 0"), std::string::npos) << result.err;
  }
}

TEST_F(Interruption, CtrlCKeepsFinishedFrames) {
  RunningProgram program(folder_, arguments_);
  EXPECT_TRUE(waitForFrames(program));
  program.send(SIGINT);
  const auto result = program.wait();
  EXPECT_EQ(result.exitCode, 130);
  EXPECT_NE(result.err.find("interrupted after"), std::string::npos) << result.err;
  const json out = json::parse(result.out, nullptr, false);
  ASSERT_TRUE(out.is_object());
  EXPECT_EQ(out["interrupted"], true);
  const auto frames = out["frames"].get<std::size_t>();
  EXPECT_GE(frames, 1u);
  const auto usd = readUsd(folder_ / "out/hair.usda");
  EXPECT_EQ(usd.points.size(), frames);
  EXPECT_EQ(usd.metadata.at("endTimeCode"), std::to_string(frames));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/last.obj"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/sheet.png"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/hair.usda.partial"));
}

TEST_F(Interruption, AKilledRunLeavesItsFrames) {
  RunningProgram program(folder_, arguments_);
  EXPECT_TRUE(waitForFrames(program));
  program.send(SIGKILL);
  EXPECT_EQ(program.wait().exitCode, -1);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/hair.usda"));
  EXPECT_GE(readUsd(folder_ / "out/hair.usda.partial").points.size(), 1u);
}

}  // namespace
}  // namespace ringlet::simulate_test
