// UsdPrims: the prims of a USD layer for who reads a mesh that moves: found by path, with values that a
// relationship or a prim above gives, and with the file's name in what is said of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/usd/usd_layer.h"

namespace ringlet {

inline constexpr const char* kFlattenUsd = "flatten the file first, as `usdcat --flatten` does";

/// An attribute and whose it is.
struct UsdProperty {
  std::uint32_t prim = kNoUsdPrim;
  const UsdAttribute* attribute = nullptr;
};

/// Names in an order, each once.
struct UsdNames {
  std::vector<std::string_view> names{};
  std::map<std::string_view, std::uint32_t> indices{};

  std::optional<std::uint32_t> indexOf(std::string_view name) const {
    const auto found = indices.find(name);
    return found == indices.end() ? std::nullopt : std::optional(found->second);
  }
};

class UsdPrims {
 public:
  /// Both must live as long; `file` is its name.
  UsdPrims(const UsdLayer& layer, const std::string& file);

  const UsdLayer& layer() const { return layer_; }
  const UsdPrim& operator[](std::uint32_t prim) const { return layer_.prims[prim]; }
  std::string pathOf(std::uint32_t prim) const { return usdPathOf(layer_, prim); }
  Error wrong(std::uint32_t prim, const std::string& sentence) const;

  /// Whether it and all above it are defined and active.
  bool isThere(std::uint32_t prim) const;
  /// An Error where other files compose it or a prim above it.
  Status checkComposition(std::uint32_t prim) const;

  /// The prim's own, or that of the nearest above it that has a value. Nothing where "None" stands in the
  /// way.
  std::optional<UsdProperty> nearest(std::uint32_t prim, std::string_view name) const;
  /// Of a path from the root, or of "../Skeleton" from a prim; nothing where there is none.
  std::optional<std::uint32_t> primAt(std::string_view path, std::uint32_t from) const;
  /// The prim of this type at the target of a relationship. Errors: none there, or of another type; one that
  /// other files compose.
  Result<std::uint32_t> targetOf(const UsdProperty& relationship, std::size_t which,
                                 std::string_view type) const;
  /// Likewise of its only target.
  Result<std::uint32_t> onlyTargetOf(const UsdProperty& relationship, std::string_view type) const;

  /// Its value, which `mustStay` for the reason told, and is not given by a connection.
  Result<const UsdValue*> constantOf(const UsdProperty& property, std::string_view mustStay) const;
  /// The texts of an attribute; none where there is no such. Errors: one is there twice; they change.
  Result<UsdNames> namesOf(std::uint32_t prim, std::string_view attribute) const;

  /// 24 where the file does not say.
  Result<double> timeCodesPerSecond() const;

 private:
  const UsdLayer& layer_;
  const std::string& file_;
  std::map<std::pair<std::uint32_t, std::string_view>, std::uint32_t> children_;  // of (parent, name)
};

}  // namespace ringlet
