// The embedded SPIR-V of the strand kernel: a module a form and part of what hair may need.
#pragma once

#include <cstdint>
#include <span>

namespace ringlet {

/// How strands are stepped: runs in registers, runs in memory, or one lane a strand without subgroups.
enum class StrandForm { lanes, memory, serial };
/// Hair by itself; in contact; among bodies, air, goals or fields too; by other integrators than jacobi; of
/// one of many heads. Code that is only switched off a driver reads all the same, half a second a kernel on
/// lavapipe, and its buffers stay bound. In memory and serial, surroundings has the contacts.
enum class StrandPart { plain, contacts, surroundings, baselines, heads };

/// `taps`: the module writes every intermediate. Empty where there is none: heads have no taps, and nothing
/// has in a library that was built without RINGLET_BUILD_TAPS.
std::span<const std::uint32_t> strandModule(StrandForm form, StrandPart part, bool taps);

}  // namespace ringlet
