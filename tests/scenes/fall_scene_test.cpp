// fall: a swatch droops onto another below it, and lies there.
#include "tests/scenes/contact_runs.h"

namespace ringlet::test::fall_scene_test {
namespace {

class Fall : public ContactSceneTest {};

TEST_F(Fall, TheUpperSwatchLiesOnTheLower) { expectKeptApart(watch("fall", {})); }

TEST_F(Fall, SwatchesCrossWithoutContacts) {
  const ContactRun run = watch("fall", {.contacts = false, .seconds = 4});
  EXPECT_GT(run.numbers.crossings, 100u);
  EXPECT_GT(run.numbers.deepestOverlap, kDeepestOverlap);
}

}  // namespace
}  // namespace ringlet::test::fall_scene_test
