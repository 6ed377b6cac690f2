// BendingBodies: the points of bodies that bend, frame by frame, and the fields that kernels make of them
// (mesh_fields.h), for what moves hair and for hairs that follow. A frame has a field for each of several
// times, at ends of steps: as many as keep each point's way from one to the next within about a cell. Between
// them the surface is carried (bending_buffers.glsl).
//
//   step      0     1     2     3     4     5     6
//   field     0 .......... 1 .......... 2 .......... 3      three builds of a frame of six steps
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "layout/bodies.h"
#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/scene/body.h"
#include "ringlet/solver/inputs/frame_input.h"
#include "ringlet/solver/inputs/mesh_fields.h"

namespace ringlet {

class BendingBodies {
 public:
  /// Those of `bodies` that bend, at the points of their BendingMesh. `copies`: fields of a frame, at most,
  /// one more than its steps.
  BendingBodies(std::span<const Body> bodies, std::uint32_t copies);

  bool areThere() const { return !bodies_.empty(); }
  /// vec4[copies][points], as MeshFields takes them [bytes]; and the words of their grids.
  std::uint64_t pointBytes() const;
  std::uint64_t pairCount() const;
  /// pairs: their grids begin at word firstPair. Writes where kernels find them into `rests`, one a body.
  Status createFields(gpu::Device& device, const gpu::Buffer& points, const gpu::Buffer& pairs,
                      std::uint32_t firstPair, std::span<layout::BodyRest> rests);
  const MeshFields* fields() const { return fields_ ? &*fields_ : nullptr; }

  /// What the device does for a frame before its steps.
  struct Work {
    std::uint32_t moved = 0;            // this copy becomes copy 0; 0: none does
    std::uint32_t first = 1, last = 0;  // copies that are made: none where first > last
    bool operator==(const Work&) const = default;
  };
  /// From the poses of all bodies at the frame's start and at the ends of its steps: writes the points of the
  /// frame's copies; `fields`: BodyPose::field at each of these times.
  Work writeFrame(const FrameContext& frame, std::span<const BodyPose> start, std::span<layout::vec4> points,
                  std::span<float> fields);
  /// At a moment, where one copy is enough: writes the points of copy 0. points: of each mesh, seen from what
  /// carries it; none: those of before.
  Work writeMoment(std::span<const std::vector<Vec3d>> points, std::span<layout::vec4> out);
  void jump(const FrameContext& frame, std::span<const BodyPose> start);
  bool isQuiet(const FrameContext& frame) const;
  void archive(Archive& archive);
  void record(gpu::CommandList& list, const Work& work) const;

 private:
  // A mesh that bends, in the frame of what carries it.
  struct Mesh {
    std::size_t body;  // which of all
    const BendingMesh* shape;
    std::vector<Vec3d> now;  // points of its surface
  };
  using Surfaces = std::vector<std::vector<Vec3d>>;  // points of each mesh that bends
  /// At the ends of the frame's samples.
  std::vector<Surfaces> samplesOf(const FrameContext& frame, std::span<const BodyPose> start) const;
  std::uint32_t buildCount(std::span<const Surfaces> samples, std::size_t steps) const;

  std::vector<Body> all_;
  std::vector<Mesh> bodies_;
  std::uint32_t copies_;
  std::uint32_t current_ = 0;  // the copy that the last frame ended with
  bool isStale_ = true;        // or none is of `now`
  std::optional<MeshFields> fields_;
};

}  // namespace ringlet
