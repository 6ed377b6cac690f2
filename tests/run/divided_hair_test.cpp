// run/divided_hair.h: parts of divided hair take what they are at rest from the whole, which is built once.
#include "ringlet/run/divided_hair.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ringlet/rest/whole_rest.h"
#include "ringlet/run/split_hair.h"
#include "ringlet/run/strand_parts.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"
#include "tests/support/gpu_test.h"

namespace ringlet::divided_hair_test {
namespace {

using DividedHair = test::GpuTest;

LoadedScene sceneOf(bool contacts) {
  const std::string text =
      "[groom]\ngenerate = \"swatch\"\ncolumns = 3\nrows = 2\nparticles = 16\nturns = 2\n";
  return *loadScene(*parseScene(text + (contacts ? "[contacts]\non = true\n" : ""), "the scene"));
}

// What a rest state was warned of is what its hair says, so that a sentence of one's own tells whose it is.
TEST_F(DividedHair, PartsTakeWhatTheyAreAtRestFromTheWhole) {
  for (const bool contacts : {false, true}) {
    SCOPED_TRACE(contacts ? "in contact" : "without contacts");
    const LoadedScene scene = sceneOf(contacts);
    const SceneFrames frames(scene);
    SceneHairInput input{scene, frames};
    auto rest = wholeRestOf(input);
    ASSERT_TRUE(rest) << rest.error().message;
    EXPECT_EQ(rest->contacts.has_value(), contacts);
    const std::string mark = "this is the whole";
    rest->state.warnings.push_back(mark);
    const auto parts = divideStrands(scene.groom, input.settings(), *rest, 2);
    ASSERT_TRUE(parts) << parts.error().message;
    const auto isMarked = [&](const Result<std::unique_ptr<SceneHair>>& hair) {
      EXPECT_TRUE(hair) << hair.error().message;
      return std::ranges::count((*hair)->facts().warnings, mark) > 0;
    };
    EXPECT_FALSE(isMarked(makeSplitHair(input, *parts, {{device()}, {device()}})));
    input.rest = &*rest;
    EXPECT_TRUE(isMarked(makeDeviceHair(input, {device()})));
    EXPECT_TRUE(isMarked(makeSplitHair(input, *parts, {{device()}, {device()}})));
  }
}

// In contact, in both ways, on a head that moves: two parts have the bits of the whole.
TEST_F(DividedHair, TwoPartsHaveTheBitsOfTheWhole) {
  for (const char* method : {"explicit", "volume"}) {
    SCOPED_TRACE(method);
    const LoadedScene scene = *loadScene(*parseScene(
        std::string("[groom]\ngenerate = \"swatch\"\ncolumns = 3\nrows = 2\nparticles = 16\nturns = 2\n"
                    "spacing = 0.012\n[motion]\nkind = \"shake\"\n[contacts]\nradius = 0.01\nmethod = \"") +
            method + "\"\n",
        "the scene"));
    const SceneFrames frames(scene);
    std::vector<std::vector<Vec3f>> positions;
    for (const std::size_t devices : {1u, 2u}) {
      auto hair = makeDividedHair({scene, frames}, std::vector<DeviceHairChoice>(devices, {device()}));
      ASSERT_TRUE(hair) << hair.error().message;
      for (int frame = 0; frame < 3; ++frame) {
        ASSERT_TRUE((*hair)->submit(*frames.at(frame)));
        ASSERT_TRUE((*hair)->wait());
      }
      const auto reports = (*hair)->reports();
      ASSERT_TRUE(reports) << reports.error().message;
      if (method[0] == 'e') {
        EXPECT_GT(reports->contacts.contacts, 0u);
      }
      positions.push_back(*(*hair)->positions());
    }
    EXPECT_EQ(positions[1], positions[0]);
  }
}

TEST_F(DividedHair, NeedsAStrandADevice) {
  const LoadedScene scene = sceneOf(false);
  const SceneFrames frames(scene);
  const auto hair = makeDividedHair({scene, frames}, std::vector<DeviceHairChoice>(7, {device()}));
  ASSERT_FALSE(hair);
  EXPECT_EQ(hair.error().message, "7 devices are more than the groom's 6 strands");
  const auto each = makeDividedHair({scene, frames}, std::vector<DeviceHairChoice>(6, {device()}));
  ASSERT_TRUE(each) << each.error().message;
  EXPECT_EQ((*each)->positions()->size(), scene.groom.points.size());
}

}  // namespace
}  // namespace ringlet::divided_hair_test
