// USD packages (.usdz): a zip file whose first file is the layer.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "ringlet/base/result.h"

namespace ringlet {

/// Whether it begins as a zip file does.
bool isUsdz(std::span<const std::byte> bytes);

/// The bytes of the first file in it, which must be a layer, stored as it is. What stands at the package's
/// beginning and what its directory says of it must be one; checksums and the other files are not looked at.
/// `name` is the package's, for messages.
Result<std::span<const std::byte>> firstOfUsdz(std::span<const std::byte> bytes, const std::string& name);

}  // namespace ringlet
