// Numbers of a scene that change while hair moves: which may, what they are at a time, what readers say.
#include "ringlet/scenes/frames/scene_keys.h"

#include <gtest/gtest.h>

#include "ringlet/rest/live_material.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/scene/settings_fields.h"
#include "ringlet/scenes/load/load_scene.h"
#include "tests/support/test_support.h"

namespace ringlet::scene_keys_test {
namespace {

const std::string kGroom = "[groom]\ngenerate = \"curl\"\n";

SceneFile parsed(const std::string& text) {
  auto scene = parseScene(kGroom + text, "scene.toml");
  EXPECT_TRUE(scene) << scene.error().message;
  return scene ? *scene : SceneFile{};
}

SceneNumbers numbersAt(const SceneKeys& keys, double seconds) {
  auto numbers = keys.at(seconds, 4);
  EXPECT_TRUE(numbers) << numbers.error().message;
  return *numbers;
}

TEST(SceneKeys, AreHitAndKeptBeyondTheEnds) {
  const auto keys = SceneKeys::make(parsed(
      "[material]\nbend_stiffness = 3\n[[key]]\ntime = 1\nair.wind = [1, 2, 3]\nmaterial.dials.hold = 2\n"
      "[[key]]\ntime = 2\nair.wind = [5, 2, 0]\n[[key]]\ntime = 4\nmaterial.dials.hold = 6\ngoal.strength = "
      "7\n"));
  ASSERT_TRUE(keys) << keys.error().message;
  EXPECT_EQ(keys->times(), (std::vector<double>{1, 2, 4}));
  for (const double t : {-5.0, 0.0, 1.0}) {
    EXPECT_EQ(numbersAt(*keys, t).settings.air.wind, (Vec3d{1, 2, 3})) << t;
    EXPECT_EQ(numbersAt(*keys, t).material.bendStiffness, 6) << t;
  }
  for (const double t : {2.0, 3.0, 100.0})
    EXPECT_EQ(numbersAt(*keys, t).settings.air.wind, (Vec3d{5, 2, 0})) << t;
  for (const double t : {4.0, 100.0}) EXPECT_DOUBLE_EQ(numbersAt(*keys, t).material.bendStiffness, 18) << t;
  // What one key says holds all the time, and its table is on.
  EXPECT_EQ(numbersAt(*keys, 0).settings.goal.strength, 7);
  EXPECT_TRUE(numbersAt(*keys, 0).settings.goal.on && numbersAt(*keys, 0).settings.air.on);
  // It leaves the one and comes to the other at rest: halfway between two it has gone half the way.
  EXPECT_NEAR(numbersAt(*keys, 1.5).settings.air.wind.x, 3, 1e-12);
  EXPECT_NEAR(numbersAt(*keys, 2.5).material.bendStiffness, 12, 1e-12);
  EXPECT_NEAR(numbersAt(*keys, 1.001).settings.air.wind.x, 1, 1e-4);
  EXPECT_EQ(numbersAt(*keys, 3).settings.stepsPerFrame, 4);
  const auto areEqual = [&](double a, double b) {
    const SceneNumbers one = *keys->at(a, 8), other = *keys->at(b, 8);
    return one.settings == other.settings && one.material == other.material;
  };
  EXPECT_TRUE(areEqual(-1, 1) && areEqual(4, 9));
  EXPECT_FALSE(areEqual(1, 1.5) || areEqual(2, 3));
  EXPECT_FALSE(keys->changeContacts());
}

// The cubic would go below 0 between two keys of 0 after a high one.
TEST(SceneKeys, StayInTheirRange) {
  const auto keys = SceneKeys::make(parsed(
      "[[key]]\ntime = 0\ngoal.strength = 50\n[[key]]\ntime = 1\ngoal.strength = 0\n[[key]]\ntime = 2\n"
      "goal.strength = 0\n[[key]]\ntime = 3\ngoal.strength = 0\n"));
  ASSERT_TRUE(keys) << keys.error().message;
  double least = 1;
  for (int i = 0; i <= 300; ++i) least = std::min(least, numbersAt(*keys, 0.01 * i).settings.goal.strength);
  EXPECT_EQ(least, 0);
}

// Every one, halfway to another value: what the solver takes while hair moves, and nothing else.
TEST(SceneKeys, AreWhatTheSolverTakesWhileHairMoves) {
  EXPECT_GT(keyedNumbers().size(), 30u);
  for (const KeyedNumber& number : keyedNumbers()) {
    SCOPED_TRACE(number.key);
    SceneFile scene = parsed("");
    switchOn(number, scene);
    const Vec3d before = number.get(scene);
    Vec3d after = before + Vec3d{0.25, number.isVector ? 0.5 : 0, 0};
    if (number.key.ends_with("elongation_low")) after.x = 0.5;
    const std::string value =
        number.isVector ? fmt::format("[{}, {}, {}]", after.x, after.y, after.z) : fmt::format("{}", after.x);
    const auto read =
        parseScene(kGroom + fmt::format("[[key]]\ntime = 0\n{} = {}\n", number.key, value), "s");
    if (!read) {
      // A range that does not hold it.
      EXPECT_FALSE(number.allowed.contains(after.x)) << read.error().message;
      continue;
    }
    const auto keys = SceneKeys::make(*read);
    ASSERT_TRUE(keys) << keys.error().message;
    const SceneNumbers now = numbersAt(*keys, 0);
    SceneFile set = scene;
    number.set(set, after);
    EXPECT_EQ(number.get(set), after);
    scene.timeKeys = {{0, {{number.key, before}}}};
    const SceneNumbers was = numbersAt(*SceneKeys::make(scene), 0);
    EXPECT_EQ(fixedDifference(was.settings, now.settings), "");
    EXPECT_EQ(fixedDifference(was.material, now.material), "");
  }
  for (const char* fixed :
       {"simulation.fps", "simulation.steps_per_frame", "material.line_density", "contacts.radius",
        "air.turbulence", "material.dials.root_hold", "material.variation.seed", "groom.unit"})
    EXPECT_FALSE(keyedNumber(SceneFile{}, fixed)) << fixed;
}

TEST(SceneKeys, AreWrittenAsTheyWereRead) {
  const SceneFile scene = parsed(
      "[[key]]\ntime = -0.5\nsimulation.gravity = 3.7\n[[key]]\ntime = 0.1\nair.wind = [0.1, 0, 2]\n"
      "material.variation.bend_stiffness = 0.3\n");
  const auto again = parseScene(sceneText(scene), "again");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->timeKeys, scene.timeKeys);
  EXPECT_EQ(scene.timeKeys.size(), 2u);
}

TEST(SceneKeys, MistakesAreNamedWithLineAndRemedy) {
  const struct {
    const char *text, *message;
  } kCases[] = {
      {"[[key]]\nair.wind = [1, 0, 0]", "line 3: found no time of key 1; expected one, in seconds"},
      {"[[key]]\ntime = 1\nair.wind = [1, 0, 0]\n[[key]]\ntime = 1\nair.wind = [1, 0, 0]",
       "line 7: found the time 1 of key 2; expected one after that of the key before, 1"},
      {"[[key]]\ntime = 'now'\nair.wind = [1, 0, 0]",
       "line 4: found the text 'now' for key.time; expected a number from -3600 to 36000 s"},
      {"[[key]]\ntime = 1\nair.wnd = [1, 0, 0]",
       "line 5: found 'air.wnd' in a key; it is no key of a scene; did you mean air.wind?"},
      {"[[key]]\ntime = 1\nsimulation.fps = 30",
       "line 5: found 'simulation.fps' in a key; it does not change while hair moves"},
      {"[[key]]\ntime = 1\nair.wind = 3", "line 5: found the number 3 for air.wind; expected [x, y, z]"},
      {"[[key]]\ntime = 1\nmaterial.bend_stiffness = 0",
       "line 5: found the number 0 for material.bend_stiffness; expected a number from 0.001 to 1000000 w"},
      {"[[key]]\ntime = 1",
       "line 3: found nothing that key 1 changes; expected keys with their tables, as air.wind = [1, 0, 0]"},
      {"[key]\ntime = 1", "line 3: found a table for key; expected a list of tables, as in [[key]]"},
  };
  for (const auto& c : kCases) {
    const auto scene = parseScene(kGroom + c.text, "scene.toml");
    ASSERT_FALSE(scene) << c.text;
    EXPECT_EQ(scene.error().message, std::string("scene.toml: ") + c.message) << c.text;
  }
  // What two numbers spoil together is told with the time.
  const auto spoilt =
      loadScene(parsed("[material]\nbend_stiffness = 1e6\n[[key]]\ntime = 2\nmaterial.dials.hold = 3\n"));
  ASSERT_FALSE(spoilt);
  EXPECT_NE(spoilt.error().message.find("at 2 s: bend_stiffness is 3"), std::string::npos)
      << spoilt.error().message;
}

// A run begins with the numbers of its beginning, and has steps enough for its stiffest key.
TEST(SceneKeys, AScenesStartAndStepsAreThoseOfItsKeys) {
  const std::string stiff =
      "[[key]]\ntime = 0\nmaterial.dials.hold = 1\n[[key]]\ntime = 1\nmaterial.dials.hold = 900\n";
  const auto plain = loadScene(parsed("")), keyed = loadScene(parsed(stiff)),
             held = loadScene(parsed("[material.dials]\nhold = 900\n"));
  ASSERT_TRUE(plain && keyed && held);
  EXPECT_EQ(keyed->material, plain->material);
  EXPECT_GT(held->settings.stepsPerFrame, plain->settings.stepsPerFrame);
  EXPECT_EQ(keyed->settings.stepsPerFrame, held->settings.stepsPerFrame);
  EXPECT_FALSE(plain->keys);
  const auto paper = loadScene(parsed("[simulation]\nintegrator = \"paper\"\n" + stiff));
  EXPECT_TRUE(paper) << "whose start is the material's own";
}

}  // namespace
}  // namespace ringlet::scene_keys_test
