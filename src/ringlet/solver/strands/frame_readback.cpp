// Implements solver/strands/frame_readback.h.
#include "ringlet/solver/strands/frame_readback.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "layout/frame.h"
#include "ringlet/base/packed.h"
#include "ringlet_shaders/frame_positions_plain.h"

namespace ringlet {
namespace {

constexpr std::uint32_t kReadbackGroupSize = 64;
constexpr std::uint64_t kPlaceBytes = sizeof(Vec3f);
static_assert(kPlaceBytes == 3 * sizeof(float));

gpu::KernelDescription describe() {
  gpu::KernelDescription description;
  description.name = "frame_positions";
  description.spirv = k_frame_positions_plain;
  description.remedy = "take another device, or keep positions on the device";
  description.pushConstantBytes = sizeof(layout::FrameParameters);
  description.constants = {{layout::kSpecGroupSize, kReadbackGroupSize}};
  description.groupSize = kReadbackGroupSize;
  return description;
}

// The number of positions that fit into mostBytes, such that the next part can begin at a valid offset.
std::uint64_t placesOfPart(std::uint64_t mostBytes, std::uint64_t alignment) {
  const std::uint64_t unit = std::lcm(kPlaceBytes, alignment);
  return std::max<std::uint64_t>(mostBytes / unit, 1) * unit / kPlaceBytes;
}

}  // namespace

FramePlaces FramePlaces::of(const RestState& rest) {
  const std::size_t here = hereCount(rest);
  std::size_t count = 0, rigid = 0;
  for (std::size_t s = 0; s < here; ++s) count += rest.strands[s].particleCount;
  for (const RigidStrand& strand : rest.rigid) rigid += strand.points.size();
  FramePlaces all{.areOfGroom = count + rigid == rest.groomParticleCount};
  if (all.areOfGroom) {
    all.places = groomIndices(rest);
    all.count = static_cast<std::uint32_t>(rest.groomParticleCount);
  } else {
    all.places.resize(rest.points.size(), layout::kNoPlace);
    std::iota(all.places.begin(), all.places.begin() + static_cast<std::ptrdiff_t>(count), 0u);
    all.count = static_cast<std::uint32_t>(count);
  }
  return all;
}

Result<std::shared_ptr<const gpu::Buffer>> FramePlaces::onDevice(gpu::Device& device,
                                                                 const GroomChunk& chunk) const {
  const auto mine = std::span(places).subspan(chunk.particleBegin, chunk.particleCount());
  auto buffer = createZero(device, mine.size_bytes(), "places in a frame");
  if (!buffer) return buffer.error();
  if (Status status = buffer->upload(std::as_bytes(mine)); !status) return status.error();
  return std::make_shared<const gpu::Buffer>(std::move(*buffer));
}

Result<FrameReadback> FrameReadback::create(gpu::Device& device, const DeviceGroom& groom,
                                            std::uint32_t count, std::uint64_t mostBufferBytes) {
  auto frame = gpu::Buffer::create(device, count * kPlaceBytes, gpu::BufferKind::stream,
                                   "positions read back", gpu::BufferUse::inParts);
  if (!frame) return frame.error();
  FrameReadback self(std::move(*frame));
  std::ranges::fill(self.positions(), Vec3f());  // places of rigid strands stay 0
  self.groom_ = &groom;
  Status made = device.properties().isCpu ? self.makeCopies(device, groom)
                                          : self.makePieces(device, groom, count, mostBufferBytes);
  if (!made) return made.error();
  return self;
}

Status FrameReadback::makeCopies(gpu::Device& device, const DeviceGroom& groom) {
  for (const DeviceChunk& chunk : groom.chunks) {
    auto copy = gpu::Buffer::create(device, chunk.part.particleCount() * sizeof(layout::vec4),
                                    gpu::BufferKind::stream, "positions in device order");
    if (!copy) return copy.error();
    copies_.push_back(std::move(*copy));
  }
  return {};
}

Status FrameReadback::makePieces(gpu::Device& device, const DeviceGroom& groom, std::uint32_t count,
                                 std::uint64_t mostBufferBytes) {
  auto kernel = gpu::Kernel::create(device, describe());
  if (!kernel) return kernel.error();
  kernel_ = std::move(*kernel);
  mostGroups_ = device.properties().maxGroupCount;
  const std::uint64_t most = placesOfPart(mostBufferBytes, frame_.alignment());
  std::vector<std::uint32_t> begins;
  for (std::uint64_t begin = 0; begin < count; begin += most) {
    begins.push_back(static_cast<std::uint32_t>(begin));
    if (count <= most) break;
    const std::uint64_t places = std::min<std::uint64_t>(most, count - begin);
    auto part = gpu::Buffer::part(frame_, begin * kPlaceBytes, places * kPlaceBytes, "positions read back");
    if (!part) return part.error();
    parts_.push_back(std::move(*part));
  }
  for (const DeviceChunk& chunk : groom.chunks) {
    for (std::size_t k = 0; k < begins.size(); ++k) {
      const gpu::Buffer& out = parts_.empty() ? frame_ : parts_[k];
      auto bindings = gpu::Bindings::create(*kernel_, {{layout::kBindFramePositions, chunk.positions},
                                                       {layout::kBindFramePlaces, *chunk.framePlaces},
                                                       {layout::kBindFrameOut, out}});
      if (!bindings) return bindings.error();
      const std::uint32_t end = k + 1 < begins.size() ? begins[k + 1] : count;
      pieces_.push_back({std::move(*bindings), chunk.part.particleCount(), begins[k], end});
    }
  }
  return {};
}

void FrameReadback::record(gpu::CommandList& list) const {
  for (std::size_t c = 0; c < copies_.size(); ++c)
    list.copyBuffer(groom_->chunks[c].positions, copies_[c],
                    groom_->chunks[c].part.particleCount() * sizeof(layout::vec4));
  for (const Piece& piece : pieces_) {
    const std::uint32_t groups =
        std::min((piece.count + kReadbackGroupSize - 1) / kReadbackGroupSize, mostGroups_);
    if (groups == 0) continue;
    list.dispatch(*kernel_, piece.bindings, layout::FrameParameters{piece.count, piece.begin, piece.end},
                  groups);
  }
}

void FrameReadback::put(const FramePlaces& places, const GroomChunk& chunk,
                        std::span<const layout::vec4> values) const {
  const std::span<Vec3f> all = positions();
  const auto mine = std::span(places.places).subspan(chunk.particleBegin, chunk.particleCount());
  for (std::size_t i = 0; i < mine.size(); ++i)
    if (mine[i] < all.size()) all[mine[i]] = unpacked(values[i]);
}

void FrameReadback::arrive(const FramePlaces& places) {
  for (std::size_t c = 0; c < copies_.size(); ++c) {
    const auto* values = reinterpret_cast<const layout::vec4*>(copies_[c].mapped().data());
    const GroomChunk& chunk = groom_->chunks[c].part;
    put(places, chunk, {values, chunk.particleCount()});
  }
}

std::uint64_t FrameReadback::bytes() const {
  std::uint64_t sum = frame_.bytes();
  for (const gpu::Buffer& copy : copies_) sum += copy.bytes();
  return sum;
}

Status FrameReadback::download(const FramePlaces& places) {
  for (const DeviceChunk& chunk : groom_->chunks) {
    auto values = downloadAll<layout::vec4>(chunk.positions, chunk.part.particleCount());
    if (!values) return values.error();
    put(places, chunk.part, *values);
  }
  return {};
}

std::span<Vec3f> FrameReadback::positions() const {
  const auto bytes = frame_.mapped();
  return {reinterpret_cast<Vec3f*>(bytes.data()), bytes.size() / kPlaceBytes};
}

}  // namespace ringlet
