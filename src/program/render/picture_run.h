// renderAnimation of the library, as the program has it: with its progress shown, and ended by Ctrl-C.
#pragma once

#include <filesystem>

#include "program/device/open_device.h"
#include "ringlet/base/result.h"
#include "ringlet/pictures/render_animation.h"

namespace ringlet::program {

Result<RenderOutcome> drawAnimation(const std::filesystem::path& animation, const ComputeDevice& device,
                                    RenderPlan plan, bool showProgress);

}  // namespace ringlet::program
