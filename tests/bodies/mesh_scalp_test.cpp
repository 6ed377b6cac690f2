// bodies/mesh_scalp.h, and heads of hair on meshes.
#include "ringlet/bodies/mesh_scalp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "ringlet/bodies/icosphere.h"
#include "ringlet/groom/generate.h"
#include "ringlet/groom/head_regions.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/style_samples.h"

namespace ringlet::mesh_scalp_test {
namespace {

constexpr Vec3d kAxes{0.07, 0.095, 0.1};  // of a long head [m]

// An ellipsoid about the origin, or what of it is above a height.
TriangleMesh ellipsoid(double lowest = -1) {
  TriangleMesh mesh = makeIcosphere(24);
  for (Vec3d& p : mesh.points) p = {p.x * kAxes.x, p.y * kAxes.y, p.z * kAxes.z};
  std::erase_if(mesh.triangles, [&](const auto& triangle) {
    return std::ranges::any_of(triangle, [&](std::uint32_t i) { return mesh.points[i].y < lowest; });
  });
  return mesh;
}
// 1 on it, above outside.
double scaledLength(Vec3d p) { return length(Vec3d{p.x / kAxes.x, p.y / kAxes.y, p.z / kAxes.z}); }

std::vector<Vec3d> rootsOf(const Groom& groom) {
  std::vector<Vec3d> roots;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    roots.push_back(Vec3d(groom.strand(s)[0]) * groom.metresPerUnit);
  return roots;
}

// From each root to its nearest other.
std::vector<double> nearest(const std::vector<Vec3d>& roots) {
  std::vector<double> all;
  for (const Vec3d& a : roots) {
    double least = 1;
    for (const Vec3d& b : roots)
      if (&a != &b) least = std::min(least, length(a - b));
    all.push_back(least);
  }
  return all;
}

TEST(MeshScalp, OfAMeshIsNearlyTheSphereItIs) {
  TriangleMesh mesh = makeIcosphere(24);
  for (Vec3d& p : mesh.points) p = p * 0.09;
  const auto made = makeMeshScalp(mesh);
  ASSERT_TRUE(made) << made.error().message;
  const ScalpSurface& scalp = **made;
  const SphereScalp sphere(0.09);
  for (int i = 0; i < 200; ++i) {
    const double y = 0.999 - 0.009 * i, a = 2.4 * i, r = std::sqrt(1 - y * y);
    const Vec3d direction{r * std::cos(a), y, r * std::sin(a)};
    const auto root = scalp.rootAlong(direction), exact = sphere.rootAlong(direction);
    ASSERT_TRUE(root && exact);
    EXPECT_LT(length(root->position - exact->position), 1e-4) << i;
    EXPECT_GT(dot(root->normal, exact->normal), 0.999) << i;
    const Vec3d place = direction * (i % 2 == 0 ? 0.1 : 0.13);
    EXPECT_NEAR(scalp.heightOf(place).height, sphere.heightOf(place).height, 1e-4) << i;
    EXPECT_NEAR(sphere.heightOf(sphere.raisedTo(place, 0.003)).height, 0.003, 1e-12);
    EXPECT_NEAR(sphere.heightOf(scalp.raisedTo(place, 0.003)).height, 0.003, 1e-4) << i;
  }
}

TEST(MeshScalp, HairOfEveryStyleGrowsEvenlyOnAMeshAndStaysOutside) {
  const auto scalp = *makeMeshScalp(ellipsoid());
  for (const std::string& name : test::styleNames()) {
    HeadParameters head = *headOfStyle(name);
    head.strandCount = 400;
    head.curl.particleCount = 48;
    head.curl.metresPerUnit = 1;
    head.scalp = scalp;
    const auto groom = makeHead(head);
    ASSERT_TRUE(groom) << name << ": " << groom.error().message;
    ASSERT_EQ(groom->strandCount(), 400u) << name;
    const std::vector<Vec3d> roots = rootsOf(*groom);
    for (const Vec3d root : roots) {
      EXPECT_NEAR(scaledLength(root), 1, 0.004) << name;
      EXPECT_TRUE(isAboveHairline(head, normalizedOr(root, Vec3d{}))) << name;
    }
    for (const Vec3f& p : groom->points) EXPECT_GT(scaledLength(Vec3d(p)), 0.99) << name;
    // A hexagonal lattice has the ratio 1; places at random have 0.
    std::vector<double> apart = nearest(roots);
    std::ranges::sort(apart);
    EXPECT_GT(apart.front() / apart[200], 0.7) << name;
    EXPECT_LT(apart[399] / apart[200], 1.6) << name;
  }
}

// As wide curls as half a head, bent down at once.
TEST(MeshScalp, WideCurlsThatBendAtOnceStayOutside) {
  HeadParameters head{.strandCount = 60, .browElevation = 1.2, .napeElevation = -1.2, .bendLength = 1e-4};
  head.curl = {.radius = 0.03, .turns = 12, .particleCount = 200, .metresPerUnit = 1};
  head.rampShare = 0.05;
  head.scalp = *makeMeshScalp(ellipsoid());
  const auto groom = makeHead(head);
  ASSERT_TRUE(groom) << groom.error().message;
  for (const Vec3f& p : groom->points) EXPECT_GT(scaledLength(Vec3d(p)), 0.99);
}

TEST(MeshScalp, OfAnOpenMeshHairGrowsOnWhatThereIs) {
  HeadParameters head{.strandCount = 300};
  head.curl.metresPerUnit = 1;
  head.scalp = *makeMeshScalp(ellipsoid(0.03));
  const auto groom = makeHead(head);
  ASSERT_TRUE(groom) << groom.error().message;
  double lowest = 1;
  for (const Vec3d root : rootsOf(*groom)) {
    EXPECT_NEAR(scaledLength(root), 1, 0.004);
    lowest = std::min(lowest, root.y);
  }
  EXPECT_GT(lowest, 0.0299);
  EXPECT_LT(lowest, 0.04);
}

TEST(MeshScalp, OneThatIsElsewhereIsRefused) {
  HeadParameters head{.strandCount = 10};
  TriangleMesh mesh = ellipsoid();
  for (Vec3d& p : mesh.points) p.y -= 0.5;
  head.scalp = *makeMeshScalp(mesh);
  auto groom = makeHead(head);
  ASSERT_FALSE(groom);
  EXPECT_TRUE(test::contains(groom.error().message, "expected a scalp about the origin"))
      << groom.error().message;
  EXPECT_FALSE(makeMeshScalp({}));
}

}  // namespace
}  // namespace ringlet::mesh_scalp_test
