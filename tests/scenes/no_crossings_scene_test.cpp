// ContactSettings::noCrossings: scenes whose hair goes through hair without it, counted in every step, by
// itself and beside the forces of contacts.
#include "tests/scenes/contact_runs.h"

namespace ringlet::test::no_crossings_scene_test {
namespace {

struct Meeting {
  const char* scene;
  double seconds;
  bool hasForces = false;  // of contacts
};

BuiltinScene sceneOf(const Meeting& meeting, bool holds) {
  auto scene = makeScene(meeting.scene, {.contacts = true, .seconds = meeting.seconds});
  EXPECT_TRUE(scene) << scene.error().message;
  ContactSettings& contacts = scene->settings.contacts;
  contacts.method = ContactMethod::explicitPairs;
  contacts.noCrossings = holds;
  if (!meeting.hasForces) contacts.stiffness = contacts.dampingRatio = 0;
  return std::move(*scene);
}

class NoCrossings : public ContactSceneTest {};

TEST_F(NoCrossings, AreThereInAnyStep) {
  for (const Meeting& meeting :
       {Meeting{"two_curls", 4}, Meeting{"fall", 1}, Meeting{"pile", 4}, Meeting{"curtain", 1.5},
        Meeting{"flip", 0.75}, Meeting{"flip", 0.75, true}}) {
    SCOPED_TRACE(meeting.scene);
    const ContactRun off = watch(sceneOf(meeting, false)), on = watch(sceneOf(meeting, true));
    const CrossingReport& ways = on.report.ways;
    const double share = double(ways.changed) / double(ways.particles);
    fmt::print(
        "{}{}: {} crossings, with ways changed {}; {:.1f} % changed, {:.2f} mm on the mean, {:.1f} at most; {} "
        "edges stretched, to {:.2f}; {} tied; held in {} steps\n",
        meeting.scene, meeting.hasForces ? " with forces" : "", off.numbers.crossings, on.numbers.crossings,
        100 * share, 1000 * ways.changes / double(std::max<std::uint64_t>(ways.changed, 1)),
        1000 * ways.mostChange, ways.stretched, ways.mostStretch, ways.tied, ways.heldSteps);
    EXPECT_GT(off.numbers.crossings, 0u);
    EXPECT_EQ(off.report.ways.particles, 0u);
    EXPECT_EQ(on.numbers.crossings, 0u);
    EXPECT_GT(ways.changed, 0u);
    EXPECT_EQ(ways.unsafe, 0u);
    EXPECT_EQ(ways.heldSteps, 0u);
    EXPECT_LE(on.worstRootError, kRootPlace);
  }
}

// Frames of many steps, each a submission of its own, are the same steps.
TEST_F(NoCrossings, FramesOfManyStepsHaveTheSameBits) {
  const BuiltinScene scene = sceneOf({"fall", 0.25}, true), steps = frameByStep(scene);
  const double T = scene.settings.stepSeconds();
  const auto make = [&](const Settings& settings) {
    auto made =
        Simulation::create(device(), scene.groom, scene.material, settings,
                           {.head = scene.motion.poseAt(0), .oneStepEarlier = scene.motion.poseAt(-T)});
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
  };
  Simulation whole = make(scene.settings), single = make(steps.settings);
  for (int frame = 0; frame < scene.frameCount; ++frame) {
    const std::vector<HeadPose> poses = posesOfFrame(scene, frame);
    ASSERT_TRUE(whole.stepFrame(poses));
    for (const HeadPose& pose : poses) ASSERT_TRUE(single.stepFrame(std::span(&pose, 1)));
    ASSERT_EQ(*whole.positions(), *single.positions()) << "frame " << frame;
    ASSERT_EQ(whole.framePositions(), *whole.positions());
  }
  EXPECT_GT(whole.contactReport()->ways.changed, 0u);
  EXPECT_EQ(whole.contactReport()->ways.changed, single.contactReport()->ways.changed);
}

// The stage is the same code in both; around it are the device's solve and the reference's.
TEST_F(NoCrossings, DeviceAndReferenceAgree) {
  const BuiltinScene scene = sceneOf({"two_curls", 1.5}, true);
  const double T = scene.settings.stepSeconds();
  auto simulation = Simulation::create(device(), scene.groom, scene.material, scene.settings,
                                       {.head = scene.motion.poseAt(0),
                                        .oneStepEarlier = scene.motion.poseAt(-T),
                                        .rootShifts = scene.rootShifts});
  ASSERT_TRUE(simulation) << simulation.error().message;
  reference::Simulation<double> reference(scene.groom, scene.material, scene.settings, scene.motion.poseAt(0),
                                          scene.motion.poseAt(-T));
  if (!scene.rootShifts.empty()) reference.setRootShifts(scene.rootShifts);
  double worst = 0;
  for (int frame = 0; frame < scene.frameCount; ++frame) {
    const std::vector<HeadPose> poses = posesOfFrame(scene, frame);
    ASSERT_TRUE(simulation->stepFrame(poses));
    reference.stepFrame(poses);
    const std::vector<Vec3f> positions = simulation->framePositions();
    for (std::size_t i = 0; i < positions.size(); ++i)
      worst = std::max(worst, (reference::toEigen<double>(positions[i]) - reference.positions()[i]).norm());
  }
  fmt::print("{:.1e} m apart\n", worst);
  EXPECT_LE(worst, 1e-6);
  EXPECT_GT(reference.ways().changed, 0u);
}

TEST_F(NoCrossings, SaysWhatItCannotHoldYet) {
  const BuiltinScene scene = sceneOf({"fall", 0.25}, true);
  auto simulation = Simulation::create(device(), scene.groom, scene.material, scene.settings);
  ASSERT_TRUE(simulation) << simulation.error().message;
  const StrandCut cut{.strand = 0, .keep = 8};
  const Status status = simulation->cut(std::span(&cut, 1));
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("no_crossings"), std::string::npos) << status.error().message;
  EXPECT_TRUE(simulation->stepFrame(scene.motion.poseAt(1 / 24.0)));
}

}  // namespace
}  // namespace ringlet::test::no_crossings_scene_test
