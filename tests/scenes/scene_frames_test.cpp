// What a scene says of each frame: when, where, what changes; alone, in single steps, with something dragged,
// with a clock that is changed.
#include "ringlet/scenes/frames/scene_frames.h"

#include <gtest/gtest.h>

#include <string>

#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet::scene_frames_test {
namespace {

const std::string kShaken =
    "[groom]\ngenerate = \"swatch\"\ncolumns = 2\nrows = 1\nparticles = 6\nturns = 0\n"
    "[motion]\nkind = \"shake\"\npre_roll = 0.11\n"
    "[[body]]\nshape = \"sphere\"\nradius = 0.03\nposition = [0.3, 0, 0]\nmoves = \"head\"\n"
    "[[body]]\nshape = \"sphere\"\nradius = 0.03\nposition = [0.6, 0, 0]\nmoves = \"still\"\n";

LoadedScene sceneOf(const std::string& text) {
  const auto file = parseScene(text, "scene");
  EXPECT_TRUE(file) << file.error().message;
  auto scene = loadScene(*file);
  EXPECT_TRUE(scene) << scene.error().message;
  return std::move(*scene);
}

bool isSame(const HeadPose& a, const HeadPose& b) {
  return a.position == b.position && a.rotation == b.rotation && a.shift == b.shift;
}

TEST(SceneFrames, ThePreRollIsWholeFramesBeforeTheFirst) {
  LoadedScene scene = sceneOf(kShaken);
  for (const auto& [seconds, first] :
       {std::pair{0.0, 0}, {0.11, -3}, {0.125, -3}, {2 / 24.0, -2}, {1e-9, 0}}) {
    scene.preRollSeconds = seconds;
    EXPECT_EQ(SceneFrames(scene).first(), first) << seconds;
  }
}

// However late: the step's number over steps a second.
TEST(SceneFrames, TimesAreQuotients) {
  const LoadedScene scene = sceneOf(kShaken);
  const SceneFrames frames(scene);
  const double steps = scene.settings.stepsPerFrame, perSecond = 24 * steps;
  for (const int number : {-3, 0, 7, 123'457}) {
    const auto frame = frames.at(number);
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->number, number);
    ASSERT_EQ(frame->stepCount(), static_cast<std::size_t>(steps));
    ASSERT_EQ(frame->bodies.size(), 2 * frame->stepCount());
    for (std::size_t k = 0; k < frame->stepCount(); ++k) {
      const double t = (number * steps + static_cast<double>(k) + 1) / perSecond;
      EXPECT_TRUE(isSame(frame->heads[k], scene.motion.poseAt(t))) << number << " " << k;
      EXPECT_EQ(frame->bodies[2 * k], scene.bodies[0].poseAt(t, frame->heads[k]));
      EXPECT_EQ(frame->bodies[2 * k + 1], scene.bodies[1].poseAt(t, frame->heads[k]));
    }
    const ScenePlaces places = frames.placesAt(number);
    EXPECT_TRUE(isSame(places.head, scene.motion.poseAt(number / 24.0)));
    EXPECT_TRUE(isSame(places.headEarlier, scene.motion.poseAt(number / 24.0 - 1 / perSecond)));
    EXPECT_EQ(places.bodies, frames.bodiesAt(number));
  }
}

TEST(SceneFrames, AStepAloneIsThatStep) {
  const LoadedScene scene = sceneOf(kShaken +
                                    "[[field]]\nkind = \"uniform\"\nbind = \"head\"\nstrength = 2\n"
                                    "[[cut]]\ntime = 0.08\nat = 0.5\n"
                                    "[[key]]\ntime = 0\nair.wind = [0, 0, 0]\nfield.1.strength = 0\n"
                                    "[[key]]\ntime = 1\nair.wind = [3, 0, 0]\nfield.1.strength = 8\n");
  const auto frame = SceneFrames(scene).at(2);
  ASSERT_TRUE(frame) << frame.error().message;
  ASSERT_EQ(frame->change.cuts.size(), 1u);
  ASSERT_TRUE(frame->change.numbers);
  double strength = frame->forces.fieldsFrom[0].axial;
  for (std::size_t k = 0; k < frame->stepCount(); ++k) {
    const SceneFrame step = frame->step(k);
    EXPECT_EQ(step.number, 2);
    EXPECT_EQ(step.ofStep, k);
    ASSERT_EQ(step.stepCount(), 1u);
    EXPECT_TRUE(isSame(step.heads[0], frame->heads[k]));
    EXPECT_EQ(step.bodies, std::vector(frame->bodies.begin() + static_cast<std::ptrdiff_t>(2 * k),
                                       frame->bodies.begin() + static_cast<std::ptrdiff_t>(2 * k + 2)));
    EXPECT_EQ(step.change.isNone(), k > 0) << "what changes, changes as the frame begins";
    EXPECT_NEAR(step.forces.fieldsFrom[0].axial, strength, 1e-12);
    strength = step.forces.fields[0].axial;
  }
  EXPECT_NEAR(strength, frame->forces.fields[0].axial, 1e-12);
}

// Numbers of keys have the lists of strands that files say.
TEST(SceneFrames, KeysKeepTheListsOfStrands) {
  const LoadedScene scene =
      sceneOf(kShaken +
              "[contacts]\non = true\n[[group]]\nname = \"bun\"\nstrands = \"0:1\"\ntouch = false\n"
              "[[key]]\ntime = 0\nair.wind = [0, 0, 0]\n[[key]]\ntime = 1\nair.wind = [3, 0, 0]\n");
  ASSERT_TRUE(scene.settings.contacts.bundles);
  const auto frame = SceneFrames(scene).at(3);
  ASSERT_TRUE(frame && frame->change.numbers);
  EXPECT_EQ(frame->change.numbers->settings.contacts.bundles, scene.settings.contacts.bundles);
}

// A checkpoint knows nothing of what frames before it changed.
TEST(SceneFrames, ChangesBeforeAFrameAreItsNumbersAndAllCuts) {
  const LoadedScene scene =
      sceneOf(kShaken +
              "[[cut]]\ntime = -0.1\nat = 0.8\nstrands = \"0\"\n[[cut]]\ntime = 0.1\nat = 0.5\n"
              "[[key]]\ntime = 0\nmaterial.dials.weight = 1\n[[key]]\ntime = 0.1\nmaterial.dials.weight = 2\n"
              "[[key]]\ntime = 0.2\nmaterial.dials.weight = 1\n");
  const SceneFrames frames(scene);
  const auto none = frames.changesBefore(frames.first());
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->empty());
  const auto changes = frames.changesBefore(10);  // the weight is 1 again
  ASSERT_TRUE(changes);
  ASSERT_EQ(changes->size(), 3u) << "the first other material, the last numbers, the cuts";
  EXPECT_FALSE((*changes)[0].numbers->material == scene.material);
  EXPECT_TRUE((*changes)[1].numbers->material == frames.at(9)->change.numbers->material);
  EXPECT_EQ((*changes)[2].cuts.size(), 2u);
}

TEST(SceneFrames, WhatIsDraggedIsElsewhereAndNothingElse) {
  const LoadedScene scene = sceneOf(kShaken);
  const SceneFrames frames(scene);
  const SceneFrame still = *frames.at(4);
  SceneDrags drags{.bodies = {{}, {}}};
  const SceneFrame same = *frames.at(4, drags);
  for (std::size_t k = 0; k < still.stepCount(); ++k)
    EXPECT_TRUE(isSame(same.heads[k], still.heads[k])) << "bits";
  EXPECT_EQ(same.bodies, still.bodies);

  drags.head = {{{0.1, 0, 0}, {}}, {{0.3, 0, 0}, {}}};
  drags.bodies[1] = {{}, {{0, 0.2, 0}, {}}};
  const SceneFrame dragged = *frames.at(4, drags);
  for (std::size_t k = 0; k < still.stepCount(); ++k) {
    const double share = static_cast<double>(k + 1) / static_cast<double>(still.stepCount());
    EXPECT_NEAR(length(dragged.heads[k].position - still.heads[k].position), 0.1 + 0.2 * share, 1e-12);
    EXPECT_NEAR(length(dragged.bodies[2 * k].position - still.bodies[2 * k].position), 0.1 + 0.2 * share,
                1e-12)
        << "the head carries it";
    EXPECT_NEAR(dragged.bodies[2 * k + 1].position.y - still.bodies[2 * k + 1].position.y, 0.2 * share,
                1e-12);
  }
  const ScenePlaces places = frames.placesAt(5, drags);
  EXPECT_TRUE(isSame(places.head, dragged.heads.back())) << "where the frame before ended";
  EXPECT_LT(length(places.headEarlier.position - dragged.heads[still.stepCount() - 2].position), 1e-12);
  EXPECT_EQ(places.bodies[1], dragged.bodies.back());
}

TEST(SceneFrames, TimeGoesOnWithOtherFramesASecond) {
  const LoadedScene scene = sceneOf(kShaken);
  SceneFrames frames(scene);
  Settings settings = scene.settings;
  settings.framesPerSecond = 48;
  frames.change(6, settings, {});
  EXPECT_EQ(frames.secondsAt(6), 6 / 24.0);
  EXPECT_EQ(frames.secondsAt(12), 6 / 24.0 + 6 / 48.0);
  EXPECT_TRUE(isSame(frames.at(11)->heads.back(), scene.motion.poseAt(6 / 24.0 + 6 / 48.0)));
  settings.maxStretch = 1.3;
  frames.change(9, settings, {});
  EXPECT_EQ(frames.secondsAt(12), 6 / 24.0 + 6 / 48.0);
  frames.restart();
  EXPECT_EQ(frames.first(), -6);
  EXPECT_EQ(frames.secondsAt(12), 12 / 48.0);
}

}  // namespace
}  // namespace ringlet::scene_frames_test
