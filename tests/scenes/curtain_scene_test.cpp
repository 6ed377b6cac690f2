// curtain: two sheets of limp curls swing into each other and do not pass.
#include "tests/scenes/contact_runs.h"

namespace ringlet::test::curtain_scene_test {
namespace {

class Curtain : public ContactSceneTest {};

TEST_F(Curtain, SheetsDoNotPassEachOther) { expectKeptApart(watch("curtain", {.seconds = 2})); }

TEST_F(Curtain, SheetsCrossHundredsOfTimesWithoutContacts) {
  const ContactRun run = watch("curtain", {.contacts = false, .seconds = 2});
  EXPECT_GT(run.numbers.crossings, 300u);
  EXPECT_GT(run.numbers.deepestOverlap, kDeepestOverlap);
}

}  // namespace
}  // namespace ringlet::test::curtain_scene_test
