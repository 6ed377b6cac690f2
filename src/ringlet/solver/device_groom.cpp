// Implements solver/device_groom.h.
#include "ringlet/solver/device_groom.h"

#include <algorithm>

#include "ringlet/solver/device_buffers.h"

namespace ringlet {

using gpu::Buffer;
using gpu::BufferKind;

Result<DeviceGroom> DeviceGroom::create(gpu::Device& device, const RestState& rest,
                                        std::uint64_t scratchRecords, bool withContacts, bool keepsSolved,
                                        std::size_t slots) {
  const std::uint64_t stateBytes = rest.points.size() * sizeof(layout::vec4);
  auto positions = createZero(device, stateBytes, "positions");
  if (!positions) return positions.error();
  auto velocities = createZero(device, stateBytes, "velocities");
  if (!velocities) return velocities.error();
  auto particles = createFilled(device, rest.particles, "particles");
  if (!particles) return particles.error();
  auto strands = createFilled(device, rest.strands, "strands");
  if (!strands) return strands.error();
  auto reports = createZero(device, rest.strands.size() * sizeof(layout::StrandReport), "reports");
  if (!reports) return reports.error();
  auto scratch = createZero(device, scratchRecords * sizeof(layout::vec4), "scratch");
  if (!scratch) return scratch.error();
  auto poses = FrameInput::create(device, layout::kMaxStepPoses * sizeof(layout::StepPose), slots, "poses");
  if (!poses) return poses.error();
  const std::uint64_t contactParticles = withContacts ? rest.points.size() : 0;
  auto solved = createZero(device, keepsSolved ? stateBytes : 0, "solved velocities");
  if (!solved) return solved.error();
  auto systems = createZero(device, contactParticles * sizeof(layout::ContactSystem), "contact systems");
  if (!systems) return systems.error();
  auto control = Buffer::create(device, withContacts ? sizeof(layout::ContactControl) : 0, BufferKind::stream,
                                "contact control");
  if (!control) return control.error();
  return DeviceGroom{std::move(*positions), std::move(*velocities), std::move(*particles),
                     std::move(*strands),   std::move(*reports),    std::move(*scratch),
                     std::move(*poses),     std::move(*solved),     std::move(*systems),
                     std::move(*control)};
}

bool DeviceGroom::fitsTexels(const gpu::Device& device) const {
  return isSeenAsTexels(
      device, std::max({positions.bytes(), particles.bytes(), strands.bytes(), contactSystems.bytes()}));
}

std::vector<std::uint32_t> groomIndices(const RestState& rest) {
  std::vector<std::uint32_t> indices(rest.points.size());
  for (std::size_t s = 0; s < rest.strands.size(); ++s) {
    for (std::uint32_t i = 0; i < rest.strands[s].particleCount; ++i)
      indices[rest.strands[s].firstParticle + i] = rest.firstInGroom[s] + i;
  }
  return indices;
}

}  // namespace ringlet
