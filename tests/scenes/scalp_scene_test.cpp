// Hair on a mesh that moves under the skin's joints, through the solver: roots stay on the mesh as it bends,
// and a mesh that moves rigidly and slowly carries hair at rest rigidly.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "ringlet/motion/head_scalp.h"
#include "ringlet/motion/skinned_mesh.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/solver/simulation.h"
#include "tests/motion/gltf_samples.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"

namespace ringlet::test::scalp_scene_test {
namespace {

constexpr double kLength = 0.15;  // of a curl [m]

// Curls that hang from the places, in metres.
Groom curlsAt(const std::vector<Vec3d>& places) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (Vec3d place : places) {
    std::vector<Vec3f> strand = helix(32, 0.008, kLength, 5, 0, 1);
    const Vec3f root = strand.front();
    for (Vec3f& p : strand) p = p - root + Vec3f(place);
    groom.addStrand(strand);
  }
  return groom;
}

std::vector<Vec3d> rootsOf(const Groom& groom) {
  std::vector<Vec3d> roots;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) roots.push_back(Vec3d(groom.strand(s).front()));
  return roots;
}

class ScalpScene : public GpuTest {
 protected:
  // Calls seen(positions, head, t) after every frame from `begin` to `end` [s].
  template <class Seen>
  void run(const Groom& groom, const Motion& head, const HeadScalp& scalp, double begin, double end,
           Seen&& seen) {
    const Settings settings;
    const double T = settings.stepSeconds();
    const std::vector<BodyPose> roots0 = scalp.rootPosesAt(begin), earlier = scalp.rootPosesAt(begin - T);
    auto simulation = Simulation::create(device(), groom, materialPreset("ringlet").value(), settings,
                                         {.head = head.poseAt(begin),
                                          .oneStepEarlier = head.poseAt(begin - T),
                                          .roots = roots0,
                                          .rootsEarlier = earlier},
                                         {.features = {.roots = true}});
    ASSERT_TRUE(simulation) << simulation.error().message;
    for (double t = begin; t < end - T;) {
      std::vector<HeadPose> heads;
      std::vector<BodyPose> roots;
      for (int k = 0; k < settings.stepsPerFrame; ++k) {
        t += T;
        heads.push_back(head.poseAt(t));
        for (const BodyPose& pose : scalp.rootPosesAt(t)) roots.push_back(pose);
      }
      ASSERT_TRUE(simulation->stepFrame(heads, {}, roots));
      seen(*simulation->positions(), simulation->head(), t);
    }
    EXPECT_EQ(simulation->report()->nonfinite, 0u);
  }
};

std::shared_ptr<const SkinnedMesh> meshOf(const GltfBuilder& builder) {
  auto file = parseGltf(bytesOf(builder.glb()), "");
  EXPECT_TRUE(file) << file.error().message;
  auto mesh = SkinnedMesh::of(std::make_shared<const GltfFile>(std::move(*file)));
  EXPECT_TRUE(mesh) << mesh.error().message;
  return std::make_shared<const SkinnedMesh>(std::move(*mesh));
}

// Against the closed form of the mesh (gltf_samples.h), while the head goes its own way.
TEST_F(ScalpScene, RootsStayOnAMeshThatBends) {
  const auto mesh = meshOf(bendingStrip(8, 5121, 5126));
  std::vector<Vec3d> places;
  for (int k = 0; k < 24; ++k) places.push_back({0.05 + 0.08 * k, 0, 0.07 * std::sin(2.0 * k)});
  const Groom groom = curlsAt(places);
  const Motion head{.kind = MotionKind::shake, .axis = {0, 0.6, 0.8}, .amplitude = 0.05};
  const auto scalp = HeadScalp::bind(mesh, rootsOf(groom), head);
  ASSERT_TRUE(scalp) << scalp.error().message;
  const std::vector<Vec3d> rest = mesh->pointsAt(0);
  double farthest = 0;
  run(groom, head, *scalp, 0, 1, [&](const std::vector<Vec3f>& positions, const HeadPose& pose, double t) {
    for (std::size_t s = 0; s < places.size(); ++s) {
      const auto [a, b, c] = mesh->triangles()[scalp->scalp().triangleOf(s)];
      // The shares of a place in a triangle of the flat strip, whose area is twice `whole`.
      const auto area = [](Vec3d p, Vec3d q, Vec3d r) { return cross(q - p, r - p).y; };
      const double whole = area(rest[a], rest[b], rest[c]);
      const double wa = area(places[s], rest[b], rest[c]) / whole,
                   wb = area(rest[a], places[s], rest[c]) / whole;
      const Vec3d wanted =
          bentPoint(rest[a], t) * wa + bentPoint(rest[b], t) * wb + bentPoint(rest[c], t) * (1 - wa - wb);
      const Vec3d found = pose.position + Vec3d(positions[groom.firstPoint[s]]);
      farthest = std::max(farthest, length(found - wanted));
    }
  });
  fmt::print("roots are at most {:.1e} m from the strip\n", farthest);
  EXPECT_LE(farthest, 1e-6);  // float positions of a strip 2 m long are right to 1.2e-7
}

// A strip that glides and turns about the vertical: hair at rest goes with it. What is left is centrifugal
// force, w^2 r = 0.04 rad^2/s^2 x 0.2 m of gravity's 9.81 m/s^2, on curls that gravity would stretch by about
// their length.
TEST_F(ScalpScene, ASlowRigidMeshCarriesHairRigidly) {
  GltfBuilder builder;
  builder.root["meshes"] = {
      {{"primitives",
        {{{"attributes", {{"POSITION", builder.floats({-1, 0, -1, 1, 0, -1, 0, 0, 2}, "VEC3")}}}}}}}};
  builder.node({{"mesh", 0}});
  const double turn = 0.2 * 4;  // [rad], in 4 s
  builder.channel(0, 0, "translation", "LINEAR", {0, 4}, {0, 0, 0, 0.8, 0.2, -0.4});
  builder.channel(0, 0, "rotation", "LINEAR", {0, 4},
                  {0, 0, 0, 1, 0, std::sin(turn / 2), 0, std::cos(turn / 2)});
  const auto mesh = meshOf(builder);
  const Groom groom = curlsAt({{0.1, 0, 0}, {-0.05, 0, 0.1}, {0, 0, -0.2}});
  const auto scalp = HeadScalp::bind(mesh, rootsOf(groom), Motion{});
  ASSERT_TRUE(scalp) << scalp.error().message;
  double farthest = 0;
  run(groom, Motion{}, *scalp, 0.5, 2.5, [&](const std::vector<Vec3f>& positions, const HeadPose&, double t) {
    const Quatd turned = fromRotationVector(Vec3d{0, 0.2 * t, 0});
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Vec3d wanted = Vec3d{0.2, 0.05, -0.1} * t + rotate(turned, Vec3d(groom.points[i]));
      farthest = std::max(farthest, length(Vec3d(positions[i]) - wanted));
    }
  });
  fmt::print("hair is at most {:.1e} of a curl's length from where a rigid motion takes it\n",
             farthest / kLength);
  EXPECT_LE(farthest, 2 * 0.04 * 0.2 / 9.81 * kLength);
}

}  // namespace
}  // namespace ringlet::test::scalp_scene_test
