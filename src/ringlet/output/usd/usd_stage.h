// UsdStage: what a USD file of ours says of its prims, but for the samples of what moves: one description,
// which usd_text.h writes as text and usdc_head.h as a crate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/groom/usd/usdc_format.h"
#include "ringlet/output/up_axis.h"

namespace ringlet {

struct UsdStageAttribute {
  std::string name, type;            // "points", "point3f[]": as text has them
  std::vector<double> numbers{};     // its value, one element after the other
  std::vector<std::string> texts{};  // of tokens and strings
  std::string interpolation{};       // "": it states none
  bool isUniform = false;            // it cannot change over time
  bool comesLater = false;           // its samples are known one frame after the others
  std::size_t elementsOfSample = 0;  // above 0: it has samples in place of a value, each of so many elements
};

struct UsdStagePrim {
  std::string name, type;
  bool isOver = false;                          // it changes a prim of another layer
  std::vector<std::string> apiSchemas{};        // that are applied to it, before those of other layers
  std::vector<UsdStageAttribute> attributes{};  // text and crates have them in this order
  std::vector<UsdStagePrim> children{};
};

struct UsdStage {
  std::string defaultPrim;
  double framesPerSecond = 24, metresPerUnit = 0.01;
  std::optional<UpAxis> up = UpAxis::y;  // none: it is not stated
  int firstTimeCode = 1;                 // of the first frame; each has one of its own
  int frameCount = 0;  // most frames that will come; 0: nothing has samples, and no times are stated
  std::vector<UsdStagePrim> prims;
};

/// A type by its name in text.
struct UsdStageType {
  std::uint32_t number = 0;  // a crate's (usdc_format.h)
  bool isArray = false;

  usdc::Kind kind() const { return usdc::kTypes[number].kind; }
  /// Numbers of an element.
  std::size_t width() const { return usdc::kTypes[number].width; }
  std::size_t elementBytes() const { return width() * usdc::sizeOf(kind()); }
};

/// Of "point3f[]" or "matrix4d"; nothing for a type that is not written.
std::optional<UsdStageType> usdTypeOf(std::string_view name);

}  // namespace ringlet
