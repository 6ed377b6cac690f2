// How much memory a groom takes on a device, and how it is cut into chunks where no kernel sees all of it: a
// device bounds what one binding shows (maxStorageBufferRange, 128 MiB on many), which is 4 million
// particles. Every chunk has buffers of its own, so that no binding needs an offset and one that is all of
// the groom is as before. Pure arithmetic, no device.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/shape_plan.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

/// Bytes of one particle and of one strand in each of their buffers; 0: it is not needed.
struct GroomRecords {
  std::uint64_t position = 0, velocity = 0, particleRest = 0, taps = 0, solved = 0;
  std::uint64_t contactSystem = 0, addedByVolume = 0, force = 0, goals = 0;
  std::uint64_t strandRest = 0, report = 0, rootPoses = 0;

  std::uint64_t perParticle() const {
    return position + velocity + particleRest + taps + solved + contactSystem + addedByVolume + force + goals;
  }
  std::uint64_t perStrand() const { return strandRest + report + rootPoses; }
  // And for each frame in flight, in the host's memory: positions read back, forces, goals and poses taken
  // over.
  std::uint64_t perParticleOfFrame() const { return position + force + goals; }
  std::uint64_t perStrandOfFrame() const { return rootPoses; }
};

/// `kinds`: of contacts.
GroomRecords groomRecords(const Settings& settings, const KernelChoice& choice, ContactKinds kinds);

/// Strands [strandBegin, strandEnd) in device order, and their particles.
struct GroomChunk {
  std::uint32_t strandBegin = 0, strandEnd = 0;
  std::uint32_t particleBegin = 0, particleEnd = 0;

  std::uint32_t strandCount() const { return strandEnd - strandBegin; }
  std::uint32_t particleCount() const { return particleEnd - particleBegin; }
};

/// The fewest chunks of whole strands, in device order, of which no buffer has more than `mostBytes`. Fails,
/// with the numbers, where one strand has more; and where there is more than one chunk and `wholeFor`, which
/// needs all strands in one, is not empty. No strands are one chunk of nothing.
Result<std::vector<GroomChunk>> cutGroom(std::span<const std::uint32_t> particleCounts,
                                         const GroomRecords& records, std::uint64_t mostBytes,
                                         const std::string& wholeFor = "");

/// The same ranges, none of strands of two chunks: begin and end are within the range's chunk.
std::vector<StrandRange> cutRanges(std::span<const StrandRange> ranges, std::span<const GroomChunk> chunks);

/// Fails, with the numbers, where `what` needs more bytes than the device has left.
Status checkMemory(const std::string& what, std::uint64_t neededBytes, std::uint64_t availableBytes);

}  // namespace ringlet
