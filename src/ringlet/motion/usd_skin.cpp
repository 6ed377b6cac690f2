// Implements motion/usd_skin.h.
#include "ringlet/motion/usd_skin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ringlet/base/quoted.h"
#include "ringlet/groom/usd/usd_matrix.h"

namespace ringlet {
namespace {

constexpr const char* kJointIndices = "primvars:skel:jointIndices";
constexpr const char* kJointWeights = "primvars:skel:jointWeights";
constexpr const char* kSkinMustStay = "expected the same at all times";
constexpr double kLeastWeight = 1e-7;  // of a point in all: a float's rounding of 1

std::optional<Affine> inverseOfBind(const Affine& bind) {
  const UsdTransform map{{bind.x, bind.y, bind.z}, bind.position};
  if (!(std::abs(map.determinant()) > 0)) return std::nullopt;
  const UsdTransform back = map.inverse();
  const Affine inverse{back.rows[0], back.rows[1], back.rows[2], back.move};
  return inverse.isFinite() ? std::optional(inverse) : std::nullopt;
}

// Whether one element stands for all points. By USD it does where the file says nothing; a number of elements
// as of points tells that this was not meant.
Result<bool> isConstant(const UsdPrims& prims, const UsdProperty& property, std::size_t pointCount) {
  const UsdAttribute& attribute = *property.attribute;
  const bool saysNothing = attribute.interpolation.empty();
  const std::size_t count = attribute.value.numbers.size();
  if (saysNothing && pointCount > 1 && count % pointCount == 0)
    return prims.wrong(property.prim,
                       fmt::format("found {} {} and no interpolation; expected \"vertex\" or \"constant\"",
                                   count, attribute.name));
  if (saysNothing || attribute.interpolation == "constant") return true;
  if (attribute.interpolation == "vertex") return false;
  return prims.wrong(property.prim,
                     fmt::format("found {} of interpolation {}; expected \"vertex\" or \"constant\"",
                                 attribute.name, quoted(attribute.interpolation)));
}

Status checkUnindexed(const UsdPrims& prims, std::uint32_t mesh, std::string_view name) {
  const std::string indexed = fmt::format("{}:indices", name);
  const auto found = prims.nearest(mesh, indexed);
  if (!found) return {};
  return prims.wrong(found->prim, fmt::format("has {}; expected values that are not indexed", indexed));
}

void warnOfMethod(const UsdPrims& prims, std::uint32_t mesh, std::vector<std::string>& warnings) {
  const auto method = prims.nearest(mesh, "primvars:skel:skinningMethod");
  if (!method || method->attribute->value.texts.empty()) return;
  const std::string_view name = method->attribute->value.texts.front();
  if (name != "classicLinear")
    warnings.push_back(
        fmt::format("{}: is skinned by {}; linear blending is used, which narrows joints that "
                    "twist",
                    prims.pathOf(mesh), quoted(name)));
}

}  // namespace

Result<std::optional<UsdSkin>> UsdSkin::of(const UsdPrims& prims, std::uint32_t mesh, std::size_t pointCount,
                                           std::optional<std::uint32_t> skeleton,
                                           std::optional<std::uint32_t> animation,
                                           std::vector<std::string>& warnings) {
  const auto indices = prims.nearest(mesh, kJointIndices), weights = prims.nearest(mesh, kJointWeights);
  if (!indices && !weights) return std::optional<UsdSkin>();
  if (!indices || !weights)
    return prims.wrong(mesh, fmt::format("has {} but no {}", indices ? kJointIndices : kJointWeights,
                                         indices ? kJointWeights : kJointIndices));
  if (!skeleton)
    return prims.wrong(
        mesh, fmt::format("has {} but no skel:skeleton, of its own or of a prim above", kJointIndices));
  for (const char* name : {kJointIndices, kJointWeights})
    if (Status checked = checkUnindexed(prims, mesh, name); !checked) return checked.error();
  UsdSkin skin;
  auto joints = UsdJoints::of(prims, *skeleton, animation);
  if (!joints) return joints.error();
  skin.joints_ = std::move(*joints);
  if (Status bound = skin.bindJoints(prims, mesh, *skeleton); !bound) return bound.error();
  if (Status read = skin.readInfluences(prims, *indices, *weights, pointCount); !read) return read.error();
  if (const std::size_t unweighted = skin.normalizeWeights())
    warnings.push_back(fmt::format("{}: {} of its points have no weight; no joint moves them",
                                   prims.pathOf(mesh), skin.isRigid_ ? pointCount : unweighted));
  warnOfMethod(prims, mesh, warnings);
  return std::optional(std::move(skin));
}

// The mesh may name joints of the skeleton in an order of its own.
Status UsdSkin::bindJoints(const UsdPrims& prims, std::uint32_t mesh, std::uint32_t skeleton) {
  const auto all = prims.namesOf(skeleton, "joints");
  if (!all) return all.error();
  const UsdAttribute* attribute = usdAttributeOf(prims[skeleton], "bindTransforms");
  if (!attribute) return prims.wrong(skeleton, "has no bindTransforms");
  const auto binds =
      usdMatricesOf(prims, {skeleton, attribute}, all->names.size(), "one for each of its joints");
  if (!binds) return binds.error();
  if (const auto own = prims.nearest(mesh, "primvars:skel:geomBindTransform")) {
    const auto matrix = usdMatricesOf(prims, *own, 1, "one for all points");
    if (!matrix) return matrix.error();
    bind_ = matrix->front();
  }
  const auto order = prims.nearest(mesh, "skel:joints");
  const auto names = order ? prims.namesOf(order->prim, "skel:joints") : all;
  if (!names) return names.error();
  for (const std::string_view name : names->names) {
    const auto joint = all->indexOf(name);
    if (!joint)
      return prims.wrong(
          order->prim, fmt::format("skel:joints names {}, which is none of the {} joints of {}", quoted(name),
                                   all->names.size(), prims.pathOf(skeleton)));
    const auto inverse = inverseOfBind((*binds)[*joint]);
    if (!inverse)
      return prims.wrong(
          skeleton, fmt::format("the matrix of joint {} in bindTransforms has no inverse", quoted(name)));
    bound_.push_back({*joint, *inverse * bind_});
  }
  return {};
}

Status UsdSkin::readInfluences(const UsdPrims& prims, const UsdProperty& indices, const UsdProperty& weights,
                               std::size_t pointCount) {
  const auto joints = prims.constantOf(indices, kSkinMustStay);
  if (!joints) return joints.error();
  const auto shares = prims.constantOf(weights, kSkinMustStay);
  if (!shares) return shares.error();
  const auto rigid = isConstant(prims, indices, pointCount),
             rigidToo = isConstant(prims, weights, pointCount);
  if (!rigid) return rigid.error();
  if (!rigidToo) return rigidToo.error();
  isRigid_ = *rigid;
  const std::size_t count = (*joints)->numbers.size();
  if ((*shares)->numbers.size() != count || *rigid != *rigidToo)
    return prims.wrong(indices.prim,
                       fmt::format("found {} jointIndices and {} jointWeights; expected as many "
                                   "of each, of one interpolation",
                                   count, (*shares)->numbers.size()));
  if (!isRigid_ && count % pointCount != 0)
    return prims.wrong(indices.prim, fmt::format("found {} jointIndices; expected as many for each of the {} "
                                                 "points",
                                                 count, pointCount));
  perPoint_ = isRigid_ ? count : count / pointCount;
  for (std::size_t k = 0; k < count; ++k) {
    const double joint = (*joints)->numbers[k], weight = (*shares)->numbers[k];
    if (!(joint >= 0 && joint < static_cast<double>(bound_.size())))
      return prims.wrong(indices.prim, fmt::format("found joint {} in jointIndices; expected 0 to {}", joint,
                                                   bound_.size() - 1));
    if (!std::isfinite(weight))
      return prims.wrong(weights.prim, fmt::format("jointWeights has {}; expected finite numbers", weight));
    influences_.push_back({static_cast<std::uint32_t>(joint), weight});
  }
  return {};
}

// Says how many groups of influences have no weight.
std::size_t UsdSkin::normalizeWeights() {
  std::size_t unweighted = 0;
  for (std::size_t first = 0; first < influences_.size(); first += perPoint_) {
    double sum = 0;
    for (std::size_t k = first; k < first + perPoint_; ++k) sum += influences_[k].weight;
    const bool isNothing = !(std::abs(sum) > kLeastWeight) || !std::isfinite(sum);
    for (std::size_t k = first; k < first + perPoint_; ++k)
      influences_[k].weight = isNothing ? 0 : influences_[k].weight / sum;
    if (!isNothing) continue;
    influences_[first] = {static_cast<std::uint32_t>(bound_.size()), 1};
    ++unweighted;
  }
  return unweighted;
}

bool UsdSkin::isMirroring() const { return dot(bind_.x, cross(bind_.y, bind_.z)) < 0; }

// All points have one map, whose columns are the blended ones.
Affine UsdSkin::rigidMap(const std::vector<Affine>& maps) const {
  Affine blended{{}, {}, {}, {}};
  for (const auto& [joint, weight] : influences_) {
    const Affine& map = maps[joint];
    blended.x += map.x * weight;
    blended.y += map.y * weight;
    blended.z += map.z * weight;
    blended.position += map.position * weight;
  }
  return blended;
}

void UsdSkin::move(std::vector<Vec3d>& points, double seconds, const Affine& placement) const {
  const std::vector<Affine> poses = joints_.at(seconds);
  std::vector<Affine> maps;
  for (const Bound& bound : bound_) maps.push_back(placement * poses[bound.joint] * bound.bind);
  maps.push_back(placement * bind_);
  if (isRigid_) {
    const Affine map = rigidMap(maps);
    for (Vec3d& point : points) point = map(point);
    return;
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    Vec3d place;
    for (std::size_t k = p * perPoint_; k < (p + 1) * perPoint_; ++k)
      if (influences_[k].weight != 0) place += maps[influences_[k].joint](points[p]) * influences_[k].weight;
    points[p] = place;
  }
}

}  // namespace ringlet
