// Implements scenes/frames/scene_forces.h.
#include "ringlet/scenes/frames/scene_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "ringlet/base/assert.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/rest/goal.h"
#include "ringlet/scenes/frames/velocity_file.h"
#include "ringlet/scenes/load/goal_animation.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/scenes/load/scene_maps.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet {
namespace {

constexpr double kStartStrength = 10;  // of what holds hair to how it began, at first: its weight 1 mm off

constexpr double kUsualDrag = 20;  // of kinds that need one [1/s]: a twentieth of a second takes hair along

// What its kind makes of the strength.
void setStrength(const SceneForceField& stated, ForceField& field) {
  const bool needsDrag = stated.kind == "drag" || stated.kind == "grid";
  field.drag = stated.drag.value_or(needsDrag ? kUsualDrag : 0);
  if (stated.kind == "uniform") field.axial = stated.strength;
  if (stated.kind == "point" || stated.kind == "line") field.radial = -stated.strength;
  if (stated.kind == "vortex") field.around = stated.strength;
  if (stated.kind == "blast") field.radial = stated.strength;
  if (stated.kind == "grid") field.gridShare = stated.strength;
}

ForceField forceFieldOf(const SceneForceField& stated, std::size_t index) {
  ForceField field;
  field.name = nameInKeys(stated.name, index);
  field.place = {stated.position, turnOfDegrees(stated.rotateDegrees)};
  field.axis = stated.axis;
  field.aboutAxis = stated.kind == "line" || stated.kind == "vortex";
  field.core = stated.core;
  field.reach = stated.reach;
  if (stated.kind == "blast") field.thickness = stated.thickness;
  setStrength(stated, field);
  return field;
}

// How firmly a hold holds at a time, as a share of its strength.
double shareHeld(const SceneHold& hold, double seconds) {
  const auto ramp = [&](double since) {
    if (hold.ease <= 0) return since >= 0 ? 1.0 : 0.0;
    return std::clamp(since / hold.ease, 0.0, 1.0);
  };
  const double taken = hold.start ? ramp(seconds - *hold.start) : 1;
  const double left = hold.release ? 1 - ramp(seconds - *hold.release) : 1;
  return std::min(taken, left);
}

BodyPose toCarrier(const BodyPose& carrier, const BodyPose& place) {
  return {carrier.position + rotate(carrier.rotation, place.position), carrier.rotation * place.rotation};
}

// Two springs are one: their strengths together, at the place between.
void addSpring(Vec3d place, double strength, std::size_t particle, GoalPose& pose) {
  float& sum = pose.strengths[particle];
  Vec3f& at = pose.places[particle];
  const double all = static_cast<double>(sum) + strength;
  if (all <= 0) return;
  at = static_cast<Vec3f>((Vec3d(at) * static_cast<double>(sum) + place * strength) / all);
  sum = static_cast<float>(all);
}

}  // namespace

FrameForces FrameForces::part(double begin, double end) const {
  FrameForces some = *this;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    some.fieldsFrom[f] = interpolate(fieldsFrom[f], fields[f], begin);
    some.fields[f] = interpolate(fieldsFrom[f], fields[f], end);
  }
  const auto at = [&](std::size_t i, double share) {
    const Vec3d from(placesFrom[i]), to(goals.places[i]);
    return static_cast<Vec3f>(from + (to - from) * share);
  };
  for (std::size_t i = 0; i < placesFrom.size(); ++i) {
    some.placesFrom[i] = at(i, begin);
    some.goals.places[i] = at(i, end);
  }
  return some;
}

BodyPose SceneForces::Carrier::poseAt(double seconds, const HeadPose& head) const {
  if (isWorld) return {};
  if (!motion) return {head.position, head.rotation};
  const HeadPose pose = motion->poseAt(seconds);
  return {pose.position, pose.rotation};
}

Result<SceneForces::Carrier> SceneForces::carrierOf(const SceneFile& scene, const std::string& bind,
                                                    const std::string& joint,
                                                    std::vector<std::string>& warnings) {
  Carrier carrier{.motion = {}, .isWorld = joint.empty() && bind == "world"};
  if (joint.empty()) return carrier;
  auto motion = jointMotion(scene, joint, warnings);
  if (!motion) return motion.error();
  carrier.motion.emplace(std::move(*motion));
  return carrier;
}

Result<SceneForces::Hold> SceneForces::holdOf(const SceneFile& scene, const SceneHold& stated,
                                              const Groom& groom, const Motion& head,
                                              std::vector<std::string>& warnings) {
  Hold hold;
  auto carrier = carrierOf(scene, stated.bind, stated.joint, warnings);
  if (!carrier) return carrier.error();
  hold.carrier = std::move(*carrier);
  const auto last = static_cast<std::uint32_t>(groom.strandCount() - 1);
  auto runs = stated.strands.empty() ? Result<std::vector<StrandRun>>(std::vector<StrandRun>{{0, last, 1.f}})
                                     : parseStrands(stated.strands, 1, scene.groups);
  if (!runs) return runs.error();
  if (runs->back().last > last)
    return Error{fmt::format("it names strand {}; the groom has {}, numbered from 0", runs->back().last,
                             groom.strandCount())};
  const GroomGoal goal = goalOf(groom);
  Vec3d sum{};
  for (const StrandRun& run : *runs) {
    for (std::size_t i = groom.firstPoint[run.first]; i < groom.firstPoint[run.last + 1]; ++i) {
      const double share = goal.shares[i];
      if (share < stated.begin || share > stated.end) continue;
      hold.held.push_back({i, Vec3d(goal.places[i])});
      sum = sum + Vec3d(goal.places[i]);
    }
  }
  if (hold.held.empty())
    return Error{
        fmt::format("no particle stands between {} and {} of its strand's length; expected a wider range",
                    stated.begin, stated.end)};
  const Vec3d middle = sum / static_cast<double>(hold.held.size());
  const HeadPose start = head.poseAt(0);
  const BodyPose carriedBy = hold.carrier.poseAt(0, start);
  const Quatd back = carriedBy.rotation.conjugate();
  const bool isHeads = hold.carrier.isHeads();
  const Quatd turn = isHeads ? Quatd{} : back * start.rotation;
  for (Held& held : hold.held) held.offset = rotate(turn, held.offset - middle);
  hold.middle =
      isHeads ? middle : rotate(back, start.position + rotate(start.rotation, middle) - carriedBy.position);
  return hold;
}

Result<SceneForces> SceneForces::load(const SceneFile& scene, const Groom& groom, const Motion& head,
                                      std::vector<std::string>& warnings) {
  if (scene.goal.shape && !scene.holds.empty())
    return Error{
        "goal.shape = true cannot stand with [[hold]]: a hold pulls hair to places, and goals are of one "
        "kind; leave out one of them"};
  SceneForces self;
  self.scene_.fields = scene.fields;
  self.scene_.holds = scene.holds;
  for (std::size_t i = 0; i < scene.fields.size(); ++i) {
    const SceneForceField& stated = scene.fields[i];
    const auto failed = [&](const Error& cause) {
      return Error{fmt::format("the field {}: {}", nameInKeys(stated.name, i), cause.message)};
    };
    auto carrier = carrierOf(scene, stated.bind, stated.joint, warnings);
    if (!carrier) return failed(carrier.error());
    ForceField field = forceFieldOf(stated, i);
    if (!stated.file.empty()) {
      auto grid = readVelocities(stated.file, stated.cell);
      if (!grid) return failed(grid.error());
      field.grid = std::make_shared<const VelocityGrid>(std::move(*grid));
    }
    self.fields_.push_back({std::move(*carrier), std::move(field)});
  }
  for (std::size_t i = 0; i < scene.holds.size(); ++i) {
    auto hold = holdOf(scene, scene.holds[i], groom, head, warnings);
    if (!hold)
      return Error{fmt::format("the hold {}: {}", nameInKeys(scene.holds[i].name, i), hold.error().message)};
    self.holds_.push_back(std::move(*hold));
  }
  if (Status loaded = self.loadGoal(scene, groom); !loaded)
    return Error{fmt::format("the goal: {}", loaded.error().message)};
  return self;
}

Status SceneForces::loadGoal(const SceneFile& scene, const Groom& groom) {
  hasGoalFile_ = !scene.goalFile.empty();
  const auto factors = factorsOf(kGoalStrengthMap, scene, groom.strandCount());
  if (!factors) return factors.error();
  for (std::size_t s = 0; s < factors->size(); ++s)
    goalFactors_.insert(goalFactors_.end(), groom.firstPoint[s + 1] - groom.firstPoint[s], (*factors)[s]);
  if (haveGoals()) groom_ = goalOf(groom);
  if (!hasGoalFile_) return {};
  if (holdsAnimation(scene.goalFile)) {
    auto animation = GoalAnimation::open(scene.goalFile, groom, foreignReadingOf(scene));
    if (!animation) return animation.error();
    animation_ = std::move(*animation);
    return {};
  }
  SceneGroom placed = scene.groom;
  placed.generate.clear();
  placed.file = scene.goalFile;
  auto pose = loadGroom(placed);
  if (!pose) return pose.error();
  if (pose->groom.firstPoint != groom.firstPoint)
    return Error{
        fmt::format("{} has other strands than the groom; expected the same ones, particle for particle",
                    scene.goalFile.string())};
  groom_.places = goalOf(pose->groom).places;
  return {};
}

std::vector<ForceField> SceneForces::fieldsAt(double seconds, const HeadPose& head,
                                              const SceneKeys* keys) const {
  const std::vector<SceneForceField> stated = keys ? keys->fieldsAt(seconds) : scene_.fields;
  std::vector<ForceField> fields;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    ForceField field = fields_[i].field;
    setStrength(stated[i], field);
    field.reach = stated[i].reach;
    field.front = stated[i].kind == "blast" ? stated[i].speed * (seconds - stated[i].start) : 0;
    field.place =
        toCarrier(fields_[i].carrier.poseAt(seconds, head), {stated[i].position, field.place.rotation});
    fields.push_back(std::move(field));
  }
  return fields;
}

void SceneForces::holdStart(const Groom& groom, std::vector<Vec3f> places, double seconds) {
  if (!haveGoals()) groom_ = goalOf(groom);
  startPlaces_ = std::move(places);
  startSeconds_ = seconds;
}

Result<GoalPose> SceneForces::goalsAt(double seconds, const HeadPose& head, const GoalSettings& goal,
                                      const SceneKeys* keys) const {
  const std::vector<SceneHold> stated = keys ? keys->holdsAt(seconds) : scene_.holds;
  GoalPose pose{groom_.places, std::vector<float>(groom_.places.size(), 0)};
  if (goal.on) pose.strengths = strengthsOf(groom_, goal);
  for (std::size_t i = 0; i < goalFactors_.size(); ++i) pose.strengths[i] *= goalFactors_[i];
  if (animation_) {
    auto places = animation_->placesAt(seconds, head);
    if (!places) return places.error();
    pose.places = std::move(*places);
  }
  const Quatd back = head.rotation.conjugate();
  for (std::size_t h = 0; h < holds_.size(); ++h) {
    const Hold& hold = holds_[h];
    const double strength = stated[h].strength * shareHeld(stated[h], seconds);
    const BodyPose carrier = hold.carrier.poseAt(seconds, head);
    const Vec3d middle = stated[h].position.value_or(hold.middle);
    for (const Held& held : hold.held) {
      Vec3d place = middle + held.offset * stated[h].gather;
      if (!hold.carrier.isHeads())  // goals are in the groom's axes
        place = rotate(back, carrier.position + rotate(carrier.rotation, place) - head.position);
      addSpring(place, strength, held.particle, pose);
    }
  }
  const double left = startSeconds_ > 0 ? 1 - seconds / startSeconds_ : 0;
  for (std::size_t i = 0; left > 0 && i < startPlaces_.size(); ++i)
    addSpring(Vec3d(startPlaces_[i]), left * kStartStrength, i, pose);
  return pose;
}

Result<FrameForces> SceneForces::inFrame(const Moment& begin, const Moment& end, const GoalSettings& goal,
                                         const SceneKeys* keys) const {
  FrameForces forces;
  forces.fieldsFrom = fieldsAt(begin.seconds, begin.head, keys);
  forces.fields = fieldsAt(end.seconds, end.head, keys);
  if (!haveGoals()) return forces;
  const GoalSettings now = keys ? keys->goalAt(end.seconds) : goal;
  auto from = goalsAt(begin.seconds, begin.head, now, keys), to = goalsAt(end.seconds, end.head, now, keys);
  if (!from) return from.error();
  if (!to) return to.error();
  forces.placesFrom = std::move(from->places);
  forces.goals = std::move(*to);
  forces.goalDamping = now.damping;
  return forces;
}

}  // namespace ringlet
