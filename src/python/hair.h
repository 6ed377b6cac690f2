// Hair as Python holds it.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "python/assets.h"
#include "python/poses.h"
#include "ringlet/solver/simulation.h"

namespace ringlet::python {

/// The solver takes hair from one thread at a time, and rules that the caller keeps; this keeps them. What
/// works, works without the GIL. Throws Failure, and py::value_error for poses that do not fit.
class HairObject {
 public:
  HairObject(AssetHandle asset, Simulation simulation, std::span<const Body> bodies)
      : asset_(std::move(asset)), simulation_(std::move(simulation)) {
    takeCounts(bodies);
  }

  struct Frame {
    HeadWay head{};
    std::vector<BodyPose> bodies{}, roots{};
    std::vector<std::vector<Vec3d>> points{};  // of each body that bends
  };
  void step(const Frame& frame);
  void submit(const Frame& frame);
  void wait();
  /// Of the frame that was waited for last.
  std::vector<Vec3f> positions();
  /// The same in the world, in the groom's unit; with no frame under way.
  std::vector<Vec3f> points();
  std::vector<Vec3f> velocities();
  void setState(HairState state);
  std::vector<std::byte> checkpoint();
  void restore(std::span<const std::byte> bytes);
  void setSettings(const Settings& settings);
  void setMaterial(const Material& material);
  void setBodies(std::span<const Body> bodies, std::span<const BodyPose> places);

  /// Of what only looks.
  template <class Look>
  auto ask(Look&& look) {
    return withoutGil([&] {
      const auto lock = lockThere();
      return look(simulation_);
    });
  }

  const AssetHandle& asset() const { return asset_; }
  void demandNoneInFlight(const char* what) const;

  /// All in one submission.
  static void stepTogether(std::span<const std::pair<HairObject*, Frame>> frames);

 private:
  struct Poses {
    std::vector<HeadPose> heads;
    std::span<const BodyPose> bodies, roots;
    std::vector<std::span<const Vec3d>> points;
  };
  void takeCounts(std::span<const Body> bodies) {
    bodyCount_ = bodies.size();
    bendingPoints_ = bendingPointCounts(bodies);
  }
  void demandProcess() const;
  void demandThere() const;
  std::unique_lock<std::mutex> lockThere();
  Poses posesOf(const Frame& frame) const;
  void losing(const Status& status);

  AssetHandle asset_;
  std::mutex mutex_;
  Simulation simulation_;
  std::size_t bodyCount_ = 0;
  std::vector<std::size_t> bendingPoints_{};  // of each body that bends
  std::size_t inFlight_ = 0;                  // submitted and not waited for
  bool isWaitedFor_ = false;                  // some frame was
  std::optional<Error> lost_{};               // after which nothing can be told of it
};
using HairHandle = std::shared_ptr<HairObject>;

/// From the solver's metres, seen from the head, to a unit of the world's.
void placeInWorld(std::vector<Vec3f>& positions, const HeadPose& head, double metresPerUnit);

HairHandle makeHair(const AssetHandle& asset, const InitialState& initial);

}  // namespace ringlet::python
