// reference/equations/column_crossing.h: each side of a closed surface counts once, also for columns through
// its corners and edges; and a mesh's field (reference/kernels/mesh_field.h) against what is known of the
// mesh.
#include "reference/equations/column_crossing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "reference/kernels/mesh_field.h"
#include "tests/bodies/body_samples.h"
#include "tests/support/bending_samples.h"

namespace ringlet::test::column_crossing_test {
namespace {

using reference::columnCrossing, reference::ColumnCrossing, reference::LatticePoint, reference::meshField,
    reference::MeshField;

// An octahedron whose corners are on the lattice, and the columns of the lattice: all pass through corners,
// edges or faces' insides.
TEST(ColumnCrossing, CountsEachSideOnce) {
  constexpr int kHalf = 4;
  struct Corner {
    LatticePoint across;
    double x;
  };
  const Corner corners[6] = {{{kHalf, 0}, 0},  {{-kHalf, 0}, 0}, {{0, kHalf}, 0},
                             {{0, -kHalf}, 0}, {{0, 0}, kHalf},  {{0, 0}, -kHalf}};
  const int faces[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                           {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (std::int64_t y = -kHalf; y <= kHalf; ++y)
    for (std::int64_t z = -kHalf; z <= kHalf; ++z) {
      int entered = 0, left = 0;
      double from = 0, to = 0;
      for (const auto& [a, b, c] : faces) {
        const ColumnCrossing<double> crossing =
            columnCrossing<double>({corners[a].across, corners[b].across, corners[c].across},
                                   {corners[a].x, corners[b].x, corners[c].x}, {y, z});
        if (crossing.turns > 0) ++entered, from = crossing.x;
        if (crossing.turns < 0) ++left, to = crossing.x;
      }
      const double half = kHalf - std::abs(double(y)) - std::abs(double(z));
      EXPECT_EQ(entered, left) << y << ", " << z;
      EXPECT_LE(entered, 1);
      if (half > 0) {
        EXPECT_EQ(entered, 1) << y << ", " << z;
        EXPECT_DOUBLE_EQ(from, -half);
        EXPECT_DOUBLE_EQ(to, half);
      }
      if (half < 0) {
        EXPECT_EQ(entered, 0) << y << ", " << z;
      }
    }
}

TEST(MeshField, KnowsDistancesAndInsides) {
  constexpr double kBand = 2;
  for (const BendingSample& sample : bendingSamples()) {
    SCOPED_TRACE(sample.name);
    const MeshField<double> field = meshField<double>(sample.mesh, sample.points, kBand);
    const TriangleMesh surface{sample.points, sample.mesh.surface.triangles};
    std::size_t inside = 0, near = 0;
    for (std::size_t i = 0; i < field.distances.size(); ++i) {
      const Vec3d place = cornerPlace(sample.mesh, i);
      const double exact = bruteDistance(surface, place) / sample.mesh.cell;
      if (exact < kBand || field.distances[i] > 0) {
        EXPECT_NEAR(std::abs(field.distances[i]), std::min(exact, kBand), 1e-9);
      } else {
        // Deep inside it is the distance, along x, of where a triangle is near, or of the grid's end.
        EXPECT_LE(field.distances[i], -1);
        if (sample.name != "part of a tall box") {
          EXPECT_GE(-field.distances[i], exact - 1e-9);
        }
      }
      near += field.triangles[i] != MeshField<double>::kNone;
      inside += field.distances[i] < 0;
      if (exact < 2 / sample.mesh.stepsPerCell()) continue;  // rounded to steps
      const bool isInside = bruteWinding(surface, place) > 0.5;
      EXPECT_EQ(field.distances[i] < 0, isInside) << "corner " << i << ", " << exact << " cells away";
    }
    EXPECT_GT(inside, 10u);
    EXPECT_GT(near, 50u);
  }
}

}  // namespace
}  // namespace ringlet::test::column_crossing_test
