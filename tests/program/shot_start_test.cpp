// [start]: hair that begins as another run ended (scenes/load/shot_start.h, startOf of run/scene_run.h).
#include "ringlet/scenes/load/shot_start.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "program/simulate/reference_hair.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/run/divided_hair.h"
#include "ringlet/run/run.h"
#include "ringlet/scenes/file/scene_file.h"
#include "tests/program/run_program.h"
#include "tests/support/gpu_test.h"
#include "tests/support/test_support.h"

namespace ringlet::shot_start_test {
namespace {

namespace fs = std::filesystem;

const std::string kGroom =
    "[groom]\ngenerate = \"swatch\"\ncolumns = 3\nrows = 2\nparticles = 24\nturns = 2\n";
// The head moves and turns until 0.25 s, and then stays.
const std::string kJerk =
    "[[motion.key]]\ntime = 0\n[[motion.key]]\ntime = 0.25\nposition = [0.1, 0, 0.05]\n"
    "rotate_degrees = [0, 40, 20]\n";
// It stays elsewhere, turned as it was at the end.
const std::string kStays = "[[motion.key]]\ntime = 0\nposition = [5, 1, 0]\nrotate_degrees = [0, 40, 20]\n";

std::string from(const fs::path& run) { return fmt::format("[start]\nfrom = '{}'\n", run.string()); }
std::string frames(int count) { return fmt::format("[simulation]\nframes = {}\n", count); }

class ShotStartTest : public test::GpuTest {
 protected:
  LoadedScene load(const std::string& text) const {
    const auto file = parseScene(text, "the scene");
    EXPECT_TRUE(file) << file.error().message;
    auto scene = loadScene(*file);
    EXPECT_TRUE(scene) << scene.error().message;
    return std::move(*scene);
  }
  std::string errorOf(const std::string& text) const {
    const auto file = parseScene(text, "the scene");
    if (!file) return file.error().message;
    const auto scene = loadScene(*file);
    return scene ? "none" : scene.error().message;
  }

  // Positions relative to the head, along the world's axes, of each frame.
  std::vector<std::vector<Vec3f>> run(const std::string& text, const fs::path& folder = {}) {
    std::vector<std::vector<Vec3f>> all;
    const auto outcome =
        runScene(load(text), {.folder = folder, .cache = CachePrecision::float32}, hairOn({device()}),
                 {.computed = [&](const ComputedFrame& frame) { all.push_back(frame.positions); }});
    EXPECT_TRUE(outcome) << outcome.error().message;
    return all;
  }

  const fs::path folder_ = test::scratchFolder("shot_start");
};

double farthest(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, length(Vec3d(a[i]) - Vec3d(b[i])));
  return most;
}

double meanDistance(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += length(Vec3d(a[i]) - Vec3d(b[i]));
  return sum / static_cast<double>(a.size());
}

// A run in two is the run in one. What differs is that velocities are of frames and not of an instant: less
// at more frames a second.
TEST_F(ShotStartTest, GoesOnAsOneRunWouldHave) {
  const std::string fast = "fps = 96\n";
  const auto whole = run(kGroom + kJerk + frames(56) + fast);
  run(kGroom + kJerk + frames(48) + fast, folder_);
  const auto rest = run(kGroom + kStays + frames(8) + fast);
  const auto second = run(kGroom + kStays + from(folder_) + frames(8) + fast);
  ASSERT_EQ(second.size(), 8u);
  double apart = 0, way = 0;
  for (std::size_t k = 0; k < second.size(); ++k) {
    apart += meanDistance(second[k], whole[48 + k]);
    way += meanDistance(whole[48 + k], rest[k]);
  }
  EXPECT_GT(way / 8, 2e-3) << "the hair swings";
  EXPECT_LT(apart, 0.08 * way);
}

// Hair that is carried along begins with its head's motion as well.
TEST_F(ShotStartTest, MovesAlongWithItsHead) {
  run(kGroom + frames(3), folder_);
  const std::string spin =
      "[[motion.key]]\ntime = -0.1\nrotate_degrees = [0, -30, 0]\n"
      "[[motion.key]]\ntime = 0.1\nrotate_degrees = [0, 30, 0]\n";
  const auto rest = run(kGroom + spin + frames(2)), begun = run(kGroom + spin + from(folder_) + frames(2));
  for (std::size_t k = 0; k < 2; ++k) EXPECT_LT(farthest(begun[k], rest[k]), 1e-4) << k;
}

TEST_F(ShotStartTest, IsTheSameOnTheReference) {
  run(kGroom + kJerk + frames(8), folder_);
  const LoadedScene scene = load(kGroom + kStays + from(folder_) + frames(2));
  const SceneFrames all(scene);
  const auto reference = program::makeReferenceHair({scene, all}), gpu = hairOn({device()})({scene, all});
  ASSERT_TRUE(reference && gpu);
  EXPECT_LT(farthest(*(*reference)->positions(), *(*gpu)->positions()), 1e-6) << "at the start";
  const auto frame = all.at(0);
  ASSERT_TRUE(frame);
  for (SceneHair* hair : {&**reference, &**gpu}) {
    ASSERT_TRUE(hair->submit(*frame));
    ASSERT_TRUE(hair->wait());
  }
  EXPECT_LT(farthest(*(*reference)->positions(), *(*gpu)->positions()), 2e-5) << "a frame later";
}

TEST_F(ShotStartTest, AnyFrameAndAnyFileWillDo) {
  const auto first = run(kGroom + kJerk + frames(8), folder_);
  const auto start = [&](const std::string& more) {
    const LoadedScene scene = load(kGroom + more);
    const SceneFrames all(scene);
    return *(*hairOn({device()})({scene, all}))->positions();
  };
  // Seen from heads that stand differently, so roots are brought together by the turn of 40 and 20 degrees.
  const auto last = start(kStays + from(folder_));
  EXPECT_LT(farthest(last, first[7]), 1e-5);
  EXPECT_LT(farthest(start(kStays + from(folder_ / "hair.rgc") + "frame = 8\n"), last), 1e-9);
  EXPECT_GT(farthest(start(kStays + from(folder_) + "frame = 7\n"), last), 1e-4);
}

TEST_F(ShotStartTest, BlendHoldsHairToHowItBegan) {
  run(kGroom + kJerk + frames(9), folder_);
  // Another groom of the same strands: straighter and shorter curls.
  const std::string other =
      "[groom]\ngenerate = \"swatch\"\ncolumns = 3\nrows = 2\nparticles = 24\nturns = 1\n";
  const LoadedScene scene = load(other + kStays + from(folder_));
  const SceneFrames all(scene);
  const auto start = *(*hairOn({device()})({scene, all}))->positions();
  const auto sudden = run(other + kStays + from(folder_) + frames(12)),
             held = run(other + kStays + from(folder_) + "blend = 8\n" + frames(12)),
             rest = run(other + kStays + frames(12));
  EXPECT_LT(farthest(held[0], start), 0.5 * farthest(sudden[0], start));
  EXPECT_LT(farthest(held[11], rest[11]), farthest(held[0], rest[0])) << "it goes to the groom's own shape";
}

// A goal of the scene and what holds the start are two springs.
TEST_F(ShotStartTest, BlendStandsBesideAGoal) {
  run(kGroom + kJerk + frames(5), folder_);
  const std::string goal = "[goal]\nstrength = 2\n", blend = from(folder_) + "blend = 4\n";
  const auto strengthsOf = [&](const std::string& text, double seconds) {
    const LoadedScene scene = load(kGroom + text);
    EXPECT_TRUE(scene.forces.haveGoals());
    const auto goals = scene.forces.goalsAt(seconds, {}, scene.settings.goal, nullptr);
    EXPECT_TRUE(goals);
    EXPECT_EQ(goals->places.size(), scene.groom.points.size());
    EXPECT_EQ(goals->strengths.size(), scene.groom.points.size());
    return goals->strengths;
  };
  const auto both = strengthsOf(goal + blend, 0), alone = strengthsOf(blend, 0),
             later = strengthsOf(goal + blend, 1), ended = strengthsOf(blend, 1);
  for (std::size_t i = 0; i < both.size(); ++i) {
    EXPECT_FLOAT_EQ(both[i], alone[i] + later[i]) << i;
    EXPECT_EQ(ended[i], 0) << i;
  }
  EXPECT_GT(later[8], 0);
}

// What was written are all hairs, and what begins are their guides and a sample.
TEST_F(ShotStartTest, GuidesBeginAsTheirHairsWere) {
  const std::string groom =
      "[groom]\nfile = '" + (folder_ / "dense.obj").string() + "'\nguides = 5\nguides_sample = 2\n";
  const auto program = [&](std::vector<std::string> arguments) {
    const auto result = test::runProgram(folder_, std::move(arguments));
    ASSERT_EQ(result.exitCode, 0) << result.err;
  };
  program({"make", "swatch", "--columns", "6", "--rows", "4", "--particles", "12", "-o", "dense.obj"});
  std::ofstream(folder_ / "a.toml") << groom << "[motion]\nkind = 'shake'\n" << frames(4);
  program({"simulate", "a.toml", "--cache", "float32", "--no-usd", "--no-sheet", "-o", "a"});
  auto all = AnimationReader::open(folder_ / "a/hair.rgc");
  ASSERT_TRUE(all) << all.error().message;
  ASSERT_EQ(all->groom().strandCount(), 24u);
  ASSERT_TRUE(all->readFrame(4));
  const LoadedScene scene = load(groom + from(folder_ / "a"));
  ASSERT_TRUE(scene.start);
  ASSERT_EQ(scene.groom.strandCount(), 7u);
  std::vector<std::uint32_t> strands = scene.level->guides;
  strands.insert(strands.end(), scene.level->sample.begin(), scene.level->sample.end());
  for (std::size_t s = 0; s < strands.size(); ++s) {
    const auto hair = all->groom().strand(strands[s]);
    for (std::size_t i = 0; i < hair.size(); ++i) {
      // `shake` does not turn the head.
      const Vec3d offset = (Vec3d(hair[i]) - Vec3d(hair[0])) * scene.groom.metresPerUnit;
      EXPECT_LT(length(Vec3d(scene.start->offsets[scene.groom.firstPoint[s] + i]) - offset), 2e-5)
          << s << ' ' << i;
    }
  }
}

TEST_F(ShotStartTest, SaysWhatIsWrong) {
  run(kGroom + frames(3), folder_);
  const std::string fewer =
      "[groom]\ngenerate = \"swatch\"\ncolumns = 2\nrows = 2\nparticles = 24\nturns = 2\n";
  fs::create_directories(folder_ / "empty");
  for (const auto& [text, part] : {
           std::pair(fewer + from(folder_), "has 6 strands of 144 particles in all, the groom 4 of 96"),
           std::pair(kGroom + from(folder_) + "frame = 4\n", "has frames 1 to 3; there is no frame 4"),
           std::pair(kGroom + from(folder_ / "empty"), "holds no hair.usda"),
           std::pair(kGroom + from(folder_ / "none.rgc"), "none.rgc"),
           std::pair(kGroom + "[start]\nblend = 3\n", "no effect without start.from"),
           std::pair(kGroom + "[motion]\nkind = \"shake\"\npre_roll = 1\n" + from(folder_),
                     "found start.from and motion.pre_roll"),
       })
    EXPECT_NE(errorOf(text).find(part), std::string::npos) << errorOf(text);
  const LoadedScene first = load(kGroom + from(folder_) + "frame = 1\n");
  ASSERT_EQ(first.warnings.size(), 1u);
  EXPECT_NE(first.warnings[0].find("begins without any"), std::string::npos) << first.warnings[0];
  EXPECT_TRUE(load(kGroom + from(folder_)).warnings.empty());
}

}  // namespace
}  // namespace ringlet::shot_start_test
