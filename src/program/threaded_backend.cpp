// Implements threaded_backend.h.
#include "program/threaded_backend.h"

#include <future>
#include <utility>

namespace ringlet::program {
namespace {

class ThreadedBackend : public Backend {
 public:
  explicit ThreadedBackend(std::unique_ptr<Backend> hair) : hair_(std::move(hair)) {}

  Status submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                     std::span<const BodyPose> rootPoses) override {
    if (Status before = settle(); !before) return before;
    under_ = std::async(std::launch::async, [this, heads = std::vector(stepPoses.begin(), stepPoses.end()),
                                             bodies = std::vector(bodyPoses.begin(), bodyPoses.end()),
                                             roots = std::vector(rootPoses.begin(), rootPoses.end())] {
      return hair_->submitFrame(heads, bodies, roots);
    });
    return {};
  }
  Status waitFrame() override {
    const Status before = settle();
    return before ? hair_->waitFrame() : before;
  }
  Status change(const Settings& settings, const Material& material, double keysAt) override {
    const Status before = settle();
    return before ? hair_->change(settings, material, keysAt) : before;
  }
  Status setFields(std::span<const ForceField> fields, std::span<const ForceField> from) override {
    const Status before = settle();
    return before ? hair_->setFields(fields, from) : before;
  }
  Status setGoals(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
                  std::span<const Vec3f> from) override {
    const Status before = settle();
    return before ? hair_->setGoals(places, strengths, dampingRatio, from) : before;
  }
  void framePositions(std::span<Vec3f> all) override { settled().framePositions(all); }
  Result<std::vector<Vec3f>> positions() override { return settled().positions(); }
  Result<std::vector<std::byte>> checkpoint() override { return settled().checkpoint(); }
  Status restore(std::span<const std::byte> checkpoint) override { return settled().restore(checkpoint); }
  Result<SimulationReport> report() override { return settled().report(); }
  Result<ContactReport> contactReport() override { return settled().contactReport(); }
  std::map<std::string, double> stageMilliseconds() const override { return settled().stageMilliseconds(); }
  bool tellsTimesOfFrames() const override { return hair_->tellsTimesOfFrames(); }
  std::optional<HostMilliseconds> hostMilliseconds() const override { return settled().hostMilliseconds(); }
  std::size_t rigidStrandCount() const override { return hair_->rigidStrandCount(); }
  std::vector<std::string> warnings() const override { return settled().warnings(); }
  std::vector<std::string> deviceMessages() const override { return settled().deviceMessages(); }
  std::string device() const override { return hair_->device(); }
  std::string driver() const override { return hair_->driver(); }
  std::string kernel() const override { return hair_->kernel(); }
  bool isTuned() const override { return hair_->isTuned(); }
  double compileMilliseconds() const override { return hair_->compileMilliseconds(); }
  std::optional<std::uint64_t> deviceBytes() const override { return settled().deviceBytes(); }

 private:
  // The frame under way is over; how it ended.
  Status settle() const {
    if (under_.valid() && outcome_) outcome_ = under_.get();
    return outcome_;
  }
  // What failed is told by submitFrame and waitFrame.
  Backend& settled() const {
    (void)settle();
    return *hair_;
  }

  std::unique_ptr<Backend> hair_;
  mutable Status outcome_{};
  mutable std::future<Status> under_;  // goes first, waiting for its thread
};

}  // namespace

std::unique_ptr<Backend> onThread(std::unique_ptr<Backend> hair) {
  return std::make_unique<ThreadedBackend>(std::move(hair));
}

}  // namespace ringlet::program
