// Where a particle meets cloth, triangles that move and have hair on both sides, and how it is kept off them
// (our choice; the paper has none). No kernel has it yet: bodies of the solver are closed.
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
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "reference/equations/body_contact.h"
#include "reference/equations/triangle_distance.h"
#include "reference/fields.h"

namespace ringlet::reference {

inline constexpr double kClothReach = 0.02;  // [m]: cloth further away has no place near a particle
inline constexpr double kOnCloth = 1e-5;  // [m]: nearer to a triangle, its own normal counts, for that of the
                                          // way is all rounding
inline constexpr double kSlip = 1e-6;     // [m] in what is left of a step: what approaches by less slides
inline constexpr int kClothRounds = 8;    // slides along cloth in a step; then the particle is held

/// Triangles at a time, and where their points are at the next time that is known [m].
template <class Real>
struct Cloth {
  std::span<const std::array<std::uint32_t, 3>> triangles;
  std::span<const Vector3<Real>> points, next;
};

/// What is near a place.
template <class Real>
struct ClothPlace {
  bool found = false;
  Real distance = 0;                              // from the nearest place of a triangle [m]
  Vector3<Real> normal = Vector3<Real>::UnitY();  // from there
  Vector3<Real> way = Vector3<Real>::Zero();      // how far that place moves to the next time [m]
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

}  // namespace cloth

/// The nearest place of all triangles, at a share of the way to the next time; none is found beyond
/// kClothReach.
template <class Real>
ClothPlace<Real> nearestOfCloth(const Cloth<Real>& cloth, Real share, const Vector3<Real>& y) {
  ClothPlace<Real> nearest{.distance = Real(kClothReach)};
  for (const auto& triangle : cloth.triangles) {
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
  Real longest = 0;  // way of a point
  for (std::size_t i = 0; i < cloth.points.size(); ++i)
    longest = std::max(longest, way.shares * (cloth.next[i] - cloth.points[i]).norm());
  for (int turn = 0;; ++turn) {
    // How much further nothing is touched; cloth beyond the reach is not met before that.
    const Real room = (Real(kClothReach) - kept) / std::max(perStep.norm() + longest, Real(1e-20));
    const bool isCut = room < 1 - touch.at;
    Real until = isCut ? room : 1 - touch.at;
    touch.found = false;
    for (const auto& triangle : cloth.triangles) {
      const cloth::Seen<Real> seen =
          cloth::seen<Real>(cloth, triangle, way.share + touch.at * way.shares, touch.place);
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
    if (touch.found ? until <= Real(0) || turn == kTraceTurns : !isCut) break;
    if (turn == kTraceTurns) {  // too fast to be followed: held
      touch.found = true;
      touch.surface = {0, directionOr<Real>(-perStep, Vector3<Real>::UnitY())};
      touch.way = Vector3<Real>::Zero();
      break;
    }
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
  kept = std::min(kept, nearestOfCloth<Real>(cloth, way.share, way.y0).distance);
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
