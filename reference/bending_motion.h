// Bodies that bend, frame by frame: their points at the times at which fields are made, and which field
// counts at which step's end. Mirrors src/ringlet/solver/inputs/bending_bodies.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/kernels/bending_field.h"
#include "ringlet/scene/body.h"

namespace ringlet::reference {

template <class Real>
class BendingMotion {
 public:
  /// At the points of their BendingMesh.
  explicit BendingMotion(std::span<const Body> bodies);

  /// Makes the fields of a frame. start, ends: poses of all bodies at its start and at the ends of its steps,
  /// [step][body].
  void beginFrame(std::span<const BodyPose> start, std::span<const BodyPose> ends, BodyPoints points);
  /// Of a frame that is not stepped.
  void jump(std::span<const BodyPose> ends, BodyPoints points);

  /// Field and share of body b after step k of the frame; of 0 steps: at its start.
  BodyShapeAt<Real> shapeAt(std::size_t b, std::size_t k) const;
  /// Which share of the way from its field to the next a body moves on in step k.
  Real share(std::size_t k) const { return static_cast<Real>(at_[k + 1] - at_[k]); }
  /// How many fields the frame has beside the one at its start.
  std::size_t buildCount() const { return fields_.empty() ? 0 : fields_.size() - 1; }

 private:
  using Surfaces =
      std::vector<std::vector<Vec3d>>;  // points of each body that bends, in its carrier's frame [m]
  std::vector<Surfaces> samples(std::span<const BodyPose> start, std::span<const BodyPose> ends,
                                BodyPoints points) const;

  std::vector<Body> bodies_;
  std::vector<std::size_t> bending_;  // which of them bend
  Surfaces now_;
  std::vector<std::vector<BendingField<Real>>> fields_;  // [time][bending body]
  std::vector<double> at_;  // after 0 and more steps: the field, and as its fraction the share of the way on
};

}  // namespace ringlet::reference
