// motion/motion_doubts.h: glTF heads that stand as high as none does are doubted, whatever unit the exporter
// wrote; heads of persons are not, wherever the person is.
#include "ringlet/motion/motion_doubts.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <numbers>

#include "ringlet/motion/motion_file.h"
#include "tests/motion/gltf_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::test::motion_doubts_test {
namespace {

enum class Form { lone, chain, underRoot };

struct Person {
  Form form = Form::chain;
  double unitsPerMetre = 1;
  Vec3d place{};      // of its root in the world [m]
  int up = 1;         // the file's axis: 1 Y, 2 Z
  double scale = 1;   // of the root, as exporters mend units
  double head = 1.6;  // above the floor [m]
  double way = 0.1;   // that the head goes to the side [m]
};

// A head that goes to the side in a second.
GltfBuilder gltfOf(const Person& person) {
  GltfBuilder file;
  const double units = person.unitsPerMetre / person.scale;
  const auto along = [&](double height, double side = 0) {
    std::array<double, 3> place{side * units, 0, 0};
    place[static_cast<std::size_t>(person.up)] = height * units;
    return place;
  };
  const double first = person.form == Form::lone ? person.head : person.head - 1.5;
  const int head = file.node({{"name", "Head"}, {"translation", along(first)}});
  if (person.form != Form::lone) {
    int below = head;
    for (const auto& [name, height] :
         {std::pair{"Neck", 0.2}, {"Chest", 0.2}, {"Spine", 0.15}, {"Hips", 0.95}})
      below = file.node({{"name", name}, {"translation", along(height)}, {"children", {below}}});
    const Vec3d at = person.place * person.unitsPerMetre;
    if (person.form == Form::underRoot) {
      file.node({{"name", "Armature"},
                 {"translation", {at.x, at.y, at.z}},
                 {"scale", {person.scale, person.scale, person.scale}},
                 {"children", {below}}});
      file.node({{"name", "World"}, {"children", {below + 1}}});
    }
  }
  std::vector<double> values;
  for (const double side : {0.0, person.way}) {
    const auto place = along(first, side);
    values.insert(values.end(), place.begin(), place.end());
  }
  file.channel(0, head, "translation", "LINEAR", {0, 1}, values);
  return file;
}

std::string warningsOf(const Person& person, MotionFileChoice choice = {}) {
  choice.path = scratchFolder("motion_doubts") / "m.gltf";
  std::ofstream(choice.path) << gltfOf(person).text();
  std::vector<std::string> warnings;
  const auto motion = readMotionFile(choice, false, warnings);
  EXPECT_TRUE(motion) << motion.error().message;
  std::string all;
  for (const std::string& warning : warnings) all += warning + "\n";
  return all;
}

// One key, or keys of one time: there is no frame for a second pose.
TEST(MotionDoubts, AnAnimationThatTakesNoTimeIsRefused) {
  for (const std::vector<double>& times : {std::vector<double>{0}, {0, 0}}) {
    GltfBuilder file;
    const int head = file.node({{"name", "Head"}, {"translation", {0, 1.6, 0}}});
    file.channel(0, head, "translation", "LINEAR", times, std::vector<double>(3 * times.size(), 1));
    const auto path = scratchFolder("motion_doubts") / "still.gltf";
    std::ofstream(path) << file.text();
    std::vector<std::string> warnings;
    const auto motion = readMotionFile({.path = path}, false, warnings);
    ASSERT_FALSE(motion);
    EXPECT_NE(motion.error().message.find("time"), std::string::npos) << motion.error().message;
  }
}

TEST(MotionDoubts, HeadsInOtherUnitsAreDoubted) {
  struct Unit {
    double perMetre;
    const char *height, *option;
  };
  for (const Form form : {Form::lone, Form::chain, Form::underRoot}) {
    for (const Unit& unit :
         {Unit{100, "160 m above the root of the file", "1.6 m with --motion-unit 0.01"},
          Unit{1000, "1.6e+03 m above the root of the file", "1.6 m with --motion-unit 0.001"},
          Unit{1 / 0.0254, "63 m above the root of the file", "1.6 m with --motion-unit 0.0254"}}) {
      SCOPED_TRACE(fmt::format("{} {}", static_cast<int>(form), unit.perMetre));
      const std::string said = warningsOf({.form = form, .unitsPerMetre = unit.perMetre});
      EXPECT_NE(said.find(std::string("the node Head stands ") + unit.height + ", which no head does"),
                std::string::npos)
          << said;
      EXPECT_NE(said.find(unit.option), std::string::npos) << said;
      EXPECT_EQ(warningsOf({.form = form, .unitsPerMetre = unit.perMetre},
                           {.path = {}, .metresPerUnit = 1 / unit.perMetre}),
                "");
    }
  }
}

// The first bone of a chain says little of the others: a head may be on its neck's very end.
TEST(MotionDoubts, AHeadNearItsNeckStandsOnAllOfTheChain) {
  for (const Form form : {Form::chain, Form::underRoot}) {
    for (const double head : {1.52, 1.51, 1.58}) {
      const std::string said = warningsOf({.form = form, .unitsPerMetre = 100, .head = head, .way = 0.002});
      EXPECT_NE(
          said.find(fmt::format("the node Head stands {:.3g} m above the root of the file", 100 * head)),
          std::string::npos)
          << head << said;
      EXPECT_EQ(warningsOf({.form = form, .head = head, .way = 0.002}), "") << head;
    }
  }
}

TEST(MotionDoubts, PersonsAreNot) {
  for (const Form form : {Form::lone, Form::chain, Form::underRoot}) {
    SCOPED_TRACE(static_cast<int>(form));
    EXPECT_EQ(warningsOf({.form = form}), "");
    EXPECT_EQ(warningsOf({.form = form, .head = 1.7}), "");
    EXPECT_EQ(warningsOf({.form = form, .head = 2.1}), "") << "tall";
  }
  for (const Vec3d& place : {Vec3d{500, 0, 0}, Vec3d{0, 0, -3000}, Vec3d{40, 2, 40}, Vec3d{0, 2, 0},
                             Vec3d{0, 5, 0}, Vec3d{0, 8, 0}, Vec3d{0, 120, 0}}) {
    EXPECT_EQ(warningsOf({.form = Form::underRoot, .place = place}), "")
        << place.x << " " << place.y << " " << place.z;
  }
  EXPECT_EQ(warningsOf({.form = Form::underRoot, .scale = 0.01}), "")
      << "centimetres under a scale that mends them";
}

// The head's own axes may be those of the file, or have Y along the neck: hair stands upright on either.
TEST(MotionDoubts, HairStandsOnHeadsOfAFileWithAnotherUpAxis) {
  for (const bool areTurned : {false, true}) {
    for (const bool upIsZ : {false, true}) {
      GltfBuilder file = gltfOf({.up = 2});
      if (areTurned) {
        const Quatd turn = fromRotationVector(Vec3d{std::numbers::pi / 2, 0, 0});
        file.root["nodes"][0]["rotation"] = {turn.x, turn.y, turn.z, turn.w};
      }
      const auto path = scratchFolder("motion_doubts_axes") / "m.gltf";
      std::ofstream(path) << file.text();
      std::vector<std::string> warnings;
      const auto motion = readMotionFile({.path = path, .up = FileAxis::plusZ}, upIsZ, warnings);
      ASSERT_TRUE(motion) << motion.error().message;
      const Vec3d up = upIsZ ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
      const HeadPose pose = motion->poseAt(0);
      EXPECT_NEAR(dot(pose.position, up), 1.6, 1e-6);
      EXPECT_GT(dot(rotate(pose.rotation, up), up), 0.9999);
    }
  }
}

TEST(MotionDoubts, AnotherAxisThanGltfsIsNamed) {
  const std::string said = warningsOf({.up = 2});
  EXPECT_NE(said.find("the node Head is along Z from Hips, where glTF has Y up"), std::string::npos) << said;
  EXPECT_NE(said.find("--motion-up Z"), std::string::npos) << said;
  EXPECT_EQ(warningsOf({.up = 2}, {.path = {}, .metresPerUnit = {}, .up = FileAxis::plusZ}), "");
}

}  // namespace
}  // namespace ringlet::test::motion_doubts_test
