// Implements solver/strands/strand_modules.h.
#include "ringlet/solver/strands/strand_modules.h"

#include <cstddef>

#include "ringlet_shaders/strand_step_baselines.h"
#include "ringlet_shaders/strand_step_bending.h"
#include "ringlet_shaders/strand_step_contacts.h"
#include "ringlet_shaders/strand_step_heads.h"
#include "ringlet_shaders/strand_step_memory_baselines.h"
#include "ringlet_shaders/strand_step_memory_bending.h"
#include "ringlet_shaders/strand_step_memory_heads.h"
#include "ringlet_shaders/strand_step_memory_plain.h"
#include "ringlet_shaders/strand_step_memory_surroundings.h"
#include "ringlet_shaders/strand_step_plain.h"
#include "ringlet_shaders/strand_step_serial_baselines.h"
#include "ringlet_shaders/strand_step_serial_bending.h"
#include "ringlet_shaders/strand_step_serial_heads.h"
#include "ringlet_shaders/strand_step_serial_plain.h"
#include "ringlet_shaders/strand_step_serial_surroundings.h"
#include "ringlet_shaders/strand_step_surroundings.h"
#ifdef RINGLET_HAS_TAPS
#include "ringlet_shaders/strand_step_baselines_taps.h"
#include "ringlet_shaders/strand_step_bending_taps.h"
#include "ringlet_shaders/strand_step_contacts_taps.h"
#include "ringlet_shaders/strand_step_memory_baselines_taps.h"
#include "ringlet_shaders/strand_step_memory_bending_taps.h"
#include "ringlet_shaders/strand_step_memory_plain_taps.h"
#include "ringlet_shaders/strand_step_memory_surroundings_taps.h"
#include "ringlet_shaders/strand_step_plain_taps.h"
#include "ringlet_shaders/strand_step_serial_baselines_taps.h"
#include "ringlet_shaders/strand_step_serial_bending_taps.h"
#include "ringlet_shaders/strand_step_serial_plain_taps.h"
#include "ringlet_shaders/strand_step_serial_surroundings_taps.h"
#include "ringlet_shaders/strand_step_surroundings_taps.h"
#endif

namespace ringlet {
namespace {

using Spirv = std::span<const std::uint32_t>;

// By form and part.
const Spirv kModules[3][6] = {
    {k_strand_step_plain, k_strand_step_contacts, k_strand_step_surroundings, k_strand_step_baselines,
     k_strand_step_heads, k_strand_step_bending},
    {k_strand_step_memory_plain, k_strand_step_memory_surroundings, k_strand_step_memory_surroundings,
     k_strand_step_memory_baselines, k_strand_step_memory_heads, k_strand_step_memory_bending},
    {k_strand_step_serial_plain, k_strand_step_serial_surroundings, k_strand_step_serial_surroundings,
     k_strand_step_serial_baselines, k_strand_step_serial_heads, k_strand_step_serial_bending}};
#ifdef RINGLET_HAS_TAPS
const Spirv kModulesWithTaps[3][6] = {{k_strand_step_plain_taps,
                                       k_strand_step_contacts_taps,
                                       k_strand_step_surroundings_taps,
                                       k_strand_step_baselines_taps,
                                       {},
                                       k_strand_step_bending_taps},
                                      {k_strand_step_memory_plain_taps,
                                       k_strand_step_memory_surroundings_taps,
                                       k_strand_step_memory_surroundings_taps,
                                       k_strand_step_memory_baselines_taps,
                                       {},
                                       k_strand_step_memory_bending_taps},
                                      {k_strand_step_serial_plain_taps,
                                       k_strand_step_serial_surroundings_taps,
                                       k_strand_step_serial_surroundings_taps,
                                       k_strand_step_serial_baselines_taps,
                                       {},
                                       k_strand_step_serial_bending_taps}};
#else
const Spirv kModulesWithTaps[3][6] = {};
#endif

}  // namespace

Spirv strandModule(StrandForm form, StrandPart part, bool taps) {
  return (taps ? kModulesWithTaps : kModules)[static_cast<std::size_t>(form)][static_cast<std::size_t>(part)];
}

}  // namespace ringlet
