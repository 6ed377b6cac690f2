// Meshes of USD files that move: point samples of a Mesh prim, sampled transforms of it and of prims above,
// blend shapes and a skeleton; in the file or in its value clips (motion/usd_clips.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/motion/file_axis.h"
#include "ringlet/motion/mesh_motion.h"
#include "ringlet/motion/usd_clip_files.h"

namespace ringlet {

struct UsdMeshChoice {
  std::string prim{};                     // its name or path; empty: the only Mesh
  std::optional<double> metresPerUnit{};  // unset: the file's; where it does not say, centimetres
  std::optional<FileAxis> up{};           // unset: the file's; where it does not say, Y
  bool upIsZ = false;                     // of ours
  const UsdClipFiles* clips = nullptr;    // where value clips are; null: a file that has some is refused
};

/// Whether the name ends in .usda, .usdc, .usd or .usdz, in any case.
bool isUsdFile(const std::filesystem::path& path);

/// Times are time codes over the file's rate, 24 where it does not say. What transforms place is placed at
/// every time at which one of them has a sample. A mesh of joints stands where its Skeleton prim does. Faces
/// become triangles by a fan about their first corner. Warnings: a subdivision surface, of which the cage is
/// taken; a mesh that does not move; points without joint weights, blend shapes without weights, inbetween
/// shapes, dual quaternions. Errors, with the file's name and the prim's path: those of the file's readers;
/// no Mesh, or several and none named; a prim that other files compose; faces that change, or name points
/// that are not there; samples of other numbers of points; a skeleton, animation or blend shape that is not
/// there or does not fit; value clips that are not there or do not fit. Cost: linear in the file; memory of
/// points as of SampledMesh.
Result<std::shared_ptr<const MeshMotion>> readUsdMesh(std::span<const std::byte> bytes,
                                                      const std::string& name,
                                                      const UsdMeshChoice& choice = {});

}  // namespace ringlet
