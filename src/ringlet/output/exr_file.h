// OpenEXR files of one picture: red, green and blue as halves, in linear light.
#pragma once

#include <filesystem>
#include <span>

#include "ringlet/base/result.h"

namespace ringlet {

/// Row by row from the top, three numbers a pixel. Errors: the file cannot be written.
Status writeExr(const std::filesystem::path& path, int width, int height, std::span<const float> pixels);

}  // namespace ringlet
