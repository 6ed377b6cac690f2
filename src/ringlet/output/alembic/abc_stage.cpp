// Implements output/alembic/abc_stage.h.
#include "ringlet/output/alembic/abc_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/output/usd/usd_carried.h"
#include "ringlet/output/usd/usd_hair_stage.h"

namespace ringlet {
namespace {

constexpr const char* kClosestGuides = "groom_closest_guides";

constexpr std::string_view kAbcPrimvar = "primvars:", kAbcOfGroom = "userProperties:",
                           kAbcIndices = ":indices";
constexpr char kMatrixOp = 3 << 4;  // a matrix, which nothing says more of

AbcType abcTypeOf(usdc::Kind kind) {
  switch (kind) {
    case usdc::Kind::boolean:
      return AbcType::boolean;
    case usdc::Kind::u8:
      return AbcType::u8;
    case usdc::Kind::i32:
      return AbcType::i32;
    case usdc::Kind::u32:
      return AbcType::u32;
    case usdc::Kind::i64:
      return AbcType::i64;
    case usdc::Kind::u64:
      return AbcType::u64;
    case usdc::Kind::half:
      return AbcType::f16;
    case usdc::Kind::f32:
      return AbcType::f32;
    case usdc::Kind::f64:
      return AbcType::f64;
    default:
      return AbcType::text;
  }
}

// As a type's metadata has it.
const char* podNameOf(AbcType type) {
  constexpr std::array<const char*, 13> kNames{"bool_t",    "uint8_t",   "int8_t",   "uint16_t", "int16_t",
                                               "uint32_t",  "int32_t",   "uint64_t", "int64_t",  "float16_t",
                                               "float32_t", "float64_t", "string"};
  return kNames[static_cast<std::size_t>(type)];
}

// "rgb" of color3f, by USD's name of the type.
std::string_view abcMeaningOf(std::string_view usdType, unsigned width) {
  if (usdType.starts_with("color")) return width == 3 ? "rgb" : "rgba";
  if (usdType.starts_with("texCoord")) return "vector";
  for (const std::string_view role : {"vector", "normal", "point", "matrix"})
    if (usdType.starts_with(role)) return role;
  return "";
}

std::string_view abcScopeOf(const UsdStageAttribute& attribute) {
  const std::string_view per = interpolationOf(attribute.name, attribute.interpolation);
  if (per == "uniform") return "uni";
  if (per == "vertex") return "vtx";
  if (per == "varying") return "var";
  return per == "faceVarying" ? "fvr" : "con";
}

std::string abcValuesOf(const UsdStageAttribute& attribute, AbcType type) {
  std::string bytes;
  for (const double number : attribute.numbers) putAbcNumber(bytes, type, number);
  for (std::string text : attribute.texts) {
    std::erase(text, '\0');
    bytes += text;
    bytes.push_back('\0');
  }
  return bytes;
}

// A geometry parameter; `indices`: into its values, or null.
AbcOutProperty abcParamOf(std::string name, const UsdStageAttribute& attribute,
                          const UsdStageAttribute* indices) {
  const auto usdType = usdTypeOf(attribute.type);
  RINGLET_ASSERT(usdType, "a type that is written");
  AbcOutProperty param{.name = std::move(name), .kind = AbcKind::array, .type = abcTypeOf(usdType->kind())};
  if (param.name == "width") param.type = AbcType::f32;                    // of floats, whatever the file had
  if (param.name.starts_with("groom_version")) param.type = AbcType::i16;  // as Unreal's schema has it
  if (param.name == kClosestGuides) param.type = AbcType::i32;
  param.width = static_cast<unsigned>(usdType->width());
  param.values = abcValuesOf(attribute, param.type);
  const std::string_view meaning = abcMeaningOf(attribute.type, param.width);
  const std::string said = meaning.empty() ? "" : fmt::format("interpretation={};", meaning);
  param.metadata = fmt::format("arrayExtent=1;geoScope={};{}isGeomParam=true;podExtent={};podName={}",
                               abcScopeOf(attribute), said, param.width, podNameOf(param.type));
  if (!indices) return param;
  AbcOutProperty indexed{.name = param.name, .metadata = param.metadata};
  AbcOutProperty places{.name = ".indices", .kind = AbcKind::array, .type = AbcType::u32};
  places.values = abcValuesOf(*indices, places.type);
  param.name = ".vals";
  indexed.parts = {std::move(param), std::move(places)};
  return indexed;
}

// What the schema has of its own, or a property of `.arbGeomParams`.
std::string abcNameOf(const UsdStageAttribute& attribute) {
  std::string_view name = attribute.name;
  for (const std::string_view prefix : {kAbcPrimvar, kAbcOfGroom})
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  const bool isOfPairs = attribute.type.starts_with("texCoord2f") || attribute.type.starts_with("float2");
  if (name == "st" && isOfPairs && abcScopeOf(attribute) == "uni") return "uv";
  return std::string(attribute.name == "widths" ? "width" : name);
}

// The guides of each strand by their ids, and their shares: three integers are no type of USD.
void addClosestGuides(const std::vector<ClosestGuides>& closest, std::vector<UsdStageAttribute>& attributes) {
  const auto ids = std::ranges::find(attributes, "primvars:groom_id", &UsdStageAttribute::name);
  if (closest.empty() || ids == attributes.end()) return;
  UsdStageAttribute guides{.name = kClosestGuides, .type = "float3[]", .interpolation = "uniform"};
  UsdStageAttribute shares{.name = "groom_guide_weights", .type = "float3[]", .interpolation = "uniform"};
  for (const ClosestGuides& each : closest) {
    for (const std::uint32_t strand : each.strands) guides.numbers.push_back(ids->numbers[strand]);
    for (const float share : each.shares) shares.numbers.push_back(static_cast<double>(share));
  }
  attributes.push_back(std::move(guides));
  attributes.push_back(std::move(shares));
}

// All that does not move, of one prim's attributes.
void addAbcParams(std::vector<UsdStageAttribute>& attributes, const UsdExtras& usd,
                  std::vector<AbcOutProperty>& geometry) {
  if (usd.unreal) addClosestGuides(usd.closestGuides, attributes);
  constexpr std::string_view kShape[] = {"curveVertexCounts", "type",     "wrap",
                                         "xformOpOrder",      kUsdPoints, kUsdExtent};
  AbcOutProperty others{.name = ".arbGeomParams"};
  for (const UsdStageAttribute& attribute : attributes) {
    const bool isShape = std::ranges::find(kShape, attribute.name) != std::end(kShape);
    if (isShape || attribute.elementsOfSample > 0 || attribute.name.ends_with(kAbcIndices)) continue;
    const auto indices =
        std::ranges::find(attributes, attribute.name + std::string(kAbcIndices), &UsdStageAttribute::name);
    AbcOutProperty param =
        abcParamOf(abcNameOf(attribute), attribute, indices == attributes.end() ? nullptr : &*indices);
    const bool isOwn = param.name == "width" || param.name == "uv";
    (isOwn ? geometry : others.parts).push_back(std::move(param));
  }
  if (!others.parts.empty()) geometry.push_back(std::move(others));
}

std::string abcMeasuresOf(double metresPerUnit, std::optional<UpAxis> up) {
  std::string text = fmt::format(";{}={}", kAbcUnit, metresPerUnit);
  if (up) text += fmt::format(";{}={}", kAbcUp, *up == UpAxis::y ? "Y" : "Z");
  return text;
}

// A matrix a frame.
void addAbcTransform(std::vector<AbcOutProperty>& transform) {
  std::string channels;
  for (unsigned k = 0; k < kAbcMatrixNumbers; ++k) putAbcU32(channels, k);
  const std::string yes(1, '\1');
  transform = {
      {.name = ".inherits", .kind = AbcKind::scalar, .values = yes, .isCounted = true},
      {.name = ".ops", .kind = AbcKind::scalar, .type = AbcType::u8, .values = std::string(1, kMatrixOp)},
      {.name = ".vals",
       .kind = AbcKind::scalar,
       .type = AbcType::f64,
       .width = kAbcMatrixNumbers,
       .sampleBytes = 8 * std::size_t{kAbcMatrixNumbers},
       .isCounted = true},
      {.name = "isNotConstantIdentity", .kind = AbcKind::scalar, .values = yes},
      {.name = ".animChans", .kind = AbcKind::array, .type = AbcType::u32, .values = std::move(channels)}};
}

}  // namespace

AbcStage abcStageOf(const Groom& topology, const AnimationOptions& options) {
  AnimationOptions own = options;
  own.usd.originPrims = false;
  HairStage hair = hairStageOf(topology, own);
  AbcStage stage{.archive = abcHairOf(topology), .margin = hair.curves.front().margin};
  AbcOutArchive& archive = stage.archive;
  archive.metadata += fmt::format(";{}={}", kAbcRate, options.framesPerSecond) +
                      abcMeasuresOf(options.metresPerUnit, options.up);
  archive.samplings.push_back(
      {1 / options.framesPerSecond, options.usd.firstTimeCode / options.framesPerSecond, 0});

  if (options.usd.head == UsdHead::transform) addAbcTransform(abcTransformOf(archive));
  std::vector<AbcOutProperty>& geometry = abcGeometryOf(archive);
  const std::size_t pointBytes = sizeof(Vec3f) * topology.firstPoint.back();
  for (AbcOutProperty& property : geometry) {
    if (property.name == ".selfBnds") property.sampleBytes = 2 * 3 * sizeof(double);
    if (property.name == kAbcPoints) property.sampleBytes = pointBytes;
    property.isCounted |= property.isMoving();
  }
  if (options.usd.velocities)
    geometry.push_back({.name = kAbcVelocities,
                        .metadata = "interpretation=vector",
                        .kind = AbcKind::array,
                        .type = AbcType::f32,
                        .width = 3,
                        .sampleBytes = pointBytes,
                        .isCounted = true,
                        .comesLater = true});
  addAbcParams(hair.stage.prims.front().attributes, options.usd, geometry);
  return stage;
}

AbcOutArchive abcGroomOf(const Groom& groom, const GroomWriting& writing) {
  HairStage hair = groomStageOf(groom, writing);
  std::vector<UsdStageAttribute>& attributes = hair.stage.prims.front().attributes;
  AbcOutArchive archive = abcHairOf(groom);
  archive.metadata += abcMeasuresOf(hair.stage.metresPerUnit, hair.stage.up);
  std::vector<AbcOutProperty>& geometry = abcGeometryOf(archive);
  for (AbcOutProperty& property : geometry) {
    if (property.name == ".selfBnds") {
      const auto extent = std::ranges::find(attributes, kUsdExtent, &UsdStageAttribute::name);
      for (const double number : extent->numbers) putAbcF64(property.values, number);
    } else if (property.name == kAbcPoints) {
      property.values.resize(sizeof(Vec3f) * groom.points.size());
      putAbcPoints(groom.points, property.values, 0);
    }
  }
  addAbcParams(attributes, writing.usd, geometry);
  return archive;
}

}  // namespace ringlet
