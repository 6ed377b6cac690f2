// Pairs of edges that are about to pass through each other, and the exact judge of it.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "ringlet/crossings/crossing_judge.h"
#include "ringlet/measure/crossings.h"

namespace ringlet::test {

struct MovedPair {
  EdgeWay p, q;
};

inline double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
/// In a cube about 0, of this half edge.
inline Vec3d inCube(std::mt19937& random, double half) {
  const double x = uniform(random, -half, half), y = uniform(random, -half, half);
  return {x, y, uniform(random, -half, half)};
}
inline Vec3d anyDirection(std::mt19937& random) { return normalizedOr(inCube(random, 1), Vec3d{1, 0, 0}); }

/// Edges of 1 to 20 mm, 1 um to 3 mm apart, some nearly parallel, some of which move together, by up to 12
/// mm; as floats hold them.
inline MovedPair randomPair(std::mt19937& random) {
  const Vec3d along = anyDirection(random);
  const bool isParallel = random() % 4 == 0;
  const double off = std::pow(10, uniform(random, -5, -1));
  const Vec3d another = anyDirection(random);
  const Vec3d other = isParallel ? normalizedOr(along + off * another, along) : another;
  const Vec3d apart =
      std::pow(10, uniform(random, -6, -2.5)) * normalizedOr(cross(along, other), Vec3d{1, 0, 0});
  const double a = uniform(random, 0.001, 0.02), c = uniform(random, 0.001, 0.02);
  const double onP = uniform(random, -0.2, 1.2), onQ = uniform(random, -0.2, 1.2);
  const Vec3d middle = inCube(random, 0.2);
  MovedPair pair;
  pair.p.from = {middle - onP * a * along, middle + (1 - onP) * a * along};
  pair.q.from = {middle + apart - onQ * c * other, middle + apart + (1 - onQ) * c * other};
  const Vec3d common = inCube(random, random() % 2 ? 0.012 : 0.001);
  const double own = std::pow(10, uniform(random, -5, -2));
  const bool isPinned = random() % 8 == 0;
  for (std::size_t e = 0; e < 2; ++e) {
    pair.p.to[e] = pair.p.from[e] + (isPinned ? 0.0 : 1.0) * (common + inCube(random, own));
    pair.q.to[e] = pair.q.from[e] + common + inCube(random, own);
  }
  for (EdgeWay* edge : {&pair.p, &pair.q})
    for (EdgeEnds* ends : {&edge->from, &edge->to})
      for (Vec3d& x : *ends) x = asStored(x);
  return pair;
}

inline std::uint64_t exactCrossings(std::span<const std::uint32_t> firstPoint, std::span<const Vec3d> from,
                                    std::span<const Vec3d> to) {
  std::vector<Vec3f> before, after;
  for (const Vec3d& x : from) before.push_back(static_cast<Vec3f>(x));
  for (const Vec3d& x : to) after.push_back(static_cast<Vec3f>(x));
  return countCrossings(firstPoint, before, after);
}
inline std::uint64_t exactCrossings(const MovedPair& pair) {
  const std::uint32_t firstPoint[]{0, 2, 4};
  const Vec3d from[]{pair.p.from[0], pair.p.from[1], pair.q.from[0], pair.q.from[1]};
  const Vec3d to[]{pair.p.to[0], pair.p.to[1], pair.q.to[0], pair.q.to[1]};
  return exactCrossings(firstPoint, from, to);
}

}  // namespace ringlet::test
