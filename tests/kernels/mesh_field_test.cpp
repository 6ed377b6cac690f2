// solver/inputs/mesh_fields.h: grids of meshes that bend, made on the device, against the reference.
#include "ringlet/solver/inputs/mesh_fields.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "reference/kernels/mesh_field.h"
#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/recorder.h"
#include "tests/support/bending_samples.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::mesh_field_test {
namespace {

constexpr std::uint32_t kCopies = 3;

// A mesh a little elsewhere in each copy.
std::vector<Vec3d> pointsOf(const BendingSample& sample, std::uint32_t copy) {
  std::vector<Vec3d> points = sample.points;
  for (Vec3d& p : points)
    p +=
        Vec3d{0.4 + p.y / sample.mesh.reach, 0.3, -0.7 * p.x / sample.mesh.reach} * (copy * sample.mesh.cell);
  return points;
}

struct Made {
  std::vector<std::uint32_t> keys, pairs;
  std::vector<layout::MeshRest> rests;

  double distance(std::uint32_t mesh, std::uint32_t copy, std::size_t corner) const {
    const std::uint32_t pair = pairs[rests[mesh].firstPair + copy * rests[mesh].corners + corner];
    return static_cast<float>(std::bit_cast<Eigen::half>(static_cast<std::uint16_t>(pair & 0xffff)));
  }
  std::uint32_t triangle(std::uint32_t mesh, std::uint32_t copy, std::size_t corner) const {
    const std::uint32_t key = keys[rests[mesh].firstKey + copy * rests[mesh].corners + corner];
    const std::uint32_t mask = (1u << rests[mesh].triangleBits) - 1;
    return key == 0 ? ~0u : mask - (key & mask);
  }
};

class MeshFieldTest : public GpuTest {
 protected:
  // All samples at once; grids `first` .. `first + count - 1` are made twice, the others once.
  Made make(const std::vector<BendingSample>& samples, std::uint32_t first, std::uint32_t count) {
    gpu::Device& gpu = device().gpu();
    std::vector<const BendingMesh*> meshes;
    std::vector<layout::vec4> points;
    std::size_t corners = 0;
    for (const BendingSample& sample : samples) {
      meshes.push_back(&sample.mesh);
      corners += kCopies * sample.mesh.cornerCount();
      for (std::uint32_t copy = 0; copy < kCopies; ++copy)
        for (const Vec3d p : pointsOf(sample, copy)) points.push_back(packed(p));
    }
    auto pointBuffer = createFilled(gpu, points, "points");
    auto pairs = gpu::Buffer::create(gpu, corners * 4, gpu::BufferKind::storage, "pairs");
    EXPECT_TRUE(pointBuffer && pairs);
    auto fields = MeshFields::create(gpu, meshes, kCopies, *pointBuffer, *pairs);
    EXPECT_TRUE(fields) << fields.error().message;
    auto recorder = gpu::Recorder::create(gpu, "mesh fields");
    EXPECT_TRUE(recorder && recorder->begin());
    fields->record(*recorder, 0, kCopies - 1);
    fields->record(*recorder, first, first + count - 1);
    EXPECT_TRUE(recorder->submitAndWait());
    return {*downloadAll<std::uint32_t>(fields->keys(), corners),
            *downloadAll<std::uint32_t>(*pairs, corners), fields->rests()};
  }
};

TEST_F(MeshFieldTest, AgreesWithTheReference) {
  const std::vector<BendingSample> samples = bendingSamples();
  const Made made = make(samples, 1, 1);
  for (std::uint32_t m = 0; m < samples.size(); ++m) {
    SCOPED_TRACE(samples[m].name);
    const BendingMesh& mesh = samples[m].mesh;
    for (std::uint32_t copy = 0; copy < kCopies; ++copy) {
      const std::vector<Vec3d> points = pointsOf(samples[m], copy);
      const auto field = reference::meshField<double>(mesh, points, double{layout::kMeshBand});
      // Of a half's last digit; of triangles a hundred cells long a float leaves some 1e-4 cells.
      double worst = 0;
      std::size_t otherSign = 0, otherTriangle = 0;
      for (std::size_t i = 0; i < field.distances.size(); ++i) {
        const double distance = made.distance(m, copy, i), expected = field.distances[i];
        worst = std::max(worst, std::abs(distance - expected) / std::max(std::abs(expected) / 1024, 5e-4));
        otherSign += std::abs(expected) > 2e-3 && (distance < 0) != (expected < 0);
        const std::uint32_t triangle = made.triangle(m, copy, i);
        if (triangle == field.triangles[i]) continue;
        // Another triangle that is as near, or the band's end.
        if (triangle == ~0u || field.triangles[i] == ~0u) {
          EXPECT_NEAR(std::abs(expected), double{layout::kMeshBand}, 1e-3);
          continue;
        }
        const auto& [a, b, c] = mesh.surface.triangles[triangle];
        const Vec3d p = cornerPlace(mesh, i);
        const double toIt = length(p - closestOnTriangle(p, points[a], points[b], points[c])) / mesh.cell;
        otherTriangle += toIt > std::abs(expected) + 1e-4;
      }
      EXPECT_LE(worst, 1.1);
      EXPECT_EQ(otherSign, 0u);
      EXPECT_EQ(otherTriangle, 0u);
    }
  }
}

// A pair's second distance is the next corner's along x.
TEST_F(MeshFieldTest, PairsAreOfNeighbours) {
  const std::vector<BendingSample> samples = bendingSamples();
  const Made made = make(samples, 0, 2);
  for (const layout::MeshRest& rest : made.rests)
    for (std::uint32_t i = 0; i < kCopies * rest.corners; ++i) {
      const std::uint32_t here = made.pairs[rest.firstPair + i];
      const bool isLast = i % (rest.cells[0] + 1) == rest.cells[0];
      EXPECT_EQ(here >> 16, (isLast ? here : made.pairs[rest.firstPair + i + 1]) & 0xffff);
    }
}

TEST_F(MeshFieldTest, RepeatsBitForBit) {
  const std::vector<BendingSample> samples = bendingSamples();
  const Made once = make(samples, 0, 1);
  for (std::uint32_t first = 0; first < kCopies; ++first) {
    const Made again = make(samples, first, kCopies - first);
    EXPECT_EQ(once.keys, again.keys);
    EXPECT_EQ(once.pairs, again.pairs);
  }
}

}  // namespace
}  // namespace ringlet::test::mesh_field_test
