// The embedded SPIR-V of the strand kernel: a module for each form and part.
#pragma once

#include <cstdint>
#include <span>

namespace ringlet {

/// How strands are laid out: runs in registers, runs in memory, or one lane a strand without subgroup
/// operations.
enum class StrandForm { lanes, memory, serial };
/// Hair alone; with contacts; also with bodies, air, goals or fields; with other integrators than jacobi; one
/// of many heads; as surroundings, with bodies that bend. A module of its own is needed because a driver also
/// reads code that is only switched off, half a second a kernel on lavapipe, and its buffers stay bound. In
/// memory and serial forms, surroundings includes contacts.
enum class StrandPart { plain, contacts, surroundings, baselines, heads, bending };

/// `taps`: the module writes every intermediate. Empty where there is no such module: heads have no taps, and
/// no part has any in a library built without RINGLET_BUILD_TAPS.
std::span<const std::uint32_t> strandModule(StrandForm form, StrandPart part, bool taps);

}  // namespace ringlet
