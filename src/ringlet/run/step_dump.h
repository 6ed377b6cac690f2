// What a device holds after one step of a scene, in files, for those who look for a fault.
#pragma once

#include <cstdint>
#include <filesystem>

#include "ringlet/base/result.h"
#include "ringlet/run/device_hair.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// Steps the scene's hair as a run does, to the end of a step, 1 being the first after the pre-roll, and
/// writes each buffer (Diagnostics::bufferContents) into the new folder: NAME.bin, with _ for spaces, and
/// buffers.txt with a line for each, its bytes and its file. Errors: the folder is there, or cannot be
/// written; the scene has fewer steps.
Status dumpStep(const LoadedScene& scene, const DeviceHairChoice& choice, std::uint64_t step,
                const std::filesystem::path& folder);

}  // namespace ringlet
