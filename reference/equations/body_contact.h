// Where a particle or an edge meets a body within a step, and what velocities that leaves it (our choice; the
// paper has no bodies). Mirrors shaders/equations/body_contact.glsl.
//
//      y0 .                      In the body's frame, where the body rests, a particle goes from y0 to y1.
//      The
//          \   n                 way is followed by the distance to the surface, which cannot be overshot
//      _____\__|____             ("sphere tracing", Hart 1996), to the first place h that is near enough to
//     /      h  \                touch. From there on it may go along the surface's plane, not into it:
//    |           . y1                n . (v - u) >= (n . (h - y0) - distance(h)) / T
#pragma once

#include <algorithm>

#include "reference/equations/body_distance.h"

namespace ringlet::reference {

// Shape: whatever bodyDistance() takes, a Body or the BodyShapeAt of a time (kernels/bending_field.h).

inline constexpr double kTouchDistance = 1e-5;  // [m]: nearer counts as touching; a tenth of a hair
inline constexpr double kOutside = 1e-4;    // [m]: no deeper counts as outside, and is put outside at once
inline constexpr int kTraceTurns = 16;      // looks along a way; grazing ones give up and count as touching
inline constexpr double kLeaveSpeed = 0.2;  // [m/s]: what begins inside leaves no faster
// What is deeper inside [m] leaves across its strand, which else would be stretched or crushed, held by this
// share of the weight.
inline constexpr double kDeep = 1e-3, kDeepShare = 0.04;
// [m]: what began no deeper goes no deeper. Beyond, where the way out may be on any side, it may by this
// multiple of how far beyond it began: without a jump, by which rounding would show.
inline constexpr double kHeldDepth = 2e-3, kGivenDepth = 20;
inline constexpr double kBodyWeight = 200;    // of what holds a particle at its allowed speed, in its masses
inline constexpr double kFullDeficit = 0.01;  // [m/s]: of a deficit that gives half of that weight: without a
                                              // ramp, rounding would decide whether what just rests is held
// Of a strand whose root is in a body, so many particles may be under its skin, root included: these are not
// pushed.
inline constexpr std::size_t kMostBuried = 4;
// After the move, out of bodies and within the stretch limit, by turns, until edges are short enough.
inline constexpr int kKeepOutRounds = 8;
inline constexpr double kLeastShare = 0.2;  // an edge touched nearer its other end does not move this one

/// The least distance at a step's end [m] of a particle that had this one at its start: 0 of what was
/// outside.
template <class Real>
Real leastDistance(Real before) {
  return std::min(before + Real(kOutside), Real(0)) +
         Real(kGivenDepth) * std::min(before + Real(kHeldDepth), Real(0));
}

/// Where a way first touches.
template <class Real>
struct Touch {
  bool found = false;
  Surface<Real> surface;                        // at h
  Vector3<Real> place = Vector3<Real>::Zero();  // h, in the body's frame [m]
  Vector3<Real> from = Vector3<Real>::Zero();   // what was there at the step's start [m]
  Real along = 0;                               // edges: share of the way from particle i to i + 1
};

template <class Real, class Shape>
Touch<Real> traceParticle(const Shape& body, const Vector3<Real>& y0, const Vector3<Real>& y1) {
  const Vector3<Real> way = y1 - y0;
  const Real length = way.norm();
  Touch<Real> touch{.surface = bodyDistance<Real>(body, y0), .place = y0, .from = y0};
  Real gone = 0;
  for (int turn = 0; turn < kTraceTurns && touch.surface.distance > Real(kTouchDistance); ++turn) {
    gone += touch.surface.distance;
    if (gone >= length) return touch;
    touch.place = y0 + gone / length * way;
    touch.surface = bodyDistance<Real>(body, touch.place);
  }
  touch.found = true;
  return touch;
}

/// Where the cubic with these values and slopes at 0 and 1 is least, for a first slope below 0 and a second
/// above.
template <class Real>
Real leastOfCubic(Real value0, Real slope0, Real value1, Real slope1) {
  const Real rise = value1 - value0, cube = slope0 + slope1 - 2 * rise;
  const Real square = 3 * rise - 2 * slope0 - slope1;
  const Real root = std::sqrt(std::max(Real(0), square * square - 3 * cube * slope0));
  return std::clamp(-slope0 / std::max(square + root, Real(1e-20)), Real(0), Real(1));
}

/// The place of an edge from a to b that is deepest, by distances and slopes at its ends, and again between
/// the place found and one of them. Where that is an end, it is its particle's, and `isWithin` false.
template <class Real>
struct EdgeSurface {
  bool isWithin = false;
  Real along = 0;
  Surface<Real> surface;
  Vector3<Real> place = Vector3<Real>::Zero();
  Real nearest = 0;  // distance of the nearest of ends and place [m]
};
/// At a place of an edge; side: the sum of the normals at its ends. Only cloth has two sides
/// (kernels/bending_field.h).
template <class Real, class Shape>
Surface<Real> distanceBetween(const Shape& body, const Vector3<Real>& y, const Vector3<Real>&) {
  return bodyDistance<Real>(body, y);
}
/// Whether the edge goes from one side to the other there, so that there is no way out.
template <class Real, class Shape>
bool goesThrough(const Shape&, const Surface<Real>&, const Vector3<Real>&) {
  return false;
}
/// An edge with an end inside leaves with its particle: `isWithin` is false for it too.
template <class Real, class Shape>
EdgeSurface<Real> edgeDistance(const Shape& body, const Vector3<Real>& a, const Vector3<Real>& b) {
  const Vector3<Real> edge = b - a;
  const Surface<Real> atA = bodyDistance<Real>(body, a), atB = bodyDistance<Real>(body, b);
  const Vector3<Real> side = atA.normal + atB.normal;
  const Real slopeA = atA.normal.dot(edge), slopeB = atB.normal.dot(edge);
  EdgeSurface<Real> result;
  result.isWithin = slopeA < Real(0) && slopeB > Real(0) && atA.distance >= Real(-kOutside) &&
                    atB.distance >= Real(-kOutside);
  if (result.isWithin) {
    // Where its two slopes meet, which far from a thin body is it; then as a cubic, which near a round one
    // is.
    const Real first =
        std::clamp((atB.distance - slopeB - atA.distance) / (slopeA - slopeB), Real(0), Real(1));
    const Surface<Real> there = distanceBetween<Real>(body, Vector3<Real>(a + first * edge), side);
    const Real slope = there.normal.dot(edge);
    if (slope > Real(0)) {
      result.along = first * leastOfCubic(atA.distance, first * slopeA, there.distance, first * slope);
    } else {
      const Real rest = 1 - first;
      result.along = first + rest * leastOfCubic(there.distance, rest * slope, atB.distance, rest * slopeB);
    }
  } else {
    result.along = atA.distance < atB.distance ? Real(0) : Real(1);
  }
  result.place = a + result.along * edge;
  result.surface = result.isWithin ? distanceBetween<Real>(body, result.place, side)
                                   : bodyDistance<Real>(body, result.place);
  if (result.isWithin && goesThrough<Real>(body, result.surface, side)) result.isWithin = false;
  result.nearest = std::min({atA.distance, atB.distance, result.surface.distance});
  return result;
}

/// Both ends move straight, a0 to a1 and b0 to b1, until the edge touches between them, or one of them does.
template <class Real, class Shape>
Touch<Real> traceEdge(const Shape& body, const Vector3<Real>& a0, const Vector3<Real>& a1,
                      const Vector3<Real>& b0, const Vector3<Real>& b1) {
  const Real longest = std::max((a1 - a0).norm(), (b1 - b0).norm());
  EdgeSurface<Real> deepest = edgeDistance<Real>(body, a0, b0);
  Real gone = 0;
  for (int turn = 0; turn < kTraceTurns && deepest.nearest > Real(kTouchDistance); ++turn) {
    gone += deepest.nearest;
    if (gone >= longest) return {};
    const Real share = gone / longest;
    deepest = edgeDistance<Real>(body, a0 + share * (a1 - a0), b0 + share * (b1 - b0));
  }
  return {deepest.isWithin && deepest.surface.distance <= Real(kTouchDistance), deepest.surface,
          deepest.place, a0 + deepest.along * (b0 - a0), deepest.along};
}

/// How fast what touches must at least part from the body along n [m/s]; negative: how fast it may near it.
template <class Real>
Real leastParting(const Touch<Real>& touch, Real seconds) {
  const Real parting =
      (touch.surface.normal.dot(touch.place - touch.from) - touch.surface.distance) / seconds;
  return std::min(parting, Real(kLeaveSpeed));
}

/// The weight that holds a particle of mass m [kg] which falls short of its least speed by `deficit` [m/s].
template <class Real>
Real bodyWeight(Real mass, Real deficit) {
  return mass * Real(kBodyWeight) * deficit / (deficit + Real(kFullDeficit));
}

/// The way out n of a particle so deep that its strand, along t, counts: across the strand, unless that is
/// hardly out.
template <class Real>
Vector3<Real> wayOutOfDepth(const Vector3<Real>& n, const Vector3<Real>& t) {
  const Vector3<Real> across = n - t.dot(n) * t;
  return across.norm() > Real(0.05) ? Vector3<Real>(across.normalized()) : n;
}

/// Coulomb's friction takes at most `coefficient` times the normal momentum from what slides at u along the
/// surface. Nearly all of it as a weight in the solve that does so at the velocity found without: a strand
/// feels as a whole what holds one of its particles, which else would be torn from it.
template <class Real>
Real frictionWeight(const Vector3<Real>& sliding, Real normalMomentum, Real coefficient, Real mass) {
  const Real most = coefficient * std::max(normalMomentum, Real(0));
  return std::min(most / std::max(sliding.norm(), Real(1e-6)), mass * Real(kBodyWeight));
}

/// And what that left, from each particle by itself, so that what stops, stops: a body `weight` slower than
/// needed takes w / (m + w) of a velocity, and a momentum of m w / (m + w) of it; where w is m or more, the
/// rest of what is allowed, w^2 / (m + w), is enough for the rest of the velocity.
template <class Real>
Vector3<Real> rubbed(const Vector3<Real>& velocity, const Vector3<Real>& sliding, Real weight,
                     Real normalMomentum, Real coefficient, Real mass) {
  const Real speed = sliding.norm();
  const Real left = coefficient * std::max(normalMomentum, Real(0)) - weight * speed;
  if (!(speed > Real(0)) || !(left > Real(0))) return velocity;
  return velocity - std::min(Real(1), left / mass / speed) * sliding;
}

/// What velocity into the body [m/s], relative to it and along n, hair loses that is put back by `shift` [m]:
/// as much as the shift is worth, and never so much that it bounces.
template <class Real>
Vector3<Real> slowedInward(const Vector3<Real>& relative, const Vector3<Real>& normal, Real shift,
                           Real seconds) {
  const Real inward = std::max(Real(0), -normal.dot(relative));
  return std::min(inward, std::max(Real(0), shift) / seconds) * normal;
}

}  // namespace ringlet::reference
