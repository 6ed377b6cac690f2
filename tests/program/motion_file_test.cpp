// `ringlet simulate --motion FILE.bvh` and FILE.gltf: the groom follows a joint, and mistakes are sentences.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ringlet/groom/groom_file.h"
#include "tests/motion/gltf_samples.h"
#include "tests/program/run_program.h"
#include "tests/scenes/joint_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::motion_file_test {
namespace {

using nlohmann::json;
using test::runProgram;
using test::scratchFolder;

// A strand of three particles, 2 cm long, and a skeleton 2 units tall whose head goes 12 units to the side in
// 12 frames of a twenty-fourth of a second and turns there by a quarter; a T-pose first.
void writeFiles(const std::filesystem::path& folder) {
  std::ofstream(folder / "groom.obj") << "v 0 0 0\nv 0 -1 0\nv 0 -2 0\nl 1 2 3\n";
  std::ofstream bvh(folder / "walk.BVH");
  bvh << "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\nJOINT "
         "rig:Head\n{\n"
         "OFFSET 0 2 0\nCHANNELS 1 Zrotation\nEnd Site\n{\nOFFSET 0 0 0\n}\n}\n}\nMOTION\nFrames:14\nFrame "
         "Time: 0.0416666667\n-40 0 0 170\n";
  for (int k = 0; k <= 12; ++k) bvh << k << " 0 0 " << 7.5 * k << "\n";
}

// The same head, in metres: 12 cm to the side in half a second, upright; and a second animation.
test::GltfBuilder gltfHead() {
  test::GltfBuilder file;
  const int head = file.node({{"name", "rig:Head"}});
  file.node({{"name", "Hips"}, {"translation", {0, 0.02, 0}}, {"children", {head}}});
  std::vector<double> seconds, values;
  for (int k = 0; k <= 12; ++k) {
    seconds.push_back(k / 24.0 + 1);
    values.insert(values.end(), {k * 0.01, 0, 0});
  }
  file.channel(0, head, "translation", "LINEAR", seconds, values);
  return file;
}

TEST(MotionFile, TheGroomFollowsTheNodeOfAGltf) {
  const auto folder = scratchFolder("motion_file_gltf");
  writeFiles(folder);
  std::ofstream(folder / "walk.GLB", std::ios::binary) << gltfHead().glb();
  std::ofstream(folder / "walk.gltf") << gltfHead().text();
  struct Case {
    std::vector<std::string> options;
    double y, z, scale;
  };
  for (const Case& c : {Case{{"--motion", "walk.GLB"}, 2, 0, 1},
                        Case{{"--motion", "walk.gltf", "--motion-unit", "0.5"}, 1, 0, 0.5},
                        Case{{"--motion", "walk.gltf", "--up", "Z", "--joint", "rig:head"}, 0, 2, 1}}) {
    std::vector<std::string> arguments{"simulate",  "groom.obj",   "--gravity", "0",   "--backend",
                                       "reference", "--overwrite", "-o",        "out", "--json"};
    arguments.insert(arguments.end(), c.options.begin(), c.options.end());
    const auto result = runProgram(folder, arguments);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const json out = json::parse(result.out, nullptr, false);
    EXPECT_EQ(out["frames"], 12) << "as long as the animation, from its first key";
    // The groom hangs along -Y, which is said where Z is up, and nothing else.
    const bool isOnItsSide = c.z > 0;
    ASSERT_EQ(out["warnings"].size(), isOnItsSide ? 1u : 0u) << out["warnings"];
    if (isOnItsSide) {
      EXPECT_NE(out["warnings"][0].get<std::string>().find("hang along -Y, and Z is up"), std::string::npos);
    }
    const auto last = readGroom(folder / "out/last.obj");
    ASSERT_TRUE(last) << last.error().message;
    EXPECT_NEAR(last->groom.points[0].x, 12 * c.scale, 1e-4);
    EXPECT_NEAR(last->groom.points[0].y, c.y, 1e-4);
    EXPECT_NEAR(last->groom.points[0].z, c.z, 1e-4);
  }
}

TEST(MotionFile, SaysWhichAnimationOfAGltfItTook) {
  const auto folder = scratchFolder("motion_file_gltf_warnings");
  writeFiles(folder);
  auto file = gltfHead();
  file.channel(1, 1, "translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0});
  file.node({{"name", "Stone"}});
  std::ofstream(folder / "two.glb", std::ios::binary) << file.glb();
  const auto warningsOf = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"simulate",    "groom.obj", "--motion",  "two.glb",
                                       "--frames",    "1",         "--backend", "reference",
                                       "--overwrite", "-o",        "out",       "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return json::parse(result.out, nullptr, false)["warnings"].dump();
  };
  EXPECT_NE(warningsOf({}).find("has 2 animations; the first, take0, is taken"), std::string::npos)
      << warningsOf({});
  EXPECT_EQ(warningsOf({"--animation", "take1"}), "[]");
  EXPECT_NE(
      warningsOf({"--animation", "1", "--joint", "Stone"}).find("nothing in its animation take1 moves Stone"),
      std::string::npos);
}

TEST(MotionFile, TheGroomFollowsTheJoint) {
  const auto folder = scratchFolder("motion_file");
  writeFiles(folder);
  const auto result = runProgram(
      folder, {"simulate", "groom.obj", "--motion", "walk.BVH", "--skip-frames", "1", "--motion-unit", "0.01",
               "--gravity", "0", "--backend", "reference", "-o", "out", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const json out = json::parse(result.out, nullptr, false);
  EXPECT_EQ(out["frames"], 12) << "as long as the file goes on";
  EXPECT_EQ(out["warnings"], json::array());
  const auto last = readGroom(folder / "out/last.obj");
  ASSERT_TRUE(last) << last.error().message;
  EXPECT_NEAR(last->groom.points[0].x, 12, 1e-4);
  EXPECT_NEAR(last->groom.points[0].y, 2, 1e-4);
}

TEST(MotionFile, SaysWhatItTookForGranted) {
  const auto folder = scratchFolder("motion_file_warnings");
  writeFiles(folder);
  const auto result = runProgram(folder, {"simulate", "groom.obj", "--motion", "walk.BVH", "--frames", "2",
                                          "--backend", "reference", "-o", "out", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const json out = json::parse(result.out, nullptr, false);
  EXPECT_EQ(out["frames"], 2);
  ASSERT_GE(out["warnings"].size(), 2u);
  EXPECT_NE(out["warnings"][0].get<std::string>().find("2 units is taken to be 1.7 m tall"),
            std::string::npos);
  EXPECT_NE(out["warnings"][1].get<std::string>().find("from frame 1 to the next Head turns at 71 rad/s"),
            std::string::npos)
      << out["warnings"][1];
}

TEST(MotionFile, MistakesAreOneSentence) {
  const auto folder = scratchFolder("motion_file_mistakes");
  writeFiles(folder);
  std::ofstream(folder / "broken.bvh") << "HIERARCHY\nJOINT";
  std::ofstream(folder / "walk.glb", std::ios::binary) << gltfHead().glb();
  std::ofstream(folder / "cut.glb", std::ios::binary) << gltfHead().glb().substr(0, 500);
  test::GltfBuilder still;
  still.node({{"name", "Head"}});
  std::ofstream(folder / "still.gltf") << still.text();
  struct Case {
    std::vector<std::string> options;
    int exitCode;
    std::string message;
  };
  for (const Case& c : {
           Case{{"--motion", "walk.BVH", "--joint", "Haed"}, 1, "walk.BVH has no joint Haed; "},
           Case{{"--motion", "walk.BVH", "--joint", "LeftWrist"}, 1, "it has Hips, rig:Head"},
           Case{{"--motion", "walk.BVH", "--skip-frames", "13"}, 1, "and the first 13 are skipped"},
           Case{{"--motion", "walk.BVH", "--amplitude", "1"}, 2, "found --amplitude with a motion by file"},
           Case{{"--motion", "walk.BVH", "--motion-unit", "0"}, 2, "must be a number from"},
           Case{{"--motion", "nod", "--joint", "Head"},
                2,
                "found --joint with a motion by nod; only file has it"},
           Case{{"--motion", "missing.bvh"}, 4, "missing.bvh"},
           Case{{"--motion", "broken.bvh"}, 1, "broken.bvh is no BVH motion: line 2: \"ROOT\" should stand"},
           Case{{"--motion", "walk.BVH", "--animation", "run"},
                2,
                "found --animation: a .bvh file has only one"},
           Case{{"--motion", "walk.glb", "--skip-frames", "1"},
                2,
                "--skip-frames: a glTF animation has times and no frames"},
           Case{{"--motion", "walk.glb", "--joint", "Haed"}, 1, "walk.glb has no node Haed; "},
           Case{{"--motion", "walk.glb", "--joint", "LeftWrist"}, 1, "it has rig:Head, Hips"},
           Case{{"--motion", "walk.glb", "--animation", "run"}, 1, "has no animation run; it has take0"},
           Case{{"--motion", "still.gltf"}, 1, "still.gltf has no animation"},
           Case{{"--motion", "missing.gltf"}, 4, "missing.gltf"},
           Case{{"--motion", "cut.glb"}, 1, "cut.glb is no glTF: it says it has"},
           Case{{"--motion", "nodd"}, 2, "did you mean nod?"},
           Case{{"--motion", "nod", "--motion-up", "Z"}, 2, "--motion-up"},
           Case{{"--motion", "walk.BVH", "--motion-up", "W"}, 2, "Y, Z, X, -Y, -Z, -X"},
       }) {
    std::vector<std::string> arguments{"simulate",    "groom.obj", "--backend", "reference",
                                       "--overwrite", "-o",        "out"};
    arguments.insert(arguments.end(), c.options.begin(), c.options.end());
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << result.err;
    EXPECT_NE(result.err.find(c.message), std::string::npos) << result.err;
  }
}

// A strand that hangs 1.5 m up from beside the head's joint, as it was modelled in the world. Where the joint
// has another axis up, it is told which option mends that; with the option it hangs as before.
TEST(MotionFile, JointsWithOtherAxesAreSaidAndBindUpright) {
  const auto folder = scratchFolder("motion_file_axes");
  std::ofstream(folder / "groom.obj") << "v 5 150 0\nv 5 145 0\nv 5 140 0\nl 1 2 3\n";
  std::ofstream(folder / "local.obj") << "v 5 0 0\nv 5 -5 0\nv 5 -10 0\nl 1 2 3\n";
  const auto simulated = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "simulate");
    for (const char* more :
         {"--gravity", "0", "--backend", "reference", "-o", "out", "--json", "--overwrite", "--frames", "1"})
      arguments.emplace_back(more);
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    std::string warnings;
    const json report = json::parse(result.out);
    for (const auto& warning : report["warnings"]) warnings += std::string(warning) + "\n";
    return warnings;
  };
  for (const auto& axis : test::kJointAxes) {
    test::writeBvhOf(axis, folder / "joint.bvh");
    test::writeGltfOf(axis, folder / "joint.gltf");
    for (const char* file : {"joint.bvh", "joint.gltf"}) {
      SCOPED_TRACE(fmt::format("{} {}", file, axis.name));
      std::vector<std::string> motion{"--motion", file};
      if (file == std::string("joint.bvh")) motion.insert(motion.end(), {"--motion-unit", "0.01"});
      const auto with = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), motion.begin(), motion.end());
        return simulated(arguments);
      };
      const std::string unbound = with({"local.obj"});
      const bool isUpright = axis.name == std::string("+Y");
      EXPECT_EQ(unbound.find("tilted") == std::string::npos, isUpright) << unbound;
      if (!isUpright) {
        EXPECT_NE(unbound.find(std::string("has its ") + axis.name), std::string::npos);
      }

      const std::string bound = with({"groom.obj", "--bind", "world"});
      EXPECT_EQ(bound.find("joint"), std::string::npos) << bound;
      const auto moved = readGroom(folder / "out" / "last.obj");
      ASSERT_TRUE(moved);
      // In the first frame the head has turned by 2.5 degrees and gone 1 cm.
      const std::vector<Vec3f>& points = moved->groom.points;
      EXPECT_NEAR(points[0].x, 6, 0.1);
      EXPECT_NEAR(points[0].y, 150, 0.5);
      EXPECT_GT(points[0].y, points[1].y + 4.5f);
      EXPECT_GT(points[1].y, points[2].y + 4.5f);
    }
  }
  EXPECT_NE(simulated({"groom.obj", "--motion", "joint.gltf"}).find("takes bind = \"world\""),
            std::string::npos);
  EXPECT_NE(simulated({"local.obj", "--motion", "joint.gltf", "--bind", "world"}).find("are the units"),
            std::string::npos);
  (void)simulated({"groom.obj", "--motion", "joint.gltf", "--bind", "world", "--bind-frame", "2"});
  const auto still = readGroom(folder / "out" / "last.obj");
  ASSERT_TRUE(still);
  EXPECT_NEAR(still->groom.points[0].x, 5, 1e-3) << "the first frame of the run is the motion's second";
}

// What is there and is no motion is named with what is read; "there is no" is said of what is not there.
TEST(MotionFile, FilesOfOtherKindsAreNamed) {
  const auto folder = scratchFolder("motion_file_kinds");
  writeFiles(folder);
  std::filesystem::create_directories(folder / "shots.fbx");
  const std::string expected = ".bvh, .gltf, .glb or .vrm";
  const std::string scene = "[groom]\nfile = 'groom.obj'\n[simulation]\nframes = 2\n";
  for (const char* file : {"walk.fbx", "walk.FBX", "walk.abc", "walk.usd", "walk.usda", "walk.bhv",
                           "walk.gtlf", "walk.glb.txt", "stroll", "sub/walk.fbx", "shots.fbx", "groom.obj"}) {
    for (const bool isThere : {false, true}) {
      const bool isFolder = file == std::string("shots.fbx"), isGroom = file == std::string("groom.obj");
      if (!isThere && (isFolder || isGroom)) continue;
      if (isThere && !isFolder && !isGroom) {
        std::filesystem::create_directories((folder / file).parent_path());
        std::ofstream(folder / file) << "walk";
      }
      std::ofstream(folder / "head.toml") << scene << "[motion]\nfile = '" << file << "'\n";
      std::ofstream(folder / "body.toml")
          << scene << "[[body]]\nname = 'b'\nshape = 'sphere'\nradius = 0.01\n"
          << "[body.moves]\nfile = '" << file << "'\n";
      std::vector<std::vector<std::string>> commands{
          {"simulate", "groom.obj", "--motion", file},
          {"simulate", "head.toml"},
          {"simulate", "body.toml"},
          {"sweep", "head.toml", "--vary", "material.dials.hold=1,2"}};
      for (std::vector<std::string>& command : commands) {
        SCOPED_TRACE(fmt::format("{} {} {}", command[1], file, isThere ? "there" : "not there"));
        command.insert(command.end(), {"--backend", "reference", "-o", "out"});
        const auto result = runProgram(folder, command);
        EXPECT_NE(result.exitCode, 0);
        EXPECT_NE(result.err.find(file), std::string::npos) << result.err;
        EXPECT_EQ(result.err.find("there is no") != std::string::npos, !isThere) << result.err;
        const bool isWord = file == std::string("stroll") && !isThere && command[0] == "simulate";
        if (!isWord || command[1] != "groom.obj") {
          EXPECT_NE(result.err.find(expected), std::string::npos) << result.err;
        }
      }
    }
    if (file != std::string("shots.fbx") && file != std::string("groom.obj"))
      std::filesystem::remove(folder / file);
  }
}

// Avatars are binary glTF by another ending, which may be in capitals.
TEST(MotionFile, VrmIsReadAsTheGltfItIs) {
  const auto folder = scratchFolder("motion_file_vrm");
  writeFiles(folder);
  for (const char* file : {"head.vrm", "HEAD.VRM"}) {
    std::ofstream(folder / file, std::ios::binary) << gltfHead().glb();
    const auto result = runProgram(folder, {"simulate", "groom.obj", "--motion", file, "--gravity", "0",
                                            "--backend", "reference", "-o", "out", "--overwrite", "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(json::parse(result.out)["warnings"], json::array());
    const auto last = readGroom(folder / "out/last.obj");
    ASSERT_TRUE(last) << last.error().message;
    EXPECT_NEAR(last->groom.points[0].x, 12, 1e-4);
  }
}

// Half of a run is no beginning of another: the buffers of a glTF file are its content too, and the mesh of
// hairs that an option names.
TEST(MotionFile, ARunDoesNotGoOnWithAnotherBuffer) {
  const auto folder = scratchFolder("motion_file_resume");
  writeFiles(folder);
  std::ofstream(folder / "walk.gltf") << gltfHead().textBeside("walk.bin");
  const auto writeBuffer = [&](const char* file, const std::string& bytes) {
    std::ofstream(folder / file, std::ios::binary) << bytes;
  };
  const std::string bytes = gltfHead().bytes();
  writeBuffer("walk.bin", bytes);
  const std::string scalp = "v -2 0 -2\nv 2 0 -2\nv 0 0 2\nf 1 2 3\n";
  writeBuffer("scalp.obj", scalp);
  const std::vector<std::string> arguments{"simulate", "groom.obj",    "--motion",  "walk.gltf", "--frames",
                                           "100000",   "--checkpoint", "2",         "--resume",  "--hairs",
                                           "9",        "--hair-scalp", "scalp.obj", "--backend", "reference",
                                           "-o",       "out"};
  test::RunningProgram program(folder, arguments);
  EXPECT_TRUE(program.waitUntil([&] { return test::hasDoneFrames(folder / "out"); }));
  program.send(SIGKILL);
  (void)program.wait();
  const auto refused = [&](const char* file) {
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, 4) << result.err;
    EXPECT_NE(result.err.find(std::string("the content of ") + file), std::string::npos) << result.err;
  };
  std::string other = bytes;
  other.back() = static_cast<char>(other.back() + 1);
  writeBuffer("walk.bin", other);
  refused("walk.bin");
  writeBuffer("walk.bin", bytes);
  writeBuffer("scalp.obj", scalp + "# more\n");
  refused("scalp.obj");
  writeBuffer("scalp.obj", scalp);
  // As it was, it goes on.
  const auto kept = readCheckpoint(folder / "out/checkpoint.rgk");
  ASSERT_TRUE(kept) << kept.error().message;
  test::RunningProgram again(folder, arguments);
  EXPECT_TRUE(again.waitUntil([&] {
    const auto checkpoint = readCheckpoint(folder / "out/checkpoint.rgk");
    return checkpoint && checkpoint->frame > kept->frame;
  }));
  again.send(SIGKILL);
  (void)again.wait();
}

}  // namespace
}  // namespace ringlet::motion_file_test
