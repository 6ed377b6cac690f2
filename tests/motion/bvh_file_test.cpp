// motion/bvh_file.h, by hand and on real captures.
#include "ringlet/motion/bvh_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "ringlet/motion/bvh_stance.h"
#include "tests/support/test_support.h"

namespace ringlet::test::bvh_file_test {
namespace {

// Two bones and a head: 10 up, 5 up, and the end 2 further. `channels` of the neck.
std::string skeleton(const std::string& channels, const std::string& motion) {
  return "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0 0 0\n\tCHANNELS 6 Xposition Yposition Zposition Zrotation "
         "Xrotation "
         "Yrotation\n\tJOINT Neck\n\t{\n\t\tOFFSET 0 10 0\n\t\tCHANNELS " +
         channels +
         "\n\t\tJOINT mixamorig:Head\n\t\t{\n\t\t\tOFFSET 0 5 0\n\t\t\tCHANNELS 0\n\t\t\tEnd "
         "Site\n\t\t\t{\n\t\t\t\tOFFSET 0 2 "
         "0\n\t\t\t}\n\t\t}\n\t}\n}\nMOTION\n" +
         motion;
}
const char* const kStill = "Frames: 1\nFrame Time: 0.04\n1 2 3 0 0 0 0 0 0\n";

Vec3d headAt(const BvhFile& file) { return file.motionOf(*file.find("Head"), 1, 0).poses.front().position; }

void expectNear(Vec3d a, Vec3d b) { EXPECT_LT(length(a - b), 1e-12) << a.x << " " << a.y << " " << a.z; }

TEST(BvhFile, ReadsASkeleton) {
  const auto file = parseBvh(skeleton("3 Zrotation Xrotation Yrotation", kStill));
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->joints.size(), 4u);
  EXPECT_EQ(file->channelCount, 9u);
  EXPECT_EQ(file->frameCount(), 1u);
  EXPECT_EQ(file->frameSeconds, 0.04);
  expectNear(file->placesAt(0)[3], {1, 19, 3});
  expectNear(headAt(*file), {1, 17, 3});
}

TEST(BvhFile, FindsJointsByNameCaseAndSuffix) {
  const auto file = parseBvh(skeleton("3 Zrotation Xrotation Yrotation", kStill));
  ASSERT_TRUE(file);
  EXPECT_EQ(file->find("Neck"), 1u);
  EXPECT_EQ(file->find("neck"), 1u);
  EXPECT_EQ(file->find("Head"), 2u);
  EXPECT_EQ(file->find("mixamorig:Head"), 2u);
  EXPECT_FALSE(file->find("ead"));
  EXPECT_FALSE(file->find(""));
}

// Rotations apply in the order they are listed, each about the axes the ones before have turned.
TEST(BvhFile, RotatesInTheListedOrder) {
  const auto place = [](const char* channels, const char* angles) {
    const auto file = parseBvh(
        skeleton(channels, std::string("Frames: 1\nFrame Time: 0.04\n0 0 0 0 0 0 ") + angles + "\n"));
    EXPECT_TRUE(file) << file.error().message;
    return headAt(*file) - Vec3d{0, 10, 0};
  };
  // Z by 90 takes up to -X; X by 90 takes up to +Z.
  expectNear(place("3 Zrotation Xrotation Yrotation", "90 0 0"), {-5, 0, 0});
  expectNear(place("3 Zrotation Xrotation Yrotation", "0 90 0"), {0, 0, 5});
  expectNear(place("3 Zrotation Xrotation Yrotation", "90 90 0"), {0, 0, 5});   // Z (X up) = Z (+Z)
  expectNear(place("3 Xrotation Zrotation Yrotation", "90 90 0"), {-5, 0, 0});  // X (Z up) = X (-X)
  expectNear(place("3 Yrotation Zrotation Xrotation", "90 90 0"), {0, 0, 5});   // Y (Z up) = Y (-X) = +Z
}

TEST(BvhFile, PositionsStandInPlaceOfOffsets) {
  const auto file = parseBvh(skeleton("6 Xposition Yposition Zposition Zrotation Xrotation Yrotation",
                                      "Frames:1\r\nFrame Time:\t0.04\r\n0 0 0 0 0 0 1 20 3 0 0 0\r\n"));
  ASSERT_TRUE(file) << file.error().message;
  expectNear(headAt(*file), {1, 25, 3});
}

TEST(BvhFile, SaysWhatIsWrongAndWhere) {
  const std::string turns = "3 Zrotation Xrotation Yrotation";
  const std::pair<std::string, const char*> cases[] = {
      {"", "line 1: the file ends where \"HIERARCHY\" should stand"},
      {"HIERARCHY\nJOINT a", "line 2: \"ROOT\" should stand where 'JOINT' is"},
      {"HIERARCHY\nROOT a\n{\nOFFSET 0 x 0", "line 4: a number of an offset"},
      {skeleton("3 Zrotation Wrotation Yrotation", kStill), "line 9: a channel"},
      {skeleton("7 Zrotation Xrotation Yrotation", kStill), "a joint has 0 to 6 channels, not 7"},
      {skeleton(turns, "Frames: 0\nFrame Time: 0.04\n1 2 3 0 0 0 0 0 0\n"), "not 0; the number there"},
      {skeleton(turns, "Frames: 1\nFrame Time: 0\n"), "must be above 0"},
      {skeleton(turns, "Frames: 2\nFrame Time: 0.04\n1 2 3 0 0 0 0 0 0\n1 2 3\n"),
       "line 26: frame 2 has 3 of its 9 numbers; the file states 2 frames and holds 1 and a part of one"},
      {skeleton(turns, "Frames: 1\nFrame Time: 0.04\n1 2 nan 0 0 0 0 0 0\n"), "number 3 of 9"},
      {skeleton(turns, "Frames: 1\nFrame Time: 0.04\n1 2 3 0 0 0 0 0 0 9\n"),
       "frame 2 has 1 of its 9 numbers; the file states 1 frames and holds 1 and a part of one"},
      {skeleton(turns, "Frames: 3\nFrame Time: 0.04\n"), "states 3 frames and holds none"},
      {skeleton(turns, "Frames: 1\nFrame Time: 0.04\n1 2 3 0 0 0 0 0 0\nend\n"), "number 1 of 9: line 25"},
      {"HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n}\nMOTION\nFrames: 3\nFrame Time: 1\n", "no channels"},
  };
  for (const auto& [text, expected] : cases) {
    const auto file = parseBvh(text);
    ASSERT_FALSE(file) << expected;
    EXPECT_NE(file.error().message.find(expected), std::string::npos) << file.error().message;
  }
}

// Exporters miscount. What is there is read, up to what is stated.
TEST(BvhFile, ReadsWholeFramesWhateverTheCountSays) {
  for (const int stated : {1, 2, 3, 4, 5, 100}) {
    for (const int held : {1, 2, 3, 4}) {
      std::string motion = fmt::format("Frames: {}\nFrame Time: 0.04\n", stated);
      for (int k = 0; k < held; ++k) motion += fmt::format("{} 2 3 0 0 0 0 0 0\n", k);
      const auto file = parseBvh(skeleton("3 Zrotation Xrotation Yrotation", motion));
      ASSERT_TRUE(file) << file.error().message;
      EXPECT_EQ(file->statedFrameCount, static_cast<std::size_t>(stated));
      EXPECT_EQ(file->foundFrameCount, static_cast<std::size_t>(held));
      ASSERT_EQ(file->frameCount(), static_cast<std::size_t>(std::min(stated, held)));
      const Keyframes keys = file->motionOf(*file->find("Head"), 1, 0);
      for (std::size_t k = 0; k < keys.poses.size(); ++k)
        expectNear(keys.poses[k].position, {static_cast<double>(k), 17, 3});
    }
  }
}

// Cut or changed anywhere, a file is refused or read; nothing worse.
TEST(BvhFile, SurvivesCutFiles) {
  const std::string whole = skeleton("3 Zrotation Xrotation Yrotation", kStill);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    (void)parseBvh(whole.substr(0, size));
    std::string changed = whole;
    for (char c : {'{', '}', ':', ' ', '9', '-'}) {
      changed[size] = c;
      (void)parseBvh(changed);
    }
  }
}

// Captures nobody here made: a walk whose first frame is a T-pose, and a head that drops.
TEST(BvhFile, ReadsRealCaptures) {
  RINGLET_NEEDS_DATA(walkPath, "bvh/cmu_12_01_walk.bvh");
  RINGLET_NEEDS_DATA(bankPath, "bvh/test_mocapbank.bvh");
  const auto walk = readBvh(walkPath), bank = readBvh(bankPath);
  ASSERT_TRUE(walk) << walk.error().message;
  ASSERT_TRUE(bank) << bank.error().message;
  for (const auto* file : {&*walk, &*bank}) {
    const auto head = file->find("head");
    ASSERT_TRUE(head);
    const double height = stanceOf(*file, 1, {}).height, unit = 1.7 / height;
    const Keyframes all = file->motionOf(*head, unit, 0), rest = file->motionOf(*head, unit, 1);
    double low = INFINITY, high = -INFINITY, fastest = 0;
    for (std::size_t k = 0; k < rest.poses.size(); ++k) {
      low = std::min(low, rest.poses[k].position.y), high = std::max(high, rest.poses[k].position.y);
      if (k > 0)
        fastest = std::max(fastest,
                           length(rest.poses[k].position - rest.poses[k - 1].position) / rest.secondsPerKey);
    }
    fmt::print(
        "{} frames of {} s, person {:.4g} units tall; head from {:.2f} to {:.2f} m, up to {:.2f} m/s; "
        "turns at "
        "{:.1f} rad/s with the first frame, {:.1f} without\n",
        file->frameCount(), file->frameSeconds, height, low, high, fastest, all.fastestTurn().speed,
        rest.fastestTurn().speed);
    EXPECT_GT(low, 0.2);
    EXPECT_LT(high, 2.5);
    EXPECT_LT(fastest, 6);
    EXPECT_LT(rest.fastestTurn().speed, 30);
  }
}

}  // namespace
}  // namespace ringlet::test::bvh_file_test
