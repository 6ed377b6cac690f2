// Implements solver/plan/groom_chunks.h.
#include "ringlet/solver/plan/groom_chunks.h"

#include <fmt/format.h>

#include <algorithm>

#include "layout/contacts.h"
#include "layout/strands.h"
#include "ringlet/base/vec3.h"

namespace ringlet {
namespace {

std::uint64_t largestOfParticle(const GroomRecords& r) {
  return std::max(
      {r.position, r.velocity, r.particleRest, r.taps, r.solved, r.contactSystem, r.addedByVolume, r.force});
}
std::uint64_t largestOfStrand(const GroomRecords& r) {
  return std::max({r.strandRest, r.report, r.rootPoses});
}

std::string mebibytes(std::uint64_t bytes) {
  return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1 << 20));
}

}  // namespace

GroomRecords groomRecords(const Settings& settings, const KernelChoice& choice, ContactKinds kinds,
                          bool isCpu) {
  GroomRecords records;
  records.position = records.velocity = sizeof(layout::vec4);
  records.particleRest = sizeof(layout::ParticleRest);
  records.place = isCpu ? 0 : sizeof(std::uint32_t);
  records.positionInFrame = sizeof(Vec3f) + (isCpu ? records.position : 0);
  if (choice.taps) records.taps = layout::kTapCount * sizeof(layout::vec4);
  if (kinds.any()) records.solved = sizeof(layout::vec4);
  if (kinds.pairs) records.contactSystem = sizeof(layout::ContactSystem);
  if (kinds.volume) records.addedByVolume = sizeof(layout::vec4);
  if (choice.features.forces) records.force = sizeof(layout::vec4);
  if (choice.features.goals) records.goals = 2 * sizeof(layout::vec4);  // at the frame's start and at its end
  records.strandRest = sizeof(layout::StrandRest);
  records.report = sizeof(layout::StrandReport);
  if (choice.features.roots)
    records.rootPoses = (static_cast<std::uint64_t>(settings.stepsPerFrame) + 1) * sizeof(layout::RootPose);
  return records;
}

Result<std::vector<GroomChunk>> cutGroom(std::span<const std::uint32_t> particleCounts,
                                         const GroomRecords& records, std::uint64_t mostBytes,
                                         const std::string& wholeFor) {
  const std::uint64_t mostParticles = mostBytes / largestOfParticle(records);
  const std::uint64_t mostStrands = mostBytes / largestOfStrand(records);
  std::vector<GroomChunk> chunks;
  std::uint32_t particles = 0;
  for (std::uint32_t s = 0; s < particleCounts.size(); ++s) {
    const std::uint32_t count = particleCounts[s];
    if (count > mostParticles || mostStrands == 0) {
      return Error{fmt::format(
          "a strand of {} particles needs a buffer of {}, and this device's are {} at most; cut it into "
          "fewer particles, or use fewer steps a frame, another device or the reference",
          count, mebibytes(std::max(count * largestOfParticle(records), largestOfStrand(records))),
          mebibytes(mostBytes))};
    }
    if (chunks.empty() || chunks.back().strandCount() == mostStrands ||
        std::uint64_t{chunks.back().particleCount()} + count > mostParticles)
      chunks.push_back({s, s, particles, particles});
    particles += count;
    chunks.back().strandEnd = s + 1;
    chunks.back().particleEnd = particles;
  }
  if (chunks.empty()) chunks.push_back({});
  if (chunks.size() > 1 && !wholeFor.empty()) {
    return Error{fmt::format(
        "{} need the whole groom in one piece: its {} strands of {} particles need buffers of up to {}, and "
        "this device's are {} at most, enough for {} particles; use fewer or coarser strands, or another "
        "device",
        wholeFor, particleCounts.size(), particles,
        mebibytes(std::max(particles * largestOfParticle(records),
                           particleCounts.size() * largestOfStrand(records))),
        mebibytes(mostBytes), mostParticles)};
  }
  return chunks;
}

std::vector<StrandRange> cutRanges(std::span<const StrandRange> ranges, std::span<const GroomChunk> chunks) {
  std::vector<StrandRange> pieces;
  for (const StrandRange& range : ranges) {
    for (std::uint32_t c = 0; c < chunks.size(); ++c) {
      const std::uint32_t begin = std::max(range.begin, chunks[c].strandBegin);
      const std::uint32_t end = std::min(range.end, chunks[c].strandEnd);
      if (begin >= end) continue;
      StrandRange piece = range;
      piece.begin = begin - chunks[c].strandBegin;
      piece.end = end - chunks[c].strandBegin;
      piece.chunk = c;
      pieces.push_back(piece);
    }
  }
  return pieces;
}

Status checkMemory(const std::string& what, std::uint64_t neededBytes, std::uint64_t availableBytes) {
  if (neededBytes <= availableBytes) return {};
  return Error{
      fmt::format(
          "{} needs {} of the device's memory, which has {} left; use fewer or coarser strands, or another "
          "device",
          what, mebibytes(neededBytes), mebibytes(availableBytes)),
      Fault::deviceMemory};
}

}  // namespace ringlet
