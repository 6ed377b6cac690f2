// Whether two edges can pass through each other while their ends move straight and evenly, and which way they
// have to be pushed apart where they could. Two answers that say no, each by itself, in an interval [t0, t1]
// of the step; ends of the edges a_i, b_j:
//
//     planes   n0, n1 a direction at t0, t1; ends relative to a plane that moves and turns evenly with them
//              have distances that are quadratic in time. Their Bernstein coefficients must be positive:
//
//                  g(n, n', a, b) = min_i (n.a_i + n'.a_i') - max_j (n.b_j + n'.b_j')
//                  n0.a_i(t0) - n0.b_j(t0),   n0.a_i(t1) + n1.a_i(t0) - ...,   n1.a_i(t1) - n1.b_j(t1)
//
//     volume   V(t) = ((p1 - p0) x (q0 - p0)) . (q1 - q0) is a cubic; where its four Bernstein coefficients
//     have
//              one sign the lines of both edges never meet.
//
// Directions are those between the nearest points at kCrossingNodes times. What neither answer clears counts
// as a crossing. Ours; planes that part what moves: Brochu and Bridson 2009, Chen et al. 2025 (offset
// geometric contact). In double: the answer is about numbers as they are stored.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "ringlet/base/vec3.h"

namespace ringlet {

inline constexpr int kCrossingNodes = 4;         // intervals of a step, each looked at by itself
inline constexpr double kCrossingRound = 1e-12;  // of volumes, as a share of the product of three lengths
inline constexpr double kEdgesTouch = 1e-9;  // [m]: edges that start nearer have sides by their volume's sign
inline constexpr double kPartingStep = 2e-6;  // [m] a step

/// An edge at a time: its two ends [m].
using EdgeEnds = std::array<Vec3d, 2>;

/// An edge at the step's start and end.
struct EdgeWay {
  EdgeEnds from, to;

  EdgeEnds at(double t) const { return {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])}; }
};

/// Where two edges are nearest: shares of their lengths, the direction from q to p, and how far.
struct NearestOfEdges {
  double onP = 0, onQ = 0;
  Vec3d normal{};
  double gap = 0;
};

/// Ericson 2005, section 5.1.9.
inline NearestOfEdges nearestOfEdges(const EdgeEnds& p, const EdgeEnds& q) {
  const Vec3d a = p[1] - p[0], c = q[1] - q[0], r = p[0] - q[0];
  const double aa = dot(a, a), cc = dot(c, c), ac = dot(a, c), ar = dot(a, r), cr = dot(c, r);
  const auto clamped = [](double x) { return std::clamp(x, 0.0, 1.0); };
  NearestOfEdges nearest;
  const double determinant = aa * cc - ac * ac;
  if (determinant > 1e-10 * aa * cc) nearest.onP = clamped((ac * cr - ar * cc) / determinant);
  nearest.onQ = cc > 0 ? (ac * nearest.onP + cr) / cc : 0;
  if (nearest.onQ < 0 || nearest.onQ > 1) {
    nearest.onQ = clamped(nearest.onQ);
    nearest.onP = aa > 0 ? clamped((ac * nearest.onQ - ar) / aa) : 0;
  }
  const Vec3d apart = r + nearest.onP * a - nearest.onQ * c;
  nearest.gap = length(apart);
  // Edges that touch: the side that the volume's sign 0 stands for.
  nearest.normal =
      nearest.gap > 0 ? apart / nearest.gap : normalizedOr(cross(a, c), normalizedOr(r, {1, 0, 0}));
  return nearest;
}

/// How far p is beyond q along n, at least: negative where planes across n do not part them.
inline double partedAlong(Vec3d n, const EdgeEnds& p, const EdgeEnds& q) {
  return std::min(dot(n, p[0]), dot(n, p[1])) - std::max(dot(n, q[0]), dot(n, q[1]));
}

namespace crossing {

// Twice the middle coefficient.
inline double partedBetween(Vec3d n0, Vec3d n1, const EdgeEnds& p0, const EdgeEnds& p1, const EdgeEnds& q0,
                            const EdgeEnds& q1) {
  const auto height = [&](const EdgeEnds& e0, const EdgeEnds& e1, std::size_t i) {
    return dot(n0, e1[i]) + dot(n1, e0[i]);
  };
  return std::min(height(p0, p1, 0), height(p0, p1, 1)) - std::max(height(q0, q1, 0), height(q0, q1, 1));
}

// The three vectors of a volume at a time.
struct Volume {
  Vec3d a, b, c;
  Volume(const EdgeEnds& p, const EdgeEnds& q) : a(p[1] - p[0]), b(q[0] - p[0]), c(q[1] - q[0]) {}
};

inline double mixed(Vec3d a, Vec3d b, Vec3d c) { return dot(cross(a, b), c); }

// Whether the four coefficients have one sign, from the start s to the end e of an interval.
inline bool keepsVolume(const Volume& s, const Volume& e) {
  const double first = mixed(s.a, s.b, s.c), last = mixed(e.a, e.b, e.c);
  const double second = mixed(e.a, s.b, s.c) + mixed(s.a, e.b, s.c) + mixed(s.a, s.b, e.c);
  const double third = mixed(e.a, e.b, s.c) + mixed(e.a, s.b, e.c) + mixed(s.a, e.b, e.c);
  const double size = std::max(length(s.a), length(e.a)) * std::max(length(s.b), length(e.b)) *
                      std::max(length(s.c), length(e.c)) * kCrossingRound;
  const double least = std::min({first, second / 3, third / 3, last});
  const double most = std::max({first, second / 3, third / 3, last});
  return least > size || most < -size;
}

}  // namespace crossing

/// What a pair asks of the step: to end no nearer than `aim`, and by no means nearer than `least` [m].
struct PairDemand {
  double aim = 0, least = 0;
};

/// Of a pair that begins so far apart [m]: the aim is `gap`, or what it had; what is very near parts slowly.
inline PairDemand demandOf(double apart, double gap, double leastGap) {
  const double parting = std::min(2 * apart + kPartingStep, gap / 2);
  return {std::min(gap, std::max(apart, parting)), std::min(leastGap, apart / 2)};
}

/// Whether the pair is known not to cross; and where it has to be pushed apart, in p's direction, by how much
/// at the step's end.
struct PairVerdict {
  bool isSafe = false;
  NearestOfEdges at;
  double shortfall = 0;
};

/// Distance at the step's end, along the normal, of what was nearest.
inline double partedAtEnd(const NearestOfEdges& at, const EdgeWay& p, const EdgeWay& q) {
  const Vec3d onP = p.to[0] + at.onP * (p.to[1] - p.to[0]);
  const Vec3d onQ = q.to[0] + at.onQ * (q.to[1] - q.to[0]);
  return dot(at.normal, onP - onQ);
}

/// From a time at which the normal's planes part them: they do until the end, or the nearest points have to
/// be pushed, or else the two ends that are furthest beyond.
inline PairVerdict judgeFrom(NearestOfEdges at, const EdgeWay& p, const EdgeWay& q,
                             const PairDemand& demand) {
  const double parted = partedAlong(at.normal, p.to, q.to);
  if (parted >= demand.aim && partedAlong(at.normal, p.from, q.from) > 0) return {true, at, 0};
  const double nearest = demand.aim - partedAtEnd(at, p, q);
  if (nearest > 0) return {false, at, nearest};
  at.onP = dot(at.normal, p.to[1] - p.to[0]) < 0 ? 1 : 0;
  at.onQ = dot(at.normal, q.to[1] - q.to[0]) > 0 ? 1 : 0;
  return {false, at, std::max(demand.aim - parted, 0.0)};
}

inline PairVerdict judgePair(const EdgeWay& p, const EdgeWay& q, const PairDemand& demand) {
  NearestOfEdges near = nearestOfEdges(p.from, q.from);
  const bool startsParted = partedAlong(near.normal, p.from, q.from) > 0 || near.gap <= kEdgesTouch;
  if (startsParted && partedAlong(near.normal, p.to, q.to) >= demand.aim) return {true, near, 0};
  EdgeEnds p0 = p.from, q0 = q.from;
  for (int k = 1; k <= kCrossingNodes; ++k) {
    const bool isLast = k == kCrossingNodes;
    const double t = double{1} * k / kCrossingNodes;
    const EdgeEnds p1 = isLast ? p.to : p.at(t), q1 = isLast ? q.to : q.at(t);
    const NearestOfEdges next = nearestOfEdges(p1, q1);
    const bool isParted = (k == 1 ? startsParted : partedAlong(near.normal, p0, q0) > 0) &&
                          crossing::partedBetween(near.normal, next.normal, p0, p1, q0, q1) > 0 &&
                          partedAlong(next.normal, p1, q1) > 0;
    const bool isSafe =
        (isParted || crossing::keepsVolume({p0, q0}, {p1, q1})) && (!isLast || next.gap >= demand.least);
    if (!isSafe) return judgeFrom(near, p, q, demand);
    near = next, p0 = p1, q0 = q1;
  }
  return {true, near, std::max(demand.aim - near.gap, 0.0)};
}

}  // namespace ringlet
