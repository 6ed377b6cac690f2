// Implements solver/strands/stillness.h.
#include "ringlet/solver/strands/stillness.h"

#include <algorithm>

namespace ringlet {

void Stillness::begin(bool isQuiet) {
  ++frame_;
  if (!isQuiet) quietSince_ = std::max(quietSince_, frame_ + 1);
  if (sleeps_ && quietSince_ <= frame_) return;
  sleeps_ = false;
  if (frame_ <= kLag) return;
  const std::uint64_t known = frame_ - kLag;
  const std::uint64_t since = std::max(quietSince_, stillSince_[known % stillSince_.size()]);
  sleeps_ = since + kFrames <= known + 1;
}

void Stillness::observe(std::span<const Vec3f> now, double farthest) {
  const auto isStill = [&](Vec3f a, Vec3f b) {
    const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return x * x + y * y + z * z <= farthest * farthest;  // false for NaN
  };
  const bool areStill = !now.empty() && std::ranges::equal(now, before_, isStill);
  const std::uint64_t since = stillSince_[observed_ % stillSince_.size()];
  ++observed_;
  stillSince_[observed_ % stillSince_.size()] = areStill ? since : observed_ + 1;
  before_.assign(now.begin(), now.end());
}

void Stillness::archive(Archive& archive) {
  archive.value(frame_);
  archive.value(observed_);
  archive.value(quietSince_);
  archive.value(stillSince_);
  archive.value(sleeps_);
  archive.list(before_);
}

}  // namespace ringlet
