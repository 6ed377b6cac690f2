// Implements solver/strands/strand_kernels.h.
#include "ringlet/solver/strands/strand_kernels.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <future>
#include <span>

#include "layout/strands.h"
#include "ringlet/solver/strands/strand_modules.h"
#include "ringlet_shaders/cloth_near_plain.h"

namespace ringlet {
namespace {

using Spirv = std::span<const std::uint32_t>;

Spirv moduleOf(const StrandShape& shape, const StrandKernelOptions& options) {
  const StrandForm form = shape.serial()   ? StrandForm::serial
                          : shape.inMemory ? StrandForm::memory
                                           : StrandForm::lanes;
  const bool amongOthers = options.bodies || options.air || options.goals || options.fields;
  const StrandPart part = options.heads                              ? StrandPart::heads
                          : options.integrator != Integrator::jacobi ? StrandPart::baselines
                          : options.bodies && options.bends          ? StrandPart::bending
                          : amongOthers                              ? StrandPart::surroundings
                          : options.contacts                         ? StrandPart::contacts
                                                                     : StrandPart::plain;
  return strandModule(form, part, options.taps && !options.heads);
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
  for (const StrandForm form : {StrandForm::lanes, StrandForm::serial}) {
    for (const std::uint32_t word : strandModule(form, StrandPart::plain, false))
      hash = (hash ^ word) * 0x100000001b3;
  }
  return fmt::format("{:016x}", hash);
}

Result<std::uint32_t> askedGroupSize(const DeviceLimits& limits, int asked) {
  constexpr std::uint32_t kMostAnywhere = 128;  // the smallest maxComputeWorkGroupInvocations that Vulkan
                                                // allows
  const auto size = static_cast<std::uint32_t>(std::max(asked, 0));
  if (std::has_single_bit(size) && size >= limits.subgroupSize && size <= kMostAnywhere) return size;
  return Error{fmt::format(
      "workgroups of {} invocations were asked for; this device can have powers of two from {} to {}", asked,
      limits.subgroupSize, kMostAnywhere)};
}

gpu::KernelDescription describeStrandKernel(const StrandShape& shape, const StrandKernelOptions& options) {
  gpu::KernelDescription description;
  description.name = "strand_step " + shape.describe();
  description.spirv = moduleOf(shape, options);
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
                           {layout::kSpecCloth, options.clothTurns},
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

Result<std::shared_ptr<const gpu::Kernel>> createClothKernel(gpu::Device& device,
                                                             const StrandKernelOptions& options) {
  gpu::KernelDescription description;
  description.name = "cloth_near";
  description.spirv = k_cloth_near_plain;
  description.pushConstantBytes = sizeof(layout::StepParameters);
  description.groupSize = options.groupSize;
  description.constants = {{layout::kSpecGroupSize, options.groupSize},
                           {layout::kSpecTexels, options.texels ? 1u : 0u},
                           {layout::kSpecContacts, options.contacts ? 1u : 0u},
                           {layout::kSpecCloth, options.clothTurns},
                           {layout::kSpecFalls, options.falls ? 1u : 0u}};
  return gpu::Kernel::create(device, description);
}

Result<std::vector<std::shared_ptr<const gpu::Kernel>>> createStrandKernels(
    gpu::Device& device, std::span<const StrandShape> shapes, const StrandKernelOptions& options) {
  if (moduleOf(shapes.front(), options).empty())
    return Error{
        "this ringlet was built without kernels that have taps; build it with -DRINGLET_BUILD_TAPS=ON"};
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
    } catch (const std::system_error&) {  // no thread is available: this one makes the kernel
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
