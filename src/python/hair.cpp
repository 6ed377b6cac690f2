// Implements python/hair.h.
#include "python/hair.h"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "ringlet/solver/hair_frames.h"

namespace ringlet::python {
namespace {

Error refused(std::string message) { return Error{std::move(message)}; }

}  // namespace

// Asked before the lock: another thread of the parent's may have had it when the process forked.
void HairObject::demandProcess() const { demand(asset_->device->device.checkProcess()); }

std::unique_lock<std::mutex> HairObject::lockThere() {
  demandProcess();
  std::unique_lock lock(mutex_);
  demandThere();
  return lock;
}

void HairObject::demandThere() const {
  if (lost_)
    throw Failure(
        {"this hair was lost with an earlier error; create another: " + lost_->message, lost_->fault});
}

void HairObject::demandNoneInFlight(const char* what) const {
  if (inFlight_ > 0)
    throw Failure(refused(fmt::format("{} while {} submitted frame(s) were not waited for: call wait() first",
                                      what, inFlight_)));
}

void HairObject::losing(const Status& status) {
  if (status) return;
  lost_ = status.error();
  throw Failure(status.error());
}

HairObject::Poses HairObject::posesOf(const Frame& frame) const {
  const auto steps = static_cast<std::size_t>(simulation_.settings().stepsPerFrame);
  Poses poses{stepPosesOf(frame.head, simulation_.head(), static_cast<int>(steps)),
              frame.bodies,
              frame.roots,
              {frame.points.begin(), frame.points.end()}};
  if (const Status checked = checkBodyPoints(bendingPoints_, poses.points); !checked)
    throw py::value_error(checked.error().message);
  if (!frame.bodies.empty() && frame.bodies.size() != steps * bodyCount_)
    throw py::value_error(
        fmt::format("body_poses must have a pose for each of {} steps and {} bodies, got {}", steps,
                    bodyCount_, frame.bodies.size()));
  if (frame.roots.empty()) return poses;
  if (frame.roots.size() != steps * asset_->asset.strandCount())
    throw py::value_error(
        fmt::format("root_poses must have a pose for each of {} steps and {} strands, got {}", steps,
                    asset_->asset.strandCount(), frame.roots.size()));
  return poses;
}

void HairObject::step(const Frame& frame) {
  withoutGil([&] {
    const auto lock = lockThere();
    demandNoneInFlight("step");
    const Poses poses = posesOf(frame);
    losing(simulation_.stepFrame(poses.heads, poses.bodies, poses.roots, poses.points));
    isWaitedFor_ = true;
  });
}

void HairObject::submit(const Frame& frame) {
  withoutGil([&] {
    const auto lock = lockThere();
    if (inFlight_ == Simulation::kFramesInFlight)
      throw Failure(
          refused(fmt::format("at most {} frames are under way: call wait() before the next submit()",
                              Simulation::kFramesInFlight)));
    const Poses poses = posesOf(frame);
    losing(simulation_.submitFrame(poses.heads, poses.bodies, poses.roots, poses.points));
    ++inFlight_;
  });
}

void HairObject::wait() {
  withoutGil([&] {
    const auto lock = lockThere();
    if (inFlight_ == 0) throw Failure(refused("there is no frame to wait for: submit() one first"));
    losing(simulation_.waitFrame());
    --inFlight_;
    isWaitedFor_ = true;
  });
}

std::vector<Vec3f> HairObject::positions() {
  return withoutGil([&] {
    const auto lock = lockThere();
    if (inFlight_ == 0) return valueOf(simulation_.positions());
    if (!isWaitedFor_ || inFlight_ == Simulation::kFramesInFlight)
      throw Failure(refused("no frame was waited for whose positions are still there: call wait() first"));
    return simulation_.framePositions();
  });
}

std::vector<Vec3f> HairObject::points() {
  return withoutGil([&] {
    const auto lock = lockThere();
    demandNoneInFlight("points");
    std::vector<Vec3f> points = valueOf(simulation_.positions());
    placeInWorld(points, simulation_.head(), asset_->groom->groom().metresPerUnit);
    return points;
  });
}

std::vector<Vec3f> HairObject::velocities() {
  return ask([](Simulation& simulation) { return valueOf(simulation.state()).velocities; });
}

void HairObject::setState(HairState state) {
  withoutGil([&] {
    const auto lock = lockThere();
    demandNoneInFlight("set_state");
    losing(simulation_.setState(state));
  });
}

std::vector<std::byte> HairObject::checkpoint() {
  return ask([](Simulation& simulation) { return valueOf(simulation.checkpoint()); });
}

void HairObject::restore(std::span<const std::byte> bytes) {
  withoutGil([&] {
    const auto lock = lockThere();
    demandNoneInFlight("restore");
    const Status restored = simulation_.restore(bytes);
    if (!restored && restored.error().fault == Fault::input) throw Failure(restored.error());
    losing(restored);
  });
}

void HairObject::setSettings(const Settings& settings) {
  ask([&](Simulation& simulation) { demand(simulation.setSettings(settings)); });
}
void HairObject::setMaterial(const Material& material) {
  ask([&](Simulation& simulation) { demand(simulation.setMaterial(material)); });
}
void HairObject::setBodies(std::span<const Body> bodies, std::span<const BodyPose> places) {
  if (!places.empty() && places.size() != bodies.size())
    throw py::value_error(
        fmt::format("places has {} poses and there are {} bodies", places.size(), bodies.size()));
  withoutGil([&] {
    const auto lock = lockThere();
    demand(simulation_.setBodies(bodies, places));
    takeCounts(bodies);
  });
}

void HairObject::stepTogether(std::span<const std::pair<HairObject*, Frame>> frames) {
  std::set<HairObject*> hairs;  // in an order that all threads keep
  for (const auto& [hair, frame] : frames) {
    if (!hairs.insert(hair).second) throw py::value_error("a hair stands twice among the frames");
    if (hair->asset_->device != frames.front().first->asset_->device)
      throw py::value_error("the frames are of hair on several devices");
  }
  withoutGil([&] {
    std::vector<std::unique_lock<std::mutex>> locks;
    for (HairObject* hair : hairs) hair->demandProcess();
    for (HairObject* hair : hairs) locks.emplace_back(hair->mutex_);
    std::vector<Poses> poses;
    std::vector<HairFrame> handed;
    poses.reserve(frames.size());
    for (const auto& [hair, frame] : frames) {
      hair->demandThere();
      hair->demandNoneInFlight("step_frames");
      poses.push_back(hair->posesOf(frame));
      const Poses& given = poses.back();
      handed.push_back({&hair->simulation_, given.heads, given.bodies, given.roots, given.points});
    }
    const Status status = stepFrames(handed);
    for (const auto& [hair, frame] : frames) {
      if (!status) hair->lost_ = status.error();
      hair->isWaitedFor_ = true;
    }
    demand(status);
  });
}

void placeInWorld(std::vector<Vec3f>& positions, const HeadPose& head, double metresPerUnit) {
  for (Vec3f& p : positions) p = Vec3f((head.position + Vec3d(p)) / metresPerUnit);
}

HairHandle makeHair(const AssetHandle& asset, const InitialState& initial) {
  Simulation made = withoutGil([&] { return valueOf(Simulation::create(asset->asset, initial)); });
  return std::make_shared<HairObject>(asset, std::move(made), initial.bodies);
}

}  // namespace ringlet::python
