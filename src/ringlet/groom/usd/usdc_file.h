// Binary USD (.usdc, "crates"): the layer one holds.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/groom/usd/usd_layer.h"

namespace ringlet {

/// Whether it begins as a crate does.
bool isUsdc(std::span<const std::byte> bytes);

struct UsdcReading {
  /// Samples are not decoded: of each attribute that has some it is noted where they are (UsdAttribute), in a
  /// file that `bytes` may be the beginning of.
  bool keepsPlaces = false;
  UsdContent content = UsdContent::strands;
  std::optional<double> time{};  // values that move are those of this time, and count as ones that do not
};

/// Reads a layer from a crate of version 0.4.0 to 0.13.0, in which all that is inside counts from its first
/// byte. `name` is the file's, for messages, which say byte, what was found and what was expected. Values
/// that no groom needs are not looked at. What the file packs may not become more than its own size allows: a
/// path, field and token a byte of the file, and sixteen numbers. Throws nothing but std::bad_alloc. Cost:
/// one pass over the structure, and over the values read.
Result<UsdLayer> readUsdc(std::span<const std::byte> bytes, const std::string& name,
                          UsdcReading reading = {});

}  // namespace ringlet
