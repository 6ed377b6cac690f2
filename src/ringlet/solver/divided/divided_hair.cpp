// Implements solver/divided/divided_hair.h.
#include "ringlet/solver/divided/divided_hair.h"

#include <span>
#include <utility>

#include "layout/parts.h"
#include "layout/types.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet_shaders/part_pack_plain.h"
#include "ringlet_shaders/part_unpack_plain.h"

namespace ringlet {
namespace {

constexpr std::uint32_t kJointGroupSize = 64;

gpu::KernelDescription describe(const char* name, std::span<const std::uint32_t> spirv) {
  gpu::KernelDescription description;
  description.name = name;
  description.spirv = spirv;
  description.remedy = "take another device, or do not divide the hair";
  description.pushConstantBytes = sizeof(layout::PartParameters);
  description.constants = {{layout::kSpecGroupSize, kJointGroupSize}};
  description.groupSize = kJointGroupSize;
  return description;
}

// Bytes of a particle's row.
std::size_t rowBytes(Rows rows) {
  return sizeof(float) * (rows == Rows::step ? layout::kFloatsOfStepRow : layout::kFloatsOfSolveRow);
}

}  // namespace

Result<DividedHair> DividedHair::create(gpu::Device& device, const RestContacts& contacts,
                                        const RestHalo& halo, PartLink& link, const DeviceChunk& hair) {
  DividedHair self(link);
  // The contact particles of each strand.
  std::vector<std::vector<std::uint32_t>> particlesOf(contacts.particles.radii.size());
  for (std::size_t c = 0; c < contacts.particles.particles.size(); ++c)
    particlesOf[contacts.particles.strands[c]].push_back(contacts.particles.particles[c]);
  const auto make = [&](Direction& direction, const gpu::KernelDescription& description,
                        std::vector<std::uint32_t> RestHalo::Peer::*strands) -> Status {
    std::vector<std::uint32_t> particles;
    for (const RestHalo::Peer& peer : halo.peers) {
      for (const std::uint32_t s : peer.*strands)
        particles.insert(particles.end(), particlesOf[s].begin(), particlesOf[s].end());
      direction.ends.push_back(static_cast<std::uint32_t>(particles.size()));
    }
    auto kernel = gpu::Kernel::create(device, description);
    if (!kernel) return kernel.error();
    auto list = createFilled(device, particles, "particles of a halo");
    if (!list) return list.error();
    auto rows = gpu::Buffer::create(device, particles.size() * rowBytes(Rows::step), gpu::BufferKind::stream,
                                    "rows of a halo");
    if (!rows) return rows.error();
    auto bindings = gpu::Bindings::create(**kernel, {{layout::kBindPartPositions, hair.positions},
                                                     {layout::kBindPartVelocities, hair.velocities},
                                                     {layout::kBindPartSolved, hair.solved},
                                                     {layout::kBindPartParticles, *list},
                                                     {layout::kBindPartRows, *rows}});
    if (!bindings) return bindings.error();
    direction.kernel = std::move(*kernel);
    direction.particles.emplace(std::move(*list));
    direction.rows.emplace(std::move(*rows));
    direction.bindings.emplace(std::move(*bindings));
    return {};
  };
  for (const RestHalo::Peer& peer : halo.peers) self.peers_.push_back(peer.part);
  if (Status made = make(self.out_, describe("part_pack", k_part_pack_plain), &RestHalo::Peer::out); !made)
    return made.error();
  if (Status made = make(self.in_, describe("part_unpack", k_part_unpack_plain), &RestHalo::Peer::in); !made)
    return made.error();
  return self;
}

void DividedHair::record(gpu::CommandList& list, const Direction& direction, Rows rows) const {
  const std::uint32_t count = direction.count();
  if (count == 0) return;
  const layout::PartParameters parameters{.count = count, .isStep = rows == Rows::step ? 1u : 0u};
  list.dispatch(*direction.kernel, *direction.bindings, parameters,
                (count + kJointGroupSize - 1) / kJointGroupSize);
}

void DividedHair::recordOut(gpu::CommandList& list, Rows rows) const { record(list, out_, rows); }
void DividedHair::recordIn(gpu::CommandList& list, Rows rows) const { record(list, in_, rows); }

Status DividedHair::exchange(Rows rows) {
  const auto section = [&](const Direction& direction, std::size_t peer) {
    const std::size_t begin = peer > 0 ? direction.ends[peer - 1] : 0;
    return direction.rows->mapped().subspan(begin * rowBytes(rows),
                                            (direction.ends[peer] - begin) * rowBytes(rows));
  };
  std::vector<PartLink::Message> messages;
  for (std::size_t k = 0; k < peers_.size(); ++k)
    messages.push_back({peers_[k], section(out_, k), section(in_, k)});
  return link_->exchange(messages);
}

std::uint64_t DividedHair::bytes() const {
  return out_.particles->bytes() + out_.rows->bytes() + in_.particles->bytes() + in_.rows->bytes();
}

}  // namespace ringlet
