// Implements groom/cubic_curve.h. All pieces are looked at as Bezier curves: of a piece B with control points
// b0 .. b3 a polyline of m equal steps is no farther than max |B''| / (8 m^2), and |B''| is largest at an
// end: 6 |b0 - 2 b1 + b2| or 6 |b1 - 2 b2 + b3|.
#include "ringlet/groom/cubic_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

using Piece = std::array<Vec3d, 4>;

class Pieces {
 public:
  Pieces(std::span<const Vec3d> points, CubicBasis basis, bool isPinned)
      : points_(points), basis_(basis), isPinned_(isPinned && basis != CubicBasis::bezier) {}

  std::size_t count() const {
    if (isPinned_) return points_.size() - 1;
    return basis_ == CubicBasis::bezier ? (points_.size() - 1) / 3 : points_.size() - 3;
  }

  Piece operator[](std::size_t k) const {
    if (basis_ == CubicBasis::bezier) return {at(3 * k), at(3 * k + 1), at(3 * k + 2), at(3 * k + 3)};
    const std::size_t first = isPinned_ ? k : k + 1;  // point of the piece's second
    const Vec3d p = before(first), q = at(first), r = at(first + 1), s = after(first + 1);
    if (basis_ == CubicBasis::catmullRom) return {q, q + (r - p) / 6, r - (s - q) / 6, r};
    return {(p + 4.0 * q + r) / 6, (2.0 * q + r) / 3, (q + 2.0 * r) / 3, (q + 4.0 * r + s) / 6};
  }

 private:
  Vec3d at(std::size_t i) const { return points_[i]; }
  // Beyond the ends of a pinned curve its first and last edge go on.
  Vec3d before(std::size_t i) const { return i > 0 ? at(i - 1) : at(0) * 2 - at(1); }
  Vec3d after(std::size_t i) const { return i + 1 < points_.size() ? at(i + 1) : at(i) * 2 - at(i - 1); }

  std::span<const Vec3d> points_;
  CubicBasis basis_;
  bool isPinned_;
};

// By de Casteljau's way, which gives the ends' very bits.
Vec3d pointAt(const Piece& b, double t) {
  const auto between = [t](Vec3d from, Vec3d to) { return from * (1 - t) + to * t; };
  const Vec3d p = between(b[0], b[1]), q = between(b[1], b[2]), r = between(b[2], b[3]);
  return between(between(p, q), between(q, r));
}

// The blossom of the B-spline's span from knots[3] to knots[4] at three parameters: four points, eight knots.
Vec3d blossomAt(std::span<const Vec3d> points, std::span<const double> knots,
                const std::array<double, 3>& at) {
  Piece d{points[0], points[1], points[2], points[3]};
  for (std::size_t r = 1; r <= 3; ++r) {
    for (std::size_t j = 3; j >= r; --j) {
      const double low = knots[j], high = knots[j + 4 - r], share = (at[r - 1] - low) / (high - low);
      d[j] = d[j - 1] * (1 - share) + d[j] * share;
    }
  }
  return d[3];
}

}  // namespace

bool isCubicCount(CubicBasis basis, bool isPinned, std::size_t count) {
  if (basis == CubicBasis::bezier) return count >= 4 && (count - 4) % 3 == 0;
  return count >= (isPinned ? 2u : 4u);
}

void appendCubic(std::span<const Vec3d> points, CubicBasis basis, bool isPinned,
                 std::vector<Vec3d>& particles) {
  RINGLET_ASSERT(isCubicCount(basis, isPinned, points.size()), "as many points as the basis needs");
  const Pieces pieces(points, basis, isPinned);
  double total = 0, bend = 0;
  for (std::size_t k = 0; k < pieces.count(); ++k) {
    const Piece b = pieces[k];
    total += length(b[1] - b[0]) + length(b[2] - b[1]) + length(b[3] - b[2]);
    bend = std::max({bend, length(b[0] - b[1] * 2 + b[2]), length(b[1] - b[2] * 2 + b[3])});
  }
  // At most sqrt(0.75 / tolerance): no bend is larger than the whole.
  const double steps = total > 0 ? std::ceil(std::sqrt(0.75 * bend / (kCubicTolerance * total))) : 1;
  const auto m = static_cast<std::size_t>(std::max(steps, 1.0));
  particles.push_back(pieces[0][0]);
  for (std::size_t k = 0; k < pieces.count(); ++k) {
    const Piece b = pieces[k];
    for (std::size_t i = 1; i < m; ++i)
      particles.push_back(pointAt(b, static_cast<double>(i) / static_cast<double>(m)));
    particles.push_back(b[3]);
  }
}

bool areCubicKnots(std::span<const double> knots, std::size_t count) {
  if (count < 4 || knots.size() != count + 4) return false;
  for (std::size_t k = 0; k < knots.size(); ++k)
    if (!std::isfinite(knots[k]) || (k > 0 && knots[k] < knots[k - 1])) return false;
  return knots[3] < knots[count];
}

void appendBezierOfKnots(std::span<const Vec3d> points, std::span<const double> knots,
                         std::vector<Vec3d>& bezier) {
  RINGLET_ASSERT(areCubicKnots(knots, points.size()), "as many knots as the points need");
  bool isFirst = true;
  for (std::size_t k = 3; k < points.size(); ++k) {
    const double from = knots[k], to = knots[k + 1];
    if (!(from < to)) continue;
    const auto own = points.subspan(k - 3, 4);
    const auto around = knots.subspan(k - 3, 8);
    if (isFirst) bezier.push_back(blossomAt(own, around, {from, from, from}));
    bezier.push_back(blossomAt(own, around, {from, from, to}));
    bezier.push_back(blossomAt(own, around, {from, to, to}));
    bezier.push_back(blossomAt(own, around, {to, to, to}));
    isFirst = false;
  }
}

}  // namespace ringlet
