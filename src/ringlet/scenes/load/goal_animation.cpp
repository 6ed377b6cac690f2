// Implements scenes/load/goal_animation.h.
#include "ringlet/scenes/load/goal_animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ringlet/output/animation_reader.h"

namespace ringlet {

GoalAnimation::GoalAnimation(std::filesystem::path path, const ForeignReading& reading)
    : path_(std::move(path)), reading_(reading) {}
GoalAnimation::~GoalAnimation() = default;

Result<std::shared_ptr<GoalAnimation>> GoalAnimation::open(const std::filesystem::path& path,
                                                           const Groom& groom,
                                                           const ForeignReading& reading) {
  const std::shared_ptr<GoalAnimation> self(new GoalAnimation(path, reading));
  if (Status read = self->show(1); !read) return read.error();
  const Groom& found = self->reader_->groom();
  if (found.firstPoint != groom.firstPoint)
    return Error{fmt::format(
        "{} has {} strands of {} particles in all, the groom {} of {}; expected the same strands, particle "
        "for particle",
        path.string(), found.strandCount(), found.points.size(), groom.strandCount(), groom.points.size())};
  if ((self->reader_->header().up == UpAxis::z) != reading.upIsZ)
    return Error{fmt::format("{} has another up axis than the scene", path.string())};
  return self;
}

Status GoalAnimation::read(int frame) {
  if (Status read = reader_->readFrame(frame); !read) return read;
  before_ = std::move(after_);
  after_.clear();
  for (const Vec3f& p : reader_->groom().points) after_.push_back(Vec3d(p) * reader_->header().metresPerUnit);
  latest_ = frame;
  return {};
}

Status GoalAnimation::show(int frame) {
  if (frame == latest_) return {};
  if (!reader_ || frame < latest_) {
    auto opened = AnimationReader::open(path_, reading_);
    if (!opened) return opened.error();
    reader_ = std::make_unique<AnimationReader>(std::move(*opened));
    latest_ = 0;
    if (reader_->frameCount() < 1) return Error{fmt::format("{} has no frames", path_.string())};
  }
  // Before the first stands the first.
  if (frame - 1 > latest_ || latest_ == 0) {
    if (Status before = read(std::max(1, frame - 1)); !before) return before;
  }
  if (frame > latest_) {
    if (Status after = read(frame); !after) return after;
  } else {
    before_ = after_;
  }
  return {};
}

Result<std::vector<Vec3f>> GoalAnimation::placesAt(double seconds, const HeadPose& head) {
  const std::scoped_lock lock(mutex_);
  const int last = reader_->frameCount();
  const double at = std::clamp(seconds * reader_->header().framesPerSecond, 1.0, static_cast<double>(last));
  const int frame = std::clamp(static_cast<int>(std::ceil(at)), std::min(2, last), last);
  if (Status shown = show(frame); !shown) return shown.error();
  const double share = at - (frame - 1);
  const Quatd back = head.rotation.conjugate();
  std::vector<Vec3f> places;
  for (std::size_t i = 0; i < after_.size(); ++i) {
    const Vec3d world = last == 1 ? after_[i] : before_[i] + (after_[i] - before_[i]) * share;
    places.push_back(static_cast<Vec3f>(rotate(back, world - head.position)));
  }
  return places;
}

}  // namespace ringlet
