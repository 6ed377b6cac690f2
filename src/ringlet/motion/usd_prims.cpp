// Implements motion/usd_prims.h.
#include "ringlet/motion/usd_prims.h"

#include <fmt/format.h>

#include <algorithm>

#include "ringlet/base/quoted.h"

namespace ringlet {
namespace {

bool hasValue(const UsdAttribute& attribute) {
  const UsdValue& value = attribute.value;
  return !value.numbers.empty() || !value.texts.empty() || value.isBlocked || !attribute.drivenBy.empty();
}

}  // namespace

UsdPrims::UsdPrims(const UsdLayer& layer, const std::string& file) : layer_(layer), file_(file) {
  for (std::uint32_t p = 0; p < layer_.prims.size(); ++p)
    children_.insert({{layer_.prims[p].parent, layer_.prims[p].name}, p});
}

Error UsdPrims::wrong(std::uint32_t prim, const std::string& sentence) const {
  return Error{fmt::format("{}: {}: {}", file_, pathOf(prim), sentence)};
}

bool UsdPrims::isThere(std::uint32_t prim) const {
  for (; prim != kNoUsdPrim; prim = layer_.prims[prim].parent)
    if (!layer_.prims[prim].isActive || layer_.prims[prim].specifier != UsdSpecifier::def) return false;
  return true;
}

Status UsdPrims::checkComposition(std::uint32_t prim) const {
  for (; prim != kNoUsdPrim; prim = layer_.prims[prim].parent) {
    const std::string_view by = layer_.prims[prim].composedBy;
    if (!by.empty()) return wrong(prim, fmt::format("has {}, which are not followed; {}", by, kFlattenUsd));
  }
  return {};
}

std::optional<UsdProperty> UsdPrims::nearest(std::uint32_t prim, std::string_view name) const {
  for (; prim != kNoUsdPrim; prim = layer_.prims[prim].parent) {
    const UsdAttribute* attribute = usdAttributeOf(layer_.prims[prim], name);
    if (!attribute || !hasValue(*attribute)) continue;
    if (attribute->value.isBlocked && attribute->samples.empty()) return std::nullopt;
    return UsdProperty{prim, attribute};
  }
  return std::nullopt;
}

std::optional<std::uint32_t> UsdPrims::primAt(std::string_view path, std::uint32_t from) const {
  std::uint32_t at = path.starts_with('/') ? kNoUsdPrim : from;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    const std::string_view name = path.substr(0, end);
    path.remove_prefix(std::min(end + 1, path.size()));
    if (name.empty()) continue;
    if (name == "..") {
      if (at == kNoUsdPrim) return std::nullopt;
      at = layer_.prims[at].parent;
      continue;
    }
    const auto found = children_.find({at, name});
    if (found == children_.end()) return std::nullopt;
    at = found->second;
  }
  return at == kNoUsdPrim ? std::nullopt : std::optional(at);
}

Result<std::uint32_t> UsdPrims::targetOf(const UsdProperty& relationship, std::size_t which,
                                         std::string_view type) const {
  const std::string_view path = relationship.attribute->value.texts[which];
  const auto refused = [&](const std::string& why) {
    return wrong(relationship.prim, fmt::format("{} names {}, {}; expected a {}",
                                                relationship.attribute->name, quoted(path), why, type));
  };
  const auto prim = primAt(path, relationship.prim);
  if (!prim) return refused("where there is no prim");
  if (layer_.prims[*prim].type != type)
    return refused(fmt::format("which is of type {}", quoted(layer_.prims[*prim].type)));
  if (!isThere(*prim)) return refused("which is inactive or not defined");
  if (Status whole = checkComposition(*prim); !whole) return whole.error();
  return *prim;
}

Result<std::uint32_t> UsdPrims::onlyTargetOf(const UsdProperty& relationship, std::string_view type) const {
  const std::size_t count = relationship.attribute->value.texts.size();
  if (count != 1)
    return wrong(relationship.prim,
                 fmt::format("{} has {} targets; expected one", relationship.attribute->name, count));
  return targetOf(relationship, 0, type);
}

Result<const UsdValue*> UsdPrims::constantOf(const UsdProperty& property, std::string_view mustStay) const {
  const UsdAttribute& attribute = *property.attribute;
  if (!attribute.drivenBy.empty())
    return wrong(property.prim,
                 fmt::format("{} is given by {}, which is not followed", attribute.name, attribute.drivenBy));
  for (const UsdSample& sample : attribute.samples) {
    if (sample.value.numbers != attribute.value.numbers || sample.value.texts != attribute.value.texts)
      return wrong(property.prim,
                   fmt::format("{} changes at time {}; {}", attribute.name, sample.time, mustStay));
  }
  return &attribute.value;
}

Result<UsdNames> UsdPrims::namesOf(std::uint32_t prim, std::string_view attribute) const {
  UsdNames names;
  const UsdAttribute* found = usdAttributeOf(layer_.prims[prim], attribute);
  if (!found) return names;
  const auto value = constantOf({prim, found}, "expected the same names at all times");
  if (!value) return value.error();
  for (const std::string_view name : (*value)->texts) {
    const auto index = static_cast<std::uint32_t>(names.names.size());
    if (!names.indices.insert({name, index}).second)
      return wrong(prim, fmt::format("{} has {} twice; expected each once", attribute, quoted(name)));
    names.names.push_back(name);
  }
  return names;
}

Result<double> UsdPrims::timeCodesPerSecond() const { return usdTimeCodesPerSecond(layer_, file_); }

}  // namespace ringlet
