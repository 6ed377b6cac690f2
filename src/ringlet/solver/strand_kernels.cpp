// Implements solver/strand_kernels.h.
#include "ringlet/solver/strand_kernels.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <future>
#include <span>

#include "layout/strands.h"
#include "ringlet_shaders/strand_step_baselines.h"
#include "ringlet_shaders/strand_step_baselines_taps.h"
#include "ringlet_shaders/strand_step_contacts.h"
#include "ringlet_shaders/strand_step_contacts_taps.h"
#include "ringlet_shaders/strand_step_heads.h"
#include "ringlet_shaders/strand_step_memory_baselines.h"
#include "ringlet_shaders/strand_step_memory_baselines_taps.h"
#include "ringlet_shaders/strand_step_memory_heads.h"
#include "ringlet_shaders/strand_step_memory_plain.h"
#include "ringlet_shaders/strand_step_memory_plain_taps.h"
#include "ringlet_shaders/strand_step_memory_surroundings.h"
#include "ringlet_shaders/strand_step_memory_surroundings_taps.h"
#include "ringlet_shaders/strand_step_plain.h"
#include "ringlet_shaders/strand_step_plain_taps.h"
#include "ringlet_shaders/strand_step_serial_baselines.h"
#include "ringlet_shaders/strand_step_serial_baselines_taps.h"
#include "ringlet_shaders/strand_step_serial_heads.h"
#include "ringlet_shaders/strand_step_serial_plain.h"
#include "ringlet_shaders/strand_step_serial_plain_taps.h"
#include "ringlet_shaders/strand_step_serial_surroundings.h"
#include "ringlet_shaders/strand_step_serial_surroundings_taps.h"
#include "ringlet_shaders/strand_step_surroundings.h"
#include "ringlet_shaders/strand_step_surroundings_taps.h"

namespace ringlet {
namespace {

using Spirv = std::span<const std::uint32_t>;

// Code that is only switched off the driver reads all the same, half a second a kernel on lavapipe, and its
// buffers stay bound.
Spirv spirvOf(const StrandShape& shape, const StrandKernelOptions& options) {
  const auto either = [&](Spirv plain, Spirv taps) { return options.taps ? taps : plain; };
  const bool amongOthers = options.bodies || options.air || options.goals || options.fields;
  const bool isBaseline = options.integrator != Integrator::jacobi;
  if (options.heads)
    return shape.serial()   ? Spirv(k_strand_step_serial_heads)
           : shape.inMemory ? Spirv(k_strand_step_memory_heads)
                            : Spirv(k_strand_step_heads);
  if (shape.serial()) {
    if (isBaseline) return either(k_strand_step_serial_baselines, k_strand_step_serial_baselines_taps);
    if (amongOthers || options.contacts)
      return either(k_strand_step_serial_surroundings, k_strand_step_serial_surroundings_taps);
    return either(k_strand_step_serial_plain, k_strand_step_serial_plain_taps);
  }
  if (shape.inMemory) {
    if (isBaseline) return either(k_strand_step_memory_baselines, k_strand_step_memory_baselines_taps);
    if (amongOthers || options.contacts)
      return either(k_strand_step_memory_surroundings, k_strand_step_memory_surroundings_taps);
    return either(k_strand_step_memory_plain, k_strand_step_memory_plain_taps);
  }
  if (isBaseline) return either(k_strand_step_baselines, k_strand_step_baselines_taps);
  if (amongOthers) return either(k_strand_step_surroundings, k_strand_step_surroundings_taps);
  if (options.contacts) return either(k_strand_step_contacts, k_strand_step_contacts_taps);
  return either(k_strand_step_plain, k_strand_step_plain_taps);
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

// FNV-1a, word by word.
std::string strandKernelHash() {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const Spirv code : {Spirv(k_strand_step_plain), Spirv(k_strand_step_serial_plain)}) {
    for (const std::uint32_t word : code) hash = (hash ^ word) * 0x100000001b3;
  }
  return fmt::format("{:016x}", hash);
}

Result<std::uint32_t> askedGroupSize(const DeviceLimits& limits, int asked) {
  constexpr std::uint32_t kMostAnywhere = 128;  // maxComputeWorkGroupInvocations, the least allowed
  const auto size = static_cast<std::uint32_t>(std::max(asked, 0));
  if (std::has_single_bit(size) && size >= limits.subgroupSize && size <= kMostAnywhere) return size;
  return Error{fmt::format(
      "workgroups of {} invocations were asked for; this device can have powers of two from {} to {}", asked,
      limits.subgroupSize, kMostAnywhere)};
}

gpu::KernelDescription describeStrandKernel(const StrandShape& shape, const StrandKernelOptions& options) {
  gpu::KernelDescription description;
  description.name = "strand_step " + shape.describe();
  description.spirv = spirvOf(shape, options);
  description.remedy = "take another device, or leave out contacts, bodies and air";
  description.pushConstantBytes = sizeof(layout::StepParameters);
  description.constants = {{layout::kSpecGroupSize, options.groupSize},
                           {layout::kSpecTexels, options.texels ? 1u : 0u},
                           {layout::kSpecIntegrator, integratorConstant(options.integrator)},
                           {layout::kSpecOneSmoothing, options.oneSmoothing ? 1u : 0u},
                           {layout::kSpecResidual, options.residual ? 1u : 0u},
                           {layout::kSpecBendVaries, options.bendVaries ? 1u : 0u},
                           {layout::kSpecProfiles, options.profiles ? 1u : 0u},
                           {layout::kSpecForces, options.forces ? 1u : 0u},
                           {layout::kSpecMovingRoots, options.movingRoots ? 1u : 0u},
                           {layout::kSpecContacts, options.contacts ? 1u : 0u},
                           {layout::kSpecBodies, options.bodies ? 1u : 0u},
                           {layout::kSpecAir, options.air ? 1u : 0u},
                           {layout::kSpecTurbulent, options.turbulence ? 1u : 0u},
                           {layout::kSpecGoals, options.goals ? 1u : 0u},
                           {layout::kSpecFields, options.fields ? 1u : 0u},
                           {layout::kSpecFalls, options.falls ? 1u : 0u},
                           {layout::kSpecGoalShape, options.goals && options.goalShape ? 1u : 0u}};
  if (options.contacts) {
    description.constants.push_back({layout::kSpecPairs, options.pairs ? 1u : 0u});
    description.constants.push_back({layout::kSpecVolume, options.volume ? 1u : 0u});
  }
  description.groupSize = options.groupSize;
  description.constants.push_back({layout::kSpecRun, shape.particlesPerLane});
  if (!shape.serial()) {
    description.constants.push_back({layout::kSpecLanes, shape.lanes});
    description.wantsFullSubgroups = true;
    description.subgroupSize = options.subgroupSize;
  }
  return description;
}

Result<std::vector<std::shared_ptr<const gpu::Kernel>>> createStrandKernels(
    gpu::Device& device, std::span<const StrandShape> shapes, const StrandKernelOptions& options) {
  const auto create = [&](const StrandShape& shape) {
    return gpu::Kernel::create(device, describeStrandKernel(shape, options));
  };
  std::vector<std::future<Result<std::shared_ptr<const gpu::Kernel>>>> others;
  for (const StrandShape& shape : shapes.subspan(1)) {
    const bool isCompiled = gpu::Kernel::isCompiled(device, describeStrandKernel(shape, options));
    const auto policy = isCompiled ? std::launch::deferred : std::launch::async;
    const auto make = [&create, &shape] { return create(shape); };
    try {
      others.push_back(std::async(policy, make));
    } catch (const std::system_error&) {  // no thread to be had: this one makes it
      others.push_back(std::async(std::launch::deferred, make));
    }
  }
  std::vector<Result<std::shared_ptr<const gpu::Kernel>>> made;
  made.push_back(create(shapes.front()));
  for (auto& other : others) made.push_back(other.get());
  std::vector<std::shared_ptr<const gpu::Kernel>> kernels;
  for (auto& kernel : made) {
    if (!kernel) return kernel.error();
    kernels.push_back(std::move(*kernel));
  }
  return kernels;
}

}  // namespace ringlet
