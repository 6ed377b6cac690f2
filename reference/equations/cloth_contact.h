// Where a particle meets cloth, triangles that move and have hair on both sides, and how it is kept off them
// (our choice; the paper has none). Mirrors shaders/equations/cloth_contact.glsl and
// shaders/shared/cloth_lists.glsl.
//
//   In the frame of what carries the cloth, over a step, the particle goes straight from y0 to y1 and each
//   corner of a triangle straight on by w. Let d be the particle's distance to the triangle and n the
//   direction to it from the triangle's nearest place q. All of the triangle is beyond the plane through q,
//   so
//
//          . y0            after a share t of the step the distance is at least
//        n |                  d + t (n . (y1 - y0) - max over corners of n . w)
//      ____|____
//     a    q    b          A particle that does not approach cannot come nearer; one that does is safe until
//                          that is the distance kept. So a way is followed in ever shorter parts to the place
//                          of contact, and along the cloth in few.
//
//   A particle knows only the triangles of its list: those that come nearest to the way on which it would go
//   if nothing but cloth changed its velocity, in the frame that moves on with the cloth at its start. All
//   others stay `reach` away from that way, so it may leave it by that much less the distance kept, and is
//   held there.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reference/equations/body_contact.h"
#include "reference/equations/triangle_distance.h"
#include "reference/fields.h"

namespace ringlet::reference {

inline constexpr double kClothReach = 0.02;  // [m]: cloth further away has no place near a particle
inline constexpr double kOnCloth = 1e-5;  // [m]: nearer to a triangle, its own normal counts, for that of the
                                          // way is all rounding
inline constexpr double kSlip = 1e-6;     // [m] in what is left of a step: what approaches by less slides
inline constexpr int kClothRounds = 8;    // slides along cloth in a step; then the particle is held
inline constexpr std::size_t kClothListed = 31;  // triangles that a particle knows, at most
inline constexpr double kOneSide = 0.5;          // square of the sum of two normals that are of one side
inline constexpr double kThrough = 1e-4;         // [m]: nearer, an edge between two sides goes through
inline constexpr double kClothSearch = 0.1;  // [m]: triangles further from a particle's way are in no list
inline constexpr int kOutTurns = 12;         // halvings of a way of which not all is known
inline constexpr double kListSlack =
    2e-3;  // of a way's length: how much too large lineTriangleDistance may be
inline constexpr double kListRound = 1e-5;  // [m]: the same, for positions are rounded

using ClothTriangle = std::array<std::uint32_t, 3>;

/// The triangles that a particle may meet in a step, and how far from its way it knows all of them.
template <class Real>
struct ClothList {
  Vector3<Real> from = Vector3<Real>::Zero();   // where the way starts [m]
  Vector3<Real> along = Vector3<Real>::Zero();  // the way, in the frame that moves on with the cloth [m]
  Vector3<Real> way =
      Vector3<Real>::Zero();          // of that frame, that of the nearest place, to the next time [m]
  Real share = 0;                     // of the way to the next time, at the step's start
  Real reach = 0;                     // [m]
  Real distance = Real(kClothReach);  // of the nearest place at the step's start, at most kClothReach [m]
  std::vector<ClothTriangle> triangles{};

  /// How far all triangles that are not listed are from a place, at least [m].
  Real reachFrom(const Vector3<Real>& y, Real at) const {
    return reach - segmentDistance<Real>(y - (at - share) * way, from, Vector3<Real>(from + along));
  }
};

/// Points of triangles at a time, and where they are at the next time that is known [m]; and what a particle,
/// or the two ends of an edge, know of the triangles.
template <class Real>
struct Cloth {
  std::span<const Vector3<Real>> points, next;
  std::array<const ClothList<Real>*, 2> lists{};
  Real later = 0;  // than those of the lists are these points, in ways to the next time

  /// The list that reaches furthest at a place.
  const ClothList<Real>& listAt(const Vector3<Real>& y, Real share) const {
    if (lists[0] == lists[1]) return *lists[0];
    return *lists[lists[1]->reachFrom(y, share + later) > lists[0]->reachFrom(y, share + later) ? 1 : 0];
  }
};

/// What is near a place.
template <class Real>
struct ClothPlace {
  bool found = false;
  Real distance = 0;                             // from the nearest place of a triangle [m]
  Vector3<Real> normal = Vector3<Real>::Zero();  // from there
  Vector3<Real> way = Vector3<Real>::Zero();     // how far that place moves to the next time [m]
};

namespace cloth {

// A triangle at a share of the way to the next time, seen from y.
template <class Real>
struct Seen {
  Real distance;
  Vector3<Real> normal;
  Vector3<Real> way;  // of its nearest place [m]
  Real fastest;       // of its corners along the normal [m]
  Real slope;         // by which ways along the normal differ from place to place [1]
};
template <class Real>
Seen<Real> seen(const Cloth<Real>& cloth, const std::array<std::uint32_t, 3>& triangle, Real share,
                const Vector3<Real>& y) {
  Vector3<Real> ways[3], corners[3];
  for (std::size_t k = 0; k < 3; ++k) {
    ways[k] = cloth.next[triangle[k]] - cloth.points[triangle[k]];
    corners[k] = cloth.points[triangle[k]] + share * ways[k];
  }
  const Vector3<Real> shares = nearestShares<Real>(y, corners[0], corners[1], corners[2]);
  const Vector3<Real> apart = y - (shares[0] * corners[0] + shares[1] * corners[1] + shares[2] * corners[2]);
  const Vector3<Real> ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const Vector3<Real> own = directionOr<Real>(Vector3<Real>(ab.cross(ac)), Vector3<Real>::UnitY());
  const Real distance = apart.norm();
  const Vector3<Real> n = distance > Real(kOnCloth)  ? Vector3<Real>(apart / distance)
                          : apart.dot(own) < Real(0) ? Vector3<Real>(-own)
                                                     : own;
  const Real ofA = n.dot(ways[0]), ofB = n.dot(ways[1]) - ofA, ofC = n.dot(ways[2]) - ofA;
  const Real bb = ab.squaredNorm(), cc = ac.squaredNorm(), bc = ab.dot(ac);
  const Real square = cc * ofB * ofB - 2 * bc * ofB * ofC + bb * ofC * ofC;
  return {distance, n, shares[0] * ways[0] + shares[1] * ways[1] + shares[2] * ways[2],
          ofA + std::max({Real(0), ofB, ofC}),
          std::sqrt(std::max(square, Real(0)) / std::max(bb * cc - bc * bc, Real(1e-30)))};
}

// When a particle that goes by `perStep` in a step may have come nearer by `gap`: the first t > 0 of
// gap = A t + B t^2 with A its approach to the nearest place, B how much faster places beside come, as far as
// it gets in t; never before all places came as fast as the fastest corner.
template <class Real>
Real untilNearer(const Seen<Real>& seen, const Vector3<Real>& perStep, Real shares, Real gap) {
  const Real parts = seen.normal.dot(perStep), approach = shares * seen.normal.dot(seen.way) - parts;
  const Real most = shares * seen.fastest - parts;
  if (most <= Real(0)) return std::numeric_limits<Real>::max();
  const Real faster = shares * seen.slope * (perStep - shares * seen.way).norm();
  const Real root = std::sqrt(approach * approach + 4 * faster * gap);
  const Real curved = approach > Real(0) ? 2 * gap / (approach + root)
                      : faster > Real(0) ? (root - approach) / (2 * faster)
                                         : std::numeric_limits<Real>::max();
  return std::max(curved, gap / most);
}

// For how many steps from now a particle stays as near to its list's way as it must: all of `left`, or the
// last time of some at which it does, for how far it is from the way has no largest value on its own straight
// way.
template <class Real>
Real untilOut(const ClothList<Real>& list, const Vector3<Real>& place, Real share,
              const Vector3<Real>& perStep, Real shares, Real left, Real kept) {
  const auto isKnown = [&](Real at) {
    return list.reachFrom(place + at * perStep, share + at * shares) >= kept;
  };
  if (isKnown(left)) return left;
  Real in = 0, out = left;
  for (int k = 0; k < kOutTurns; ++k) {
    const Real middle = (in + out) / 2;
    (isKnown(middle) ? in : out) = middle;
  }
  return in;
}

}  // namespace cloth

/// The nearest place of the listed triangles, at a share of the way to the next time. None is found beyond
/// kClothReach, nor where a triangle that is not listed may be nearer.
template <class Real>
ClothPlace<Real> nearestOfCloth(const Cloth<Real>& cloth, Real share, const Vector3<Real>& y) {
  const ClothList<Real>& list = cloth.listAt(y, share);
  ClothPlace<Real> nearest{
      .distance = std::clamp(list.reachFrom(y, share + cloth.later), Real(0), Real(kClothReach))};
  for (const ClothTriangle& triangle : list.triangles) {
    const cloth::Seen<Real> seen = cloth::seen(cloth, triangle, share, y);
    if (seen.distance >= nearest.distance) continue;
    nearest = {true, seen.distance, seen.normal, seen.way};
  }
  return nearest;
}

/// A particle's way in a step, in the frame of what carries the cloth: from y0, at the share `begin` of the
/// step, to y1 at its end. `share`, `shares`: the way to the next time that the cloth is on at the step's
/// start, and goes on by in the step.
template <class Real>
struct ClothWay {
  Vector3<Real> y0, y1;
  Real share, shares;
  Real begin = 0;
};

/// The list of a particle of which the way would be that: at most `most` triangles.
template <class Real>
ClothList<Real> clothList(const Cloth<Real>& cloth, std::span<const ClothTriangle> triangles,
                          const ClothWay<Real>& way, std::size_t most) {
  ClothList<Real> list{.from = way.y0, .share = way.share};
  const Vector3<Real> whole = way.y1 - way.y0;
  Real longest = 0;
  for (std::size_t i = 0; i < cloth.points.size(); ++i)
    longest = std::max(longest, (cloth.next[i] - cloth.points[i]).norm());
  // Cloth further away is not met on that way, nor within kClothReach of it.
  Real nearest =
      std::min(Real(kClothReach) + 2 * whole.norm() + 3 * way.shares * longest + 4 * Real(kListRound),
               Real(kClothSearch));
  for (const ClothTriangle& triangle : triangles) {
    const cloth::Seen<Real> seen = cloth::seen(cloth, triangle, way.share, way.y0);
    if (seen.distance < nearest) nearest = seen.distance, list.way = seen.way;
  }
  list.along = whole - way.shares * list.way;
  const auto cornersAt = [&](const ClothTriangle& triangle) {
    std::array<Vector3<Real>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] =
          cloth.points[triangle[k]] + way.share * (cloth.next[triangle[k]] - cloth.points[triangle[k]]);
    return corners;
  };
  // Where the way goes through cloth, it will slide from there on.
  Real first = 2;
  Vector3<Real> beyond = Vector3<Real>::Zero();
  for (const ClothTriangle& triangle : triangles) {
    const auto [a, b, c] = cornersAt(triangle);
    const Real at = crossingShare<Real>(way.y0, Vector3<Real>(way.y0 + list.along), a, b, c);
    if (at >= first) continue;
    const Vector3<Real> n = (b - a).cross(c - a).normalized();
    first = at, beyond = (1 - at) * n.dot(list.along) * n;
  }
  list.along -= beyond;
  // From all that is not nearer than the nearest place; where that is enough, no list is needed.
  const Real slack = Real(kListSlack) * list.along.norm() + Real(kListRound);
  list.distance = std::min(nearest, Real(kClothReach));
  list.reach = nearest - list.along.norm() - slack - way.shares * (longest + list.way.norm());
  if (list.reach >= Real(kClothReach)) return list;
  const Real search = std::min(Real(kClothReach) + 2 * list.along.norm(), Real(kClothSearch));
  struct Bound {
    Real least;  // how near it comes, in the step, to the way
    ClothTriangle triangle;
  };
  std::vector<Bound> bounds;
  for (const ClothTriangle& triangle : triangles) {
    const auto [a, b, c] = cornersAt(triangle);
    const Real apart = lineTriangleDistance<Real>(way.y0, Vector3<Real>(way.y0 + list.along), a, b, c);
    Real faster = 0;
    for (const std::uint32_t p : triangle)
      faster = std::max(faster, way.shares * (cloth.next[p] - cloth.points[p] - list.way).norm());
    const Real least = apart - faster - slack;
    if (least < search) bounds.push_back({least, triangle});
  }
  std::ranges::stable_sort(bounds, {}, &Bound::least);
  if (bounds.size() > most) bounds.resize(most);
  list.reach = bounds.size() == most ? bounds.back().least : search;
  list.distance = std::min(list.distance, std::max(list.reach, Real(0)));
  for (const Bound& bound : bounds) list.triangles.push_back(bound.triangle);
  return list;
}

/// Where it comes as near as `kept` to the cloth, still approaching it.
template <class Real>
struct ClothTouch {
  bool found = false;
  Real at = 0;                                  // share of the step
  Surface<Real> surface{};                      // distance: beyond what is kept [m]
  Vector3<Real> place = Vector3<Real>::Zero();  // of the particle [m]
  Vector3<Real> way = Vector3<Real>::Zero();    // of the cloth there, in the step [m]
};
template <class Real>
ClothTouch<Real> traceCloth(const Cloth<Real>& cloth, const ClothWay<Real>& way, Real kept) {
  ClothTouch<Real> touch{.at = way.begin, .place = way.y0};
  const Real left = 1 - way.begin;
  const Vector3<Real> perStep = left > 0 ? Vector3<Real>((way.y1 - way.y0) / left) : Vector3<Real>::Zero();
  const ClothList<Real>& list = *cloth.lists[0];
  for (int turn = 0;; ++turn) {
    const Real share = way.share + touch.at * way.shares;
    touch.found = false;
    Real until = 1 - touch.at;
    for (const ClothTriangle& triangle : list.triangles) {
      const cloth::Seen<Real> seen = cloth::seen<Real>(cloth, triangle, share, touch.place);
      const Vector3<Real>& n = seen.normal;
      const Real gap = seen.distance - kept;
      const bool approaches = (way.shares * n.dot(seen.way) - n.dot(perStep)) * left > Real(kSlip);
      const bool touches =
          approaches ? gap <= Real(kTouchDistance) : touch.at <= Real(0) && gap < Real(-kTouchDistance);
      const Real slack = approaches ? gap : std::max(gap, Real(0)) + Real(kTouchDistance);
      const Real first = touches ? Real(0) : cloth::untilNearer<Real>(seen, perStep, way.shares, slack);
      if (touch.found ? first >= until : !touches && first >= until) continue;
      touch.found = true;
      until = first;
      touch.surface = {gap, n};
      touch.way = way.shares * seen.way;
    }
    const Real out = cloth::untilOut<Real>(list, touch.place, share, perStep, way.shares, until, kept);
    if (out < until) {  // where triangles are not known: held there
      touch.at += out;
      touch.place = way.y0 + (touch.at - way.begin) * perStep;
      touch.found = true;
      touch.way = way.shares * list.way;
      touch.surface = {0, directionOr<Real>(Vector3<Real>(touch.way - perStep), Vector3<Real>::UnitY())};
      break;
    }
    if (!touch.found || until <= Real(0) || turn == kTraceTurns) break;
    touch.at += until;
    touch.place = way.y0 + (touch.at - way.begin) * perStep;
  }
  return touch;
}

/// Where a particle that began the step at y0 and has moved to y1 is put, so that it is on the side of the
/// cloth where it was, and no nearer than `kept`; one that began nearer, no nearer than then.
template <class Real>
struct KeptOff {
  bool moved = false;
  Vector3<Real> place, normal;
};
template <class Real>
KeptOff<Real> keptOff(const Cloth<Real>& cloth, ClothWay<Real> way, Real kept) {
  const Vector3<Real> came = way.y1;
  Vector3<Real> normal = Vector3<Real>::Zero();
  kept = std::min(kept, cloth.lists[0]->distance);
  for (int round = 0; round <= kClothRounds; ++round) {
    const ClothTouch<Real> touch = traceCloth<Real>(cloth, way, kept);
    if (!touch.found) break;
    const Vector3<Real> held = touch.place + (1 - touch.at) * touch.way;
    normal = touch.surface.normal;
    way.y0 = touch.place, way.begin = touch.at;
    // Along the plane of what it touches.
    const Real gap = touch.surface.distance;
    const Real beyond =
        normal.dot(way.y1 - held) + (gap > Real(kTouchDistance) ? gap : std::min(gap, Real(0)));
    way.y1 -= std::min(beyond, Real(0)) * normal;
    if (round == kClothRounds) way.y1 = held;
  }
  return {(way.y1 - came).norm() > Real(0), way.y1, normal};
}

}  // namespace ringlet::reference
