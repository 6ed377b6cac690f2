// Meshes that move, from files: skins of glTF and USD, point samples of USD and Alembic, point caches over
// an OBJ file, sequences of OBJ files.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/motion/file_axis.h"
#include "ringlet/motion/mesh_motion.h"

namespace ringlet {

struct MeshMotionChoice {
  std::filesystem::path path;     // of kMeshMotionEndings; '#'s in its name: a sequence
  std::filesystem::path cache{};  // of an .obj: .pc2 or .mdd, with points in the same order
  std::string mesh{};       // glTF: of it, or of its node; USD, Alembic: of the prim or object, or its path
  std::string animation{};  // glTF: a name or a number from 0; empty: the first
  std::optional<double> metresPerUnit{};  // unset: the file's; 1 where it has none
  std::optional<FileAxis> up{};           // of the file; unset: the file's; ours where it has none
  double framesPerSecond = 24;            // of .pc2 and of sequences, whose times are frames
};

/// The endings of files that have points over time, for messages.
inline constexpr const char* kMeshMotionEndings =
    ".gltf, .glb, .vrm, .usda, .usdc, .usd, .usdz, .abc, .obj with a point cache (.pc2, .mdd), or a sequence as in body.####.obj";

/// Whether files of this ending state neither unit nor axis, so that those of the groom count: .obj, .abc.
bool isWithoutUnit(const std::filesystem::path& path);

/// Whether the name has '#'s, which stand for the digits of a frame's number.
bool isMeshSequence(const std::filesystem::path& path);

/// The files that are there of a sequence, by rising number. Of digits there may be more than '#'s. Empty
/// where the folder cannot be read.
std::vector<std::filesystem::path> meshSequenceFiles(const std::filesystem::path& pattern);

/// Every file that the choice of these two names: a sequence's all.
std::vector<std::filesystem::path> meshMotionFiles(const std::filesystem::path& path,
                                                   const std::filesystem::path& cache);

/// In a world whose up axis is Y, or Z; times begin at the file's first key, of caches and sequences at 0 s.
/// A cache that mirrors the points of its OBJ file, as MDD files of left-handed programs do, is mirrored back
/// along Z, with a warning. Errors, each with the file's name: those of the readers; a name of no such kind;
/// an OBJ file alone, which has no motion; a cache with other points than the OBJ file; a sequence of which a
/// file has other points or faces than the first.
Result<std::shared_ptr<const MeshMotion>> readMeshMotion(const MeshMotionChoice& choice, bool upIsZ);

}  // namespace ringlet
