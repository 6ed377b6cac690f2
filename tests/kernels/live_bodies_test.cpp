// Bodies that change while hair moves: the hair meets those that are there.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ringlet/c/handles.h"
#include "ringlet/scene/body_forms.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::live_bodies_test {
namespace {

using LiveBodies = GpuTest;

HeadPose headAt(int frame) {
  return {Vec3d{0.02 * frame, 0, 0}, fromRotationVector(Vec3d{0, 0.05 * frame, 0})};
}

// In turn: none, one sphere in the hair, all samples.
std::vector<std::vector<Body>> sets() {
  Body sphere;
  sphere.radius = 0.03;
  sphere.place.position = {0.01, -0.04, 0};
  return {{}, {sphere}, sampleBodies()};
}

// Hair that meets bodies, by itself and pair by pair.
std::vector<Settings> ways() {
  Settings pairs;
  pairs.contacts.on = true;
  pairs.contacts.method = ContactMethod::explicitPairs;
  return {Settings{}, pairs};
}

std::vector<HeadPose> posesOf(int frame, const Settings& settings) {
  std::vector<HeadPose> poses;
  for (int k = 1; k <= settings.stepsPerFrame; ++k)
    poses.push_back(interpolate(headAt(frame), headAt(frame + 1), double(k) / settings.stepsPerFrame));
  return poses;
}

// From any to any other, before the first frame: as hair that was born among them. And with two in flight.
TEST_F(LiveBodies, AreAsIfHairHadBeenBornAmongThem) {
  const Groom groom = randomGroom({31, 5, 64, 2, 17}, 3);
  for (const Settings& settings : ways()) {
    const auto asset = HairAsset::build(device(), groom, {}, settings, {.features = {.bodies = true}});
    ASSERT_TRUE(asset) << asset.error().message;
    std::vector<std::vector<Vec3f>> ends;
    for (const auto& to : sets()) {
      for (const auto& from : sets()) {
        SCOPED_TRACE(std::to_string(from.size()) + " to " + std::to_string(to.size()));
        Simulation late = *Simulation::create(*asset, {.bodies = from});
        const Status status = late.setBodies(to);
        ASSERT_TRUE(status) << status.error().message;
        for (int frame = 0; frame < 3; ++frame) ASSERT_TRUE(late.stepFrame(posesOf(frame, settings)));
        if (to.empty()) ends.push_back(*late.positions());
        Simulation early = *Simulation::create(*asset, {.bodies = to});
        for (int frame = 0; frame < 3; ++frame) ASSERT_TRUE(early.stepFrame(posesOf(frame, settings)));
        EXPECT_TRUE(late.state()->positions == early.state()->positions);
        EXPECT_TRUE(late.state()->velocities == early.state()->velocities);
        EXPECT_EQ(*late.positions() == ends.front(), to.empty()) << "the bodies are not in the way";
      }
    }
  }
}

// In the middle of a run, also with a frame in flight: as hair that is put, as it is then, among the others.
TEST_F(LiveBodies, ChangeBetweenFrames) {
  const Groom groom = randomGroom({31, 5, 64, 2, 17}, 3);
  const Settings settings;
  const auto asset = HairAsset::build(device(), groom, {}, settings, {.features = {.bodies = true}});
  const std::vector<Body> first = sets()[1], second = sets()[2];
  Simulation hair = *Simulation::create(*asset, {.bodies = first}),
             flies = *Simulation::create(*asset, {.bodies = first});
  for (int frame = 0; frame < 2; ++frame) ASSERT_TRUE(hair.stepFrame(posesOf(frame, settings)));
  const HairState state = *hair.state();
  ASSERT_TRUE(hair.setBodies(second));
  ASSERT_TRUE(hair.stepFrame(posesOf(2, settings)));

  ASSERT_TRUE(flies.submitFrame(posesOf(0, settings)));
  ASSERT_TRUE(flies.submitFrame(posesOf(1, settings)));
  ASSERT_TRUE(flies.setBodies(second));
  for (int frame = 0; frame < 2; ++frame) ASSERT_TRUE(flies.waitFrame());
  ASSERT_TRUE(flies.stepFrame(posesOf(2, settings)));
  EXPECT_TRUE(*flies.positions() == *hair.positions());

  const std::vector<HeadPose> before = posesOf(1, settings);
  Simulation put = *Simulation::create(
      *asset, {.head = before.back(), .oneStepEarlier = before[before.size() - 2], .bodies = second});
  ASSERT_TRUE(put.setState(state));
  ASSERT_TRUE(put.stepFrame(posesOf(2, settings)));
  EXPECT_TRUE(*put.positions() == *hair.positions());
}

// Places say where bodies are when the next frame begins: from there on they are as fast as they move.
TEST_F(LiveBodies, StandWhereTheyAreSaidToStand) {
  const Groom groom = randomGroom({31, 5, 64, 2, 17}, 3);
  const Settings settings;
  const auto asset = HairAsset::build(device(), groom, {}, settings, {.features = {.bodies = true}});
  std::vector<Body> bodies = sets()[1];
  bodies[0].radius = 0.1, bodies[0].place.position = {0, -0.05, 0.1};  // beside the hair, and would sweep it
  const BodyPose there{{0, -0.1, 0}, {}};
  const std::vector<BodyPose> frame(settings.stepsPerFrame, there);
  Simulation late = *Simulation::create(*asset, {.bodies = sets()[2]});
  const std::vector<BodyPose> places{there};
  Simulation early = *Simulation::create(*asset, {.bodies = bodies, .bodyPlaces = places});
  ASSERT_TRUE(late.setBodies(bodies, places));
  ASSERT_TRUE(late.stepFrame(posesOf(0, settings), frame));
  ASSERT_TRUE(early.stepFrame(posesOf(0, settings), frame));
  EXPECT_TRUE(*late.positions() == *early.positions());
}

// Whichever of settings and bodies changes first.
TEST_F(LiveBodies, KeepTheSettings) {
  const Groom groom = randomGroom({31, 5, 64, 2, 17}, 3);
  Settings settings;
  settings.air = {.on = true, .wind = {1, 0, 0}};
  const auto asset = HairAsset::build(device(), groom, {}, settings, {.features = {.bodies = true}});
  Simulation first = *Simulation::create(*asset, {.bodies = sets()[2]}),
             second = *Simulation::create(*asset, {.bodies = sets()[2]});
  settings.stepsPerFrame = 4, settings.framesPerSecond = 48, settings.air.wind = {0, 3, 0};
  ASSERT_TRUE(first.setSettings(settings));
  ASSERT_TRUE(first.setBodies(sets()[1]));
  ASSERT_TRUE(second.setBodies(sets()[1]));
  ASSERT_TRUE(second.setSettings(settings));
  for (int frame = 0; frame < 2; ++frame) {
    ASSERT_TRUE(first.stepFrame(posesOf(frame, settings)));
    ASSERT_TRUE(second.stepFrame(posesOf(frame, settings)));
  }
  EXPECT_TRUE(*first.positions() == *second.positions());
}

TEST_F(LiveBodies, WrongOnesAreRefusedAndChangeNothing) {
  const Groom groom = randomGroom({31, 5}, 3);
  const auto asset = HairAsset::build(device(), groom, {}, {}, {.features = {.bodies = true}});
  Simulation hair = *Simulation::create(*asset, {.bodies = sets()[1]}),
             untouched = *Simulation::create(*asset, {.bodies = sets()[1]});
  Body wrong;
  wrong.radius = -1;
  EXPECT_FALSE(hair.setBodies(std::vector<Body>{wrong}));
  for (int frame = 0; frame < 2; ++frame) {
    ASSERT_TRUE(hair.stepFrame(posesOf(frame, {})));
    ASSERT_TRUE(untouched.stepFrame(posesOf(frame, {})));
  }
  EXPECT_TRUE(*hair.positions() == *untouched.positions());
}

// The same through the C interface.
TEST_F(LiveBodies, ChangeThroughC) {
  const Groom groom = randomGroom({31, 5, 64}, 3);
  const auto asset = HairAsset::build(device(), groom, {}, {}, {.features = {.bodies = true}});
  Simulation expected = *Simulation::create(*asset, {.bodies = sets()[1]});
  ringlet_asset handle{*asset, device()};
  const ringlet_number large{"radius", {0.03}}, small{"radius", {0.001}};
  ringlet_body sphere = RINGLET_INIT(ringlet_body);
  sphere.shape = "sphere", sphere.numbers = &large, sphere.number_count = 1;
  sphere.pose = {{0.01, -0.04, 0}, {0, 0, 0, 1}};
  ringlet_body other = sphere;
  other.numbers = &small;
  ringlet_initial_state initial = RINGLET_INIT(ringlet_initial_state);
  initial.bodies = &other, initial.body_count = 1;
  ringlet_hair* hair = nullptr;
  ASSERT_EQ(ringlet_hair_create(&handle, &initial, &hair), RINGLET_OK) << ringlet_error_message();
  ASSERT_EQ(ringlet_hair_set_bodies(hair, &sphere, 1), RINGLET_OK) << ringlet_error_message();
  EXPECT_EQ(ringlet_hair_set_bodies(hair, nullptr, 2), RINGLET_ERROR_INVALID_ARGUMENT);
  const ringlet_pose head{{0.02, 0, 0}, {0, 0, 0, 0}};
  ASSERT_EQ(ringlet_step_to(hair, &head), RINGLET_OK);
  ASSERT_TRUE(expected.stepFrame(HeadPose{{0.02, 0, 0}, {}}));
  std::vector<Vec3f> found(groom.points.size());
  ASSERT_EQ(ringlet_positions(hair, &found[0].x, found.size()), RINGLET_OK);
  EXPECT_TRUE(found == *expected.positions());
  ringlet_hair_release(hair);
}

// Hair with a body that C describes moves as with one of C++; a number that a shape does not have is refused.
TEST_F(LiveBodies, HaveShapesAndNumbersByNameInC) {
  const Groom groom = randomGroom({31, 5}, 3);
  const auto asset = HairAsset::build(device(), groom, {}, {}, {.features = {.bodies = true}});
  ringlet_asset handle{*asset, device()};
  for (const BodyForm& form : bodyForms()) {
    if (form.shape == BodyShape::grid) continue;
    Body body{.shape = form.shape, .place = {{0.01, -0.03, 0}, {}}};
    std::vector<ringlet_number> own;
    std::vector<const char*> foreign;
    for (const SettingField<Body>& row : bodyNumbers()) {
      if (!hasNumber(form, row)) {
        foreign.push_back(row.key);
      } else if (const auto* number = std::get_if<double Body::*>(&row.member)) {
        body.** number = 0.011 + 0.001 * static_cast<double>(own.size());
        own.push_back({row.key, {body.**number}});
      } else {
        body.*std::get<Vec3d Body::*>(row.member) = {0.01, 0.02, 0.03};
        own.push_back({row.key, {0.01, 0.02, 0.03}});
      }
    }
    const std::vector<Body> bodies{body};
    Simulation expected = *Simulation::create(*asset, {.bodies = bodies});
    ringlet_body stated = RINGLET_INIT(ringlet_body);
    stated.shape = form.name.data(), stated.pose = {{0.01, -0.03, 0}, {0, 0, 0, 1}};
    stated.numbers = own.data(), stated.number_count = static_cast<std::uint32_t>(own.size());
    ringlet_initial_state initial = RINGLET_INIT(ringlet_initial_state);
    initial.bodies = &stated, initial.body_count = 1;
    ringlet_hair* hair = nullptr;
    ASSERT_EQ(ringlet_hair_create(&handle, &initial, &hair), RINGLET_OK) << ringlet_error_message();
    for (const double x : {0.02, 0.05}) {
      const ringlet_pose head{{x, 0, 0}, {0, 0, 0, 0}};
      ASSERT_EQ(ringlet_step_to(hair, &head), RINGLET_OK);
      ASSERT_TRUE(expected.stepFrame(HeadPose{{x, 0, 0}, {}}));
    }
    std::vector<Vec3f> found(groom.points.size());
    ASSERT_EQ(ringlet_positions(hair, &found[0].x, found.size()), RINGLET_OK);
    EXPECT_TRUE(found == *expected.positions()) << form.name;
    for (const char* key : foreign) {
      const ringlet_number number{key, {0.01, 0.01, 0.01}};
      stated.numbers = &number, stated.number_count = 1;
      EXPECT_EQ(ringlet_hair_set_bodies(hair, &stated, 1), RINGLET_ERROR_INVALID_ARGUMENT)
          << form.name << " has a " << key;
    }
    ringlet_hair_release(hair);
  }
}

}  // namespace
}  // namespace ringlet::test::live_bodies_test
