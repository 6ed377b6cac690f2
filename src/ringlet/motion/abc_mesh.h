// Meshes of Alembic files that move: samples of the points of a PolyMesh or SubD object, and sampled
// transforms of the objects above it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/motion/affine.h"
#include "ringlet/motion/mesh_motion.h"

namespace ringlet {

struct AbcMeshChoice {
  std::string object{};  // its name or path; empty: the only mesh
  Affine world{};        // from the file's unit and axes, which the format does not say, into metres and ours
};

/// Whether the name ends in .abc, in any case.
bool isAbcFile(const std::filesystem::path& path);

/// Times are the file's, in seconds. What transforms place is placed at every time at which one of them has a
/// sample. Faces become triangles by a fan about their first corner, wound as ours are. Warnings: a
/// subdivision surface, of which the cage is taken; a mesh that does not move. Errors, with the file's name
/// and the object's path: those of AbcArchive and AbcTransforms; no mesh, or several and none named; faces
/// that change, or name points that are not there; samples of other numbers of points, or that are not
/// finite. Cost: linear in the file; memory of points as of SampledMesh.
Result<std::shared_ptr<const MeshMotion>> readAbcMesh(std::span<const std::byte> bytes,
                                                      const std::string& name,
                                                      const AbcMeshChoice& choice = {});

}  // namespace ringlet
