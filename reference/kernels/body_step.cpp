// Implements kernels/body_step.h.
#include "reference/kernels/body_step.h"

#include <algorithm>

#include "reference/equations/body_contact.h"

namespace ringlet::reference {
namespace {

// Along the strand at a free particle: between the directions of its two edges, or zero.
template <class Real>
Vector3<Real> strandDirection(FieldView<Real> positions, std::size_t i) {
  const Vector3<Real> zero = Vector3<Real>::Zero();
  Vector3<Real> sum = i > 0 ? directionOr<Real>(positions[i] - positions[i - 1], zero) : zero;
  if (i + 1 < positions.size()) sum += directionOr<Real>(positions[i + 1] - positions[i], zero);
  return directionOr<Real>(sum, zero);
}

// How many of its first particles are under the body's skin. What falls has no root that may be there.
template <class Real>
std::size_t buriedCount(const RestStrand<Real>& rest, const BodyStep<Real>& step, FieldView<Real> positions) {
  std::size_t count = 0;
  if (rest.falls()) return 0;
  while (count < std::min(kMostBuried, positions.size()) &&
         bodyDistance<Real>(step.at(count).shapeNow, step.atStart(positions[count])).distance <
             Real(-kOutside))
    ++count;
  return count;
}

/// Where a particle that goes from p to q meets the body, and the body's velocity there.
template <class Real>
struct Met {
  Touch<Real> touch;
  Vector3<Real> velocity;  // [m/s]
};
template <class Real>
Met<Real> meet(const BodyStep<Real>& step, const Vector3<Real>& p, const Vector3<Real>& q) {
  const Vector3<Real> y0 = step.atStart(p), y1 = step.atEnd(q);
  if (!step.shapeNow.isCloth())
    return {traceParticle<Real>(step.shapeNow, y0, Vector3<Real>(y1 - step.bentOnPath(y0, y1))),
            step.velocityAt(p)};
  const ClothTouch<Real> touch = traceCloth<Real>(step.shapeNow.asCloth(), step.clothWay(y0, y1),
                                                  static_cast<Real>(step.body->thickness));
  return {{touch.found, touch.surface, touch.place, Vector3<Real>(y0 + touch.at * touch.way)},
          step.velocityAt(p, touch.way)};
}

/// A particle that began the step at y0 and has moved to y1: out of the body, the way it came; or if it began
/// inside, up to leastDistance().
template <class Real>
struct KeptOut {
  bool moved = false;
  Vector3<Real> place, normal;
};
template <class Real>
KeptOut<Real> keptOut(const BodyStep<Real>& step, const Vector3<Real>& y0, Vector3<Real> y1) {
  if (step.shapeNow.isCloth()) {
    const KeptOff<Real> kept = keptOff<Real>(step.shapeNow.asCloth(), step.clothWay(y0, y1),
                                             static_cast<Real>(step.body->thickness));
    return {kept.moved, kept.place, kept.normal};
  }
  const Real before = bodyDistance<Real>(step.shapeNow, y0).distance;
  const Real least = leastDistance(before);
  const Touch<Real> touch =
      traceParticle<Real>(step.shapeNow, y0, Vector3<Real>(y1 - step.bentOnPath(y0, y1)));
  // The surface by which it ends may move otherwise than the one that it was traced to.
  const bool isWithin = step.shapeNext.field && bodyDistance<Real>(step.shapeNext, y1).distance < least;
  if (!touch.found && !isWithin) return {};
  const Vector3<Real> held = touch.place + step.bent(touch.place);
  const Vector3<Real> came = y1;
  // Onto the plane where it touched, then out of what curves beyond it; else back to the place itself.
  const Real beyond = touch.surface.normal.dot(y1 - held) + touch.surface.distance - least;
  Vector3<Real> normal = touch.surface.normal;
  if (touch.found) y1 -= std::min(beyond, Real(0)) * normal;
  for (int turn = 0; turn < 3; ++turn) {
    const Surface<Real> surface = bodyDistance<Real>(step.shapeNext, y1);
    if (surface.distance >= least) continue;
    y1 -= (surface.distance - least) * surface.normal;
    normal = surface.normal;
  }
  if (bodyDistance<Real>(step.shapeNext, y1).distance - least < Real(-kOutside)) {
    y1 = held;
    // Another surface has closed in on it.
    const Surface<Real> there = bodyDistance<Real>(step.shapeNext, held);
    if (step.shapeNext.field) y1 -= std::min(there.distance - least, Real(0)) * there.normal;
  }
  return {(y1 - came).norm() > Real(0), y1, normal};
}

}  // namespace

template <class Real>
std::vector<ClothList<Real>> clothLists(const BodyStep<Real>& step, const Field<Real>& positions,
                                        const Field<Real>& velocities) {
  std::vector<ClothList<Real>> lists;
  if (!step.shapeNow.isCloth()) return lists;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vector3<Real> end = positions[i] + step.seconds * velocities[i];
    lists.push_back(clothList<Real>(step.shapeNow.asCloth(), step.shapeNow.field->cloth->surface.triangles,
                                    step.clothWay(step.atStart(positions[i]), step.atEnd(end)),
                                    kClothListed));
  }
  return lists;
}

template <class Real>
bool findPushes(const RestStrand<Real>& rest, const std::vector<BodyStep<Real>>& bodies,
                FieldView<Real> positions, FieldView<Real> free, std::vector<BodyPush<Real>>& pushes) {
  pushes.assign(rest.particleCount(), {});
  bool any = false;
  std::vector<bool> touches;  // particles that this body pushes or would
  for (const BodyStep<Real>& body : bodies) {
    touches.assign(rest.particleCount(), false);
    const Real T = body.seconds, friction = static_cast<Real>(body.body->friction);
    for (std::size_t i = std::max(rest.pinnedCount(), buriedCount(rest, body, positions));
         i < rest.particleCount(); ++i) {
      const BodyStep<Real> step = body.at(i);
      const Met<Real> met = meet(step, positions[i], Vector3<Real>(positions[i] + T * free[i]));
      const Touch<Real>& touch = met.touch;
      if (!touch.found) continue;
      touches[i] = true;
      const bool isDeep = touch.surface.distance < Real(-kDeep);
      Vector3<Real> n = step.outward(touch.surface.normal);
      if (isDeep) n = wayOutOfDepth(n, strandDirection<Real>(positions, i));
      const Vector3<Real>& u = met.velocity;
      const Real target = n.dot(u) + leastParting(touch, T), deficit = target - n.dot(free[i]);
      if (!(deficit > Real(0))) continue;
      const Real weight = (isDeep ? Real(kDeepShare) : Real(1)) * bodyWeight(rest.masses[i], deficit);
      pushes[i].add(weight, n, target, u, friction);
      any = true;
    }
    for (std::size_t i = 0; i + 1 < rest.particleCount(); ++i) {
      // Its ends are asked for what it needs; asked again through the edge, they would be thrown off.
      if (touches[i] && touches[i + 1]) continue;
      const BodyStep<Real> step = body.at(i, i + 1);
      const auto start = [&](std::size_t k) { return step.atStart(positions[k]); };
      const auto end = [&](std::size_t k) -> Vector3<Real> {
        const Vector3<Real> y1 = step.atEnd(positions[k] + T * free[k]);
        return y1 - step.bentOnPath(start(k), y1);
      };
      const Touch<Real> touch = traceEdge<Real>(step.shapeNow, start(i), end(i), start(i + 1), end(i + 1));
      if (!touch.found) continue;
      const Vector3<Real> n = step.outward(touch.surface.normal);
      const Real shares[2] = {1 - touch.along, touch.along};
      const Vector3<Real> place = shares[0] * positions[i] + shares[1] * positions[i + 1];
      const Vector3<Real> u = step.velocityAt(place);
      const Real now = n.dot(shares[0] * free[i] + shares[1] * free[i + 1]);
      const Real deficit = n.dot(u) + leastParting(touch, T) - now;
      if (!(deficit > Real(0))) continue;
      const Real sum = shares[0] * shares[0] + shares[1] * shares[1];
      for (std::size_t side = 0; side < 2; ++side) {
        const std::size_t k = i + side;
        if (k < rest.pinnedCount() || shares[side] < Real(kLeastShare)) continue;
        const Real target = n.dot(free[k]) + shares[side] / sum * deficit;
        pushes[k].add(shares[side] * bodyWeight(rest.masses[k], deficit), n, target, u, friction);
        any = true;
      }
    }
  }
  return any;
}

template <class Real>
void addFriction(const RestStrand<Real>& rest, std::vector<BodyPush<Real>>& pushes,
                 FieldView<Real> velocities) {
  for (std::size_t i = rest.pinnedCount(); i < rest.particleCount(); ++i) {
    BodyPush<Real>& push = pushes[i];
    const Vector3<Real>& v = velocities[i];
    push.rubbing =
        frictionWeight<Real>(push.sliding(v), push.normalMomentum(v), push.friction, rest.masses[i]);
    const Vector3<double> n = push.normal.template cast<double>();
    const Matrix3<double> along = Matrix3<double>::Identity() - n * n.transpose();
    push.weight += double(push.rubbing) * along;
    push.momentum += double(push.rubbing) * along * push.bodyVelocity.template cast<double>();
  }
}

template <class Real>
void rub(const RestStrand<Real>& rest, const std::vector<BodyPush<Real>>& pushes,
         FieldView<Real> velocities) {
  for (std::size_t i = rest.pinnedCount(); i < rest.particleCount(); ++i) {
    const BodyPush<Real>& push = pushes[i];
    const Vector3<Real> v = velocities[i];
    velocities[i] =
        rubbed<Real>(v, push.sliding(v), push.rubbing, push.normalMomentum(v), push.friction, rest.masses[i]);
  }
}

template <class Real>
void keepOut(const RestStrand<Real>& rest, const std::vector<BodyStep<Real>>& bodies,
             const Field<Real>& starts, FieldView<Real> positions, FieldView<Real> velocities) {
  for (const BodyStep<Real>& body : bodies) {
    for (std::size_t i = rest.pinnedCount(); i < rest.particleCount(); ++i) {
      const BodyStep<Real> step = body.at(i);
      const KeptOut<Real> kept = keptOut(step, step.atStart(starts[i]), step.atEnd(positions[i]));
      if (!kept.moved) continue;
      const Vector3<Real> place = step.fromEnd(kept.place), n = step.outward(kept.normal);
      velocities[i] += slowedInward<Real>(velocities[i] - step.velocityAt(starts[i]), n,
                                          n.dot(place - positions[i]), step.seconds);
      positions[i] = place;
    }
  }
  Field<Real> shifts(rest.particleCount(), Vector3<Real>::Zero());
  Field<Real> changes = shifts;  // of velocities, by the same edge
  for (const BodyStep<Real>& body : bodies) {
    for (std::size_t i = 0; i + 1 < rest.particleCount(); ++i) {
      const BodyStep<Real> step = body.at(i, i + 1);
      const EdgeSurface<Real> deepest =
          edgeDistance<Real>(step.shapeNext, step.atEnd(positions[i]), step.atEnd(positions[i + 1]));
      if (!deepest.isWithin || deepest.surface.distance >= Real(0)) continue;
      const Vector3<Real> n = step.outward(deepest.surface.normal);
      const Real out = std::min(-deepest.surface.distance, Real(kLeaveSpeed) * step.seconds);
      const Real shares[2] = {1 - deepest.along, deepest.along};
      const Real sum = shares[0] * shares[0] + shares[1] * shares[1];
      const Vector3<Real> start = shares[0] * starts[i] + shares[1] * starts[i + 1];
      const Vector3<Real> velocity = shares[0] * velocities[i] + shares[1] * velocities[i + 1];
      const Vector3<Real> slowed =
          slowedInward<Real>(velocity - step.velocityAt(start), n, out, step.seconds);
      for (std::size_t side = 0; side < 2; ++side) {
        const std::size_t k = i + side;
        const Vector3<Real> shift = shares[side] / sum * out * n;
        if (k < rest.pinnedCount() || shift.norm() <= shifts[k].norm()) continue;
        shifts[k] = shift;
        changes[k] = shares[side] / sum * slowed;
      }
    }
  }
  for (std::size_t i = 0; i < rest.particleCount(); ++i) {
    positions[i] += shifts[i];
    velocities[i] += changes[i];
  }
}

#define RINGLET_INSTANTIATE(Real)                                                                            \
  template std::vector<ClothList<Real>> clothLists(const BodyStep<Real>& step, const Field<Real>& positions, \
                                                   const Field<Real>& velocities);                           \
  template bool findPushes(const RestStrand<Real>& rest, const std::vector<BodyStep<Real>>& bodies,          \
                           FieldView<Real> positions, FieldView<Real> free,                                  \
                           std::vector<BodyPush<Real>>& pushes);                                             \
  template void addFriction(const RestStrand<Real>& rest, std::vector<BodyPush<Real>>& pushes,               \
                            FieldView<Real> velocities);                                                     \
  template void rub(const RestStrand<Real>& rest, const std::vector<BodyPush<Real>>& pushes,                 \
                    FieldView<Real> velocities);                                                             \
  template void keepOut(const RestStrand<Real>& rest, const std::vector<BodyStep<Real>>& bodies,             \
                        const Field<Real>& starts, FieldView<Real> positions, FieldView<Real> velocities)
RINGLET_INSTANTIATE(float);
RINGLET_INSTANTIATE(double);
#undef RINGLET_INSTANTIATE

}  // namespace ringlet::reference
