// What dials do on built-in scenes: each changes what it is named for, and leaves what it says it leaves.
// Figures for all: docs/art-direction.md.
#include <cmath>

#include "tests/scenes/scene_runs.h"

namespace ringlet::test::dials_scene_test {
namespace {

struct Found {
  double droop = 0, worstDroop = 0, hertz = 0, settle = 0;
};

class DialsScene : public SceneTest {
 protected:
  Found with(const char* name, const MaterialDials& dials, double preload) {
    const auto scene = makeScene(name, {.preload = preload, .dials = dials});
    EXPECT_TRUE(scene) << scene.error().message;
    const SceneRun run = this->run(*scene);
    return {run.numbers.droop, std::abs(run.numbers.worstDroop), run.numbers.bounceHz.value_or(NAN),
            run.numbers.settleSeconds.value_or(NAN)};
  }
};

TEST_F(DialsScene, OfAHangingCurl) {
  const auto hanging = [&](const MaterialDials& dials) { return with("hanging_curl", dials, 0); };
  const Found plain = hanging({});

  // Its own weight twice: sags as far again, less what its core spring stiffens, at the same pace.
  const Found heavy = hanging({.weight = 2}), light = hanging({.weight = 0.5});
  EXPECT_GT(heavy.droop, 1.6 * plain.droop);
  EXPECT_LT(light.droop, 0.6 * plain.droop);
  for (const Found& found : {heavy, light}) EXPECT_NEAR(found.settle / plain.settle, 1, 0.1);

  // Firmer hangs less and settles as before.
  const Found firm = hanging({.hold = 2}), soft = hanging({.hold = 0.5});
  EXPECT_LT(firm.droop, 0.75 * plain.droop);
  EXPECT_GT(soft.droop, 1.25 * plain.droop);
  for (const Found& found : {firm, soft}) EXPECT_NEAR(found.settle / plain.settle, 1, 0.05);

  const Found calm = hanging({.springBack = 2}), lively = hanging({.springBack = 0.5});
  EXPECT_LT(calm.settle, 0.7 * plain.settle);
  EXPECT_GT(lively.settle, 1.4 * plain.settle);
  for (const Found& found : {calm, lively}) {
    EXPECT_NEAR(found.droop / plain.droop, 1, 1e-3);
    EXPECT_NEAR(found.hertz / plain.hertz, 1, 0.02);
  }

  // Wet hair hangs lower, and comes to rest sooner in terms of its swings.
  const Found wet = hanging({.wet = 1});
  EXPECT_GT(wet.droop, 2 * plain.droop);
  EXPECT_LT(wet.settle * wet.hertz, plain.settle * plain.hertz);
  // A still head has no inertia to feel.
  EXPECT_EQ(hanging({.bounce = 2}).droop, plain.droop);
}

TEST_F(DialsScene, OfACurlThatIsThrownUpAndDown) {
  const auto thrown = [&](const MaterialDials& dials) { return with("bounce", dials, 1); };
  const Found plain = thrown({}), twice = thrown({.bounce = 2}), half = thrown({.bounce = 0.5});
  EXPECT_GT(twice.worstDroop, 1.2 * plain.worstDroop);
  EXPECT_LT(half.worstDroop, 0.8 * plain.worstDroop);
  for (const Found& found : {twice, half}) EXPECT_NEAR(found.settle / plain.settle, 1, 0.1);
}

// The inertia of a head that goes twice as far, which is all that hair sees of it.
TEST_F(DialsScene, BounceIsAHeadThatGoesAsFar) {
  auto far = makeScene("head_shake", {.seconds = 1}),
       felt = makeScene("head_shake", {.dials = {.bounce = 2}, .seconds = 1});
  ASSERT_TRUE(far && felt);
  far->motion.amplitude *= 2;
  EXPECT_EQ(this->run(*far).last, this->run(*felt).last);
  const auto plain = makeScene("head_shake", {.seconds = 1});
  EXPECT_NE(this->run(*plain).last, this->run(*felt).last);
}

TEST_F(DialsScene, WeightIsAsMuchGravity) {
  auto heavy = makeScene("release", {.seconds = 1});
  const auto felt = makeScene("release", {.dials = {.weight = 1.5}, .seconds = 1});
  ASSERT_TRUE(heavy && felt);
  heavy->settings.gravity = 1.5 * heavy->settings.gravity;
  EXPECT_EQ(this->run(*heavy).last, this->run(*felt).last);
}

}  // namespace
}  // namespace ringlet::test::dials_scene_test
