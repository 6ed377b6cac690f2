// pile: a swatch is pressed crosswise into a swatch and held there.
#include "tests/scenes/contact_runs.h"

namespace ringlet::test::pile_scene_test {
namespace {

class Pile : public ContactSceneTest {};

TEST_F(Pile, SwatchesBendAndDoNotPass) { expectKeptApart(watch("pile", {})); }

TEST_F(Pile, SwatchesCrossWithoutContacts) {
  const ContactRun run = watch("pile", {.contacts = false, .seconds = 4});
  EXPECT_GT(run.numbers.crossings, 30u);
  EXPECT_GT(run.numbers.deepestOverlap, kDeepestOverlap);
}

}  // namespace
}  // namespace ringlet::test::pile_scene_test
