// UsdJoints: the joints of a Skeleton prim over time, as a SkelAnimation poses them. The hierarchy is that of
// their names:
//
//   Hips, Hips/Spine, Hips/Spine/Head    local:  scaled, then turned, then moved
//                                        joint = local, then the joint above it
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/motion/affine.h"
#include "ringlet/motion/usd_prims.h"
#include "ringlet/motion/usd_track.h"

namespace ringlet {

class UsdJoints {
 public:
  /// Without an animation all joints rest. Errors, with the prim's path: no joints; another count of rest
  /// transforms, or none where one is needed; samples that do not fit the animation's joints; numbers that
  /// are not finite; quaternions of 0.
  static Result<UsdJoints> of(const UsdPrims& prims, std::uint32_t skeleton,
                              std::optional<std::uint32_t> animation);

  /// Into the skeleton's space from each joint's, in the skeleton's order. Time: linear in joints.
  std::vector<Affine> at(double seconds) const;

  /// Translations, rotations and scales; none where no joint is animated.
  const std::vector<UsdTrack>& tracks() const { return tracks_; }

 private:
  struct Joint {
    std::uint32_t parent = kNoJoint;
    std::uint32_t animated = kNoJoint;  // its place in the animation; none: it rests
    Affine rest{};
  };
  static constexpr std::uint32_t kNoJoint = 0xffffffff;

  Status linkJoints(const UsdPrims& prims, std::uint32_t skeleton, const UsdNames& names);
  Status readAnimation(const UsdPrims& prims, std::uint32_t animation, const UsdNames& names);
  Status readRest(const UsdPrims& prims, std::uint32_t skeleton, const UsdNames& names);

  std::vector<Joint> joints_;
  std::vector<std::uint32_t> order_;  // of joints, so that none comes before the one above it
  std::vector<UsdTrack> tracks_;
};

/// The matrices of an attribute, in rows. Errors: another count, numbers that are not finite, a matrix that
/// is no affine one.
Result<std::vector<Affine>> usdMatricesOf(const UsdPrims& prims, const UsdProperty& property,
                                          std::size_t count, const std::string& reason);

}  // namespace ringlet
