// USD files as layers and as grooms: text (.usda), crates (.usdc), either (.usd) and packages (.usdz).
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/groom/usd/usd_layer.h"

namespace ringlet {

/// The layer that a file of any of these kinds is, or begins with. Its names and texts are views of `bytes`.
Result<UsdLayer> readUsdLayer(std::span<const std::byte> bytes, const std::string& name, UsdContent content);

/// Reads the strands of all BasisCurves in a USD file; its first bytes say which kind it is. The unit and the
/// up axis are the file's, if it states them. docs/formats.md says what is read, what is left out and what is
/// refused; `path` is for messages, which name line or byte, or the prim. Memory and time are bounded by the
/// file's size. Throws nothing but std::bad_alloc.
Result<LoadedGroom> readUsd(std::span<const std::byte> bytes, const std::filesystem::path& path,
                            const GroomReading& reading = {});

}  // namespace ringlet
