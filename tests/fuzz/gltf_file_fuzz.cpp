// glTF files: ways of nodes, skinned meshes, scalps.
#include "ringlet/motion/gltf_file.h"

#include "ringlet/motion/motion_doubts.h"
#include "ringlet/motion/scalp.h"
#include "ringlet/motion/skinned_mesh.h"
#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

// TinyGLTF keeps the file's tree twice, and buffers beside it.
const MemoryBound kMemory{.base = 4 << 20, .perByte = 4096};

namespace {

void tryMotion(const GltfFile& file) {
  const GltfAnimation* animation = file.animations.empty() ? nullptr : &file.animations.front();
  demand(file.parentsFirst.size() == file.nodes.size(), "every node stands behind its parent");
  if (file.nodes.empty()) return;
  const std::size_t node = file.nodes.size() - 1;
  file.worldsAt(animation, 0.5);
  // A thousand samples are enough to try it.
  const double seconds = animation ? animation->lastSeconds - animation->firstSeconds : 0;
  if (!(seconds < 40)) return;
  doubtsOf(file, node, animation, {}, false, "");
  doubtsOf(file, node, animation, {.up = FileAxis::minusZ}, true, "");
  const auto keys = file.motionOf(node, animation, {}, 24.0);
  if (!keys) return;
  for (const HeadPose& pose : keys->poses) {
    const Quatd q = pose.rotation;
    demand(isFinite(pose.position) && std::isfinite(q.x + q.y + q.z + q.w), "all poses are finite");
  }
}

void tryMesh(const std::shared_ptr<const GltfFile>& file, const std::string& node) {
  auto made = SkinnedMesh::of(file, {.node = node});
  if (!made) return;
  const auto mesh = std::make_shared<const SkinnedMesh>(std::move(*made));
  const double first = mesh->firstSeconds();
  const std::vector<Vec3d> points = mesh->pointsAt(first);
  demandFinite(std::span<const Vec3d>(points));
  for (const auto& triangle : mesh->triangles()) {
    for (const std::uint32_t point : triangle) demand(point < points.size(), "triangles have their points");
  }
  const Vec3d roots[] = {points[mesh->triangles().front()[0]]};
  const auto scalp = Scalp::bind(mesh, roots, first, 0.01);
  if (!scalp) return;
  demand(scalp->triangleOf(0) < mesh->triangles().size(), "a root has a triangle");
  demand(scalp->posesAt(mesh->lastSeconds()).size() == 1, "a root has a pose");
}

}  // namespace

void tryBytes(std::span<const std::byte> bytes) {
  auto read = parseGltf(bytes, kNoFolder);
  if (!read) return;
  const auto file = std::make_shared<const GltfFile>(std::move(*read));
  tryMotion(*file);
  tryMesh(file, "");
  for (const GltfMesh& mesh : file->meshes) tryMesh(file, mesh.name);
}

}  // namespace ringlet::fuzz
