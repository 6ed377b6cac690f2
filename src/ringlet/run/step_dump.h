// Writes the contents of a device's buffers after one step of a scene into files, for debugging.
#pragma once

#include <cstdint>
#include <filesystem>

#include "ringlet/base/result.h"
#include "ringlet/run/device_hair.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// Steps the scene's hair as a run does, to the end of a step, counted from 1 after the pre-roll, and writes
/// each buffer (Diagnostics::bufferContents) into the new folder: NAME.bin, with _ for spaces, and
/// buffers.txt with a line for each, its bytes and its file. Errors: the folder exists, or cannot be written;
/// the scene has fewer steps.
Status dumpStep(const LoadedScene& scene, const DeviceHairChoice& choice, std::uint64_t step,
                const std::filesystem::path& folder);

}  // namespace ringlet
