// Meshes of USD files that move: point samples of a Mesh prim, and sampled transforms of it and of prims
// above.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/motion/file_axis.h"
#include "ringlet/motion/sampled_mesh.h"

namespace ringlet {

struct UsdMeshChoice {
  std::string prim{};                     // its name or path; empty: the only Mesh
  std::optional<double> metresPerUnit{};  // unset: the file's; where it does not say, centimetres
  std::optional<FileAxis> up{};           // unset: the file's; where it does not say, Y
  bool upIsZ = false;                     // of ours
};

/// Whether the name ends in .usda, .usdc, .usd or .usdz, in any case.
bool isUsdFile(const std::filesystem::path& path);

/// Times are time codes over the file's rate, 24 where it does not say. What transforms place is placed at
/// every time at which one of them has a sample. Faces become triangles by a fan about their first corner.
/// Warnings: a subdivision surface, of which the cage is taken; a mesh that does not move. Errors, with the
/// file's name and the prim's path: those of the file's readers; no Mesh, or several and none named; a prim
/// that other files compose, or a skeleton or blend shapes deform; faces that change, or name points that are
/// not there; samples of other numbers of points. Cost: linear in the file; memory as of SampledMesh.
Result<SampledMesh> readUsdMesh(std::span<const std::byte> bytes, const std::string& name,
                                const UsdMeshChoice& choice = {});
Result<SampledMesh> readUsdMesh(const std::filesystem::path& path, const UsdMeshChoice& choice = {});

}  // namespace ringlet
