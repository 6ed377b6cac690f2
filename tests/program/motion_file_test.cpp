// `ringlet simulate --motion FILE.bvh`: the groom follows a joint of a motion capture, and mistakes are
// sentences.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "ringlet/groom/groom_file.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet {
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
  struct Case {
    std::vector<std::string> options;
    int exitCode;
    std::string message;
  };
  for (const Case& c : {
           Case{{"--motion", "walk.BVH", "--joint", "Haed"}, 1, "walk.BVH has no joint Haed; "},
           Case{{"--motion", "walk.BVH", "--joint", "LeftWrist"}, 1, "it has Hips, rig:Head"},
           Case{{"--motion", "walk.BVH", "--skip-frames", "13"}, 1, "too few are left"},
           Case{{"--motion", "walk.BVH", "--amplitude", "1"}, 2, "a motion from a file has its own"},
           Case{{"--motion", "walk.BVH", "--motion-unit", "0"}, 2, "must be a number from"},
           Case{{"--motion", "nod", "--joint", "Head"}, 2, "only a .bvh file has a --joint"},
           Case{{"--motion", "missing.bvh"}, 1, "missing.bvh"},
           Case{{"--motion", "broken.bvh"}, 1, "broken.bvh is no BVH motion: line 2: \"ROOT\" should stand"},
           Case{{"--motion", "nodd"}, 2, "did you mean nod?"},
       }) {
    std::vector<std::string> arguments{"simulate", "groom.obj", "--backend", "reference", "-o", "out"};
    arguments.insert(arguments.end(), c.options.begin(), c.options.end());
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << result.err;
    EXPECT_NE(result.err.find(c.message), std::string::npos) << result.err;
  }
}

}  // namespace
}  // namespace ringlet
