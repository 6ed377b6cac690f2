// UsdLayer: what a USD file says of its prims, as far as strands of hair or a mesh that moves need it, from
// text (usda_file.h) or from a crate (usdc_file.h). usd_groom.h makes a groom of it, motion/usd_mesh.h a
// mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet {

inline constexpr std::uint32_t kNoUsdPrim = 0xffffffff;
inline constexpr std::size_t kDeepestUsdPrim = 256;     // levels; files of people have ten
inline constexpr std::size_t kMostUsdAttributes = 256;  // of a prim, of those that are kept
inline constexpr std::size_t kMostUsdEntries = 256;     // of a dictionary of metadata

/// A value: numbers, or texts (strings and tokens).
struct UsdValue {
  std::vector<double> numbers;  // one element after the other
  std::size_t width = 1;        // numbers of an element: 3 of a point, 16 of a matrix, a row after the other
  std::vector<std::string_view> texts;
  bool isBlocked = false;  // "None": there is no value
};

/// Where a sample of a crate is.
struct UsdSamplePlace {
  double time = 0;
  std::uint64_t rep = 0;  // the value's 64 bits (usdc_format.h)
};

struct UsdSample {
  double time = 0;
  UsdValue value{};
};

/// An attribute; or a relationship, whose value is the paths of its targets as texts, blocked where it is
/// said to have none.
struct UsdAttribute {
  std::string_view name;
  UsdValue value{};                      // the first sample's, where it has samples
  bool isSampled = false;                // and it has more than one
  std::optional<double> time{};          // of the sample
  std::optional<double> emptyTime{};     // of a sample before it that is empty (mayBeginEmpty)
  std::vector<UsdSamplePlace> places{};  // of all samples, where these are asked for in place of the value
  std::vector<UsdSample> samples{};      // all, by rising time, where these are asked for
  std::string_view type{}, interpolation{};  // "color3f[]", "uniform"; "" for none stated
  std::string_view drivenBy{};               // "a connection" or "a spline"; empty for neither
};

/// An entry of a dictionary: a value, or a dictionary, of which nothing is kept.
struct UsdEntry {
  std::string_view key{};
  UsdValue value{};
  bool isDictionary = false;
};

/// A clip set, as the metadata `clips` of a prim have it.
struct UsdClipSet {
  std::string_view name{};
  std::vector<UsdEntry> entries{};
  bool isDictionary = true;
};

/// A change of the order in which clip sets count: "prepend", "delete" ..., "" for a whole list in its place.
struct UsdNameEdit {
  std::string_view edit{};
  std::vector<std::string_view> names{};
};

enum class UsdSpecifier { def, over, abstract };  // abstract: a class

struct UsdPrim {
  std::string_view name, type;  // no type: ""
  std::uint32_t parent = kNoUsdPrim;
  UsdSpecifier specifier = UsdSpecifier::def;
  bool isActive = true;
  std::string_view composedBy;           // the first field that brings in other prims: "references" ...
  std::string_view deformedBy{};         // the first property that isUsdDeformation() names
  std::vector<UsdAttribute> attributes;  // those that isKeptUsdAttribute() and ...Relationship() name
  std::vector<UsdClipSet> clips{};       // of meshes; strands have them in composedBy
  std::vector<UsdNameEdit> clipSets{};
};

struct UsdLayer {
  std::size_t byteCount = 0;   // of the file that said all this
  std::vector<UsdPrim> prims;  // in the file's order, parents first
  std::optional<double> metresPerUnit, timeCodesPerSecond;
  std::string_view upAxis;            // "" where the file does not say
  std::string_view composedBy;        // as of a prim, of the whole layer
  std::vector<char> text;             // what views are into, unless they are into the file's own bytes
  std::deque<std::string> targets{};  // likewise, of relationships, and texts without their escapes
};

/// Whether it is one of those that are carried from a groom to its animation.
inline bool isUsdValue(std::string_view name) {
  return name == "widths" || name == "ids" || name.starts_with("primvars:");
}

/// What of a file is kept: of strands their first samples, of those that move and of meshes all.
enum class UsdContent { strands, strandsAndValues, movingStrands, meshes };

/// Whether all samples are kept and not the first.
inline bool keepsUsdSamples(UsdContent content) {
  return content == UsdContent::movingStrands || content == UsdContent::meshes;
}

/// Whether a mesh that moves needs it: its points and faces, and what deforms it (motion/usd_skin.h). A prim
/// without a type, as clips have them, may be of any.
inline bool isUsdMeshAttribute(std::string_view primType, std::string_view name) {
  const auto mayBe = [&](std::string_view type) { return primType == type || primType.empty(); };
  if (name.starts_with("primvars:skel:") || name == "skel:joints") return true;
  if (mayBe("Mesh") && (name == "points" || name == "faceVertexCounts" || name == "faceVertexIndices" ||
                        name == "orientation" || name == "subdivisionScheme" || name == "skel:blendShapes"))
    return true;
  if (mayBe("Skeleton") && (name == "joints" || name == "bindTransforms" || name == "restTransforms"))
    return true;
  if (mayBe("SkelAnimation") && (name == "joints" || name == "translations" || name == "rotations" ||
                                 name == "scales" || name == "blendShapes" || name == "blendShapeWeights"))
    return true;
  return mayBe("BlendShape") &&
         (name == "offsets" || name == "pointIndices" || name.starts_with("inbetweens:"));
}

/// Whether the targets of the relationship are kept.
inline bool isKeptUsdRelationship(std::string_view name, UsdContent content) {
  return content == UsdContent::meshes &&
         (name == "skel:skeleton" || name == "skel:animationSource" || name == "skel:blendShapeTargets");
}

/// Whether the attribute of a prim of this type is kept; all others are read over. Widths of strands always
/// are.
inline bool isKeptUsdAttribute(std::string_view primType, std::string_view name, UsdContent content) {
  if (name == "xformOpOrder" || name == "visibility" || name == "purpose" || name.starts_with("xformOp:"))
    return true;
  if (content == UsdContent::meshes) return isUsdMeshAttribute(primType, name);
  const bool keepsValues = content == UsdContent::strandsAndValues;
  if (primType == "BasisCurves" && (name == "widths" || (keepsValues && isUsdValue(name)))) return true;
  return primType == "BasisCurves" && (name == "points" || name == "curveVertexCounts" || name == "type" ||
                                       name == "basis" || name == "wrap");
}

/// Whether what a prim has under this name binds it, or what is below it, to a skeleton or to blend shapes.
inline bool isUsdDeformation(std::string_view name) {
  return name == "skel:skeleton" || name == "primvars:skel:jointIndices" ||
         name == "primvars:skel:jointWeights" || name == "skel:blendShapes" ||
         name == "skel:blendShapeTargets";
}

/// Whether strands have a value between two samples' there; of all else the sample before holds.
inline bool goesBetweenUsdSamples(std::string_view name) {
  return name == "points" || name.starts_with("xformOp:");
}

/// Of which time strands have a value at a time: visibility is that of its first sample.
inline double usdTimeOf(std::string_view name, double time) {
  return name == "visibility" ? -std::numeric_limits<double>::infinity() : time;
}

/// Whether its first samples count for nothing as long as they are empty: hair that is not there yet.
inline bool mayBeginEmpty(std::string_view name) { return name == "points" || name == "curveVertexCounts"; }

/// 24 where the file does not say. Errors, which begin with the file's `name`: a rate that is none.
Result<double> usdTimeCodesPerSecond(const UsdLayer& layer, const std::string& name);

/// Null where the prim has none of this name, or none that is kept.
const UsdAttribute* usdAttributeOf(const UsdPrim& prim, std::string_view name);

/// The token of an attribute, or what holds without one.
std::string_view usdTokenOf(const UsdPrim& prim, std::string_view name, std::string_view otherwise);

/// "/Head/Hair"; control characters are shown as \xNN.
std::string usdPathOf(const UsdLayer& layer, std::uint32_t prim);

}  // namespace ringlet
