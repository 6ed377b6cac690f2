// Implements motion/usd_blend_shapes.h.
#include "ringlet/motion/usd_blend_shapes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "ringlet/base/quoted.h"

namespace ringlet {
namespace {

constexpr std::string_view kInbetween = "inbetweens:";
constexpr std::size_t kMostNamedShapes = 6;  // in a sentence

std::string namedShapes(const std::vector<std::string_view>& names) {
  std::vector<std::string> shown;
  for (std::size_t k = 0; k < std::min(kMostNamedShapes, names.size()); ++k)
    shown.push_back(quoted(names[k]));
  return fmt::format("{}{}", fmt::join(shown, ", "), names.size() > shown.size() ? " and others" : "");
}

void warnOfInbetweens(const UsdPrims& prims, std::uint32_t prim, std::vector<std::string>& warnings) {
  std::vector<std::string_view> names;
  for (const UsdAttribute& attribute : prims[prim].attributes) {
    if (!attribute.name.starts_with(kInbetween)) continue;
    const std::string_view name = attribute.name.substr(kInbetween.size());
    if (name.find(':') == name.npos) names.push_back(name);  // no normals of one
  }
  if (!names.empty())
    warnings.push_back(
        fmt::format("{}: inbetween shapes are left out ({}); the shape grows straight with its weight",
                    prims.pathOf(prim), namedShapes(names)));
}

// Of the shapes' names the numbers among the animation's weights; none of those that it does not name.
Result<UsdNames> weightNamesOf(const UsdPrims& prims, std::uint32_t mesh, const UsdNames& shapes,
                               std::optional<std::uint32_t> animation, std::vector<std::string>& warnings) {
  UsdNames weights;
  if (animation) {
    auto names = prims.namesOf(*animation, "blendShapes");
    if (!names) return names.error();
    weights = std::move(*names);
  }
  std::vector<std::string_view> still;
  for (const std::string_view name : shapes.names)
    if (!weights.indexOf(name)) still.push_back(name);
  if (!still.empty())
    warnings.push_back(fmt::format("{}: no animation weights the blend shapes {}; they do nothing",
                                   prims.pathOf(mesh), namedShapes(still)));
  return weights;
}

}  // namespace

Result<UsdBlendShapes::Shape> UsdBlendShapes::readShape(const UsdPrims& prims, std::uint32_t prim,
                                                        std::size_t pointCount) {
  const char* mustStay = "expected the same at all times";
  const UsdAttribute* offsets = usdAttributeOf(prims[prim], "offsets");
  if (!offsets || offsets->value.numbers.empty()) return prims.wrong(prim, "has no offsets");
  const auto shifts = prims.constantOf({prim, offsets}, mustStay);
  if (!shifts) return shifts.error();
  const std::vector<double>& xyz = (*shifts)->numbers;
  const std::size_t count = xyz.size() / 3;
  static const std::vector<double> kAll{};
  const std::vector<double>* points = &kAll;
  if (const UsdAttribute* indices = usdAttributeOf(prims[prim], "pointIndices")) {
    const auto value = prims.constantOf({prim, indices}, mustStay);
    if (!value) return value.error();
    points = &(*value)->numbers;
  }
  const std::size_t expected = points->empty() ? pointCount : points->size();
  if ((*shifts)->width != 3 || count != expected)
    return prims.wrong(prim, fmt::format("found {} offsets; expected {}, as many as {}", count, expected,
                                         points->empty() ? "the mesh has points" : "pointIndices"));
  Shape shape;
  for (std::size_t k = 0; k < count; ++k) {
    const double point = points->empty() ? static_cast<double>(k) : (*points)[k];
    if (!(point >= 0 && point < static_cast<double>(pointCount)))
      return prims.wrong(prim, fmt::format("found {} in pointIndices; expected 0 to {}, the mesh's points",
                                           point, pointCount - 1));
    const Vec3d shift{xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]};
    shape.offsets.push_back({static_cast<std::uint32_t>(point), static_cast<Vec3f>(shift)});
    if (!isFinite(shape.offsets.back().shift))
      return prims.wrong(prim, fmt::format("offset {} is not finite", k));
  }
  return shape;
}

Result<UsdBlendShapes> UsdBlendShapes::of(const UsdPrims& prims, std::uint32_t mesh, std::size_t pointCount,
                                          std::optional<std::uint32_t> animation,
                                          std::vector<std::string>& warnings) {
  UsdBlendShapes all;
  const auto names = prims.namesOf(mesh, "skel:blendShapes");
  if (!names) return names.error();
  const UsdAttribute* targets = usdAttributeOf(prims[mesh], "skel:blendShapeTargets");
  const std::size_t targetCount = targets ? targets->value.texts.size() : 0;
  if (names->names.size() != targetCount)
    return prims.wrong(mesh, fmt::format("found {} skel:blendShapes and {} skel:blendShapeTargets; expected "
                                         "as many of each",
                                         names->names.size(), targetCount));
  if (targetCount == 0) return all;
  const auto weights = weightNamesOf(prims, mesh, *names, animation, warnings);
  if (!weights) return weights.error();
  std::map<std::uint32_t, std::size_t> shapeOf;  // of a prim, which several names may share
  for (std::size_t k = 0; k < targetCount; ++k) {
    const auto prim = prims.targetOf({mesh, targets}, k, "BlendShape");
    if (!prim) return prim.error();
    const auto weight = weights->indexOf(names->names[k]);
    if (!weight) continue;
    const auto [at, isNew] = shapeOf.insert({*prim, all.shapes_.size()});
    if (isNew) {
      auto shape = readShape(prims, *prim, pointCount);
      if (!shape) return shape.error();
      warnOfInbetweens(prims, *prim, warnings);
      all.shapes_.push_back(std::move(*shape));
    }
    all.shapes_[at->second].weights.push_back(*weight);
  }
  if (all.isEmpty()) return all;
  const UsdAttribute* given = usdAttributeOf(prims[*animation], "blendShapeWeights");
  if (!given) return prims.wrong(*animation, "has blendShapes but no blendShapeWeights");
  auto track =
      UsdTrack::of(prims, {*animation, given}, {weights->names.size(), 1, "one for each of its blendShapes"});
  if (!track) return track.error();
  all.weights_ = std::move(*track);
  return all;
}

void UsdBlendShapes::addTo(std::vector<Vec3d>& points, double seconds) const {
  if (isEmpty()) return;
  const UsdTrack::Place weights = weights_->at(seconds);
  for (const Shape& shape : shapes_) {
    double weight = 0;
    for (const std::uint32_t k : shape.weights) weight += weights[k];
    if (weight == 0) continue;
    for (const Offset& offset : shape.offsets) points[offset.point] += Vec3d(offset.shift) * weight;
  }
}

}  // namespace ringlet
