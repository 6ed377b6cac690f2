// Implements solver/inputs/fields_input.h.
#include "ringlet/solver/inputs/fields_input.h"

#include <fmt/format.h>

#include <algorithm>

#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/solver/inputs/frame_inputs.h"

namespace ringlet {
namespace {

float inverseOr0(double x) { return x > 0 ? static_cast<float>(1 / x) : 0; }

// The field in a step that begins with the head at `head`, which moves at velocity `travel` [m/s].
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

Result<FieldsInput> FieldsInput::create(const InputSource& from, std::span<const ForceField> fields) {
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
  auto nodeBuffer = createFilled(from.device, nodes, "grids of fields");
  if (!nodeBuffer) return nodeBuffer.error();
  FieldsInput self(std::move(*nodeBuffer));
  const auto mostSteps = static_cast<std::uint64_t>(from.settings.stepsPerFrame);
  if (Status status = self.stage(from, mostSteps * fields.size() * sizeof(layout::StepField), "fields");
      !status)
    return status.error();
  self.firstNodes_ = std::move(firstNodes);
  self.set(fields, fields);
  return self;
}

bool FieldsInput::hasRoomFor(std::span<const ForceField> fields) const {
  const auto gridOf = [](const ForceField& field) { return field.grid.get(); };
  return std::ranges::equal(fields, to_, {}, gridOf, gridOf);
}

void FieldsInput::set(std::span<const ForceField> from, std::span<const ForceField> to) {
  from_.assign(from.begin(), from.end());
  to_.assign(to.begin(), to.end());
}

void FieldsInput::writeFrame(std::size_t slot, const FrameContext& frame) {
  const std::size_t steps = frame.steps(), count = to_.size();
  const auto out = staged_[0].of<layout::StepField>(slot);
  for (std::size_t k = 0; k < steps; ++k) {
    const HeadPose& head = frame.heads[1 + k];
    const Vec3d travel = (frame.heads[2 + k].position - head.position) / frame.stepSeconds;
    const double share = static_cast<double>(k + 1) / static_cast<double>(steps);
    for (std::size_t f = 0; f < count; ++f)
      out[k * count + f] = packedField(interpolate(from_[f], to_[f], share), firstNodes_[f], head, travel);
  }
  from_ = to_;
}

gpu::BufferTable FieldsInput::bufferTable(std::size_t) const {
  using namespace layout;
  return {{kBindFields, staged_[0].seen()},
          {kBindFieldNodes, nodes_},
          {kBindFieldTexels, staged_[0].seen()},
          {kBindFieldNodeTexels, nodes_}};
}
std::uint64_t FieldsInput::largestBuffer() const {
  return std::max(FrameInput::largestBuffer(), nodes_.bytes());
}

}  // namespace ringlet
