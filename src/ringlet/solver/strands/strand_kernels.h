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

/// Invocations of a workgroup, at most.
inline constexpr std::uint32_t kStrandGroupSize = 64;

/// How many they are where they are asked for (KernelChoice::groupSize): a power of two, a subgroup at least,
/// so that subgroups are whole, and what every device of Vulkan has at most. Fails on others.
Result<std::uint32_t> askedGroupSize(const DeviceLimits& limits, int asked);

/// How many they are by default, for strands that have so many lanes together. A CPU device takes a workgroup
/// as a task for one of its cores: small ones share out few strands too, and cost more where strands are
/// many.
inline std::uint32_t strandGroupSize(const DeviceLimits& limits, std::uint64_t lanes) {
  const bool isFew = lanes < 16 * kStrandGroupSize;
  return limits.isCpu && isFew ? std::max(8u, limits.subgroupSize) : kStrandGroupSize;
}

/// What a strand kernel is specialized for besides its shape.
struct StrandKernelOptions {
  Integrator integrator = Integrator::jacobi;
  bool oneSmoothing = false;  // alpha_b and alpha_c are equal in every strand
  bool bendVaries = false;    // along some strand
  bool profiles = false;      // edges have factors (EdgeFactors); with bendVaries
  bool taps = false;
  bool contacts = false;  // the solve is iterated with the contacts' systems
  bool pairs = true;      // of which there are of pairs
  bool volume = false;    // and of hair as a volume
  bool texels = false;    // records are read as texels (gpu::BindingKind)
  bool residual = false;  // measure the residual of the velocity solve
  bool bodies = false;    // there are some
  bool air = false;       // hair feels it
  bool turbulence = false;
  bool movingRoots = false;  // strands have poses of their own
  bool forces = false;       // forces from outside act on particles
  bool goals = false;        // particles are pulled to places
  bool goalShape = false;    // or edges to vectors
  bool fields = false;       // fields act on them
  bool falls = false;        // strands are what was cut off
  bool heads = false;  // of one of many heads that a dispatch may step (HeadPlaces): jacobi, hair by itself
  std::uint32_t subgroupSize = 0;  // of the lanes form, one the device can be asked for; 0: its default
  std::uint32_t groupSize = kStrandGroupSize;
};

gpu::KernelDescription describeStrandKernel(const StrandShape& shape, const StrandKernelOptions& options);

/// One for each shape, in order; those not compiled yet are made on threads of their own: lavapipe reads each
/// for half a second, whatever its cache holds.
Result<std::vector<std::shared_ptr<const gpu::Kernel>>> createStrandKernels(
    gpu::Device& device, std::span<const StrandShape> shapes, const StrandKernelOptions& options);

}  // namespace ringlet
