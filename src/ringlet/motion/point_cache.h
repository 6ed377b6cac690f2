// Point caches, which have a mesh's points over time and no faces: PC2 (Blender, 3ds Max) and MDD (LightWave,
// Blender, Houdini).
//
//   PC2: base/pc2_format.h
//   MDD, big-endian: int samples, int points; float seconds of each sample; then x, y, z of each point of
//   each
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/motion/sampled_mesh.h"

namespace ringlet {

/// Whether the name ends in .pc2 or .mdd, in any case.
bool isPointCache(const std::filesystem::path& path);

/// PC2 counts in frames, of which `framesPerSecond` make a second; its first sample is at 0 s. Errors, with
/// the file's name, what was found and what was expected: no cache, another version, counts below 1, a file
/// that is shorter or longer than its counts say. Throws std::bad_alloc only.
Result<PointSamples> readPointCache(std::span<const std::byte> bytes, const std::filesystem::path& path,
                                    double framesPerSecond);
Result<PointSamples> readPointCache(const std::filesystem::path& path, double framesPerSecond);

}  // namespace ringlet
