// MeshFields: distance grids of meshes that bend, and trees of cloth, made on the device from points at
// several times (shaders/kernels/mesh_*.comp). Mirrored by reference/kernels/mesh_field.h.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "layout/mesh_fields.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/bound_kernel.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/scene/bending_mesh.h"

namespace ringlet {

class MeshFields {
 public:
  /// Every mesh has room for `copies` grids, one for each time. points: vec4[copies][points of a surface],
  /// one mesh after the other, in the carrier's frame [m]; pairs: uint[copies][corners of a mesh] likewise,
  /// from word `firstPair` on, where the grids are written. Fails when the device lacks memory.
  static Result<MeshFields> create(gpu::Device& device, std::span<const BendingMesh* const> meshes,
                                   std::uint32_t copies, const gpu::Buffer& points, const gpu::Buffer& pairs,
                                   std::uint32_t firstPair = 0);

  /// Makes grids first .. last of every mesh, and the ways from copy 0 to 1 and so on to `last`; of cloth all
  /// trees up to `last`. Ends with a barrier. Cost: the corners within the band of each triangle, and all
  /// corners twice; of a tree each triangle once a level.
  void record(gpu::CommandList& list, std::uint32_t first, std::uint32_t last) const;
  /// Makes copy `from` copy 0. Ends with a barrier.
  void moveToFirst(gpu::CommandList& list, std::uint32_t from) const;

  /// One a mesh.
  const std::vector<layout::MeshRest>& rests() const { return rests_; }
  /// uint[copies][corners of a mesh]: what meshKey says of each corner.
  const gpu::Buffer& keys() const { return keys_; }
  /// vec4[copies][triangles of a mesh]: how far each moves to the next copy, and how much its corners differ
  /// [m]; of cloth its tree (layout/mesh_fields.h).
  const gpu::Buffer& ways() const { return ways_; }
  std::uint64_t bytes() const {
    return restBuffer_.bytes() + triangles_.bytes() + keys_.bytes() + ways_.bytes();
  }

 private:
  enum Kernel : std::size_t { splat, columns, pathways, boxes };
  MeshFields(gpu::Buffer rests, gpu::Buffer triangles, gpu::Buffer keys, gpu::Buffer ways,
             const gpu::Buffer& pairs)
      : restBuffer_(std::move(rests)),
        triangles_(std::move(triangles)),
        keys_(std::move(keys)),
        ways_(std::move(ways)),
        pairs_(&pairs) {}
  /// `groups` workgroups of a kernel over the mesh and copies of `parameters`, in as many dispatches as that
  /// takes.
  void dispatch(gpu::CommandList& list, Kernel kernel, layout::MeshParameters parameters,
                std::uint32_t groups) const;

  std::vector<layout::MeshRest> rests_;
  std::vector<bool> isCloth_;
  gpu::Buffer restBuffer_, triangles_, keys_, ways_;
  const gpu::Buffer* pairs_;
  std::uint32_t mostGroups_ = 0;
  std::vector<gpu::BoundKernel> kernels_;  // by Kernel
};

}  // namespace ringlet
