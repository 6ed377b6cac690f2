// two_curls: two curls are pushed to half their width from core to core, give way, and come to rest once they
// are apart again.
#include "tests/scenes/contact_runs.h"

namespace ringlet::test::two_curls_scene_test {
namespace {

class TwoCurls : public ContactSceneTest {};

TEST_F(TwoCurls, DoNotPassEachOther) {
  for (int steps : kStepCounts) {
    SCOPED_TRACE(steps);
    expectKeptApart(watch("two_curls", {.stepsPerFrame = steps, .seconds = 4}));
  }
}

// Twice a turn, on eight turns; and neither more nor less at other steps.
TEST_F(TwoCurls, CrossWithoutContacts) {
  for (int steps : kStepCounts) {
    const ContactRun run = watch("two_curls", {.contacts = false, .stepsPerFrame = steps, .seconds = 4});
    EXPECT_EQ(run.numbers.crossings, 16u);
    EXPECT_GT(run.numbers.deepestOverlap, kDeepestOverlap);
    EXPECT_EQ(run.report.pairTests, 0u);
    EXPECT_LE(run.worstRootError, kRootPlace);
  }
}

TEST_F(TwoCurls, ComeToRest) {
  for (int steps : {4, 8}) {
    const ContactRun run = watch("two_curls", {.bendStiffness = 5, .stepsPerFrame = steps});
    EXPECT_LT(run.energyRatio, 1e-6) << steps;
  }
}

}  // namespace
}  // namespace ringlet::test::two_curls_scene_test
