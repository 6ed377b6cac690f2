// Implements solver/strands/device_groom.h.
#include "ringlet/solver/strands/device_groom.h"

#include <fmt/format.h>

#include <limits>

namespace ringlet {
namespace {

using gpu::Buffer;
using gpu::BufferKind;

// Uploads the strands of a chunk; `all`: of all chunks, in device order.
Status uploadStrands(Buffer& strands, std::span<const layout::StrandRest> all, const GroomChunk& part) {
  constexpr std::size_t kPieceStrands = 1 << 16;  // 7 MiB
  std::vector<layout::StrandRest> piece;
  for (std::size_t done = 0; done < part.strandCount(); done += piece.size()) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(part.strandBegin + done);
    const std::size_t count = std::min(kPieceStrands, part.strandCount() - done);
    piece.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    for (layout::StrandRest& strand : piece) strand.firstParticle -= part.particleBegin;
    if (Status status = strands.upload(std::as_bytes(std::span(piece)), done * sizeof(layout::StrandRest));
        !status)
      return status;
  }
  return {};
}

Result<std::shared_ptr<Buffer>> createStrands(gpu::Device& device, std::span<const layout::StrandRest> all,
                                              const GroomChunk& part) {
  auto strands =
      Buffer::create(device, part.strandCount() * sizeof(layout::StrandRest), BufferKind::storage, "strands");
  if (!strands) return strands.error();
  if (Status status = uploadStrands(*strands, all, part); !status) return status.error();
  return std::make_shared<Buffer>(std::move(*strands));
}

// `ofPlace`: if not null, the buffers of a head that shares a row with others; those that change are moved
// from it.
Result<DeviceChunk> createChunk(gpu::Device& device, const ConstantChunk& constants,
                                const GroomRecords& records, HeadBuffers* ofPlace) {
  const GroomChunk& part = constants.part;
  const std::uint64_t particleCount = part.particleCount(), strandCount = part.strandCount();
  const auto moving = [&](Buffer HeadBuffers::*own, std::uint64_t bytes, const char* name) -> Result<Buffer> {
    if (!ofPlace) return createZero(device, bytes, name);
    if (Status status = (ofPlace->*own).fillZero(); !status) return status.error();
    return std::move(ofPlace->*own);
  };
  auto positions = moving(&HeadBuffers::positions, particleCount * records.position, "positions");
  if (!positions) return positions.error();
  auto velocities = moving(&HeadBuffers::velocities, particleCount * records.velocity, "velocities");
  if (!velocities) return velocities.error();
  auto reports = moving(&HeadBuffers::reports, strandCount * records.report, "reports");
  if (!reports) return reports.error();
  auto taps = createZero(device, particleCount * records.taps, "taps");
  if (!taps) return taps.error();
  auto solved = createZero(device, particleCount * records.solved, "solved velocities");
  if (!solved) return solved.error();
  auto systems = createZero(device, particleCount * records.contactSystem, "contact systems");
  if (!systems) return systems.error();
  auto added = createZero(device, particleCount * records.addedByVolume, "added by the volume");
  if (!added) return added.error();
  return DeviceChunk{.part = part,
                     .particles = constants.particles,
                     .strands = constants.strands,
                     .framePlaces = constants.framePlaces,
                     .positions = std::move(*positions),
                     .velocities = std::move(*velocities),
                     .reports = std::move(*reports),
                     .taps = std::move(*taps),
                     .solved = std::move(*solved),
                     .contactSystems = std::move(*systems),
                     .addedByVolume = std::move(*added)};
}

}  // namespace

std::uint64_t mostBufferBytes(const gpu::Device& device, const KernelChoice& choice) {
  const gpu::DeviceProperties& p = device.properties();
  const std::uint64_t most = std::min({p.maxStorageBufferRange, p.maxAllocationBytes,
                                       std::uint64_t{std::numeric_limits<std::uint32_t>::max()}});
  return choice.mostBufferBytes > 0 ? std::min(most, choice.mostBufferBytes) : most;
}

Result<std::vector<GroomChunk>> cutForDevice(const gpu::Device& device,
                                             std::span<const std::uint32_t> particleCounts,
                                             const GroomRecords& records, const Settings& settings,
                                             const KernelChoice& choice) {
  const gpu::DeviceProperties& p = device.properties();
  std::uint64_t most = mostBufferBytes(device, choice);
  if (!settings.contacts.on && isSeenAsTexels(device, kLeastTexelBytes))
    most = std::min(most, p.maxTexelRecords * sizeof(layout::vec4));
  auto chunks = cutGroom(particleCounts, records, most,
                         settings.contacts.on ? "contacts"
                         : choice.taps        ? "taps"
                                              : "");
  if (!chunks) return chunks;
  const std::uint64_t particles = chunks->back().particleEnd, strands = chunks->back().strandEnd;
  std::uint64_t bytes = particles * records.perParticle() + strands * records.perStrand();
  if (gpu::isOneMemory(device))
    bytes += Simulation::kFramesInFlight *
             (particles * records.perParticleOfFrame() + strands * records.perStrandOfFrame());
  std::uint64_t available = gpu::availableStorageBytes(device);
  if (choice.mostDeviceBytes > 0) available = std::min(available, choice.mostDeviceBytes);
  const std::string what = fmt::format("a groom of {} strands and {} particles", strands, particles);
  if (Status status = checkMemory(what, bytes, available); !status) return status.error();
  return chunks;
}

Result<ConstantChunk> ConstantChunk::create(gpu::Device& device, std::span<const layout::StrandRest> strands,
                                            std::span<const layout::ParticleRest> particles,
                                            std::span<const EdgeFactors> factors, const GroomChunk& part) {
  const std::size_t recordCount = (factors.empty() ? 1 : 2) * std::size_t{part.particleCount()};
  auto ofParticles = createZero(device, recordCount * sizeof(layout::ParticleRest), "particles");
  if (!ofParticles) return ofParticles.error();
  const auto mine = std::as_bytes(particles.subspan(part.particleBegin, part.particleCount()));
  if (Status status = ofParticles->upload(mine); !status) return status.error();
  if (!factors.empty()) {
    const auto behind = std::as_bytes(factors.subspan(part.particleBegin, part.particleCount()));
    if (Status status = ofParticles->upload(behind, mine.size()); !status) return status.error();
  }
  auto ofStrands = createStrands(device, strands, part);
  if (!ofStrands) return ofStrands.error();
  return ConstantChunk{part, std::make_shared<Buffer>(std::move(*ofParticles)), std::move(*ofStrands)};
}

Status ConstantChunk::upload(std::span<const layout::StrandRest> all,
                             std::span<const layout::ParticleRest> allParticles) {
  const auto mine = allParticles.subspan(part.particleBegin, part.particleCount());
  if (Status status = particles->upload(std::as_bytes(mine)); !status) return status;
  return uploadStrands(*strands, all, part);
}

Status DeviceGroom::setConstants(gpu::Device& device, std::span<const layout::StrandRest> strands,
                                 std::span<const layout::ParticleRest> particles,
                                 std::span<const EdgeFactors> factors) {
  for (ConstantChunk& chunk : own) {
    if (Status status = chunk.upload(strands, particles); !status) return status;
  }
  if (!own.empty()) return {};
  std::vector<ConstantChunk> made;
  for (const DeviceChunk& chunk : chunks) {
    auto constants = ConstantChunk::create(device, strands, particles, factors, chunk.part);
    if (!constants) return constants.error();
    made.push_back(std::move(*constants));
  }
  own = std::move(made);
  for (std::size_t c = 0; c < chunks.size(); ++c)
    chunks[c].strands = own[c].strands, chunks[c].particles = own[c].particles;
  return {};
}

Result<std::vector<layout::ParticleRest>> particlesOf(std::span<const ConstantChunk> chunks) {
  std::vector<layout::ParticleRest> all;
  for (const ConstantChunk& chunk : chunks) {
    const auto some = downloadAll<layout::ParticleRest>(*chunk.particles, chunk.part.particleCount());
    if (!some) return some.error();
    all.insert(all.end(), some->begin(), some->end());
  }
  return all;
}

Result<DeviceGroom> DeviceGroom::create(gpu::Device& device, std::span<const ConstantChunk> constants,
                                        std::span<const layout::StrandRest> shifted,
                                        const GroomRecords& records, HeadPlaces* places) {
  std::optional<HeadPlace> place;
  std::optional<HeadBuffers> ofPlace;
  if (places) {
    auto taken = places->take();
    if (!taken) return taken.error();
    auto part = taken->part(1);
    if (!part) return part.error();
    place = std::move(*taken), ofPlace = std::move(*part);
  }
  auto control = createZero(
      device, records.contactSystem + records.addedByVolume > 0 ? sizeof(layout::ContactControl) : 0,
      "contact control");
  if (!control) return control.error();
  auto controlRead = gpu::Buffer::create(device, sizeof(layout::ContactControl), gpu::BufferKind::stream,
                                         "contact control read back");
  if (!controlRead) return controlRead.error();
  DeviceGroom groom{{}, std::move(*control), std::move(*controlRead), !shifted.empty()};
  groom.place = std::move(place);
  for (const ConstantChunk& constant : constants) {
    auto chunk = createChunk(device, constant, records, ofPlace ? &*ofPlace : nullptr);
    if (!chunk) return chunk.error();
    if (!shifted.empty()) {
      auto strands = createStrands(device, shifted, constant.part);
      if (!strands) return strands.error();
      chunk->strands = std::move(*strands);
    }
    groom.chunks.push_back(std::move(*chunk));
  }
  return groom;
}

gpu::BufferTable DeviceGroom::bufferTable(std::size_t chunk) const {
  using namespace layout;
  const DeviceChunk& c = chunks[chunk];
  return {{kBindPositions, c.positions},
          {kBindVelocities, c.velocities},
          {kBindParticles, *c.particles},
          {kBindStrands, *c.strands},
          {kBindReports, c.reports},
          {kBindTaps, c.taps},
          {kBindSolved, c.solved},
          {kBindContactSystems, c.contactSystems},
          {kBindContactControl, contactControl},
          {kBindPositionTexels, c.positions},
          {kBindVelocityTexels, c.velocities},
          {kBindParticleTexels, *c.particles},
          {kBindStrandTexels, *c.strands},
          {kBindContactSystemTexels, c.contactSystems},
          {kBindAddedByVolume, c.addedByVolume},
          {kBindAddedByVolumeTexels, c.addedByVolume}};
}

void DeviceGroom::recordControl(gpu::CommandList& list) const {
  list.copyBuffer(contactControl, controlRead, sizeof(layout::ContactControl));
}

const layout::ContactControl& DeviceGroom::control() const {
  return *reinterpret_cast<const layout::ContactControl*>(controlRead.mapped().data());
}

std::uint64_t DeviceGroom::largestTexels() const {
  std::uint64_t largest = place ? place->row().largestBuffer() : 0;
  for (const DeviceChunk& c : chunks)
    largest = std::max({largest, c.positions.bytes(), c.particles->bytes(), c.strands->bytes(),
                        c.contactSystems.bytes(), c.addedByVolume.bytes()});
  return largest;
}

namespace {
std::uint64_t placesBytes(const DeviceChunk& chunk) {
  return chunk.framePlaces ? chunk.framePlaces->bytes() : 0;
}
}  // namespace

std::uint64_t DeviceGroom::particleBytes() const {
  std::uint64_t bytes = 0;
  for (const DeviceChunk& c : chunks)
    bytes += c.positions.bytes() + c.velocities.bytes() + c.particles->bytes() + placesBytes(c) +
             c.taps.bytes() + c.solved.bytes() + c.contactSystems.bytes() + c.addedByVolume.bytes();
  return bytes;
}

std::uint64_t DeviceGroom::strandBytes() const {
  std::uint64_t bytes = 0;
  for (const DeviceChunk& c : chunks) bytes += c.strands->bytes() + c.reports.bytes();
  return bytes;
}

std::uint64_t DeviceGroom::sharedBytes() const {
  std::uint64_t bytes = 0;
  for (const DeviceChunk& c : chunks)
    bytes += placesBytes(c) + (own.empty() ? c.particles->bytes() : 0) +
             (hasOwnStrands || !own.empty() ? 0 : c.strands->bytes());
  return bytes;
}

Result<std::vector<layout::StrandReport>> DeviceGroom::downloadReports() const {
  std::vector<layout::StrandReport> reports(chunks.back().part.strandEnd);
  for (const DeviceChunk& chunk : chunks) {
    const auto part = std::span(reports).subspan(chunk.part.strandBegin, chunk.part.strandCount());
    if (Status status = chunk.reports.download(std::as_writable_bytes(part)); !status) return status.error();
  }
  return reports;
}

std::vector<std::uint32_t> groomIndices(const RestState& rest) {
  std::vector<std::uint32_t> indices(rest.points.size());
  GroomPlaces place(rest);
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>(place(i));
  return indices;
}

}  // namespace ringlet
