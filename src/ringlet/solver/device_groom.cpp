// Implements solver/device_groom.h.
#include "ringlet/solver/device_groom.h"

#include <fmt/format.h>

#include <algorithm>

namespace ringlet {
namespace {

using gpu::Buffer;
using gpu::BufferKind;

template <class T>
Result<Buffer> createFilled(gpu::Device& device, const std::vector<T>& values, const std::string& name) {
  auto buffer = Buffer::create(device, values.size() * sizeof(T), BufferKind::storage, name);
  if (!buffer) return buffer;
  if (Status status = buffer->upload(std::as_bytes(std::span(values))); !status) return status.error();
  return buffer;
}

Result<Buffer> createZero(gpu::Device& device, std::uint64_t bytes, const std::string& name) {
  auto buffer = Buffer::create(device, bytes, BufferKind::storage, name);
  if (!buffer) return buffer;
  if (Status status = buffer->fillZero(); !status) return status.error();
  return buffer;
}

}  // namespace

Result<DeviceGroom> DeviceGroom::create(gpu::Device& device, const RestState& rest,
                                        std::uint64_t scratchRecords, bool withContacts) {
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
  auto poses =
      Buffer::create(device, layout::kMaxStepPoses * sizeof(layout::StepPose), BufferKind::stream, "poses");
  if (!poses) return poses.error();
  const std::uint64_t contactParticles = withContacts ? rest.points.size() : 0;
  auto solved = createZero(device, contactParticles * sizeof(layout::vec4), "solved velocities");
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
  const std::uint64_t bytes = device.properties().maxTexelRecords * sizeof(layout::vec4);
  return std::max({positions.bytes(), particles.bytes(), strands.bytes(), contactSystems.bytes()}) <= bytes;
}

std::span<layout::StepPose> DeviceGroom::mappedPoses() const {
  const auto bytes = poses.mapped();
  return {reinterpret_cast<layout::StepPose*>(bytes.data()), bytes.size() / sizeof(layout::StepPose)};
}

}  // namespace ringlet
