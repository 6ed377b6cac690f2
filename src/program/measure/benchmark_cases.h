// The neutral benchmark of hair: its cases, as files for any simulator. docs/benchmark.md says what each
// asks.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scenes/builtin_scene.h"

namespace ringlet::program {

struct BenchmarkCase {
  const char* name;   // of its folder
  const char* scene;  // a built-in scene
  int particles;      // of each strand
  int strands;        // 0: the scene's
  double seconds;
  double until;  // when the head stops [s]; 0: as the scene has it
  const char* summary;
};

std::span<const BenchmarkCase> benchmarkCases();

/// Where all particles are with the scene's head there, if they move with their roots as stiff strands do
/// [m], in the world.
std::vector<Vec3f> carriedPoints(const LoadedScene& scene, const HeadPose& head);

/// Writes of each case into FOLDER/NAME: scene.toml and rest.obj, which Ringlet runs; rest.abc; carried.abc
/// and carried.usdc, the strands stiff on their moving roots; body.obj, which the head carries, where there
/// is one. Existing files are replaced. Errors: a file that cannot be written.
Status writeBenchmark(const std::filesystem::path& folder);

}  // namespace ringlet::program
