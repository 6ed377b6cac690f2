// Implements solver/strand_kernels.h.
#include "ringlet/solver/strand_kernels.h"

#include <fmt/format.h>

#include <span>

#include "ringlet_shaders/strand_step_run16.h"
#include "ringlet_shaders/strand_step_run16_taps.h"
#include "ringlet_shaders/strand_step_run32.h"
#include "ringlet_shaders/strand_step_run32_taps.h"
#include "ringlet_shaders/strand_step_run4.h"
#include "ringlet_shaders/strand_step_run4_taps.h"
#include "ringlet_shaders/strand_step_run8.h"
#include "ringlet_shaders/strand_step_run8_taps.h"
#include "ringlet_shaders/strand_step_serial_plain.h"
#include "ringlet_shaders/strand_step_serial_taps.h"
#include "shared/layout.h"

namespace ringlet {
namespace {

std::span<const std::uint32_t> spirvOf(const StrandShape& shape, bool taps) {
  if (shape.serial())
    return taps ? std::span<const std::uint32_t>(k_strand_step_serial_taps) : k_strand_step_serial_plain;
  switch (shape.particlesPerLane) {
    case 4:
      return taps ? std::span<const std::uint32_t>(k_strand_step_run4_taps) : k_strand_step_run4;
    case 8:
      return taps ? std::span<const std::uint32_t>(k_strand_step_run8_taps) : k_strand_step_run8;
    case 32:
      return taps ? std::span<const std::uint32_t>(k_strand_step_run32_taps) : k_strand_step_run32;
    default:
      return taps ? std::span<const std::uint32_t>(k_strand_step_run16_taps) : k_strand_step_run16;
  }
}

std::uint32_t integratorConstant(Integrator integrator) {
  switch (integrator) {
    case Integrator::jacobi:
      return layout::kIntegratorJacobi;
    case Integrator::pointJacobi:
      return layout::kIntegratorPointJacobi;
    case Integrator::paper:
      return layout::kIntegratorPaper;
  }
  return layout::kIntegratorJacobi;
}

}  // namespace

Result<gpu::Kernel> createStrandKernel(gpu::Device& device, const StrandShape& shape,
                                       const StrandKernelOptions& options) {
  using enum gpu::BindingKind;
  gpu::KernelDescription description;
  description.name = "strand_step " + shape.describe();
  description.spirv = spirvOf(shape, options.taps);
  description.bindings = {storage, storage, storage, storage, storage, storage, uniform, storage, storage,
                          storage, texels,  texels,  texels,  texels,  texels,  storage, storage, storage,
                          storage, storage, texels,  texels,  texels,  texels,  texels,  storage, texels};
  description.pushConstantBytes = sizeof(layout::StepParameters);
  description.constants = {{0, kStrandGroupSize},
                           {2, integratorConstant(options.integrator)},
                           {3, options.oneSmoothing ? 1u : 0u},
                           {4, options.residual ? 1u : 0u},
                           {5, options.bendVaries ? 1u : 0u},
                           {6, options.contacts ? 1u : 0u},
                           {7, options.texels ? 1u : 0u},
                           {8, options.bodies ? 1u : 0u},
                           {9, options.air ? 1u : 0u},
                           {10, options.turbulence ? 1u : 0u},
                           {11, options.movingRoots ? 1u : 0u}};
  description.groupSize = kStrandGroupSize;
  if (!shape.serial()) {
    description.constants.push_back({1, shape.lanes});
    description.wantsFullSubgroups = true;
  }
  return gpu::Kernel::create(device, description);
}

}  // namespace ringlet
