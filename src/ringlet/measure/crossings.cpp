// Implements measure/crossings.h.
//
//      q0              The volume V = ((p1 - p0) x (q0 - p0)) . (q1 - q0), six times the tetrahedron's, has
//   p0--\---->p1       a different sign on each side of p. Ends move evenly, so V is a cubic in time; where
//        \             it is 0, all ends lie in one plane, and edges that cut each other then have crossed.
//         v q1
#include "ringlet/measure/crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ringlet/base/assert.h"
#include "ringlet/base/bounds.h"
#include "ringlet/base/box_pairs.h"

namespace ringlet {
namespace {

// An edge at times 0 and 1: its first end and its vector. Both change linearly in between.
struct MovingEdge {
  Vec3d root[2], along[2];

  Vec3d rootAt(double t) const { return root[0] + (root[1] - root[0]) * t; }
  Vec3d alongAt(double t) const { return along[0] + (along[1] - along[0]) * t; }
};

// c0 + c1 t + c2 t^2 + c3 t^3, and its value at time 1 computed directly: with the same bits as at time 0 of
// the next step.
struct Cubic {
  double c0, c1, c2, c3, end;
  double at(double t) const { return t == 1 ? end : c0 + t * (c1 + t * (c2 + t * c3)); }
};

// V = (a x b) . c: a the edge p, b the way from p0 to q0, c the edge q.
Cubic volume(const MovingEdge& p, const MovingEdge& q) {
  const Vec3d a = p.along[0], b = q.root[0] - p.root[0], c = q.along[0];
  const Vec3d aEnd = p.along[1], bEnd = q.root[1] - p.root[1], cEnd = q.along[1];
  const Vec3d aWay = aEnd - a, bWay = bEnd - b, cWay = cEnd - c;
  const Vec3d n0 = cross(a, b), n1 = cross(a, bWay) + cross(aWay, b), n2 = cross(aWay, bWay);
  return {dot(n0, c), dot(n0, cWay) + dot(n1, c), dot(n1, cWay) + dot(n2, c), dot(n2, cWay),
          dot(cross(aEnd, bEnd), cEnd)};
}

// Times from 0 to 1 between which the cubic is monotonic.
struct Times {
  std::array<double, 4> values{};
  int count = 0;
  void add(double t) { values[static_cast<std::size_t>(count++)] = t; }
};

Times turningTimes(const Cubic& v) {
  Times times;
  times.add(0);
  // Roots of the slope c1 + 2 c2 t + 3 c3 t^2, in a form without cancellation.
  const double a = 3 * v.c3, b = v.c2, c = v.c1, root = b * b - a * c;
  if (root > 0) {
    const double q = -(b + std::copysign(std::sqrt(root), b));
    double first = q / a, second = c / q;
    if (!(first < second)) std::swap(first, second);
    for (double t : {first, second}) {
      if (t > 0 && t < 1) times.add(t);
    }
  }
  times.add(1);
  return times;
}

// The zero of the cubic, which has different signs at both ends, by bisection down to the precision of
// doubles.
double zeroBetween(const Cubic& v, double low, double high) {
  const bool below = v.at(low) < 0;
  for (int i = 0; i < 64; ++i) {
    const double middle = (low + high) / 2;
    ((v.at(middle) < 0) == below ? low : high) = middle;
  }
  return (low + high) / 2;
}

// Whether the two edges, whose ends lie in one plane at time t, cut each other there. An edge includes its
// first end but not its last, so that passing exactly through a particle counts for only one of its edges.
bool cutEachOther(const MovingEdge& p, const MovingEdge& q, double t) {
  const Vec3d a = p.alongAt(t), c = q.alongAt(t), between = q.rootAt(t) - p.rootAt(t);
  const double aa = dot(a, a), cc = dot(c, c), ac = dot(a, c), determinant = aa * cc - ac * ac;
  if (!(determinant > 1e-24 * aa * cc)) return false;  // parallel
  const double onP = (dot(between, a) * cc - dot(between, c) * ac) / determinant;
  const double onQ = (dot(between, a) * ac - dot(between, c) * aa) / determinant;
  return onP >= 0 && onP < 1 && onQ >= 0 && onQ < 1;
}

std::uint64_t crossingsOf(const MovingEdge& p, const MovingEdge& q) {
  const Cubic v = volume(p, q);
  const Times times = turningTimes(v);
  std::uint64_t count = 0;
  for (int i = 0; i + 1 < times.count; ++i) {
    const double low = times.values[static_cast<std::size_t>(i)],
                 high = times.values[static_cast<std::size_t>(i) + 1];
    // Zero counts as positive, so that the end of a step agrees with the start of the next.
    if ((v.at(low) < 0) == (v.at(high) < 0)) continue;
    count += cutEachOther(p, q, zeroBetween(v, low, high));
  }
  return count;
}

Box sweptBox(const MovingEdge& edge) {
  Bounds box = Bounds::none();
  for (Vec3d p : {edge.root[0], edge.root[1], edge.root[0] + edge.along[0], edge.root[1] + edge.along[1]})
    box.add(p);
  return {box.middle(), (box.high - box.low) * 0.5};
}

}  // namespace

std::uint64_t countCrossings(std::span<const std::uint32_t> firstPoint, std::span<const Vec3f> before,
                             std::span<const Vec3f> after, std::span<const std::uint32_t> bundles) {
  RINGLET_ASSERT(!firstPoint.empty() && before.size() == firstPoint.back() && after.size() == before.size(),
                 "one position per particle, before and after");
  std::vector<MovingEdge> edges;
  std::vector<std::size_t> strands;
  std::vector<Box> boxes;
  for (std::size_t s = 0; s + 1 < firstPoint.size(); ++s) {
    for (std::uint32_t i = firstPoint[s]; i + 1 < firstPoint[s + 1]; ++i) {
      const auto from0 = static_cast<Vec3d>(before[i]), from1 = static_cast<Vec3d>(after[i]);
      const auto to0 = static_cast<Vec3d>(before[i + 1]), to1 = static_cast<Vec3d>(after[i + 1]);
      edges.push_back({{from0, from1}, {to0 - from0, to1 - from1}});
      strands.push_back(s);
      boxes.push_back(sweptBox(edges.back()));
    }
  }
  const auto mayPass = [&](std::size_t a, std::size_t b) {
    return a == b || (!bundles.empty() && bundles[a] != 0 && bundles[a] == bundles[b]);
  };
  std::uint64_t count = 0;
  const BoxPairs pairs(boxes);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    pairs.visitPartners(i, [&](std::size_t j) {
      // Always in one order, so that a volume has the same bits at the end of a step and at the start of the
      // next.
      if (!mayPass(strands[i], strands[j]))
        count += crossingsOf(edges[std::min(i, j)], edges[std::max(i, j)]);
    });
  }
  return count;
}

}  // namespace ringlet
