// Implements c/ringlet.h: what acts on hair from outside, forces, goals and fields.
#include <fmt/format.h>

#include <memory>
#include <utility>
#include <vector>

#include "ringlet/c/handles.h"
#include "ringlet/c/poses.h"
#include "ringlet/c/setting_values.h"
#include "ringlet/scene/force_field.h"

namespace ringlet::c {
namespace {

// x, y, z of each.
std::vector<Vec3f> takeVectors(const float* xyz, std::uint64_t count) {
  std::vector<Vec3f> vectors(xyz ? count : 0);
  for (Vec3f& v : vectors) v = {xyz[0], xyz[1], xyz[2]}, xyz += 3;
  return vectors;
}

// 0 stands for the default.
double orElse(double number, double standard) { return number == 0 ? standard : number; }

Outcome takeField(const ringlet_field& from, std::uint32_t index, ForceField& field) {
  field.name = fmt::format("field {}", index);
  const auto place = poseOf<BodyPose>(from.pose);
  if (!place) return notFinite(field.name.c_str());
  field.place = *place;
  const auto rows = forceFieldNumbers();
  Outcome taken = takeNumbers(rows, "field", field.name, from.numbers, from.number_count, field);
  if (!taken.isFine()) return taken;
  if (!from.velocities) return {};
  VelocityGrid grid;
  std::uint64_t count = 1;
  for (std::size_t axisIndex = 0; axisIndex < 3; ++axisIndex) {
    grid.nodes[axisIndex] = from.nodes[axisIndex];
    count *= from.nodes[axisIndex];
    if (count > 0xffffffffu)
      return Outcome::invalid(fmt::format("{} has more nodes than 32 bits count", field.name));
  }
  grid.cell = orElse(from.cell, grid.cell);
  grid.velocities = takeVectors(from.velocities, count);
  field.grid = std::make_shared<const VelocityGrid>(std::move(grid));
  return {};
}

// All of an array; an empty one may be null.
Outcome takeFields(const ringlet_field* from, std::uint32_t count, std::vector<ForceField>& fields) {
  if (count > 0 && !hasSize(from)) return Outcome::invalid("there are no fields that say their size");
  fields.resize(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    if (Outcome outcome = takeField(taken(from, k), k, fields[k]); !outcome.isFine()) return outcome;
  }
  return {};
}

}  // namespace
}  // namespace ringlet::c

using namespace ringlet;
using namespace ringlet::c;

ringlet_result ringlet_hair_set_forces(ringlet_hair* hair, const float* xyz, uint64_t particle_count) {
  return guarded([&]() -> Outcome {
    if (!hair || !xyz || particle_count != hair->particleCount)
      return Outcome::invalid(
          fmt::format("ringlet_hair_set_forces takes hair, and forces for its {} particles",
                      hair ? hair->particleCount : 0));
    if (Outcome outcome = checkProcess(*hair); !outcome.isFine()) return outcome;
    return hair->simulation.setForces(takeVectors(xyz, particle_count));
  });
}

ringlet_result ringlet_hair_set_goals(ringlet_hair* hair, const ringlet_goals* goals) {
  return guarded([&]() -> Outcome {
    const ringlet_goals from = hasSize(goals) ? taken(goals) : ringlet_goals{};
    if (!hair || !from.places || !from.strengths || from.particle_count != hair->particleCount)
      return Outcome::invalid(fmt::format(
          "ringlet_hair_set_goals takes hair, and places and strengths for its {} particles in a struct that "
          "says its size",
          hair ? hair->particleCount : 0));
    if (Outcome outcome = checkProcess(*hair); !outcome.isFine()) return outcome;
    const std::vector<Vec3f> places = takeVectors(from.places, from.particle_count);
    const std::vector<Vec3f> before = takeVectors(from.from, from.particle_count);
    const std::vector<float> strengths(from.strengths, from.strengths + from.particle_count);
    return hair->simulation.setGoals(places, strengths,
                                     from.undamped != 0 ? 0 : orElse(from.damping_ratio, 1), before);
  });
}

ringlet_result ringlet_hair_set_fields(ringlet_hair* hair, const ringlet_field* fields,
                                       const ringlet_field* from, uint32_t field_count) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_hair_set_fields takes hair", {given("hair", hair)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkProcess(*hair); !outcome.isFine()) return outcome;
    std::vector<ForceField> after, before;
    if (Outcome outcome = takeFields(fields, field_count, after); !outcome.isFine()) return outcome;
    if (from) {
      if (Outcome outcome = takeFields(from, field_count, before); !outcome.isFine()) return outcome;
    }
    return hair->simulation.setFields(after, before);
  });
}
