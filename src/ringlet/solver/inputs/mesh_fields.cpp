// Implements solver/inputs/mesh_fields.h.
#include "ringlet/solver/inputs/mesh_fields.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet_shaders/mesh_boxes_plain.h"
#include "ringlet_shaders/mesh_columns_plain.h"
#include "ringlet_shaders/mesh_splat_plain.h"
#include "ringlet_shaders/mesh_ways_plain.h"

namespace ringlet {
namespace {

constexpr std::uint32_t kMostInMeshGroup = 64;
constexpr std::uint32_t kLeastTriangleBits = 8;  // a float counts the steps that are left exactly

// Of the tree of cloth below its root: leaves of at most kMostInLeaf triangles, but not more than 2^15
// leaves.
std::uint32_t treeLevels(std::uint32_t triangleCount) {
  const std::uint32_t leaves = (triangleCount + layout::kMostInLeaf - 1) / layout::kMostInLeaf;
  return std::min(15u, static_cast<std::uint32_t>(std::bit_width(leaves - 1)));
}

layout::MeshRest restOf(const BendingMesh& mesh) {
  layout::MeshRest rest{};
  rest.gridOrigin = packed3(mesh.origin);
  rest.cell = static_cast<float>(mesh.cell);
  std::copy(mesh.counts.begin(), mesh.counts.end(), rest.cells);
  rest.corners = static_cast<std::uint32_t>(mesh.cornerCount());
  rest.triangleCount = static_cast<std::uint32_t>(mesh.surface.triangles.size());
  rest.pointCount = static_cast<std::uint32_t>(mesh.surface.pointCount());
  rest.triangleBits =
      std::max(kLeastTriangleBits, static_cast<std::uint32_t>(std::bit_width(mesh.surface.triangles.size())));
  rest.snap = static_cast<float>(mesh.stepsPerCell());
  rest.levels = treeLevels(rest.triangleCount);
  rest.waysOfCopy = mesh.isCloth ? (4u << rest.levels) + 3 * rest.triangleCount : rest.triangleCount;
  return rest;
}

gpu::KernelDescription describeMesh(const gpu::Device& device, const char* name,
                                    std::span<const std::uint32_t> spirv, bool texels) {
  gpu::KernelDescription description;
  description.name = name;
  description.spirv = spirv;
  description.pushConstantBytes = sizeof(layout::MeshParameters);
  description.groupSize = std::min(kMostInMeshGroup, device.properties().maxGroupInvocations);
  description.constants = {{layout::kSpecGroupSize, description.groupSize},
                           {layout::kSpecTexels, texels ? 1u : 0u}};
  return description;
}

}  // namespace

Result<MeshFields> MeshFields::create(gpu::Device& device, std::span<const BendingMesh* const> meshes,
                                      std::uint32_t copies, const gpu::Buffer& points,
                                      const gpu::Buffer& pairs, std::uint32_t firstPair) {
  std::vector<layout::MeshRest> rests;
  std::vector<layout::uvec4> triangles;
  std::uint32_t corners = 0, pointCount = 0, ways = 0;
  for (const BendingMesh* mesh : meshes) {
    layout::MeshRest& rest = rests.emplace_back(restOf(*mesh));
    rest.firstTriangle = static_cast<std::uint32_t>(triangles.size());
    rest.firstPoint = pointCount;
    rest.firstKey = corners;
    rest.firstPair = firstPair + corners;
    rest.firstWay = ways;
    for (const auto& [a, b, c] : mesh->surface.triangles) triangles.push_back({a, b, c, 0});
    pointCount += copies * rest.pointCount;
    corners += copies * rest.corners;
    ways += copies * rest.waysOfCopy;
  }
  auto restBuffer = createFilled(device, rests, "meshes that bend");
  if (!restBuffer) return restBuffer.error();
  auto triangleBuffer = createFilled(device, triangles, "their triangles");
  if (!triangleBuffer) return triangleBuffer.error();
  auto keys = gpu::Buffer::create(device, corners * sizeof(std::uint32_t), gpu::BufferKind::storage,
                                  "the triangles nearest to their grids' corners");
  if (!keys) return keys.error();
  auto wayBuffer = gpu::Buffer::create(device, ways * sizeof(layout::vec4), gpu::BufferKind::storage,
                                       "how their triangles move");
  if (!wayBuffer) return wayBuffer.error();
  MeshFields self(std::move(*restBuffer), std::move(*triangleBuffer), std::move(*keys), std::move(*wayBuffer),
                  pairs);
  self.rests_ = std::move(rests);
  for (const BendingMesh* mesh : meshes) self.isCloth_.push_back(mesh->isCloth);
  self.mostGroups_ = device.properties().maxGroupCount;

  using namespace layout;
  const bool texels = isSeenAsTexels(device, std::max(self.triangles_.bytes(), points.bytes()));
  const gpu::BufferTable buffers{{kBindMeshes, self.restBuffer_},
                                 {kBindMeshTriangles, self.triangles_},
                                 {kBindMeshPoints, points},
                                 {kBindMeshKeys, self.keys_},
                                 {kBindMeshPairs, pairs},
                                 {kBindMeshWays, self.ways_},
                                 {kMeshTexels + kBindMeshTriangles, self.triangles_},
                                 {kMeshTexels + kBindMeshPoints, points}};
  for (const auto& description : {describeMesh(device, "mesh_splat", k_mesh_splat_plain, texels),
                                  describeMesh(device, "mesh_columns", k_mesh_columns_plain, texels),
                                  describeMesh(device, "mesh_ways", k_mesh_ways_plain, texels),
                                  describeMesh(device, "mesh_boxes", k_mesh_boxes_plain, texels)}) {
    auto kernel = gpu::BoundKernel::create(device, description, buffers);
    if (!kernel) return kernel.error();
    self.kernels_.push_back(std::move(*kernel));
  }
  return self;
}

void MeshFields::dispatch(gpu::CommandList& list, Kernel kernel, layout::MeshParameters parameters,
                          std::uint32_t groups) const {
  while (parameters.first < groups) {
    const std::uint32_t now = std::min(groups - parameters.first, mostGroups_);
    kernels_[kernel].dispatch(list, parameters, now * kernels_[kernel].groupSize());
    parameters.first += now;
  }
}

void MeshFields::record(gpu::CommandList& list, std::uint32_t first, std::uint32_t last) const {
  const std::uint32_t count = last - first + 1;
  for (const layout::MeshRest& rest : rests_) {
    const std::uint64_t bytes = std::uint64_t{count} * rest.corners * 4;
    const std::uint64_t before = std::uint64_t{first} * rest.corners;
    list.fillZero(keys_, bytes, (rest.firstKey + before) * 4);
    list.fillZero(*pairs_, bytes, (rest.firstPair + before) * 4);
  }
  list.barrier();
  const auto groupsOf = [&](Kernel kernel, std::uint32_t items) {
    const std::uint32_t size = kernels_[kernel].groupSize();
    return (items + size - 1) / size;
  };
  for (std::uint32_t mesh = 0; mesh < rests_.size(); ++mesh) {
    const std::uint32_t triangles = rests_[mesh].triangleCount;
    if (isCloth_[mesh]) {
      dispatch(list, boxes, {mesh, 0, last + 1, 0},
               groupsOf(boxes, (last + 1) * (2u << rests_[mesh].levels)));
      continue;
    }
    dispatch(list, splat, {mesh, first, count, 0}, count * triangles);
    dispatch(list, pathways, {mesh, 0, last + 1, 0}, groupsOf(pathways, (last + 1) * triangles));
  }
  list.barrier();
  for (std::uint32_t mesh = 0; mesh < rests_.size(); ++mesh) {
    if (isCloth_[mesh]) continue;
    const std::uint32_t rows = (rests_[mesh].cells[1] + 1) * (rests_[mesh].cells[2] + 1);
    dispatch(list, columns, {mesh, first, count, 0}, groupsOf(columns, count * rows));
  }
  list.barrier();
}

void MeshFields::moveToFirst(gpu::CommandList& list, std::uint32_t from) const {
  for (const layout::MeshRest& rest : rests_) {
    const std::uint64_t bytes = std::uint64_t{rest.corners} * 4;
    for (const auto& [buffer, first] : {std::pair(&keys_, rest.firstKey), std::pair(pairs_, rest.firstPair)})
      list.copyBuffer(*buffer, *buffer, bytes, std::uint64_t{first} * 4 + from * bytes,
                      std::uint64_t{first} * 4);
  }
  list.barrier();
}

}  // namespace ringlet
