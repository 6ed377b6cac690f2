// Implements motion/skinned_mesh.h.
#include "ringlet/motion/skinned_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ringlet/base/assert.h"
#include "ringlet/motion/joint_name.h"

namespace ringlet {
namespace {

// The node that has the mesh: by its own name or the mesh's.
Result<std::size_t> nodeOf(const GltfFile& file, const std::string& wanted) {
  std::vector<std::size_t> nodes;
  std::vector<std::string> names, meshNames;
  for (std::size_t n = 0; n < file.nodes.size(); ++n) {
    if (!file.nodes[n].mesh) continue;
    nodes.push_back(n);
    names.push_back(file.nodes[n].name);
    meshNames.push_back(file.meshes[*file.nodes[n].mesh].name);
  }
  if (nodes.empty()) return Error{"it has no mesh"};
  if (wanted.empty() && nodes.size() == 1) return nodes.front();
  auto found = findJoint(names, wanted);
  if (!found) found = findJoint(meshNames, wanted);
  if (found) return nodes[*found];
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k].empty()) names[k] = meshNames[k];
  }
  if (!wanted.empty()) return noSuchJoint("the file", "mesh", wanted, names);
  return Error{fmt::format(
      "it has {} meshes, so that one must be named: {}", names.size(),
      fmt::join(names.begin(), names.begin() + std::min<std::ptrdiff_t>(12, std::ssize(names)), ", "))};
}

}  // namespace

Result<SkinnedMesh> SkinnedMesh::of(std::shared_ptr<const GltfFile> file, const SkinnedMeshChoice& choice) {
  RINGLET_ASSERT(file, "a mesh is of a file");
  const auto node = nodeOf(*file, choice.node);
  if (!node) return node.error();
  const auto animation = file->animationNamed(choice.animation);
  if (!animation) return animation.error();
  SkinnedMesh mesh;
  mesh.node_ = *node;
  mesh.mesh_ = &file->meshes[*file->nodes[*node].mesh];
  mesh.animation_ = *animation;
  mesh.placement_ = choice.placement.map();
  if (mesh.mesh_->problem)
    return Error{fmt::format("mesh {}: {}", mesh.mesh_->name, mesh.mesh_->problem->message)};
  if (mesh.mesh_->triangles.empty()) return Error{fmt::format("mesh {} has no triangles", mesh.mesh_->name)};
  if (const auto skin = file->nodes[*node].skin) {
    mesh.skin_ = &file->skins[*skin];
    if (mesh.skin_->joints.size() < mesh.mesh_->jointCount) {
      return Error{fmt::format("mesh {}: its points follow {} joints, its skin has {}", mesh.mesh_->name,
                               mesh.mesh_->jointCount, mesh.skin_->joints.size())};
    }
  }
  mesh.file_ = std::move(file);
  if (!std::ranges::all_of(mesh.pointsAt(mesh.firstSeconds()), isFinite<double>))
    return Error{fmt::format("mesh {} has points beyond all numbers", mesh.mesh_->name)};
  return mesh;
}

std::vector<Vec3d> SkinnedMesh::shapeAt(double t) const {
  std::vector<Vec3d> points = mesh_->points;
  const std::vector<double>& own = file_->nodes[node_].weights;
  std::vector<double> weights = own.empty() ? mesh_->weights : own;
  if (animation_) {
    const auto found = std::ranges::find(animation_->weights, node_, &GltfChannel::node);
    if (found != animation_->weights.end()) weights = found->weightsAt(t);
  }
  weights.resize(mesh_->morphs.size());
  for (std::size_t m = 0; m < weights.size(); ++m) {
    if (weights[m] == 0) continue;
    for (const GltfMesh::Delta& delta : mesh_->morphs[m]) points[delta.point] += delta.shift * weights[m];
  }
  return points;
}

std::vector<Vec3d> SkinnedMesh::pointsAt(double t) const {
  const std::vector<Vec3d> morphed = mesh_->morphs.empty() ? std::vector<Vec3d>() : shapeAt(t);
  const std::vector<Vec3d>& shape = mesh_->morphs.empty() ? mesh_->points : morphed;
  const std::vector<Affine> worlds = file_->worldsAt(animation_, t);
  std::vector<Affine> joints;  // world from the mesh in its rest pose
  if (skin_) {
    for (std::size_t j = 0; j < skin_->joints.size(); ++j)
      joints.push_back(placement_ * worlds[skin_->joints[j]] * skin_->inverseBinds[j]);
  }
  const Affine node = placement_ * worlds[node_];
  std::vector<Vec3d> points;
  points.reserve(pointCount());
  for (std::size_t p = 0; p < pointCount(); ++p) {
    const Vec3d rest = shape[p];
    const std::size_t first = mesh_->influencesBefore[p], last = mesh_->influencesBefore[p + 1];
    if (!skin_ || first == last) {
      points.push_back(node(rest));
      continue;
    }
    // A skin stands where its joints are, wherever its node is.
    Vec3d place;
    for (std::size_t k = first; k < last; ++k)
      place += joints[mesh_->influences[k].joint](rest) * mesh_->influences[k].weight;
    points.push_back(place);
  }
  return points;
}

Result<SkinnedMesh> readSkinnedMesh(const std::filesystem::path& path, const SkinnedMeshChoice& choice) {
  auto file = readGltf(path);
  if (!file) return file.error();
  auto mesh = SkinnedMesh::of(std::make_shared<const GltfFile>(std::move(*file)), choice);
  if (!mesh) return Error{fmt::format("{}: {}", path.string(), mesh.error().message)};
  return mesh;
}

}  // namespace ringlet
