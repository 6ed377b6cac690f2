// Bodies that bend by the C interface: a scene's have the bits of the library, and so have the host's own.
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "ringlet/bodies/make_bending_mesh.h"
#include "ringlet/c/ringlet_io.h"
#include "ringlet/run/scene_run.h"
#include "tests/bodies/body_samples.h"
#include "tests/kernels/c_handles.h"
#include "tests/motion/mesh_motion_samples.h"
#include "tests/support/parity.h"
#include "tests/support/test_support.h"

namespace ringlet::test::c_bending_test {
namespace {

using CBending = CTest;

constexpr int kFrames = 3;
constexpr std::uint32_t kSteps = 4;

// A ball below the hair that swells into it, as float32 has it.
TriangleMesh ballAt(double share) {
  TriangleMesh ball = sphereMesh(0.03, 3);
  for (Vec3d& p : ball.points)
    p = static_cast<Vec3d>(static_cast<Vec3f>(p * (1 + 0.5 * share) + Vec3d{0, -0.1, 0}));
  return ball;
}

struct CScene {
  ringlet_scene* handle = nullptr;
  ringlet_scene_facts facts = RINGLET_INIT(ringlet_scene_facts);
  ~CScene() { ringlet_scene_release(handle); }
};

// Of all bodies that bend, as a frame takes them.
struct Points {
  std::vector<std::vector<double>> xyz;
  std::vector<const double*> pointers() const {
    std::vector<const double*> all;
    for (const auto& each : xyz) all.push_back(each.data());
    return all;
  }
};

Points pointsOf(const CScene& scene, int frame) {
  Points points;
  for (std::uint32_t b = 0; b < scene.facts.bending_body_count; ++b) {
    std::uint32_t count = 0;
    EXPECT_EQ(ringlet_scene_frame_points(scene.handle, frame, b, nullptr, &count), RINGLET_OK);
    points.xyz.emplace_back(std::size_t{3} * count * scene.facts.steps_per_frame);
    EXPECT_EQ(ringlet_scene_frame_points(scene.handle, frame, b, points.xyz.back().data(), &count),
              RINGLET_OK)
        << ringlet_error_message();
  }
  return points;
}

TEST_F(CBending, AScenesBodyHasTheBitsOfTheLibrary) {
  const auto folder = scratchFolder("c_bending");
  std::vector<std::vector<Vec3d>> samples;
  for (int k = 0; k <= kFrames; ++k) samples.push_back(ballAt(double(k) / kFrames).points);
  writeMeshMotion(folder, "ball", ballAt(0).triangles, samples, 30);
  const std::string text =
      "[groom]\ngenerate = 'swatch'\ncolumns = 2\nrows = 2\nparticles = 12\n"
      "[simulation]\nframes = 3\nfps = 30\nsteps_per_frame = 4\n"
      "[[body]]\nname = 'ball'\nshape = 'mesh'\nfile = 'ball.obj'\ncache = 'ball.pc2'\nunit = 1\ncells = 16\n"
      "deforms = true\n";
  std::ofstream(folder / "scene.toml") << text;
  const auto read = readScene(folder / "scene.toml");
  ASSERT_TRUE(read) << read.error().message;
  const auto expected = loadScene(*read);
  ASSERT_TRUE(expected) << expected.error().message;
  const auto asset = buildAsset(device(), *expected);
  ASSERT_TRUE(asset) << asset.error().message;
  const SceneFrames frames(*expected);
  auto hair = Simulation::create(*asset, stateOf(frames.placesAt(0), *expected));
  ASSERT_TRUE(hair) << hair.error().message;

  CScene scene;
  ASSERT_EQ(ringlet_scene_parse(text.c_str(), folder.c_str(), nullptr, &scene.handle), RINGLET_OK)
      << ringlet_error_message();
  ASSERT_EQ(ringlet_scene_get(scene.handle, &scene.facts), RINGLET_OK);
  EXPECT_EQ(scene.facts.bending_body_count, 1u);
  Handles c;
  open(c);
  ASSERT_EQ(ringlet_scene_build(c.device, scene.handle, nullptr, &c.asset), RINGLET_OK);
  for (int k = 0; k < 3; ++k)  // stepped by the scene; by its poses and points; without the points
    ASSERT_EQ(ringlet_scene_hair(scene.handle, c.asset, &c.hairs.emplace_back()), RINGLET_OK)
        << ringlet_error_message();
  const std::size_t count = ringlet_asset_particle_count(c.asset);
  for (int frame = 0; frame < kFrames; ++frame) {
    ASSERT_TRUE(stepScene(frames, *hair, frame));
    ASSERT_EQ(ringlet_scene_step(scene.handle, c.hairs[0], frame), RINGLET_OK) << ringlet_error_message();
    std::vector<ringlet_pose> heads(kSteps), bodies(kSteps);
    ASSERT_EQ(ringlet_scene_frame_poses(scene.handle, frame, heads.data(), bodies.data(), nullptr),
              RINGLET_OK);
    ringlet_frame one = RINGLET_INIT(ringlet_frame);
    one.hair = c.hairs[2], one.step_poses = heads.data(), one.step_count = kSteps;
    one.body_poses = bodies.data();
    ASSERT_EQ(ringlet_step(&one, 1), RINGLET_OK) << ringlet_error_message();
    const Points points = pointsOf(scene, frame);
    const std::vector<const double*> pointers = points.pointers();
    one.hair = c.hairs[1], one.body_points = pointers.data(), one.point_samples = kSteps;
    ASSERT_EQ(ringlet_step(&one, 1), RINGLET_OK) << ringlet_error_message();
    EXPECT_EQ(positionsOf(c.hairs[0], count), *hair->positions()) << frame;
    EXPECT_EQ(positionsOf(c.hairs[1], count), *hair->positions()) << frame;
  }
  EXPECT_NE(positionsOf(c.hairs[2], count), *hair->positions());
  std::uint32_t some = 0;
  expectInvalid(ringlet_scene_frame_points(scene.handle, 0, 1, nullptr, &some), "no bending body 1");
  expectInvalid(ringlet_scene_frame_points(scene.handle, 0, 0, nullptr, nullptr), "vertex_count is NULL");
}

// Whether it is cloth.
class CHostsBody : public CBending, public testing::WithParamInterface<bool> {};
INSTANTIATE_TEST_SUITE_P(Sides, CHostsBody, testing::Bool());

// The ball of the host, handed over as vertices and then frame by frame.
TEST_P(CHostsBody, HasTheBitsOfTheLibrary) {
  const Groom groom = randomGroom({12, 12}, 1);
  Vec3d middle{};
  for (const Vec3f& p : groom.points) middle += Vec3d(p) / double(groom.points.size());
  const auto ball = [&](double share) {
    TriangleMesh mesh = ballAt(share);
    for (Vec3d& p : mesh.points) p = static_cast<Vec3d>(static_cast<Vec3f>(p + Vec3d{0, 0.1, 0} + middle));
    return mesh;
  };
  const TriangleMesh first = ball(0);
  std::vector<float> vertices;
  for (const Vec3d& p : first.points)
    for (const double number : {p.x, p.y, p.z}) vertices.push_back(static_cast<float>(number));
  ringlet_body body = RINGLET_INIT(ringlet_body);
  body.shape = "mesh", body.vertices = vertices.data(), body.triangles = first.triangles[0].data();
  body.vertex_count = static_cast<std::uint32_t>(first.points.size());
  body.triangle_count = static_cast<std::uint32_t>(first.triangles.size());
  body.cells = 16, body.deforms = 1, body.both_sides = GetParam();
  const Bounds grid{middle - Vec3d{0.1, 0.1, 0.1}, middle + Vec3d{0.1, 0.1, 0.1}};
  const double low[] = {grid.low.x, grid.low.y, grid.low.z}, high[] = {grid.high.x, grid.high.y, grid.high.z};
  std::copy_n(low, 3, body.grid_low), std::copy_n(high, 3, body.grid_high);

  Body own{.name = "body 0", .shape = BodyShape::grid};
  std::vector<std::string> warnings;
  const Status made =
      makeBendingMesh(first, bendingRoomOf(first.points, grid, 16, GetParam()), own, warnings);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(warnings, std::vector<std::string>());
  const auto asset = HairAsset::build(device(), groom, {}, {});
  ASSERT_TRUE(asset) << asset.error().message;
  InitialState start;
  start.bodies = std::span(&own, 1);
  auto hair = Simulation::create(*asset, start);
  ASSERT_TRUE(hair) << hair.error().message;

  Handles c;
  open(c);
  const CGroom from(groom);
  ASSERT_EQ(ringlet_asset_build(c.device, &from.groom, nullptr, nullptr, nullptr, &c.asset), RINGLET_OK);
  ringlet_initial_state initial = RINGLET_INIT(ringlet_initial_state);
  initial.bodies = &body, initial.body_count = 1;
  ASSERT_EQ(ringlet_hair_create(c.asset, &initial, &c.hairs.emplace_back()), RINGLET_OK)
      << ringlet_error_message();
  ringlet_frame frame = RINGLET_INIT(ringlet_frame);
  const auto steps = static_cast<std::uint32_t>(Settings{}.stepsPerFrame);
  const std::vector<ringlet_pose> heads(steps);
  frame.hair = c.hairs[0], frame.step_poses = heads.data(), frame.step_count = steps;
  for (int k = 0; k < kFrames; ++k) {
    std::vector<Vec3d> samples;  // two a frame
    std::vector<double> xyz;
    for (const double share : {k + 0.5, k + 1.0})
      for (const Vec3d& p : ball(share / kFrames).points) {
        samples.push_back(p);
        for (const double number : {p.x, p.y, p.z}) xyz.push_back(number);
      }
    const std::span<const Vec3d> given(samples);
    ASSERT_TRUE(hair->stepFrame(std::vector<HeadPose>(steps), {}, {}, std::span(&given, 1)));
    const double* pointers[] = {xyz.data()};
    frame.body_points = pointers, frame.point_samples = 2;
    ASSERT_EQ(ringlet_step(&frame, 1), RINGLET_OK) << ringlet_error_message();
    EXPECT_EQ(positionsOf(c.hairs[0], groom.points.size()), *hair->positions()) << k;
    xyz[4] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(ringlet_step(&frame, 1), RINGLET_ERROR);
    EXPECT_NE(std::string(ringlet_error_message()).find("point 1 in sample 0 of bending body 0"),
              std::string::npos)
        << ringlet_error_message();
    pointers[0] = nullptr;
    expectInvalid(ringlet_step(&frame, 1), "no points of bending body 0");
  }
  const auto refused = [&](const char* part) {
    EXPECT_EQ(ringlet_hair_set_bodies(c.hairs[0], &body, 1), RINGLET_ERROR);
    EXPECT_NE(std::string(ringlet_error_message()).find(part), std::string::npos) << ringlet_error_message();
  };
  if (GetParam()) {
    body.deforms = 0;
    return refused("expected deforms 1");
  }
  body.grid_low[1] = body.grid_high[1];
  refused("a grid without room");
  body.grid_low[1] = 0, body.cells = 7;
  body.grid_low[1] = -10;
  refused("expected 8 to 256");
}

TEST_F(CBending, AMeshsWarningsAreToldWithItsBody) {
  TriangleMesh turned = ballAt(0);
  for (auto& triangle : turned.triangles) std::swap(triangle[1], triangle[2]);
  std::vector<float> vertices;
  for (const Vec3d& p : turned.points)
    for (const double number : {p.x, p.y, p.z}) vertices.push_back(static_cast<float>(number));
  Handles c;
  open(c);
  const Groom groom = randomGroom({12}, 1);
  const CGroom from(groom);
  ASSERT_EQ(ringlet_asset_build(c.device, &from.groom, nullptr, nullptr, nullptr, &c.asset), RINGLET_OK);
  for (const int deforms : {0, 1}) {
    std::vector<std::string> told;
    ringlet_body body = RINGLET_INIT(ringlet_body);
    body.shape = "mesh", body.vertices = vertices.data(), body.triangles = turned.triangles[0].data();
    body.vertex_count = static_cast<std::uint32_t>(turned.points.size());
    body.triangle_count = static_cast<std::uint32_t>(turned.triangles.size());
    body.cells = 16, body.deforms = deforms;
    body.warn = [](const char* sentence, void* user) {
      static_cast<std::vector<std::string>*>(user)->push_back(sentence);
    };
    body.user = &told;
    ringlet_initial_state initial = RINGLET_INIT(ringlet_initial_state);
    initial.bodies = &body, initial.body_count = 1;
    ASSERT_EQ(ringlet_hair_create(c.asset, &initial, &c.hairs.emplace_back()), RINGLET_OK);
    ASSERT_EQ(told.size(), 1u) << deforms;
    expectParts(told[0], {"body 0: ", "inside out"});
    body.warn = nullptr;
    EXPECT_EQ(ringlet_hair_set_bodies(c.hairs.back(), &body, 1), RINGLET_OK) << ringlet_error_message();
  }
}

}  // namespace
}  // namespace ringlet::test::c_bending_test
