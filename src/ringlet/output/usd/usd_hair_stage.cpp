// Implements output/usd/usd_hair_stage.h.
#include "ringlet/output/usd/usd_hair_stage.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/base/bounds.h"
#include "ringlet/output/usd/usd_carried.h"
#include "ringlet/output/usd/usd_unreal.h"

namespace ringlet {
namespace {

UsdStageAttribute tokenOf(std::string name, std::string text) {
  return {.name = std::move(name), .type = "token", .texts = {std::move(text)}, .isUniform = true};
}

// The strands of a prim, and of these their particles.
struct Range {
  std::uint32_t firstStrand, endStrand, firstPoint, endPoint;
};
Range rangeOf(const Groom& topology, const HairCurves& curves) {
  const std::uint32_t end = curves.firstStrand + curves.strandCount;
  return {curves.firstStrand, end, topology.firstPoint[curves.firstStrand], topology.firstPoint[end]};
}

// Evenly from root to tip; without a tip's diameter one number a strand, or for all where none differs.
UsdStageAttribute widthsOf(const Groom& topology, const HairCurves& curves, const AnimationOptions& options) {
  UsdStageAttribute widths{.name = "widths", .type = "float[]", .interpolation = "constant"};
  const std::vector<float>& factors = options.usd.widthFactors;
  const double root = options.diameter / curves.unit;
  if (!options.usd.tipDiameter && factors.empty()) {
    widths.numbers = {static_cast<float>(root)};
    return widths;
  }
  widths.interpolation = options.usd.tipDiameter ? "vertex" : "uniform";
  const Range range = rangeOf(topology, curves);
  for (std::uint32_t s = range.firstStrand; s < range.endStrand; ++s) {
    const double factor = factors.empty() ? 1 : factors[s];
    if (!options.usd.tipDiameter) {
      widths.numbers.push_back(static_cast<float>(factor * root));
      continue;
    }
    const double tip = *options.usd.tipDiameter / curves.unit;
    const std::uint32_t count = topology.firstPoint[s + 1] - topology.firstPoint[s];
    for (std::uint32_t i = 0; i < count; ++i)
      widths.numbers.push_back(
          static_cast<float>(factor * (root + (tip - root) * i / std::max(count - 1, 1u))));
  }
  return widths;
}

// "linear" must be said: the default is cubic.
void addShape(const Groom& topology, const HairCurves& curves, std::vector<UsdStageAttribute>& list) {
  UsdStageAttribute counts{.name = "curveVertexCounts", .type = "int[]"};
  const Range range = rangeOf(topology, curves);
  for (std::uint32_t s = range.firstStrand; s < range.endStrand; ++s)
    counts.numbers.push_back(topology.firstPoint[s + 1] - topology.firstPoint[s]);
  list.push_back(std::move(counts));
  list.push_back(tokenOf("type", "linear"));
}

void addIds(const HairCurves& curves, std::vector<UsdStageAttribute>& list) {
  UsdStageAttribute ids{.name = "primvars:id", .type = "int[]", .interpolation = "uniform"};
  for (std::uint32_t s = 0; s < curves.strandCount; ++s) ids.numbers.push_back(curves.firstStrand + s);
  list.push_back(std::move(ids));
}

void addRest(const Groom& topology, const HairCurves& curves, std::vector<UsdStageAttribute>& list) {
  UsdStageAttribute rest{.name = "primvars:rest", .type = "point3f[]", .interpolation = "vertex"};
  const Range range = rangeOf(topology, curves);
  for (std::uint32_t i = range.firstPoint; i < range.endPoint; ++i) {
    Vec3f p = topology.points[i];
    if (curves.fromGroom) p = Vec3f((*curves.fromGroom)(Vec3d(p)));
    rest.numbers.insert(rest.numbers.end(), {p.x, p.y, p.z});
  }
  list.push_back(std::move(rest));
}

std::vector<double> numbersOf(std::span<const Vec3f> points) {
  std::vector<double> numbers;
  numbers.reserve(3 * points.size());
  for (const Vec3f p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
  return numbers;
}

bool holds(const std::vector<UsdStageAttribute>& list, std::string_view name) {
  return std::ranges::find(list, name, &UsdStageAttribute::name) != list.end();
}

// What one prim of curves has; `carried`: what the groom's file said of them, which goes before ours.
std::vector<UsdStageAttribute> attributesOf(const Groom& topology, const HairCurves& curves,
                                            const AnimationOptions& options, bool hasWidths,
                                            std::vector<UsdStageAttribute> carried) {
  std::vector<UsdStageAttribute> list;
  addShape(topology, curves, list);
  const auto widths = std::ranges::find(carried, "widths", &UsdStageAttribute::name);
  if (widths != carried.end()) {
    list.push_back(std::move(*widths));
    carried.erase(widths);
  } else if (hasWidths) {
    list.push_back(widthsOf(topology, curves, options));
  }
  list.push_back(tokenOf("wrap", "nonperiodic"));
  for (UsdStageAttribute& value : carried) list.push_back(std::move(value));
  if (options.usd.ids && !holds(list, "primvars:id")) addIds(curves, list);
  if (options.usd.rest && !holds(list, "primvars:rest")) addRest(topology, curves, list);
  if (options.usd.head == UsdHead::transform) {
    list.push_back({.name = "xformOpOrder", .type = "token[]", .texts = {kUsdHead}, .isUniform = true});
    list.push_back({.name = kUsdHead, .type = "matrix4d", .elementsOfSample = 1});
  }

  // What moves.
  const Range range = rangeOf(topology, curves);
  const std::size_t pointCount = range.endPoint - range.firstPoint;
  list.push_back({.name = kUsdExtent, .type = "float3[]", .elementsOfSample = 2});
  if (options.usd.velocities)
    list.push_back(
        {.name = kUsdVelocities, .type = "vector3f[]", .comesLater = true, .elementsOfSample = pointCount});
  list.push_back({.name = kUsdPoints, .type = "point3f[]", .elementsOfSample = pointCount});
  return list;
}

// The diameter of the thickest strand, halved.
float marginOf(const std::vector<UsdStageAttribute>& list, float diameter) {
  double thickest = diameter;
  for (const UsdStageAttribute& attribute : list) {
    if (attribute.name == "widths" && !attribute.numbers.empty())
      thickest = *std::ranges::max_element(attribute.numbers);
  }
  return static_cast<float>(thickest / 2);
}

// The prim of that path, made with those above it where it is not there.
UsdStagePrim& primAt(std::vector<UsdStagePrim>& prims, std::string_view path) {
  std::vector<UsdStagePrim>* among = &prims;
  UsdStagePrim* prim = nullptr;
  while (!path.empty()) {
    path.remove_prefix(1);  // the slash
    const std::size_t end = std::min(path.find('/'), path.size());
    const std::string_view name = path.substr(0, end);
    path.remove_prefix(end);
    auto found = std::ranges::find(*among, name, &UsdStagePrim::name);
    if (found == among->end())
      found = among->insert(found, {.name = std::string(name), .type = "", .isOver = true});
    prim = &*found;
    among = &prim->children;
  }
  RINGLET_ASSERT(prim, "a path has a name");
  return *prim;
}

// Changes of the groom's prims: its values stand where they are, unless the curves are others now.
void addOriginPrims(const Groom& topology, const AnimationOptions& options, HairStage& made) {
  for (const GroomPrim& prim : options.usd.origin->prims) {
    HairCurves curves{prim.path, prim.firstStrand, prim.strandCount, prim.toGroom.scale(), {}, 0};
    if (prim.toGroom != UsdTransform{}) curves.fromGroom = prim.toGroom.inverse();
    std::vector<UsdStageAttribute> carried;
    bool statesWidths = false;
    for (const GroomValue& value : prim.values) {
      if (!isWritten(value)) continue;
      statesWidths |= value.name == "widths";
      if (!prim.isWhole) carried.push_back(carriedOf(value, 1));
    }
    UsdStagePrim& over = primAt(made.stage.prims, prim.path);
    over.type = "BasisCurves";
    over.attributes =
        attributesOf(topology, curves, options, !(statesWidths && prim.isWhole), std::move(carried));
    if (options.usd.unreal) addUnreal(topology, curves, options.usd, carriedValues({prim}), over);
    curves.margin = marginOf(over.attributes, static_cast<float>(options.diameter / curves.unit));
    made.curves.push_back(std::move(curves));
  }
  made.stage.defaultPrim = made.stage.prims.front().name;
  if (options.usd.origin->isTurned) made.stage.up = options.up == UpAxis::y ? UpAxis::z : UpAxis::y;
}

}  // namespace

HairStage hairStageOf(const Groom& topology, const AnimationOptions& options) {
  HairStage made;
  made.stage = {.defaultPrim = "Hair",
                .framesPerSecond = options.framesPerSecond,
                .metresPerUnit = options.metresPerUnit,
                .up = options.up,
                .firstTimeCode = options.usd.firstTimeCode,
                .frameCount = options.frameCount,
                .prims = {}};
  const UsdExtras& usd = options.usd;
  if (usd.originPrims) {
    RINGLET_ASSERT(usd.origin && !usd.origin->prims.empty(), "a groom of USD prims");
    addOriginPrims(topology, options, made);
    return made;
  }
  HairCurves curves{"/Hair", 0, static_cast<std::uint32_t>(topology.strandCount()), 1, {}, 0};
  std::vector<UsdStageAttribute> said;
  if (usd.origin) said = carriedValues(usd.origin->prims);
  UsdStagePrim prim{.name = "Hair", .type = "BasisCurves"};
  prim.attributes = attributesOf(topology, curves, options, options.diameter > 0,
                                 usd.originValues ? said : std::vector<UsdStageAttribute>{});
  if (usd.unreal) addUnreal(topology, curves, usd, said, prim);
  curves.margin = marginOf(prim.attributes, options.diameter);
  made.stage.prims.push_back(std::move(prim));
  made.curves.push_back(std::move(curves));
  return made;
}

HairStage groomStageOf(const Groom& groom, const GroomWriting& writing) {
  const UsdExtras& usd = writing.usd;
  RINGLET_ASSERT(usd.head == UsdHead::baked && !usd.velocities && !usd.originPrims && !usd.tipDiameter,
                 "a groom rests, in one prim, and no width is known for it");
  HairStage made =
      hairStageOf(groom, {.metresPerUnit = groom.metresPerUnit, .diameter = 0, .frameCount = 0, .usd = usd});
  made.stage.up = writing.up;
  const Bounds box = boundsOf(groom.points);
  const float margin = made.curves.front().margin;
  const Vec3f more{margin, margin, margin};
  const Vec3f corners[] = {Vec3f(box.low) - more, Vec3f(box.high) + more};
  for (UsdStageAttribute& attribute : made.stage.prims.front().attributes) {
    if (attribute.elementsOfSample == 0) continue;
    attribute.elementsOfSample = 0;
    attribute.numbers = attribute.name == kUsdPoints ? numbersOf(groom.points) : numbersOf(corners);
  }
  return made;
}

}  // namespace ringlet
