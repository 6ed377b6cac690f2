// motion/bvh_stance.h, and what readMotionFile makes of it: persons of many kinds of files stand upright and
// at their height, whatever unit, axis and axes of bones a file has, and whatever the person does.
#include "ringlet/motion/bvh_stance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "ringlet/motion/motion_file.h"
#include "tests/motion/skeleton_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::test::bvh_stance_test {
namespace {

struct Loaded {
  std::vector<HeadPose> poses;
  std::string warnings;
};

Loaded loaded(const Convention& convention, Posture posture, bool upIsZ, MotionFileChoice choice = {}) {
  const auto path = scratchFolder("bvh_stance") / "person.bvh";
  std::ofstream(path) << bvhOf(convention, posture);
  choice.path = path;
  choice.joint = headOf(convention);
  choice.skippedFrames = convention.hasTPose ? 1 : 0;
  std::vector<std::string> warnings;
  const auto motion = readMotionFile(choice, upIsZ, warnings);
  EXPECT_TRUE(motion) << motion.error().message;
  Loaded result;
  if (motion) result.poses = motion->keyframes->poses;
  for (const std::string& warning : warnings) result.warnings += warning + "\n";
  return result;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.at(values.size() / 2);
}

// Along an axis of the groom: 0, 1, 2.
double middle(const Loaded& loaded, int axis) {
  std::vector<double> values;
  for (const HeadPose& pose : loaded.poses)
    values.push_back(axis == 0 ? pose.position.x : axis == 1 ? pose.position.y : pose.position.z);
  return median(std::move(values));
}

TEST(BvhStance, PersonsOfAllKindsOfFilesStandUpright) {
  for (const Convention& convention : kConventions) {
    for (const bool upIsZ : {false, true}) {
      for (const Posture posture : {Posture::walks, Posture::turnsHead}) {
        SCOPED_TRACE(fmt::format("{}, {} up", convention.name, upIsZ ? "Z" : "Y"));
        const Loaded person = loaded(convention, posture, upIsZ);
        ASSERT_FALSE(person.poses.empty());
        const double height = middle(person, upIsZ ? 2 : 1);
        if (posture == Posture::turnsHead && !upIsZ) fmt::print("{:<45} {:.3f} m\n", convention.name, height);
        EXPECT_GT(height, 1.5);
        EXPECT_LT(height, 1.6);
        EXPECT_NEAR(middle(person, 0), 0, 0.02);
        // The head turns about what is up.
        const Vec3d up = upIsZ ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
        const Quatd first = person.poses[0].rotation;
        double most = 0;
        for (const HeadPose& pose : person.poses) {
          // Hair stands upright on joints that are upright in the file, or were before its root was turned.
          if (convention.axes != BoneAxes::alongX) {
            EXPECT_GT(dot(rotate(pose.rotation, up), up), 0.999);
          }
          const Quatd turn = pose.rotation * first.conjugate();
          EXPECT_GT(dot(rotate(turn, up), up), 0.999);
          most = std::max(most, length(Vec3d{turn.x, turn.y, turn.z}));
        }
        double widest = 0;
        const int start = convention.hasTPose ? 1 : 0;
        for (int frame = start; frame < kPersonFrames; ++frame)
          widest = std::max(widest, std::abs(headTurn(frame) - headTurn(start)));
        EXPECT_NEAR(most, std::sin(widest / 2 * std::numbers::pi / 180), 1e-5)
            << "by as much as it was written";
        const bool isOther = convention.up != 'Y';
        EXPECT_EQ(person.warnings.find("stands along") != std::string::npos, isOther) << person.warnings;
        EXPECT_EQ(person.warnings.find("motion-up") != std::string::npos, isOther) << person.warnings;
        EXPECT_EQ(person.warnings.find(" 0 units"), std::string::npos);
        EXPECT_EQ(person.warnings.find("states 48 frames and holds 49; the first 48") != std::string::npos,
                  convention.excessFrames > 0);
      }
    }
  }
}

// The unit is that of the person, whatever it does: arms above the head, legs above the hips, lying, sitting.
TEST(BvhStance, TheHeightIsOfThePersonWhateverItDoes) {
  const std::pair<const char*, Posture> postures[] = {
      {"walks", Posture::walks}, {"has its arms up", Posture::armsUp},
      {"sits", Posture::sits},   {"lies", Posture::lies},
      {"jumps", Posture::jumps}, {"kicks", Posture::kicks}};
  for (const Convention& convention : kConventions) {
    for (const auto& [name, posture] : postures) {
      SCOPED_TRACE(fmt::format("{} {}", convention.name, name));
      const auto file = parseBvh(bvhOf(convention, posture));
      ASSERT_TRUE(file) << file.error().message;
      const BvhStance stance =
          stanceOf(*file, convention.hasTPose ? 1 : 0, {}, file->find(headOf(convention)));
      EXPECT_NEAR(stance.height / convention.unitsPerMetre, kPersonTall, 0.05 * kPersonTall);
      const bool stands = posture != Posture::sits && posture != Posture::lies;
      if (posture != Posture::lies) {
        EXPECT_EQ(stance.everStands, stands);
      }
    }
  }
}

// Whoever lies in all frames may as well stand in a file of another axis: both are said, with the option.
TEST(BvhStance, WhoLiesIsNotTakenForAnotherAxisUnsaid) {
  for (const Convention& convention : kConventions) {
    if (convention.up != 'Y') continue;
    SCOPED_TRACE(convention.name);
    const Loaded person = loaded(convention, Posture::lies, false);
    EXPECT_NE(person.warnings.find("lies along"), std::string::npos) << person.warnings;
    EXPECT_NE(person.warnings.find("--motion-up -Z"), std::string::npos) << person.warnings;
    EXPECT_LT(middle(person, 1), 0.5) << "near the floor";
    // As stated, no doubt is left.
    const Loaded stated =
        loaded(convention, Posture::lies, false, {.path = {}, .metresPerUnit = {}, .up = FileAxis::plusY});
    EXPECT_EQ(stated.warnings.find("lies"), std::string::npos) << stated.warnings;
    EXPECT_NEAR(middle(stated, 1), middle(person, 1), 1e-9);
    const Loaded other =
        loaded(convention, Posture::lies, false, {.path = {}, .metresPerUnit = {}, .up = FileAxis::minusZ});
    EXPECT_NEAR(middle(other, 1), -middle(person, 2), 0.05) << other.warnings;
  }
}

// Who lies first and stands later is upright when it stands, whatever axis it lay along.
TEST(BvhStance, WhoGetsUpStandsAlongTheUpAxis) {
  for (const Convention& convention : kConventions) {
    SCOPED_TRACE(convention.name);
    const auto file = parseBvh(bvhOf(convention, Posture::getsUp));
    ASSERT_TRUE(file) << file.error().message;
    const BvhStance stance = stanceOf(*file, convention.hasTPose ? 1 : 0, {}, file->find(headOf(convention)));
    EXPECT_EQ(nameOf(stance.up), convention.up == 'y' ? "-Y" : std::string(1, convention.up));
    EXPECT_NEAR(stance.height / convention.unitsPerMetre, kPersonTall, 0.05 * kPersonTall);
    EXPECT_TRUE(stance.everStands);
  }
}

TEST(BvhStance, AStatedAxisIsTakenUnasked) {
  for (const char* name : {"Y", "Z", "X", "-Y", "-Z", "-X"}) {
    const auto axis = fileAxisNamed(name);
    ASSERT_TRUE(axis) << name;
    EXPECT_EQ(nameOf(*axis), name);
    for (const bool upIsZ : {false, true}) {
      const Affine turn = turnUp(*axis, upIsZ);
      const Vec3d up = turn(directionOf(*axis));
      EXPECT_EQ(up, (upIsZ ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0})) << name;
      EXPECT_EQ(dot(cross(turn.x, turn.y), turn.z), 1) << name;
      // A joint whose axes are the file's does in the groom's what it does in the file's.
      const Quatd rotation = fromRotationVector(Vec3d{0.4, -0.9, 1.3});
      const Quatd there = turnedRotation(*axis, *axis, upIsZ, rotation);
      for (const Vec3d v : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0.3, -0.5, 2}})
        EXPECT_LT(length(rotate(there, turn(v)) - turn(rotate(rotation, v))), 1e-12) << name;
    }
    const Loaded person =
        loaded(kConventions[1], Posture::turnsHead, false, {.path = {}, .metresPerUnit = {}, .up = axis});
    EXPECT_EQ(person.warnings.find("motion-up"), std::string::npos) << person.warnings;
    const double height = middle(person, 1);
    EXPECT_NEAR(height,
                std::string(name) == "Y"    ? 1.511
                : std::string(name) == "-Y" ? -1.511
                                            : 0,
                std::string(name) == "-Y" ? 0.02 : 1e-3)  // straightened, since it stands on its head
        << name;
    // On its head, or along another axis, it does not stand.
    EXPECT_EQ(person.warnings.find("as it stands in its frames") != std::string::npos,
              std::string(name) == "Y")
        << name << " " << person.warnings;
  }
  EXPECT_FALSE(fileAxisNamed("W"));
  EXPECT_FALSE(fileAxisNamed(""));
}

std::string bvh(const std::string& hierarchy, const std::string& motion) {
  return "HIERARCHY\n" + hierarchy + "MOTION\nFrames: 2\nFrame Time: 0.04\n" + motion;
}

// Skeletons that show no person: a unit is found or taken, and nothing is 0 units tall.
TEST(BvhStance, SkeletonsWithoutAPersonHaveAUnit) {
  struct Case {
    const char* name;
    std::string text;
    double unit;
    const char* said;
  };
  const std::string place = "CHANNELS 3 Xposition Yposition Zposition\n";
  const Case cases[] = {
      {"a point", bvh("ROOT Head\n{\nOFFSET 0 0 0\n" + place + "}\n", "0 160 0\n1 160 0\n"), 0.01,
       "one point"},
      {"all offsets zero",
       bvh("ROOT Hips\n{\nOFFSET 0 0 0\n" + place +
               "JOINT Head\n{\nOFFSET 0 0 0\nCHANNELS 0\nEnd Site\n{\nOFFSET 0 0 "
               "0\n}\n}\n}\n",
           "0 90 0\n1 90 0\n"),
       0.01, "one point"},
      {"only positions",
       bvh("ROOT Hips\n{\nOFFSET 0 0 0\n" + place + "JOINT Head\n{\nOFFSET 0 0 0\n" + place + "}\n}\n",
           "0 90 0 0 85 0\n1 90 0 0 85 0\n"),
       1.7 / 85, "85 units"},
      {"no joint called head",
       bvh("ROOT a\n{\nOFFSET 0 0 0\n" + place + "JOINT Head1\n{\nOFFSET 0 17 0\nCHANNELS 0\n}\n}\n",
           "0 90 0\n1 90 0\n"),
       0.1, "17 units"},
      {"far too small",
       bvh("ROOT Hips\n{\nOFFSET 0 0 0\n" + place + "JOINT Head\n{\nOFFSET 0 1e-9 0\nCHANNELS 0\n}\n}\n",
           "0 90 0\n1 90 0\n"),
       0.01, "which no person is in any unit"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const auto path = scratchFolder("bvh_stance_points") / "motion.bvh";
    std::ofstream(path) << c.text;
    std::vector<std::string> warnings;
    MotionFileChoice choice{path, "Head", {}};
    if (c.name == std::string("no joint called head")) choice.joint = "a";
    const auto motion = readMotionFile(choice, false, warnings);
    ASSERT_TRUE(motion) << motion.error().message;
    EXPECT_NEAR(motion->keyframes->poses[1].position.x - motion->keyframes->poses[0].position.x, c.unit,
                1e-9);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find(c.said), std::string::npos) << warnings[0];
    EXPECT_EQ(warnings[0].find(" 0 units"), std::string::npos) << warnings[0];
  }
}

// A file of one frame is a pose: what it states and holds is said, and what was skipped.
TEST(BvhStance, AMotionNeedsTwoFrames) {
  const auto path = scratchFolder("bvh_stance_frames") / "person.bvh";
  const auto errorOf = [&](int held, int excess, int skipped) {
    Convention convention = kConventions[1];
    convention.excessFrames = excess;
    std::ofstream(path) << bvhOf(convention, Posture::turnsHead, held);
    std::vector<std::string> warnings;
    const auto motion = readMotionFile({.path = path, .skippedFrames = skipped}, false, warnings);
    EXPECT_FALSE(motion);
    return motion ? "" : motion.error().message.substr(path.string().size());
  };
  EXPECT_EQ(errorOf(1, 0, 0), " has one frame; a motion needs two frames");
  EXPECT_EQ(errorOf(1, 4, 0), " has one frame (it states 1 and holds 5); a motion needs two frames");
  EXPECT_EQ(errorOf(3, 0, 2),
            " has 3 frames, and the first 2 are skipped (--skip-frames, skip_frames of [motion]); a motion "
            "needs two frames");
}

// Without a name that says so, the head is what the hair follows; other joints of the file go with it.
TEST(BvhStance, AHeadOfAnyNameIsAHead) {
  for (const char* name : {"Kopf", "j4", "testa"}) {
    for (const std::size_t which : {1u, 10u}) {  // Y up, Z up
      SCOPED_TRACE(fmt::format("{} {}", name, kConventions[which].name));
      Convention convention = kConventions[which];
      convention.names = "plain";
      std::string text = bvhOf(convention, Posture::turnsHead);
      const std::pair<std::string, std::string> words[] = {{"HeadTop", "x1"}, {"Head", name}, {"Neck", "x2"}};
      for (const auto& [word, other] : words) {
        for (std::size_t at = text.find(word); at != text.npos; at = text.find(word))
          text.replace(at, word.size(), other);
      }
      const auto path = scratchFolder("bvh_stance_names") / "person.bvh";
      std::ofstream(path) << text;
      std::vector<std::string> warnings;
      const auto head = readMotionFile({.path = path, .joint = name}, false, warnings);
      ASSERT_TRUE(head) << head.error().message;
      const Vec3d at = head->keyframes->poses[0].position;
      EXPECT_NEAR(at.y, 1.7 / 1.8 * 1.6, 0.01);
      const std::size_t said = warnings.size();
      const auto hips = readMotionFile({.path = path, .joint = "Hips", .headJoint = name}, false, warnings);
      ASSERT_TRUE(hips) << hips.error().message;
      EXPECT_NEAR(length(at - hips->keyframes->poses[0].position), 1.7 / 1.8 * 0.65, 0.01);
      EXPECT_EQ(warnings.size(), said) << "nothing is said twice";
    }
  }
}

// A stated unit in which the person is a giant, or a doll.
TEST(BvhStance, AStatedUnitIsDoubted) {
  const auto warningsOf = [](double unit) {
    return loaded(kConventions[1], Posture::turnsHead, false, {.path = {}, .metresPerUnit = unit}).warnings;
  };
  EXPECT_EQ(warningsOf(0.01), "");
  EXPECT_NE(warningsOf(1).find("180 m tall with units of 1 m, which no person is"), std::string::npos)
      << warningsOf(1);
  EXPECT_NE(warningsOf(0.001).find("which no person is"), std::string::npos) << warningsOf(0.001);
}

}  // namespace
}  // namespace ringlet::test::bvh_stance_test
