// USD text (.usda): the layer it describes.
#pragma once

#include <string>
#include <string_view>

#include "ringlet/base/result.h"
#include "ringlet/groom/usd/usd_layer.h"

namespace ringlet {

/// Whether it begins as USD text does.
bool isUsda(std::string_view text);

/// Reads a layer; its names are views of `text`. `name` is the file's, for messages, which say line, what was
/// found and what was expected. Of what no groom needs only the brackets are checked. Variants are read over.
/// Throws nothing but std::bad_alloc. Cost: one pass.
Result<UsdLayer> readUsda(std::string_view text, const std::string& name,
                          UsdContent content = UsdContent::strands);

}  // namespace ringlet
