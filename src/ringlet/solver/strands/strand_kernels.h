// The compiled variants of the strand kernel, by form, run length and taps.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/strand_shape.h"

namespace ringlet {

/// Invocations of a workgroup, at most, unless others are asked for.
inline constexpr std::uint32_t kStrandGroupSize = 64;

/// The workgroup size asked for by KernelChoice::groupSize. It must be a power of two, at least a subgroup,
/// so that subgroups are whole, and at most what every Vulkan device allows. Fails on other values.
Result<std::uint32_t> askedGroupSize(const DeviceLimits& limits, int asked);

/// The default workgroup size for strands with this number of lanes in total. A CPU device runs each
/// workgroup as a task on one of its cores: small workgroups use all cores even if strands are few, but cost
/// more if they are many.
inline std::uint32_t strandGroupSize(const DeviceLimits& limits, std::uint64_t lanes) {
  const bool isFew = lanes < 16 * kStrandGroupSize;
  return limits.isCpu && isFew ? std::max(8u, limits.subgroupSize) : kStrandGroupSize;
}

/// What a strand kernel is specialized for besides its shape.
struct StrandKernelOptions {
  Integrator integrator = Integrator::jacobi;
  bool oneSmoothing = false;  // alpha_b and alpha_c are equal in every strand
  bool bendVaries = false;    // bend stiffness varies along some strand
  bool profiles = false;      // edges have factors (EdgeFactors); together with bendVaries
  bool taps = false;
  bool contacts = false;         // the solve is iterated, with contacts
  bool pairs = true;             // with contacts: there are pairs
  bool volume = false;           // with contacts: there is a volume
  bool texels = false;           // records are read as texels (gpu::BindingKind)
  bool residual = false;         // measure the residual of the velocity solve
  bool bodies = false;           // there are bodies
  bool bends = false;            // one of them bends
  std::uint32_t clothTurns = 0;  // loop turns that a lane may spend on cloth; 0: no body is cloth
  bool air = false;              // drag of the air acts
  bool turbulence = false;
  bool movingRoots = false;        // strands have root poses
  bool forces = false;             // external forces act on particles
  bool goals = false;              // particles are pulled to places
  bool goalShape = false;          // or edges are pulled to vectors
  bool fields = false;             // force fields act on particles
  bool falls = false;              // the strands are fallen hair
  bool heads = false;              // a dispatch may step several heads (HeadPlaces): jacobi, hair alone
  std::uint32_t subgroupSize = 0;  // for runs in registers, one the device offers; 0: its default
  std::uint32_t groupSize = kStrandGroupSize;
};

gpu::KernelDescription describeStrandKernel(const StrandShape& shape, const StrandKernelOptions& options);

/// One kernel for each shape, in order. Those not compiled yet are made on threads of their own: lavapipe
/// takes half a second to read each, whatever its cache holds.
/// The kernel that lists the cloth near to particles of strands for these kernels
/// (shaders/kernels/cloth_near.comp).
Result<std::shared_ptr<const gpu::Kernel>> createClothKernel(gpu::Device& device,
                                                             const StrandKernelOptions& options);

Result<std::vector<std::shared_ptr<const gpu::Kernel>>> createStrandKernels(
    gpu::Device& device, std::span<const StrandShape> shapes, const StrandKernelOptions& options);

}  // namespace ringlet
