// Implements motion/usd_joints.h.
#include "ringlet/motion/usd_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ringlet/base/quoted.h"

namespace ringlet {
namespace {

constexpr std::ptrdiff_t kDeepestJoint = 256;  // levels; bodies of people have twenty

Quatd turnAt(const double* numbers) { return {numbers[1], numbers[2], numbers[3], numbers[0]}; }

// Quaternions, real part first. Of one that is 0, nothing can be made.
bool normalizeTurns(std::vector<double>& numbers) {
  for (std::size_t at = 0; at + 4 <= numbers.size(); at += 4) {
    double size = 0;
    for (std::size_t k = 0; k < 4; ++k) size = std::hypot(size, numbers[at + k]);
    if (!(size > 0) || !std::isfinite(size)) return false;
    for (std::size_t k = 0; k < 4; ++k) numbers[at + k] /= size;
  }
  return true;
}

}  // namespace

Result<std::vector<Affine>> usdMatricesOf(const UsdPrims& prims, const UsdProperty& property,
                                          std::size_t count, const std::string& reason) {
  const auto value = prims.constantOf(property, "expected the same at all times");
  if (!value) return value.error();
  const std::string_view name = property.attribute->name;
  const std::vector<double>& n = (*value)->numbers;
  if (n.size() != 16 * count || (*value)->width != 16)
    return prims.wrong(property.prim, fmt::format("found {} {}; expected {}, {}", n.size() / (*value)->width,
                                                  name, count, reason));
  std::vector<Affine> matrices;
  for (std::size_t at = 0; at < n.size(); at += 16) {
    const Affine matrix{{n[at], n[at + 1], n[at + 2]},
                        {n[at + 4], n[at + 5], n[at + 6]},
                        {n[at + 8], n[at + 9], n[at + 10]},
                        {n[at + 12], n[at + 13], n[at + 14]}};
    if (!matrix.isFinite())
      return prims.wrong(property.prim,
                         fmt::format("found a number in matrix {} of {} that is not finite", at / 16, name));
    if (n[at + 3] != 0 || n[at + 7] != 0 || n[at + 11] != 0 || n[at + 15] != 1)
      return prims.wrong(property.prim,
                         fmt::format("matrix {} of {} has another last column than 0, 0, 0, 1; "
                                     "expected an affine one",
                                     at / 16, name));
    matrices.push_back(matrix);
  }
  return matrices;
}

Result<UsdJoints> UsdJoints::of(const UsdPrims& prims, std::uint32_t skeleton,
                                std::optional<std::uint32_t> animation) {
  const auto names = prims.namesOf(skeleton, "joints");
  if (!names) return names.error();
  if (names->names.empty()) return prims.wrong(skeleton, "has no joints");
  UsdJoints joints;
  if (Status linked = joints.linkJoints(prims, skeleton, *names); !linked) return linked.error();
  if (animation)
    if (Status read = joints.readAnimation(prims, *animation, *names); !read) return read.error();
  if (Status read = joints.readRest(prims, skeleton, *names); !read) return read.error();
  return joints;
}

// The joint above one is the nearest that is there: of A and A/B/C, A is above A/B/C.
Status UsdJoints::linkJoints(const UsdPrims& prims, std::uint32_t skeleton, const UsdNames& names) {
  std::vector<std::ptrdiff_t> levels;
  for (const std::string_view name : names.names) {
    levels.push_back(std::ranges::count(name, '/'));
    if (levels.back() > kDeepestJoint)
      return prims.wrong(skeleton, fmt::format("joint {} has {} above it; expected at most {}", quoted(name),
                                               levels.back(), kDeepestJoint));
    Joint& joint = joints_.emplace_back();
    std::string_view above = name;
    for (auto end = above.rfind('/'); end != above.npos && joint.parent == kNoJoint; end = above.rfind('/')) {
      above = above.substr(0, end);
      joint.parent = names.indexOf(above).value_or(kNoJoint);
    }
  }
  order_.resize(joints_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::ranges::stable_sort(order_, {}, [&](std::uint32_t joint) { return levels[joint]; });
  return {};
}

Status UsdJoints::readAnimation(const UsdPrims& prims, std::uint32_t animation, const UsdNames& names) {
  const auto animated = prims.namesOf(animation, "joints");
  if (!animated) return animated.error();
  for (std::size_t j = 0; j < joints_.size(); ++j)
    joints_[j].animated = animated->indexOf(names.names[j]).value_or(kNoJoint);
  struct Wanted {
    const char* name;
    std::size_t width;
  };
  for (const Wanted& wanted : {Wanted{"translations", 3}, Wanted{"rotations", 4}, Wanted{"scales", 3}}) {
    const UsdAttribute* attribute = usdAttributeOf(prims[animation], wanted.name);
    if (!attribute) {
      if (animated->names.empty()) continue;
      return prims.wrong(animation,
                         fmt::format("has no {}; expected translations, rotations and scales", wanted.name));
    }
    auto track = UsdTrack::of(prims, {animation, attribute},
                              {animated->names.size(), wanted.width, "one for each of its joints"});
    if (!track) return track.error();
    if (wanted.width == 4 && !normalizeTurns(track->numbers()))
      return prims.wrong(animation, "found a quaternion of 0 in rotations; expected turns");
    tracks_.push_back(std::move(*track));
  }
  const bool animatesSome =
      std::ranges::any_of(joints_, [](const Joint& joint) { return joint.animated != kNoJoint; });
  if (!animatesSome) tracks_.clear();
  return {};
}

Status UsdJoints::readRest(const UsdPrims& prims, std::uint32_t skeleton, const UsdNames& names) {
  const UsdAttribute* attribute = usdAttributeOf(prims[skeleton], "restTransforms");
  const auto resting = std::ranges::find(joints_, kNoJoint, &Joint::animated);
  if (!attribute || attribute->value.numbers.empty()) {
    if (resting == joints_.end()) return {};
    const std::string_view first = names.names[static_cast<std::size_t>(resting - joints_.begin())];
    return prims.wrong(skeleton, fmt::format("has no restTransforms, which the joint {} needs, since no "
                                             "animation moves it",
                                             quoted(first)));
  }
  const auto rest = usdMatricesOf(prims, {skeleton, attribute}, joints_.size(), "one for each of its joints");
  if (!rest) return rest.error();
  for (std::size_t j = 0; j < joints_.size(); ++j) joints_[j].rest = (*rest)[j];
  return {};
}

std::vector<Affine> UsdJoints::at(double seconds) const {
  UsdTrack::Place places[3];
  for (std::size_t k = 0; k < tracks_.size(); ++k) places[k] = tracks_[k].at(seconds);
  const auto& [moves, turns, scales] = places;
  std::vector<Affine> poses(joints_.size());
  for (const std::uint32_t j : order_) {
    const Joint& joint = joints_[j];
    Affine& pose = poses[j] = joint.rest;
    if (joint.animated != kNoJoint) {
      const std::size_t v = 3 * std::size_t{joint.animated}, q = 4 * std::size_t{joint.animated};
      pose = affineOf({moves[v], moves[v + 1], moves[v + 2]},
                      slerp(turnAt(turns.before + q), turnAt(turns.after + q), turns.share),
                      {scales[v], scales[v + 1], scales[v + 2]});
    }
    if (joint.parent != kNoJoint) pose = poses[joint.parent] * pose;
  }
  return poses;
}

}  // namespace ringlet
