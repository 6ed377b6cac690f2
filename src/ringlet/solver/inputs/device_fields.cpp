// Implements solver/inputs/device_fields.h.
#include "ringlet/solver/inputs/device_fields.h"

#include <fmt/format.h>

#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"

namespace ringlet {
namespace {

float inverseOr0(double x) { return x > 0 ? static_cast<float>(1 / x) : 0; }

// The field in a step that begins with the head at `head`, which moves at this velocity [m/s].
layout::StepField packedField(const ForceField& field, std::uint32_t firstNode, const HeadPose& head,
                              Vec3d travel) {
  layout::StepField out{};
  out.place = packed3(field.place.position - head.position);
  out.axial = static_cast<float>(field.axial);
  out.axis = packed3(worldAxis(field));
  out.radial = static_cast<float>(field.radial);
  out.still = packed3(travel * -1.0);
  out.around = static_cast<float>(field.around);
  out.aboutAxis = field.aboutAxis ? 1 : 0;
  out.core = static_cast<float>(field.core);
  out.perReach = inverseOr0(field.reach);
  out.drag = static_cast<float>(field.drag);
  out.front = static_cast<float>(field.front);
  out.perThickness = inverseOr0(field.thickness);
  out.rotation = packed(field.place.rotation);
  if (!field.grid) return out;
  out.gridShare = static_cast<float>(field.gridShare);
  out.cell = static_cast<float>(field.grid->cell);
  std::ranges::copy(field.grid->nodes, out.nodes);
  out.firstNode = firstNode;
  return out;
}

}  // namespace

Result<DeviceFields> DeviceFields::create(gpu::Device& device, std::span<const ForceField> fields,
                                          int mostSteps, std::size_t slots) {
  if (fields.size() > kMostForceFields)
    return Error{fmt::format("found {} fields; expected at most {}", fields.size(), kMostForceFields)};
  std::vector<layout::vec4> nodes;
  std::vector<std::uint32_t> firstNodes;
  for (const ForceField& field : fields) {
    if (Status checked = checkForceField(field); !checked) return checked.error();
    firstNodes.push_back(static_cast<std::uint32_t>(nodes.size()));
    if (!field.grid) continue;
    for (const Vec3f& velocity : field.grid->velocities) nodes.push_back(packed(velocity));
  }
  auto steps = FrameInput::create(
      device, static_cast<std::uint64_t>(mostSteps) * fields.size() * sizeof(layout::StepField), slots,
      "fields");
  if (!steps) return steps.error();
  auto nodeBuffer = createFilled(device, nodes, "grids of fields");
  if (!nodeBuffer) return nodeBuffer.error();
  DeviceFields made(std::move(*steps), std::move(*nodeBuffer));
  made.firstNodes_ = std::move(firstNodes);
  made.set(fields, fields);
  return made;
}

bool DeviceFields::hasRoomFor(std::span<const ForceField> fields) const {
  const auto gridOf = [](const ForceField& field) { return field.grid.get(); };
  return std::ranges::equal(fields, to_, {}, gridOf, gridOf);
}

void DeviceFields::set(std::span<const ForceField> from, std::span<const ForceField> to) {
  from_.assign(from.begin(), from.end());
  to_.assign(to.begin(), to.end());
}

void DeviceFields::writeFrame(std::size_t slot, std::span<const HeadPose> heads, double stepSeconds) {
  const std::size_t steps = heads.size() - 1, count = to_.size();
  const auto out = steps_.of<layout::StepField>(slot);
  for (std::size_t k = 0; k < steps; ++k) {
    const Vec3d travel = (heads[k + 1].position - heads[k].position) / stepSeconds;
    const double share = static_cast<double>(k + 1) / static_cast<double>(steps);
    for (std::size_t f = 0; f < count; ++f)
      out[k * count + f] =
          packedField(interpolate(from_[f], to_[f], share), firstNodes_[f], heads[k], travel);
  }
  endFrame();
}

}  // namespace ringlet
