// The C interface: the same bits as the C++ one, and an answer to whatever is handed over.
#include "ringlet/c/ringlet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/rest/material_parameters.h"
#include "ringlet/scene/settings_fields.h"
#include "ringlet/solver/diagnostics.h"
#include "tests/kernels/c_handles.h"
#include "tests/kernels/sample_hairs.h"

namespace ringlet::test::c_interface_test {
namespace {

using CInterface = CTest;

constexpr double kStart = 0.4;  // where the heads are turned and away from the origin [s]

HeadPose poseAt(const Head& head, double seconds) {
  HeadPose pose = head.at(seconds);
  pose.shift = 0;
  pose.rotation = normalized(pose.rotation);
  return pose;
}

// Two heads of one asset, by C and by C++.
struct TwoHeads {
  const Hair& hair;
  Handles c{};
  std::vector<Simulation> expected{};

  std::vector<Vec3f> positions(int which) const {
    return positionsOf(c.hairs[which], hair.groom.points.size());
  }
  void create(ComputeDevice& device) {
    c.settings->settings = hair.settings;
    const CGroom groom(hair.groom);
    ringlet_asset_options options = RINGLET_INIT(ringlet_asset_options);
    for (std::size_t k = 0; k < kFeatureNames.size(); ++k)
      if (hair.kernel.features.*kFeatureNames[k].member) options.features |= std::uint32_t{1} << k;
    const Material material;
    ASSERT_EQ(ringlet_asset_build(c.device, &groom.groom, c.settings, c.material, &options, &c.asset),
              RINGLET_OK)
        << ringlet_error_message();
    EXPECT_EQ(ringlet_asset_particle_count(c.asset), hair.groom.points.size());
    EXPECT_EQ(ringlet_asset_strand_count(c.asset), hair.groom.strandCount());
    const auto asset = HairAsset::build(device, hair.groom, material, hair.settings, hair.kernel);
    for (const Head& head : kHeads) {
      const HeadPose start = poseAt(head, kStart);
      ringlet_initial_state initial = RINGLET_INIT(ringlet_initial_state);
      initial.head = poseOf(start);
      ASSERT_EQ(ringlet_hair_create(c.asset, &initial, &c.hairs.emplace_back()), RINGLET_OK);
      expected.push_back(*Simulation::create(*asset, {.head = start}));
    }
  }
  // Settings and forces of the one, the material of the other.
  void change() {
    ASSERT_EQ(ringlet_settings_set_vector(c.settings, "gravity", 1, -5, 0), RINGLET_OK);
    ASSERT_EQ(ringlet_hair_set_settings(c.hairs[0], c.settings), RINGLET_OK) << ringlet_error_message();
    Settings other = hair.settings;
    other.gravity = {1, -5, 0};
    ASSERT_TRUE(expected[0].setSettings(other));
    ASSERT_EQ(ringlet_material_set(c.material, "bend_stiffness", 3), RINGLET_OK);
    ASSERT_EQ(ringlet_hair_set_material(c.hairs[1], c.material), RINGLET_OK) << ringlet_error_message();
    Material stiff;
    stiff.bendStiffness = 3;
    ASSERT_TRUE(expected[1].setMaterial(stiff));
    std::vector<Vec3f> forces(hair.groom.points.size(), Vec3f{3, 0, -2});
    forces.back() = {0, 50, 0};
    ASSERT_EQ(ringlet_hair_set_forces(c.hairs[0], &forces[0].x, forces.size()), RINGLET_OK);
    ASSERT_TRUE(expected[0].setForces(forces));
  }
  void step(int frame) {
    std::vector<std::vector<ringlet_pose>> poses(2);
    std::vector<ringlet_frame> frames;
    for (int which = 0; which < 2; ++which) {
      std::vector<HeadPose> heads;
      for (int k = 1; k <= hair.settings.stepsPerFrame; ++k) {
        heads.push_back(
            poseAt(kHeads[which], kStart + (frame + double(k) / hair.settings.stepsPerFrame) / 24));
        poses[which].push_back(poseOf(heads.back()));
      }
      ASSERT_TRUE(expected[which].stepFrame(heads));
    }
    for (int which = 0; which < 2; ++which) {
      frames.push_back(RINGLET_INIT(ringlet_frame));
      frames.back().hair = c.hairs[which];
      frames.back().step_poses = poses[which].data();
      frames.back().step_count = static_cast<std::uint32_t>(poses[which].size());
    }
    ASSERT_EQ(ringlet_step(frames.data(), 2), RINGLET_OK) << ringlet_error_message();
    for (int which = 0; which < 2; ++which)
      EXPECT_TRUE(positions(which) == *expected[which].positions()) << which << ", frame " << frame;
  }
  void expectSameNumbers() {
    std::vector<Vec3f> velocities(hair.groom.points.size());
    ASSERT_EQ(ringlet_velocities(c.hairs[0], &velocities[0].x, velocities.size()), RINGLET_OK);
    EXPECT_TRUE(velocities == expected[0].state()->velocities);
    ringlet_report report = RINGLET_INIT(ringlet_report);
    ASSERT_EQ(ringlet_get_report(c.hairs[0], &report), RINGLET_OK);
    EXPECT_EQ(report.max_edge_stretch, expected[0].report()->maxEdgeStretch);
    EXPECT_EQ(report.device_bytes, Diagnostics(expected[0]).memory().total());
    ringlet_device_positions buffer = RINGLET_INIT(ringlet_device_positions);
    ASSERT_EQ(ringlet_device_positions_count(c.hairs[0]), 1u);
    ASSERT_EQ(ringlet_get_device_positions(c.hairs[0], 0, &buffer), RINGLET_OK);
    EXPECT_TRUE(buffer.buffer && buffer.particles && buffer.particle_count == hair.groom.points.size());
  }
  void expectRestored() {
    std::size_t size = 0;
    ASSERT_EQ(ringlet_checkpoint(c.hairs[0], nullptr, &size), RINGLET_OK);
    std::vector<std::byte> kept(size);
    ASSERT_EQ(ringlet_checkpoint(c.hairs[0], kept.data(), &size), RINGLET_OK);
    const auto before = positions(0);
    const ringlet_pose away{{0.3, 0, 0}, {0, 0, 0, 0}};
    ASSERT_EQ(ringlet_step_to(c.hairs[0], &away), RINGLET_OK);
    EXPECT_FALSE(positions(0) == before);
    ASSERT_EQ(ringlet_restore(c.hairs[0], kept.data(), size), RINGLET_OK) << ringlet_error_message();
    EXPECT_TRUE(positions(0) == before);
  }
};

// Together, with contacts or not, changed on the way; and a checkpoint of it.
TEST_F(CInterface, GivesTheSameBits) {
  for (const Hair& hair : hairs()) {
    if (hair.kernel.form != KernelChoice::Form::automatic || hair.kernel.mostBufferBytes > 0) continue;
    SCOPED_TRACE(hair.name);
    TwoHeads heads{hair};
    open(heads.c);
    ASSERT_NO_FATAL_FAILURE(heads.create(device()));
    for (int frame = 0; frame < 4; ++frame) {
      if (frame == 2) {
        ASSERT_NO_FATAL_FAILURE(heads.change());
      }
      ASSERT_NO_FATAL_FAILURE(heads.step(frame));
    }
    ASSERT_NO_FATAL_FAILURE(heads.expectSameNumbers());
    ASSERT_NO_FATAL_FAILURE(heads.expectRestored());
  }
}

// Every setting and every number of a material can be set by its name.
TEST_F(CInterface, SetsEverythingByName) {
  Handles c;
  open(c);
  const auto setAll = [&](const char* table, const auto& fields) {
    for (const auto& field : fields) {
      const std::string name = std::string(table) + field.key;
      const ringlet_result number = ringlet_settings_set(c.settings, name.c_str(), 1);
      const ringlet_result vector = ringlet_settings_set_vector(c.settings, name.c_str(), 1, 2, 3);
      const ringlet_result word =
          field.choices.empty()
              ? RINGLET_ERROR
              : ringlet_settings_set_text(c.settings, name.c_str(), namesIn(field.choices).back().c_str());
      EXPECT_EQ((number == RINGLET_OK) + (vector == RINGLET_OK) + (word == RINGLET_OK), 1) << name;
    }
  };
  setAll("", settingsFields());
  setAll("contacts.", contactFields());
  setAll("air.", airFields());
  EXPECT_EQ(ringlet_settings_set_text(c.settings, "integrator", "paper"), RINGLET_OK);
  const Settings& s = c.settings->settings;
  EXPECT_EQ(s.gravity, (Vec3d{1, 2, 3}));
  EXPECT_EQ(s.framesPerSecond, 1);
  EXPECT_EQ(s.contacts.friction, 1);
  EXPECT_EQ(s.contacts.method, ContactMethod::volume);
  EXPECT_EQ(s.contacts.taper, ContactTaper::time);
  EXPECT_EQ(s.contacts.iterations, 1);
  EXPECT_EQ(s.air.wind, (Vec3d{1, 2, 3}));
  EXPECT_EQ(s.integrator, Integrator::paper);
  for (const auto& p : materialParameters())
    EXPECT_EQ(ringlet_material_set(c.material, p.key, 0.5), RINGLET_OK);
  for (const auto& p : variationParameters())
    EXPECT_EQ(ringlet_material_set(c.material, ("variation." + std::string(p.key)).c_str(), 1), RINGLET_OK);
  EXPECT_EQ(c.material->material.bendStiffness, 0.5);
  EXPECT_EQ(c.material->material.variation.seed, 1u);
}

TEST_F(CInterface, NamesThatThereAreNot) {
  Handles c;
  open(c);
  expectInvalid(ringlet_settings_set(c.settings, "contacts.frction", 1), "did you mean contacts.friction?");
  expectInvalid(ringlet_settings_set(c.settings, "steps_per_frame", 1.5), "steps_per_frame does not take");
  expectInvalid(ringlet_settings_set_text(c.settings, "contacts.taper", "tim"), "did you mean time?");
  expectInvalid(ringlet_settings_set_text(c.settings, "gravity", "down"), "gravity does not take a word");
  expectInvalid(ringlet_settings_set(c.settings, "gravity", -9.81), "call ringlet_settings_set_vector");
  expectInvalid(ringlet_settings_set(c.settings, "contacts.method", 1), "call ringlet_settings_set_text");
  expectInvalid(ringlet_settings_set(c.settings, "integrator", 1), "call ringlet_settings_set_text");
  expectInvalid(ringlet_settings_set_vector(c.settings, "fps", 1, 2, 3), "call ringlet_settings_set");
  expectInvalid(ringlet_material_set(c.material, "bendstiffness", 1), "did you mean bend_stiffness?");
  ringlet_material* none = nullptr;
  expectInvalid(ringlet_material_create("coils", &none), "did you mean coil?");
  expectInvalid(ringlet_settings_set(nullptr, "gravity", 1), "takes settings");
  expectInvalid(ringlet_settings_create(nullptr), "nowhere");
  expectInvalid(ringlet_device_open(nullptr, nullptr), "nowhere");
  expectInvalid(ringlet_device_adopt(nullptr, &c.device), "says its size");
}

TEST_F(CInterface, AssetsThatCannotBeBuilt) {
  Handles c;
  open(c);
  const Groom hair = randomGroom({8, 8}, 1);
  CGroom groom(hair);
  expectInvalid(ringlet_asset_build(c.device, nullptr, nullptr, nullptr, nullptr, &c.asset), "groom is NULL");
  ringlet_asset_options unsized{};
  expectInvalid(ringlet_asset_build(c.device, &groom.groom, nullptr, nullptr, &unsized, &c.asset),
                "options has no struct_size");
  expectInvalid(ringlet_asset_build(nullptr, &groom.groom, nullptr, nullptr, nullptr, &c.asset),
                "device is NULL");
  expectInvalid(ringlet_asset_build(c.device, &groom.groom, nullptr, nullptr, nullptr, nullptr),
                "asset is NULL");
  ringlet_groom empty = RINGLET_INIT(ringlet_groom);
  expectInvalid(ringlet_asset_build(c.device, &empty, nullptr, nullptr, nullptr, &c.asset), "no points");
  ringlet_groom bare = groom.groom;
  bare.strand_count = 0;
  EXPECT_EQ(ringlet_asset_build(c.device, &bare, nullptr, nullptr, nullptr, &c.asset), RINGLET_ERROR);
  EXPECT_NE(std::string(ringlet_error_message()).find("no strands"), std::string::npos);
  ASSERT_EQ(ringlet_settings_set(c.settings, "fps", -1), RINGLET_OK);
  EXPECT_EQ(ringlet_asset_build(c.device, &groom.groom, c.settings, nullptr, nullptr, &c.asset),
            RINGLET_ERROR);
  EXPECT_NE(std::string(ringlet_error_message()).find("fps is -1"), std::string::npos);
  ringlet_asset_options unknown = RINGLET_INIT(ringlet_asset_options);
  unknown.features = 1u << 31;
  expectInvalid(ringlet_asset_build(c.device, &groom.groom, nullptr, nullptr, &unknown, &c.asset),
                "0x80000000");
}

// Hair of 16 particles.
void makeHair(Handles& c) {
  const Groom hair = randomGroom({8, 8}, 1);
  const CGroom groom(hair);
  ASSERT_EQ(ringlet_asset_build(c.device, &groom.groom, nullptr, nullptr, nullptr, &c.asset), RINGLET_OK);
  ASSERT_EQ(ringlet_hair_create(c.asset, nullptr, &c.hairs.emplace_back()), RINGLET_OK);
}

TEST_F(CInterface, HairThatCannotBe) {
  Handles c;
  open(c);
  ASSERT_NO_FATAL_FAILURE(makeHair(c));
  ringlet_hair* unmade = nullptr;
  expectInvalid(ringlet_hair_create(nullptr, nullptr, &unmade), "takes an asset");
  ringlet_initial_state initial = RINGLET_INIT(ringlet_initial_state);
  ringlet_initial_state sizeless{};
  expectInvalid(ringlet_hair_create(c.asset, &sizeless, &unmade), "says its size");
  initial.head.position[1] = NAN;
  expectInvalid(ringlet_hair_create(c.asset, &initial, &unmade), "not finite");
  ringlet_body body = RINGLET_INIT(ringlet_body);
  body.shape = "mesh";
  initial = RINGLET_INIT(ringlet_initial_state);
  initial.bodies = &body, initial.body_count = 1;
  EXPECT_EQ(ringlet_hair_create(c.asset, &initial, &unmade), RINGLET_ERROR);  // a mesh without triangles

  float few[3] = {0, 0, 0};
  expectInvalid(ringlet_hair_set_forces(c.hairs[0], few, 1), "forces for its 16 particles");
  expectInvalid(ringlet_hair_set_forces(c.hairs[0], nullptr, 16), "forces for its 16 particles");
  expectInvalid(ringlet_hair_prepare(nullptr, RINGLET_BODIES), "takes hair");
  expectInvalid(ringlet_hair_prepare(c.hairs[0], 32), "features 0x20; expected bits of ringlet_features");
  expectInvalid(ringlet_positions(c.hairs[0], few, 1), "room for 1 particles, and the hair has 16");
  std::size_t size = 3;
  expectInvalid(ringlet_checkpoint(c.hairs[0], few, &size), "room for 3");
  EXPECT_EQ(ringlet_restore(c.hairs[0], few, 12), RINGLET_ERROR);
  ringlet_asset_release(nullptr);
  ringlet_hair_release(nullptr);
}

TEST_F(CInterface, FramesThatCannotBe) {
  Handles c;
  open(c);
  ASSERT_NO_FATAL_FAILURE(makeHair(c));
  std::vector<ringlet_pose> poses(8);
  ringlet_frame frame = RINGLET_INIT(ringlet_frame);
  expectInvalid(ringlet_step(&frame, 1), "no hair");
  frame.hair = c.hairs[0], frame.step_poses = poses.data(), frame.step_count = 7;
  expectInvalid(ringlet_step(&frame, 1), "7 poses of the head; its settings have 8");
  frame.step_count = 8;
  poses[3].rotation[0] = std::numeric_limits<double>::infinity();
  expectInvalid(ringlet_step(&frame, 1), "not finite");
  poses[3].rotation[0] = 0;
  const ringlet_frame twice[2] = {frame, frame};
  expectInvalid(ringlet_step(twice, 2), "twice");
  expectInvalid(ringlet_record(&frame, 1, nullptr), "command buffer");
  EXPECT_EQ(ringlet_step(nullptr, 0), RINGLET_OK);
  EXPECT_EQ(ringlet_frame_is_over(c.hairs[0]), RINGLET_OK);
}

// Hair with goals and fields, by C and by C++.
struct ActedOn {
  Groom groom = randomGroom({12, 9, 12}, 3);
  Handles c{};
  std::optional<Simulation> expected{};

  void create(ComputeDevice& device) {
    const CGroom from(groom);
    ringlet_asset_options options = RINGLET_INIT(ringlet_asset_options);
    options.features = RINGLET_GOALS | RINGLET_FIELDS;
    ASSERT_EQ(ringlet_asset_build(c.device, &from.groom, nullptr, nullptr, &options, &c.asset), RINGLET_OK);
    ASSERT_EQ(ringlet_hair_create(c.asset, nullptr, &c.hairs.emplace_back()), RINGLET_OK);
    const auto asset = HairAsset::build(device, groom, Material{}, Settings{},
                                        {.features = {.goals = true, .fields = true}});
    expected = *Simulation::create(*asset, {});
  }
  void step(const char* what) {
    const std::vector<HeadPose> still(static_cast<std::size_t>(expected->settings().stepsPerFrame));
    const ringlet_pose head{};
    ASSERT_EQ(ringlet_step_to(c.hairs[0], &head), RINGLET_OK) << ringlet_error_message();
    ASSERT_TRUE(expected->stepFrame(still));
    EXPECT_TRUE(positionsOf(c.hairs[0], groom.points.size()) == *expected->positions()) << what;
  }
  // The rest pose, moved [m].
  std::vector<Vec3f> places(Vec3f by) const {
    std::vector<Vec3f> all = groom.points;
    for (Vec3f& p : all) p = p * static_cast<float>(groom.metresPerUnit) + by;
    return all;
  }
};

std::vector<ForceField> threeFields() {
  const VelocityGrid grid{{2, 3, 2}, 0.4, std::vector<Vec3f>(12, Vec3f{1, 0.5f, 0})};
  ForceField blast{.place = {{0.1, 0, 0}, {}}, .radial = 30, .core = 0.05, .front = 0.1, .thickness = 0.5};
  ForceField vortex{.place = {{0, 0.2, 0}, normalized(Quatd{1, 0, 0, 1})},
                    .axis = {1, 2, 0},
                    .aboutAxis = true,
                    .axial = 2,
                    .around = -3,
                    .reach = 2,
                    .drag = 7};
  ForceField wind{.drag = 4, .grid = std::make_shared<const VelocityGrid>(grid), .gridShare = 0.5};
  return {blast, vortex, wind};
}

// Every number by its name, but for those that are the default.
ringlet_field fieldOf(const ForceField& f, std::list<std::vector<ringlet_number>>& numbers) {
  ringlet_field field = RINGLET_INIT(ringlet_field);
  field.pose = poseOf(HeadPose{f.place.position, f.place.rotation});
  std::vector<ringlet_number>& own = numbers.emplace_back();
  for (const auto& row : forceFieldNumbers()) {
    ringlet_number number{row.key, {}};
    if (const auto* member = std::get_if<double ForceField::*>(&row.member))
      number.value[0] = f.**member;
    else if (const auto* isTrue = std::get_if<bool ForceField::*>(&row.member))
      number.value[0] = f.**isTrue;
    else
      number.value[0] = f.axis.x, number.value[1] = f.axis.y, number.value[2] = f.axis.z;
    const bool isDefault =
        std::visit([&](auto member) { return f.*member == ForceField{}.*member; }, row.member);
    if (!isDefault) own.push_back(number);
  }
  field.numbers = own.data(), field.number_count = static_cast<std::uint32_t>(own.size());
  if (!f.grid) return field;
  field.velocities = &f.grid->velocities[0].x;
  std::ranges::copy(f.grid->nodes, field.nodes);
  field.cell = f.grid->cell;
  return field;
}

TEST_F(CInterface, GoalsAndFieldsGiveTheSameBits) {
  ActedOn both;
  open(both.c);
  ASSERT_NO_FATAL_FAILURE(both.create(device()));
  const std::vector<Vec3f> places = both.places({0.01f, 0, 0.02f}), before = both.places({});
  std::vector<float> strengths(places.size(), 2);
  strengths[3] = 50;
  const std::vector<ForceField> first = threeFields();
  std::list<std::vector<ringlet_number>> numbers;
  std::vector<ForceField> second = first;
  second[0].radial = -10, second[1].place.position = {0.3, 0, 0}, second[2].gridShare = 2;
  const std::vector<ringlet_field> cFirst{fieldOf(first[0], numbers), fieldOf(first[1], numbers),
                                          fieldOf(first[2], numbers)};
  const std::vector<ringlet_field> cSecond{fieldOf(second[0], numbers), fieldOf(second[1], numbers),
                                           fieldOf(second[2], numbers)};
  for (const double damping : {1.0, 0.3, 0.0}) {
    ringlet_goals goals = RINGLET_INIT(ringlet_goals);
    goals.places = &places[0].x, goals.strengths = strengths.data(), goals.particle_count = places.size();
    goals.damping_ratio = damping == 1 ? 0 : damping, goals.undamped = damping == 0;
    goals.from = damping == 0.3 ? &before[0].x : nullptr;
    ASSERT_EQ(ringlet_hair_set_goals(both.c.hairs[0], &goals), RINGLET_OK) << ringlet_error_message();
    ASSERT_TRUE(
        both.expected->setGoals(places, strengths, damping,
                                damping == 0.3 ? std::span<const Vec3f>(before) : std::span<const Vec3f>()));
    both.step("goals");
  }
  ASSERT_EQ(ringlet_hair_set_fields(both.c.hairs[0], cFirst.data(), nullptr, 3), RINGLET_OK)
      << ringlet_error_message();
  ASSERT_TRUE(both.expected->setFields(first));
  both.step("fields");
  ASSERT_EQ(ringlet_hair_set_fields(both.c.hairs[0], cSecond.data(), cFirst.data(), 3), RINGLET_OK);
  ASSERT_TRUE(both.expected->setFields(second, first));
  both.step("fields that change");
  ASSERT_EQ(ringlet_hair_set_fields(both.c.hairs[0], nullptr, nullptr, 0), RINGLET_OK);
  ASSERT_TRUE(both.expected->setFields({}));
  both.step("no fields");
}

TEST_F(CInterface, GoalsAndFieldsThatCannotBe) {
  ActedOn hair;
  open(hair.c);
  ASSERT_NO_FATAL_FAILURE(hair.create(device()));
  const Handles& c = hair.c;
  const std::vector<Vec3f> places = hair.places({});
  const std::vector<float> strengths(places.size(), 2);
  ringlet_goals wrong = RINGLET_INIT(ringlet_goals);
  expectInvalid(ringlet_hair_set_goals(c.hairs[0], &wrong), "places and strengths for its 33 particles");
  std::vector<float> endless(99);
  endless[98] = INFINITY;
  wrong.places = endless.data(), wrong.strengths = strengths.data(), wrong.particle_count = 33;
  const auto expectParticle32 = [](ringlet_result result) {
    EXPECT_EQ(result, RINGLET_ERROR);
    EXPECT_NE(std::string(ringlet_error_message()).find("particle 32"), std::string::npos)
        << ringlet_error_message();
  };
  expectParticle32(ringlet_hair_set_goals(c.hairs[0], &wrong));
  wrong.places = &places[0].x, wrong.from = endless.data();
  expectParticle32(ringlet_hair_set_goals(c.hairs[0], &wrong));
  expectInvalid(ringlet_hair_set_goals(nullptr, &wrong), "takes hair");

  const std::vector<ForceField> fields = threeFields();
  std::list<std::vector<ringlet_number>> numbers;
  const ringlet_field blast = fieldOf(fields[0], numbers), wind = fieldOf(fields[2], numbers);
  expectInvalid(ringlet_hair_set_fields(c.hairs[0], nullptr, nullptr, 1), "there are no fields");
  ringlet_field bad = wind;
  bad.pose.position[1] = NAN;
  expectInvalid(ringlet_hair_set_fields(c.hairs[0], &bad, nullptr, 1), "field 0 has a pose");
  bad = wind;
  bad.nodes[0] = bad.nodes[1] = 0xffffffffu;
  expectInvalid(ringlet_hair_set_fields(c.hairs[0], &bad, nullptr, 1), "more nodes");
  bad = blast;
  const auto expectRefused = [&](ringlet_number number, const char* says) {
    bad.numbers = &number, bad.number_count = 1;
    EXPECT_EQ(ringlet_hair_set_fields(c.hairs[0], &bad, nullptr, 1), RINGLET_ERROR) << says;
    EXPECT_NE(std::string(ringlet_error_message()).find(says), std::string::npos) << ringlet_error_message();
  };
  expectRefused({"drag", {-1}}, "drag is -1");
  for (const auto& [number, says] :
       {std::pair<ringlet_number, const char*>{{"darg", {1}}, "did you mean drag?"},
        {{nullptr, {1}}, "no number of a field"},
        {{"about_axis", {0.5}}, "about_axis does not take 0.5"}}) {
    bad.numbers = &number, bad.number_count = 1;
    expectInvalid(ringlet_hair_set_fields(c.hairs[0], &bad, nullptr, 1), says);
  }
  bad.numbers = nullptr;
  expectInvalid(ringlet_hair_set_fields(c.hairs[0], &bad, nullptr, 1), "1 numbers, which are NULL");
  expectInvalid(ringlet_hair_set_fields(nullptr, nullptr, nullptr, 0), "takes hair");
}

TEST_F(CInterface, CutsGiveTheSameBits) {
  Handles c;
  open(c);
  const Groom groom = randomGroom({9, 14, 10}, 3);
  const CGroom from(groom);
  ASSERT_EQ(ringlet_asset_build(c.device, &from.groom, nullptr, nullptr, nullptr, &c.asset), RINGLET_OK);
  ASSERT_EQ(ringlet_hair_create(c.asset, nullptr, &c.hairs.emplace_back()), RINGLET_OK);
  auto expected = Simulation::create(device(), groom, {}, {});
  ASSERT_TRUE(expected);
  const ringlet_cut cuts[] = {{0, 4}, {2, 7}};
  ASSERT_EQ(ringlet_hair_cut(c.hairs[0], cuts, 2), RINGLET_OK) << ringlet_error_message();
  ASSERT_TRUE(expected->cut(std::vector<StrandCut>{{0, 4}, {2, 7}}));
  const std::vector<HeadPose> still(static_cast<std::size_t>(Settings{}.stepsPerFrame));
  const ringlet_pose head{};
  for (int frame = 0; frame < 3; ++frame) {
    ASSERT_EQ(ringlet_step_to(c.hairs[0], &head), RINGLET_OK) << ringlet_error_message();
    ASSERT_TRUE(expected->stepFrame(still));
  }
  EXPECT_EQ(positionsOf(c.hairs[0], groom.points.size()), *expected->positions());
  EXPECT_EQ(ringlet_hair_cut(c.hairs[0], cuts, 1), RINGLET_ERROR);
  EXPECT_NE(std::string(ringlet_error_message()).find("strand 0 has 4 particles"), std::string::npos);
  expectInvalid(ringlet_hair_cut(nullptr, cuts, 1), "takes hair");
  expectInvalid(ringlet_hair_cut(c.hairs[0], nullptr, 1), "and cuts");
}

// A caller's struct may be shorter, of a version before, or longer, of one to come.
TEST_F(CInterface, StructsMayBeOfOtherVersions) {
  Handles c;
  open(c);
  const Groom hair = randomGroom({8, 8}, 1);
  CGroom groom(hair);
  groom.groom.struct_size = offsetof(ringlet_groom, metres_per_unit);
  ASSERT_EQ(ringlet_asset_build(c.device, &groom.groom, nullptr, nullptr, nullptr, &c.asset), RINGLET_OK);
  ASSERT_EQ(ringlet_hair_create(c.asset, nullptr, &c.hairs.emplace_back()), RINGLET_OK);
  struct {
    ringlet_report report = RINGLET_INIT(ringlet_report);
    std::uint64_t later = 77;
  } longer;
  longer.report.struct_size = sizeof(longer);
  ASSERT_EQ(ringlet_get_report(c.hairs[0], &longer.report), RINGLET_OK);
  EXPECT_GT(longer.report.device_bytes, 0u);
  EXPECT_EQ(longer.later, 77u);
  ringlet_report shorter = RINGLET_INIT(ringlet_report);
  shorter.struct_size = offsetof(ringlet_report, device_bytes);
  shorter.device_bytes = 5;
  ASSERT_EQ(ringlet_get_report(c.hairs[0], &shorter), RINGLET_OK);
  EXPECT_EQ(shorter.device_bytes, 5u);
  std::vector<ringlet_pose> poses(8);
  // An array of longer structs.
  struct Longer {
    ringlet_frame frame = RINGLET_INIT(ringlet_frame);
    double later = 0;
  };
  ASSERT_EQ(ringlet_hair_create(c.asset, nullptr, &c.hairs.emplace_back()), RINGLET_OK);
  Longer frames[2];
  for (int k = 0; k < 2; ++k) {
    frames[k].frame.struct_size = sizeof(Longer);
    frames[k].frame.hair = c.hairs[k], frames[k].frame.step_poses = poses.data(),
    frames[k].frame.step_count = 8;
  }
  EXPECT_EQ(ringlet_step(&frames[0].frame, 2), RINGLET_OK) << ringlet_error_message();
}

}  // namespace
}  // namespace ringlet::test::c_interface_test
