// scenes/load/motion_reach.h: motions that end before the run, or that only jump, are said with their
// numbers.
#include "ringlet/scenes/load/motion_reach.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "ringlet/scenes/load/load_scene.h"
#include "tests/motion/gltf_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::test::motion_reach_test {
namespace {

// A second of 24 frames, in which the head goes `metres` along X.
class MotionReach : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream bvh(folder_ / "m.bvh");
    bvh << "HIERARCHY\nROOT Head\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\nEnd Site\n{\n"
           "OFFSET 0 0 0\n}\n}\nMOTION\nFrames: 25\nFrame Time: 0.0416666667\n";
    for (int k = 0; k < 25; ++k) bvh << k << " 0 0\n";
    GltfBuilder file;
    const int head = file.node({{"name", "Head"}});
    file.channel(0, head, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0.24, 0, 0});
    std::ofstream(folder_ / "m.gltf") << file.text();
  }
  std::string warningsOf(const std::string& text) const {
    const auto scene =
        parseScene("[groom]\ngenerate = 'curl'\nparticles = 16\n" + text, "the scene", folder_);
    EXPECT_TRUE(scene) << scene.error().message;
    const auto loaded = loadScene(*scene);
    EXPECT_TRUE(loaded) << loaded.error().message;
    std::string all;
    for (const std::string& warning : loaded->warnings) all += warning + "\n";
    return all;
  }
  static bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  const std::filesystem::path folder_ = scratchFolder("motion_reach");
};

TEST_F(MotionReach, AMotionThatEndsBeforeTheRunIsSaid) {
  for (const char* file : {"m.bvh", "m.gltf"}) {
    SCOPED_TRACE(file);
    const std::string motion = fmt::format("[motion]\nfile = '{}'\nunit = 0.01\n", file);
    const std::string longer = warningsOf(motion + "[simulation]\nframes = 40\n");
    EXPECT_TRUE(holds(longer,
                      "its motion ends after 1 s, at frame 24 of the 40 of this run; in the other 16 "
                      "the head keeps its last pose"))
        << longer;
    const std::string other = warningsOf(motion + "[simulation]\nseconds = 2\nfps = 60\n");
    EXPECT_TRUE(holds(other, "at frame 60 of the 120 of this run; in the other 60 the head")) << other;
    for (const char* frames : {"", "[simulation]\nframes = 24\n", "[simulation]\nframes = 3\n",
                               "[simulation]\nseconds = 1\nfps = 30\n"})
      EXPECT_FALSE(holds(warningsOf(motion + frames), "its motion ends")) << frames;

    const std::string body = warningsOf(fmt::format(
        "[motion]\nkind = 'shake'\n[[body]]\nname = 'ball'\nshape = 'sphere'\nposition = [0, -1, 0]\n"
        "[body.moves]\nfile = '{}'\nunit = 0.01\n[simulation]\nframes = 30\n",
        file));
    EXPECT_TRUE(holds(body, "at frame 24 of the 30 of this run; in the other 6 the body ball keeps")) << body;
  }
}

TEST_F(MotionReach, AHeadThatOnlyJumpsIsSaid) {
  const std::string shake =
      warningsOf("[motion]\nkind = 'shake'\namplitude = 500\n[simulation]\nframes = 48\n");
  EXPECT_TRUE(holds(shake, " of 48 frames the head moves farther than 1 m, which counts as a teleport"))
      << shake;
  EXPECT_TRUE(holds(shake, "hair is carried along and not simulated there")) << shake;
  EXPECT_TRUE(holds(shake, "--amplitude")) << shake;

  const std::string bvh =
      warningsOf("[motion]\nfile = 'm.bvh'\nunit = 2\n[simulation]\nframes = 24\n");  // 2 m a frame
  // The time that the file states for a frame is longer than 1/24 s by 3e-11: its first pose is kept so long.
  EXPECT_TRUE(holds(bvh, "in 23 of 24 frames the head moves farther than 1 m")) << bvh;
  EXPECT_TRUE(holds(bvh, "--motion-unit")) << bvh;
  const std::string gltf = warningsOf("[motion]\nfile = 'm.gltf'\nunit = 200\n[simulation]\nframes = 24\n");
  EXPECT_TRUE(holds(gltf, "in 24 of 24 frames the head moves farther than 1 m")) << gltf;
  const std::string keys = warningsOf(
      "[motion]\n[[motion.key]]\ntime = 0\n[[motion.key]]\ntime = 1\nposition = [0, 30, 0]\n"
      "[[motion.key]]\ntime = 2\nposition = [0, 0, 0]\n[simulation]\nframes = 48\nteleport_distance = 0.5\n");
  // Keys so far apart are jumped between, and the head is still else.
  EXPECT_TRUE(holds(keys, "in 2 of 48 frames the head moves farther than 0.5 m")) << keys;
  EXPECT_TRUE(holds(keys, "positions of its keys in metres")) << keys;

  for (const char* quiet :
       {"[motion]\nkind = 'shake'\n", "[motion]\nkind = 'walk'\n",
        "[motion]\nkind = 'shake'\namplitude = 0.5\n", "[motion]\nfile = 'm.bvh'\nunit = 0.01\n",
        "[motion]\nkind = 'shake'\namplitude = 500\n[simulation]\nframes = 48\nteleport_distance = 0\n",
        // one cut is a cut
        "[motion]\n[[motion.key]]\ntime = 0\n[[motion.key]]\ntime = 1\n[[motion.key]]\ntime = "
        "1.01\nposition = [50, 0, 0]\n[[motion.key]]\ntime = 2\nposition = [50, 0, 0]\n"})
    EXPECT_FALSE(holds(warningsOf(quiet), "teleport")) << quiet << warningsOf(quiet);
}

}  // namespace
}  // namespace ringlet::test::motion_reach_test
