// What bodies do to a strand in a step: find what would go into one, hold it in the velocity solve, rub, and
// keep particles and edges out of where they have moved to. Mirrors shaders/bodies/*.glsl.
#pragma once

#include <span>
#include <vector>

#include "reference/fields.h"
#include "reference/kernels/bending_field.h"
#include "reference/rest_strand.h"
#include "ringlet/scene/body.h"

namespace ringlet::reference {

/// A body in the step from n to n + 1; places relative to the head's origin, along world axes.
template <class Real>
struct BodyStep {
  const Body* body = nullptr;
  Rotation<Real> rotationNow, rotationNext;
  Vector3<Real> positionNow, positionNext;  // [m]
  Vector3<Real> velocity;  // of its origin, relative to the head's translation in this step [m/s]
  Rotation<Real> turn;     // from rotationNow to rotationNext; from double, where the two would lose digits
  Real seconds = 0;
  BodyShapeAt<Real> shapeNow, shapeNext;
  Real bending =
      0;  // share of the way from shapeNow's field to the next that the surface moves on in the step

  std::span<const ClothList<Real>> lists{};  // of cloth: one a particle of the strand

  /// What an edge between two particles, or a single one, knows of the body.
  BodyStep at(std::size_t i, std::size_t j) const {
    BodyStep known = *this;
    if (lists.empty()) return known;
    known.shapeNow.lists = known.shapeNext.lists = {&lists[i], &lists[j]};
    known.shapeNext.later = shapeNext.field == shapeNow.field ? Real(0) : Real(1);
    return known;
  }
  BodyStep at(std::size_t i) const { return at(i, i); }

  Vector3<Real> atStart(const Vector3<Real>& p) const {
    return rotationNow.conjugate() * Vector3<Real>(p - positionNow);
  }
  Vector3<Real> atEnd(const Vector3<Real>& p) const {
    return rotationNext.conjugate() * Vector3<Real>(p - positionNext);
  }
  Vector3<Real> fromEnd(const Vector3<Real>& y) const { return rotationNext * y + positionNext; }
  Vector3<Real> outward(const Vector3<Real>& normal) const { return rotationNext * normal; }
  /// How far the surface near y moves in the step, seen from what carries the body [m].
  Vector3<Real> bent(const Vector3<Real>& y) const {
    if (!shapeNow.field) return Vector3<Real>::Zero();
    return bending * shapeNow.wayNear(y);
  }
  /// A particle's way among cloth.
  ClothWay<Real> clothWay(const Vector3<Real>& y0, const Vector3<Real>& y1) const {
    return {y0, y1, shapeNow.share, bending};
  }
  /// The same for a path from y0 to y1: of the surface near its start, or else near its end.
  Vector3<Real> bentOnPath(const Vector3<Real>& y0, const Vector3<Real>& y1) const {
    if (!shapeNow.field) return Vector3<Real>::Zero();
    return bent(shapeNow.isNear(y0) ? y0 : y1);
  }
  /// Of the surface near a place that is at p when the step starts [m/s]; `way`: how far it moves in the
  /// step, seen from what carries the body [m].
  Vector3<Real> velocityAt(const Vector3<Real>& p) const { return velocityAt(p, bent(atStart(p))); }
  Vector3<Real> velocityAt(const Vector3<Real>& p, const Vector3<Real>& way) const {
    const Vector3<Real> arm = p - positionNow, q = turn.vec();
    const Vector3<Real> across = Real(2) * q.cross(arm);
    return velocity + (turn.w() * across + q.cross(across) + rotationNext * way) / seconds;
  }
};

/// Of each particle, if the body is cloth; else none. At the step's start.
template <class Real>
std::vector<ClothList<Real>> clothLists(const BodyStep<Real>& step, const Field<Real>& positions,
                                        const Field<Real>& velocities);

/// What all bodies together ask of a particle: weight v = momentum, added to its mass and right-hand side;
/// and the heaviest of what they ask, which rubs.
template <class Real>
struct BodyPush {
  Matrix3<double> weight = Matrix3<double>::Zero();    // [kg]
  Vector3<double> momentum = Vector3<double>::Zero();  // [kg m/s]
  Real heaviest = 0;                                   // [kg]
  Real target = 0;                                     // speed along the normal [m/s]
  Vector3<Real> normal = Vector3<Real>::Zero(), bodyVelocity = Vector3<Real>::Zero();
  Real friction = 0;
  Real rubbing = 0;  // friction's weight along the surface [kg]

  Real normalMomentum(const Vector3<Real>& v) const { return heaviest * (target - normal.dot(v)); }
  Vector3<Real> sliding(const Vector3<Real>& v) const {
    const Vector3<Real> relative = v - bodyVelocity;
    return relative - normal.dot(relative) * normal;
  }
  void add(Real w, const Vector3<Real>& n, Real speed, const Vector3<Real>& u, Real coefficient) {
    const Vector3<double>& direction = n.template cast<double>();
    weight += double(w) * direction * direction.transpose();
    momentum += double(w) * double(speed) * direction;
    if (w <= heaviest) return;
    heaviest = w, target = speed, normal = n, bodyVelocity = u, friction = coefficient;
  }
};

/// Of all particles, and of the edges of which not both ends touch, from where they are and the velocities
/// they would have without bodies. Whether there is any.
template <class Real>
bool findPushes(const RestStrand<Real>& rest, const std::vector<BodyStep<Real>>& bodies,
                FieldView<Real> positions, FieldView<Real> free, std::vector<BodyPush<Real>>& pushes);

/// Friction's weights, from what the pushes came to at the velocities solved without it.
template <class Real>
void addFriction(const RestStrand<Real>& rest, std::vector<BodyPush<Real>>& pushes,
                 FieldView<Real> velocities);

/// And what is left of it, at the velocities solved with it.
template <class Real>
void rub(const RestStrand<Real>& rest, const std::vector<BodyPush<Real>>& pushes, FieldView<Real> velocities);

/// After the move: particles first, then edges, which leave at kLeaveSpeed at most; of two edges the one that
/// moves a particle further. `starts`: positions at the step's start.
template <class Real>
void keepOut(const RestStrand<Real>& rest, const std::vector<BodyStep<Real>>& bodies,
             const Field<Real>& starts, FieldView<Real> positions, FieldView<Real> velocities);

}  // namespace ringlet::reference
