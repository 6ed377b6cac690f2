// Implements groom/usd/usdc_file.h: a layer, from the sections (usdc_structure.h) and the values
// (usdc_values.h) of a crate. The format is drawn in usdc_format.h.
#include "ringlet/groom/usd/usdc_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "ringlet/base/little_endian.h"
#include "ringlet/groom/usd/usdc_format.h"
#include "ringlet/groom/usd/usdc_structure.h"
#include "ringlet/groom/usd/usdc_values.h"

namespace ringlet {
namespace {

using namespace usdc;

// Bounds on the texts of targets, of the file's size: a list of paths is short, what it names may be long.
constexpr std::size_t kTargetTextPerByte = 16, kFreeTargetText = 1 << 20;

// The fields we look at.
enum class Field : std::uint8_t {
  other,
  specifier,
  typeName,
  active,
  children,
  upAxis,
  metresPerUnit,
  timeCodesPerSecond,
  standard,
  samples,
  connection,
  targets,
  spline,
  interpolation,
  composing,
  clips,
  clipSets
};
constexpr std::pair<std::string_view, Field> kFields[] = {{"specifier", Field::specifier},
                                                          {"typeName", Field::typeName},
                                                          {"active", Field::active},
                                                          {"primChildren", Field::children},
                                                          {"upAxis", Field::upAxis},
                                                          {"metersPerUnit", Field::metresPerUnit},
                                                          {"timeCodesPerSecond", Field::timeCodesPerSecond},
                                                          {"default", Field::standard},
                                                          {"interpolation", Field::interpolation},
                                                          {"timeSamples", Field::samples},
                                                          {"connectionPaths", Field::connection},
                                                          {"targetPaths", Field::targets},
                                                          {"spline", Field::spline},
                                                          {"subLayers", Field::composing},
                                                          {"layerRelocates", Field::composing},
                                                          {"relocates", Field::composing},
                                                          {"references", Field::composing},
                                                          {"payload", Field::composing},
                                                          {"inheritPaths", Field::composing},
                                                          {"specializes", Field::composing},
                                                          {"variantSetNames", Field::composing},
                                                          {"variantSelection", Field::composing},
                                                          {"clips", Field::clips},
                                                          {"clipSets", Field::clipSets}};

struct Child {
  std::uint32_t parent, token, path;
  bool isProperty;
  auto key() const { return std::tuple(parent, isProperty, token); }
};

class CrateReader {
 public:
  CrateReader(std::span<const std::byte> bytes, const std::string& name, UsdcReading reading)
      : crate_(bytes, name), values_(crate_), reading_(reading) {}

  Result<UsdLayer> read() {
    if (Status read = crate_.read(); !read) return read.error();
    for (const std::string_view token : crate_.tokens()) {
      const auto* known = std::ranges::find(kFields, token, &std::pair<std::string_view, Field>::first);
      meaning_.push_back(known == std::end(kFields) ? Field::other : known->second);
    }
    if (Status read = readPrims(); !read) return read.error();
    layer_.text = crate_.takeText();
    return std::move(layer_);
  }

 private:
  Field meaningOf(const NamedField& field) const { return meaning_[field.token]; }

  Status readPrims() {
    if (crate_.root() == kNone ||
        crate_.paths()[crate_.root()].spec != static_cast<std::uint8_t>(SpecType::root))
      return Error{fmt::format("{}: has no root, which holds all prims", crate_.name())};
    for (std::size_t i = 0; i < crate_.paths().size(); ++i) {
      const Path& path = crate_.paths()[i];
      if (path.isFound && path.parent != kNone && path.spec != 0)
        children_.push_back({path.parent, path.token, static_cast<std::uint32_t>(i), path.isProperty});
    }
    std::ranges::sort(children_, {}, &Child::key);

    struct Waiting {
      std::uint32_t path, parent;
      std::size_t depth;
    };
    std::vector<Waiting> waiting;
    const auto addChildren = [&](std::uint32_t path, std::uint32_t prim, std::size_t depth) -> Status {
      std::vector<std::uint32_t> paths;
      if (Status listed = listChildren(path, paths); !listed) return listed;
      for (std::size_t i = paths.size(); i-- > 0;) waiting.push_back({paths[i], prim, depth});
      return {};
    };
    isVisited_.resize(crate_.paths().size());
    isVisited_[crate_.root()] = true;
    if (Status read = readLayerFields(); !read) return read;
    if (Status added = addChildren(crate_.root(), kNoUsdPrim, 1); !added) return added;
    while (!waiting.empty()) {
      const Waiting next = waiting.back();
      waiting.pop_back();
      if (next.depth > kDeepestUsdPrim)
        return Error{
            fmt::format("{}: found more than {} prims in each other", crate_.name(), kDeepestUsdPrim)};
      const auto prim = static_cast<std::uint32_t>(layer_.prims.size());
      layer_.prims.push_back({.name = crate_.tokens()[crate_.paths()[next.path].token],
                              .type = {},
                              .parent = next.parent,
                              .composedBy = {},
                              .attributes = {}});
      if (Status read = readPrim(next.path, layer_.prims.back()); !read) return read;
      if (Status added = addChildren(next.path, prim, next.depth + 1); !added) return added;
    }
    return {};
  }

  // The paths of a prim's children, in its own order.
  Status listChildren(std::uint32_t path, std::vector<std::uint32_t>& paths) {
    return crate_.forEachField(path, [&](const NamedField& field) -> Status {
      if (meaningOf(field) != Field::children) return {};
      const std::uint64_t at = field.rep.payload();
      if (field.rep.type() != kTokenVectorType || !crate_.has(at, 8))
        return crate_.wrong(at, "no list of prims", "one");
      const std::uint64_t count = readU64(crate_.bytes(), at);
      if (count > (crate_.bytes().size() - at - 8) / 4)
        return crate_.ended(at, fmt::format("{} prims", count));
      for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint32_t token = readU32(crate_.bytes(), at + 8 + 4 * i);
        const auto found =
            std::ranges::lower_bound(children_, std::tuple(path, false, token), {}, &Child::key);
        const bool isThere = found != children_.end() && found->key() == std::tuple(path, false, token) &&
                             crate_.paths()[found->path].spec == static_cast<std::uint8_t>(SpecType::prim);
        if (!isThere || isVisited_[found->path])
          return crate_.wrong(at + 8 + 4 * i, fmt::format("name {} of a prim", token),
                              "one that is there, once");
        isVisited_[found->path] = true;
        paths.push_back(found->path);
      }
      return {};
    });
  }

  Status readLayerFields() {
    return crate_.forEachField(crate_.root(), [&](const NamedField& field) -> Status {
      if (meaningOf(field) == Field::upAxis) {
        auto axis = values_.nameOf(field.rep);
        if (!axis) return axis.error();
        layer_.upAxis = *axis;
      } else if (meaningOf(field) == Field::metresPerUnit) {
        auto number = values_.numberOf(field.rep);
        if (!number) return number.error();
        layer_.metresPerUnit = *number;
      } else if (meaningOf(field) == Field::timeCodesPerSecond) {
        auto number = values_.numberOf(field.rep);
        if (!number) return number.error();
        layer_.timeCodesPerSecond = *number;
      } else if (meaningOf(field) == Field::composing && values_.isFilled(field.rep) &&
                 layer_.composedBy.empty()) {
        layer_.composedBy = crate_.tokens()[field.token];
      }
      return {};
    });
  }

  Status readPrim(std::uint32_t path, UsdPrim& prim) {
    Status read = crate_.forEachField(path, [&](const NamedField& field) -> Status {
      if (meaningOf(field) == Field::specifier) {
        const std::uint32_t number = field.rep.low();
        if (field.rep.type() != kSpecifierType || number > 2)
          return Error{fmt::format("{}: {}: found specifier {}; expected 0 to 2", crate_.name(),
                                   crate_.describe(path), number)};
        prim.specifier = static_cast<UsdSpecifier>(number);
      } else if (meaningOf(field) == Field::typeName) {
        auto type = values_.nameOf(field.rep);
        if (!type) return type.error();
        prim.type = *type;
      } else if (meaningOf(field) == Field::active) {
        auto number = values_.numberOf(field.rep);
        if (!number) return number.error();
        prim.isActive = *number != 0;
      } else if (isComposing(field) && values_.isFilled(field.rep) && prim.composedBy.empty()) {
        prim.composedBy = crate_.tokens()[field.token];
      } else if (reading_.content == UsdContent::meshes) {
        return readClips(field, prim);
      }
      return {};
    });
    if (!read) return read;

    // The counts last: there are no more of them than points, and packed ones could claim to be.
    std::uint64_t points = 0;
    for (const bool isCounts : {false, true}) {
      for (auto child = std::ranges::lower_bound(children_, std::tuple(path, true, 0u), {}, &Child::key);
           child != children_.end() && child->parent == path && child->isProperty; ++child) {
        const std::string_view name = crate_.tokens()[child->token];
        if (!isCounts && isUsdDeformation(name) && prim.deformedBy.empty()) {
          const auto isFilled = holdsSomething(child->path);
          if (!isFilled) return isFilled.error();
          if (*isFilled) prim.deformedBy = name;
        }
        if (!isCounts && isKeptRelationship(*child)) {
          prim.attributes.push_back({.name = name});
          if (Status done = readTargets(child->path, prim.attributes.back()); !done) return done;
          continue;
        }
        if (!isKept(prim, name) || isCounts != (name == "curveVertexCounts")) continue;
        if (crate_.paths()[child->path].spec != static_cast<std::uint8_t>(SpecType::attribute)) continue;
        if (prim.attributes.size() == kMostUsdAttributes)
          return Error{fmt::format("{}: {} has more than {} transforms", crate_.name(), crate_.describe(path),
                                   kMostUsdAttributes)};
        prim.attributes.push_back({.name = name});
        if (Status done =
                readAttribute(child->path, isCounts ? points : ~std::uint64_t{0}, prim.attributes.back());
            !done)
          return done;
        if (name == "points")
          points = reading_.keepsPlaces ? ~std::uint64_t{0} : prim.attributes.back().value.numbers.size();
      }
    }
    return {};
  }

  Status readAttribute(std::uint32_t path, std::uint64_t mostElements, UsdAttribute& attribute) {
    return crate_.forEachField(path, [&](const NamedField& field) -> Status {
      if (meaningOf(field) == Field::samples) {
        if (field.rep.type() != kSamplesType || !field.rep.isKnown())
          return Error{fmt::format("{}: {}: found no time samples where they are named", crate_.name(),
                                   crate_.describe(path))};
        using Kept = usdc::CrateValues::Kept;
        const Kept kept = reading_.keepsPlaces                ? Kept::places
                          : keepsUsdSamples(reading_.content) ? Kept::all
                                                              : Kept::first;
        const Status read = reading_.time
                                ? values_.readSamplesAt(*reading_.time, field.rep, mostElements, attribute)
                                : values_.readSamples(field.rep, mostElements, kept, attribute);
        return isOnlyCarried(attribute) ? Status{} : read;
      }
      if (meaningOf(field) == Field::standard && !attribute.time) {
        return takeValue(values_.valueOf(field.rep, mostElements), attribute);
      } else if (meaningOf(field) == Field::typeName || meaningOf(field) == Field::interpolation) {
        auto name = values_.nameOf(field.rep);
        if (!name) return name.error();
        (meaningOf(field) == Field::typeName ? attribute.type : attribute.interpolation) = *name;
      } else if (meaningOf(field) == Field::connection && values_.isFilled(field.rep)) {
        attribute.drivenBy = "a connection";
      } else if (meaningOf(field) == Field::spline) {
        attribute.drivenBy = "a spline";
      }
      return {};
    });
  }

  // Clips bring in other files; only who reads meshes follows them.
  bool isComposing(const NamedField& field) const {
    return meaningOf(field) == Field::composing ||
           (meaningOf(field) == Field::clips && reading_.content != UsdContent::meshes);
  }

  Status readClips(const NamedField& field, UsdPrim& prim) {
    if (meaningOf(field) == Field::clips)
      return values_.readDictionary(field.rep, [&](std::string_view name, Rep rep) -> Status {
        UsdClipSet& set = prim.clips.emplace_back(UsdClipSet{.name = name});
        set.isDictionary = rep.type() == kDictionaryType;
        if (!set.isDictionary) return {};
        return values_.readDictionary(rep, [&](std::string_view key, Rep value) -> Status {
          UsdEntry& entry = set.entries.emplace_back(UsdEntry{.key = key});
          entry.isDictionary = value.type() == kDictionaryType;
          return entry.isDictionary ? Status{} : takeEntry(value, entry.value);
        });
      });
    return meaningOf(field) == Field::clipSets ? values_.readNameEdits(field.rep, prim.clipSets) : Status{};
  }
  // A value of a kind that no clip set has is none.
  Status takeEntry(Rep rep, UsdValue& value) {
    if (!CrateValues::isRead(rep)) return {};
    auto read = values_.valueOf(rep.type() == kAssetType ? rep.asType(kTokenType) : rep);
    if (!read) return read.error();
    value = std::move(*read);
    return {};
  }

  // Of a relationship or an attribute of any type, whose values are not looked at.
  Result<bool> holdsSomething(std::uint32_t path) const {
    bool isFilled = false;
    Status read = crate_.forEachField(path, [&](const NamedField& field) -> Status {
      const Field meaning = meaningOf(field);
      if (meaning == Field::targets || meaning == Field::standard || meaning == Field::samples)
        isFilled |= values_.isFilled(field.rep);
      return {};
    });
    if (!read) return read.error();
    return isFilled;
  }

  bool isKept(const UsdPrim& prim, std::string_view name) const {
    return isKeptUsdAttribute(prim.type, name, reading_.content) ||
           (reading_.keepsPlaces && (name == "extent" || name == "velocities"));
  }

  bool isKeptRelationship(const Child& property) const {
    return crate_.paths()[property.path].spec == static_cast<std::uint8_t>(SpecType::relationship) &&
           isKeptUsdRelationship(crate_.tokens()[property.token], reading_.content);
  }

  // The paths that its list brings in, in the order of the file.
  Status readTargets(std::uint32_t path, UsdAttribute& relationship) {
    return crate_.forEachField(path, [&](const NamedField& field) -> Status {
      if (meaningOf(field) != Field::targets) return {};
      std::uint64_t at = field.rep.payload();
      if (field.rep.type() != kPathListType || !crate_.has(at, 1))
        return crate_.wrong(at, "no list of paths", "one");
      const unsigned lists = std::to_integer<unsigned>(crate_.bytes()[at++]);
      for (const unsigned list : {2u, 4u, 32u, 64u}) {
        if ((lists & list) == 0) continue;
        if (!crate_.has(at, 8)) return crate_.ended(at, "a list of paths");
        const std::uint64_t count = readU64(crate_.bytes(), at);
        at += 8;
        if (count > (crate_.bytes().size() - at) / 4) return crate_.ended(at, fmt::format("{} paths", count));
        for (std::uint64_t i = 0; i < count; ++i, at += 4)
          if (Status added = addTarget(at, relationship); !added) return added;
      }
      relationship.value.isBlocked = relationship.value.texts.empty();
      return {};
    });
  }

  // The path whose number is there.
  Status addTarget(std::uint64_t at, UsdAttribute& relationship) {
    const std::uint32_t target = readU32(crate_.bytes(), at);
    const std::vector<Path>& paths = crate_.paths();
    if (target >= paths.size() || !paths[target].isFound)
      return crate_.wrong(at, fmt::format("path {}", target), "one that is there");
    const std::size_t most = crate_.mostOf(kTargetTextPerByte, kFreeTargetText);
    std::string text;
    std::size_t depth = 0;
    for (std::uint32_t p = target; p != crate_.root(); p = paths[p].parent) {
      if (p == kNone || ++depth > kDeepestUsdPrim)
        return crate_.wrong(at, fmt::format("path {}", target), "one of fewer levels");
      text = (paths[p].isProperty ? "." : "/") + std::string(crate_.tokens()[paths[p].token]) + text;
      if (targetText_ + text.size() > most)
        return crate_.wrong(at, "more paths",
                            fmt::format("at most {} bytes of them in so small a file", most));
    }
    targetText_ += text.size() + sizeof(std::string);
    layer_.targets.push_back(std::move(text));
    relationship.value.texts.push_back(layer_.targets.back());
    return {};
  }

  // What is only carried along from a groom to its animation may be of a kind that is not read.
  bool isOnlyCarried(const UsdAttribute& attribute) const {
    return reading_.content != UsdContent::meshes && isUsdValue(attribute.name);
  }
  Status takeValue(Result<UsdValue> value, UsdAttribute& attribute) const {
    if (!value && !isOnlyCarried(attribute)) return value.error();
    if (value) {
      attribute.value = std::move(*value);
    } else {
      attribute.value.isBlocked = true;
    }
    return {};
  }

  CrateStructure crate_;
  CrateValues values_;
  UsdcReading reading_;
  std::vector<Field> meaning_;  // of each token
  std::vector<Child> children_;
  std::vector<bool> isVisited_;  // of each path
  std::size_t targetText_ = 0;   // bytes of all targets so far
  UsdLayer layer_;
};

}  // namespace

bool isUsdc(std::span<const std::byte> bytes) {
  return bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

Result<UsdLayer> readUsdc(std::span<const std::byte> bytes, const std::string& name, UsdcReading reading) {
  return CrateReader(bytes, name, reading).read();
}

}  // namespace ringlet
