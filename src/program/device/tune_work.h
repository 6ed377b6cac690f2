// The kinds of work at which strand shapes are timed, and a simulation of each.
#pragma once

#include <cstdint>

#include "ringlet/base/result.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/kernel_choice.h"
#include "ringlet/solver/plan/shape_plan.h"
#include "ringlet/solver/simulation.h"

namespace ringlet::program {

/// What the strand kernel does beside its strands: nothing; contacts of pairs; hair as a volume; bodies.
enum class TuneWork { alone, contacts, volume, bodies };
inline constexpr TuneWork kTuneWorks[] = {TuneWork::alone, TuneWork::contacts, TuneWork::volume,
                                          TuneWork::bodies};
inline constexpr const char* kTuneWorkNames[] = {"alone", "contacts", "volume", "bodies"};
constexpr const char* nameOf(TuneWork work) { return kTuneWorkNames[static_cast<int>(work)]; }

/// As the planner has it.
StrandWork strandWorkOf(TuneWork work);

inline constexpr double kTunedLength = 0.25;  // of the strands [m]

/// Curls a millimetre apart, as near to a square as their number allows, that have met what they work with:
/// after a first frame, in which the head moved aside and turned. Errors: as for Simulation::create, and hair
/// that met nothing.
Result<Simulation> simulateWork(const ComputeDevice& device, TuneWork work, std::uint32_t particleCount,
                                std::uint32_t strandCount, const KernelChoice& choice);

/// Another frame; the head stands where it came to, so that all shapes see the same.
Status stepWork(TuneWork work, Simulation& simulation);

}  // namespace ringlet::program
