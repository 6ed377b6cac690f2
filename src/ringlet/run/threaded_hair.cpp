// Implements run/threaded_hair.h.
#include "ringlet/run/threaded_hair.h"

#include <future>
#include <utility>

namespace ringlet {
namespace {

class ThreadedHair : public SceneHair {
 public:
  explicit ThreadedHair(std::unique_ptr<SceneHair> hair) : hair_(std::move(hair)) {}

  Status submit(const SceneFrame& frame) override {
    if (Status before = settle(); !before) return before;
    under_ = std::async(std::launch::async, [this, frame] { return hair_->submit(frame); });
    return {};
  }
  Status wait() override {
    const Status before = settle();
    return before ? hair_->wait() : before;
  }
  void framePositions(std::span<Vec3f> all) override { settled().framePositions(all); }
  Result<std::vector<Vec3f>> positions() override { return settled().positions(); }
  Result<std::vector<std::byte>> checkpoint() override { return settled().checkpoint(); }
  Status restore(const SceneFrames& frames, int frame, std::span<const std::byte> checkpoint) override {
    return settled().restore(frames, frame, checkpoint);
  }
  Result<HairReports> reports() override { return settled().reports(); }
  HairTimes times() const override { return settled().times(); }
  bool tellsTimesOfFrames() const override { return hair_->tellsTimesOfFrames(); }
  HairFacts facts() const override { return settled().facts(); }

 private:
  // Waits for the frame in flight and returns its status.
  Status settle() const {
    if (under_.valid() && outcome_) outcome_ = under_.get();
    return outcome_;
  }
  // Waits without returning the error: submit and wait return it.
  SceneHair& settled() const {
    (void)settle();
    return *hair_;
  }

  std::unique_ptr<SceneHair> hair_;
  mutable Status outcome_{};
  mutable std::future<Status> under_;  // destroyed first: it waits for its thread
};

}  // namespace

std::unique_ptr<SceneHair> onThread(std::unique_ptr<SceneHair> hair) {
  return std::make_unique<ThreadedHair>(std::move(hair));
}

}  // namespace ringlet
