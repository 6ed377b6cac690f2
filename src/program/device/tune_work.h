// The kinds of work with which strand shapes are timed, and a simulation for each.
#pragma once

#include <cstdint>

#include "ringlet/base/result.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/kernel_choice.h"
#include "ringlet/solver/plan/shape_plan.h"
#include "ringlet/solver/simulation.h"

namespace ringlet::program {

/// What the strand kernel does besides hair alone: nothing; contacts of pairs; hair as a volume; bodies.
enum class TuneWork { alone, contacts, volume, bodies };
inline constexpr TuneWork kTuneWorks[] = {TuneWork::alone, TuneWork::contacts, TuneWork::volume,
                                          TuneWork::bodies};
inline constexpr const char* kTuneWorkNames[] = {"alone", "contacts", "volume", "bodies"};
constexpr const char* nameOf(TuneWork work) { return kTuneWorkNames[static_cast<int>(work)]; }

/// The planner's name for it.
StrandWork strandWorkOf(TuneWork work);

inline constexpr double kTunedLength = 0.25;  // of the strands [m]

/// Curls a millimetre apart, in a grid as square as their number allows, after a first frame in which the
/// head moved and turned, so that they are in contact with what the work needs. Errors: as for
/// Simulation::create; hair that touched nothing.
Result<Simulation> simulateWork(const ComputeDevice& device, TuneWork work, std::uint32_t particleCount,
                                std::uint32_t strandCount, const KernelChoice& choice);

/// Steps another frame with the head at rest, so that all shapes do the same work.
Status stepWork(TuneWork work, Simulation& simulation);

}  // namespace ringlet::program
