// Implements measure/head_fit.h. B. K. P. Horn, "Closed-form solution of absolute orientation using unit
// quaternions", 1987: the quaternion is the eigenvector of a symmetric 4x4 matrix with the greatest
// eigenvalue.
#include "ringlet/measure/head_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "ringlet/base/assert.h"
#include "ringlet/base/mean.h"

namespace ringlet {
namespace {

using Row = std::array<double, 4>;
using Matrix = std::array<Row, 4>;

// Leaves the eigenvalues of a symmetric matrix on its diagonal and returns the eigenvectors as columns
// (Jacobi rotations; a 4x4 matrix is diagonal up to rounding after about six sweeps).
Matrix diagonalize(Matrix& a) {
  Matrix vectors{Row{1, 0, 0, 0}, Row{0, 1, 0, 0}, Row{0, 0, 1, 0}, Row{0, 0, 0, 1}};
  for (int sweep = 0; sweep < 16; ++sweep) {
    for (std::size_t p = 0; p < 4; ++p) {
      for (std::size_t q = p + 1; q < 4; ++q) {
        if (a[p][q] == 0) continue;
        const double angle = 0.5 * std::atan2(2 * a[p][q], a[q][q] - a[p][p]);
        const double c = std::cos(angle), s = std::sin(angle);
        for (std::size_t k = 0; k < 4; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < 4; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
        }
        for (std::size_t k = 0; k < 4; ++k) {
          const double kp = vectors[k][p], kq = vectors[k][q];
          vectors[k][p] = c * kp - s * kq;
          vectors[k][q] = s * kp + c * kq;
        }
      }
    }
  }
  return vectors;
}

constexpr int kRounds = 20;
constexpr double kLeastDistance = 1e-5;  // that a point's weight is by [m]

// Sums of a pair of points over all: sx.y is the sum of rest x times now y.
struct Products {
  Vec3d sx{}, sy{}, sz{};

  void add(Vec3d rest, Vec3d now) {
    sx += now * rest.x;
    sy += now * rest.y;
    sz += now * rest.z;
  }
};

// Eigenvalues closer to the greatest than this share of it count as equal: they differ by rounding.
constexpr double kSameEigenvalue = 1e-6;

Quatd bestRotation(const Products& sums) {
  const auto& [sx, sy, sz] = sums;
  // Horn's matrix, in the order x y z w.
  Matrix n{Row{sx.x - sy.y - sz.z, sx.y + sy.x, sz.x + sx.z, sy.z - sz.y},
           Row{sx.y + sy.x, sy.y - sx.x - sz.z, sy.z + sz.y, sz.x - sx.z},
           Row{sz.x + sx.z, sy.z + sz.y, sz.z - sx.x - sy.y, sx.y - sy.x},
           Row{sy.z - sz.y, sz.x - sx.z, sx.y - sy.x, sx.x + sy.y + sz.z}};
  const Matrix vectors = diagonalize(n);
  const double greatest = std::max({n[0][0], n[1][1], n[2][2], n[3][3]});

  // The projection of the identity onto all best rotations: the smallest of them.
  Quatd best{0, 0, 0, 0};
  for (std::size_t k = 0; k < 4; ++k) {
    if (n[k][k] < greatest - kSameEigenvalue * std::abs(greatest)) continue;
    const double share = vectors[3][k];
    best = {best.x + share * vectors[0][k], best.y + share * vectors[1][k], best.z + share * vectors[2][k],
            best.w + share * vectors[3][k]};
  }
  if (best.w > 1e-24) return normalized(best);
  // Half a turn: all of them are orthogonal to the identity.
  for (std::size_t k = 0; k < 4; ++k) {
    if (n[k][k] == greatest) best = {vectors[0][k], vectors[1][k], vectors[2][k], vectors[3][k]};
  }
  return normalized(best);
}

}  // namespace

Quatd fitHeadRotation(std::span<const Vec3d> restRoots, std::span<const Vec3d> roots) {
  RINGLET_ASSERT(restRoots.size() == roots.size(), "as many roots as at rest");
  const Vec3d restMean = meanOf(restRoots), mean = meanOf(roots);
  Products sums;
  for (std::size_t i = 0; i < roots.size(); ++i) sums.add(restRoots[i] - restMean, roots[i] - mean);
  return bestRotation(sums);
}

HeadPose fitSharedMotion(std::span<const Vec3d> rest, std::span<const Vec3d> points) {
  RINGLET_ASSERT(rest.size() == points.size(), "as many points as at rest");
  const Vec3d middle = meanOf(rest);
  std::vector<double> weights(points.size(), 1.0);
  HeadPose pose;
  for (int round = 0; round < kRounds; ++round) {
    Vec3d restMean{}, mean{};
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      restMean += rest[i] * weights[i];
      mean += points[i] * weights[i];
      sum += weights[i];
    }
    if (!(sum > 0)) return pose;
    restMean = restMean / sum, mean = mean / sum;
    Products sums;
    for (std::size_t i = 0; i < points.size(); ++i)
      sums.add((rest[i] - restMean) * weights[i], points[i] - mean);
    pose.rotation = bestRotation(sums);
    pose.position = mean + rotate(pose.rotation, middle - restMean);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3d there = pose.position + rotate(pose.rotation, rest[i] - middle);
      const double distance = std::max(length(points[i] - there), kLeastDistance);
      weights[i] = 1 / (distance * std::sqrt(distance));
    }
  }
  return pose;
}

}  // namespace ringlet
