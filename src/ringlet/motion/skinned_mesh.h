// SkinnedMesh: a mesh of a glTF file in the world over time: shaped by its morph targets, then carried by the
// joints of its skin or by its node.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/motion/gltf_file.h"
#include "ringlet/motion/mesh_motion.h"

namespace ringlet {

struct SkinnedMeshChoice {
  std::string node{};       // that has the mesh, or the mesh's own name; empty: the only one
  std::string animation{};  // a name or a number from 0; empty: the first
  GltfPlacement placement{};
};

/// Times are the animation's own [s]: a head's Keyframes of the same file begin at firstSeconds().
class SkinnedMesh final : public MeshMotion {
 public:
  /// Errors: no such mesh (lists what there is); one that could not be read, or has no triangles; a skin
  /// with fewer joints than its points follow; points that are not finite at the first key.
  static Result<SkinnedMesh> of(std::shared_ptr<const GltfFile> file, const SkinnedMeshChoice& choice = {});

  const std::vector<Triangle>& triangles() const override { return mesh_->triangles; }
  std::size_t pointCount() const override { return mesh_->points.size(); }
  double firstSeconds() const override { return animation_ ? animation_->firstSeconds : 0; }
  double lastSeconds() const override { return animation_ ? animation_->lastSeconds : 0; }
  /// What of the mesh was left out.
  const std::vector<std::string>& warnings() const override { return mesh_->warnings; }

  /// Morph targets first, then linear blend skinning. Cost: linear in points, shifts of targets and nodes.
  std::vector<Vec3d> pointsAt(double t) const override;

 private:
  SkinnedMesh() = default;
  std::vector<Vec3d> shapeAt(double t) const;  // by its morph targets, before the skin

  std::shared_ptr<const GltfFile> file_;  // owns the next three
  const GltfMesh* mesh_ = nullptr;
  const GltfSkin* skin_ = nullptr;            // none: the node carries every point
  const GltfAnimation* animation_ = nullptr;  // none: it stands still
  std::size_t node_ = 0;
  Affine placement_;
};

/// Reads the file for this mesh alone; who wants the head's motion too reads the file once and shares it.
Result<SkinnedMesh> readSkinnedMesh(const std::filesystem::path& path, const SkinnedMeshChoice& choice = {});

}  // namespace ringlet
