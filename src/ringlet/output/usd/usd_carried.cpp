// Implements output/usd/usd_carried.h.
#include "ringlet/output/usd/usd_carried.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

namespace ringlet {
namespace {

const GroomValue* find(const GroomPrim& prim, std::string_view name) {
  const auto found = std::ranges::find(prim.values, name, &GroomValue::name);
  return found == prim.values.end() ? nullptr : &*found;
}

bool isIndexed(const GroomPrim& prim, const std::string& name) {
  return name.ends_with(":indices") || find(prim, name + ":indices") != nullptr;
}

// That of one prim after that of another.
void append(UsdStageAttribute& all, const UsdStageAttribute& own) {
  all.numbers.insert(all.numbers.end(), own.numbers.begin(), own.numbers.end());
  all.texts.insert(all.texts.end(), own.texts.begin(), own.texts.end());
}

// Once for each strand.
void repeat(UsdStageAttribute& attribute, std::uint32_t strandCount) {
  const UsdStageAttribute one = attribute;
  attribute.numbers.clear();
  attribute.texts.clear();
  for (std::uint32_t s = 0; s < strandCount; ++s) append(attribute, one);
}

std::optional<UsdStageAttribute> joined(const std::vector<GroomPrim>& prims, const GroomValue& first) {
  UsdStageAttribute all;
  for (const GroomPrim& prim : prims) {
    const GroomValue* value = find(prim, first.name);
    if (!value || value->type != first.type || isIndexed(prim, first.name)) return std::nullopt;
    UsdStageAttribute own = carriedOf(*value, prim.toGroom.scale());
    std::string_view per = interpolationOf(value->name, value->interpolation);
    if (per == "constant") {
      const bool isOne = !usdTypeOf(own.type)->isArray ||
                         std::max(own.numbers.size() / usdTypeOf(own.type)->width(), own.texts.size()) == 1;
      if (!isOne) return std::nullopt;
      repeat(own, prim.strandCount);
      if (!own.type.ends_with("[]")) own.type += "[]";
      per = "uniform";
    }
    if (per == "varying") per = "vertex";
    own.interpolation = per;
    if (all.name.empty()) {
      all = std::move(own);
    } else if (all.interpolation != own.interpolation) {
      return std::nullopt;
    } else {
      append(all, own);
    }
  }
  return all;
}

}  // namespace

std::string_view interpolationOf(std::string_view name, std::string_view stated) {
  if (!stated.empty()) return stated;
  return name == "widths" ? "vertex" : name == "ids" ? "uniform" : "constant";
}

UsdStageAttribute carriedOf(const GroomValue& value, double unit) {
  UsdStageAttribute attribute{.name = value.name,
                              .type = value.type,
                              .numbers = value.numbers,
                              .texts = value.texts,
                              .interpolation = value.interpolation};
  if (value.name == "widths" && unit != 1) {
    for (double& width : attribute.numbers) width *= unit;
  }
  return attribute;
}

bool isWritten(const GroomValue& value) {
  const auto type = usdTypeOf(value.type);
  if (!type) return false;
  const bool isText = type->kind() == usdc::Kind::token || type->kind() == usdc::Kind::string;
  const std::size_t count = isText ? value.texts.size() : value.numbers.size();
  const bool isOther = isText ? !value.numbers.empty() : !value.texts.empty();
  return !isOther && count > 0 && (isText || count % type->width() == 0) &&
         (type->isArray || count == (isText ? 1 : type->width()));
}

std::vector<UsdStageAttribute> carriedValues(const std::vector<GroomPrim>& prims) {
  std::vector<UsdStageAttribute> all;
  if (prims.empty()) return all;
  for (const GroomValue& value : prims.front().values) {
    if (!isWritten(value)) continue;
    if (prims.size() == 1) {
      all.push_back(carriedOf(value, prims.front().toGroom.scale()));
    } else if (auto made = joined(prims, value)) {
      all.push_back(std::move(*made));
    }
  }
  return all;
}

}  // namespace ringlet
