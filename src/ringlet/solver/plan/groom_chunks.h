// The memory that a groom needs on a device, and how a groom is cut into chunks. A device limits the size of
// a bound buffer (maxStorageBufferRange, 128 MiB on many), which is 4 million particles; a larger groom needs
// several chunks. Each chunk has its own buffers, so that bindings need no offsets. Pure arithmetic, no
// device.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/plan/shape_plan.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

/// Bytes per particle or per strand in each of the buffers; 0: the buffer is not needed.
struct GroomRecords {
  std::uint64_t position = 0, velocity = 0, particleRest = 0, taps = 0, solved = 0, place = 0;
  std::uint64_t contactSystem = 0, addedByVolume = 0, force = 0, goals = 0;
  std::uint64_t strandRest = 0, report = 0, rootPoses = 0;
  std::uint64_t positionInFrame = 0;

  std::uint64_t perParticle() const {
    return position + velocity + particleRest + taps + solved + place + contactSystem + addedByVolume +
           force + goals;
  }
  std::uint64_t perStrand() const { return strandRest + report + rootPoses; }
  // In addition, in host memory for each frame in flight: positions read back; forces, goals and poses
  // written.
  std::uint64_t perParticleOfFrame() const { return positionInFrame + force + goals; }
  std::uint64_t perStrandOfFrame() const { return rootPoses; }
};

/// `kinds`: of contacts.
GroomRecords groomRecords(const Settings& settings, const KernelChoice& choice, ContactKinds kinds,
                          bool isCpu);

/// Strands [strandBegin, strandEnd) in device order, and their particles.
struct GroomChunk {
  std::uint32_t strandBegin = 0, strandEnd = 0;
  std::uint32_t particleBegin = 0, particleEnd = 0;

  std::uint32_t strandCount() const { return strandEnd - strandBegin; }
  std::uint32_t particleCount() const { return particleEnd - particleBegin; }
};

/// Cuts strands, in device order, into the fewest chunks such that no buffer exceeds `mostBytes`. Fails, with
/// the numbers, if a single strand exceeds it, or if several chunks are needed and `wholeFor` names a feature
/// that needs all strands in one. Without strands there is one empty chunk.
Result<std::vector<GroomChunk>> cutGroom(std::span<const std::uint32_t> particleCounts,
                                         const GroomRecords& records, std::uint64_t mostBytes,
                                         const std::string& wholeFor = "");

/// The ranges, cut at the borders of chunks; begin and end then count within the range's chunk.
std::vector<StrandRange> cutRanges(std::span<const StrandRange> ranges, std::span<const GroomChunk> chunks);

/// Fails, with the numbers, where `what` needs more bytes than the device has left.
Status checkMemory(const std::string& what, std::uint64_t neededBytes, std::uint64_t availableBytes);

}  // namespace ringlet
