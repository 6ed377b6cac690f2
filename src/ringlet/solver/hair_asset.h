// HairAsset: what does not change of some hair, for one device: its groom and material as the solver has
// them, who may touch whom, how kernels lie over the device, constants in device memory. Any number of
// simulations, each a head of its own, share one.
//
//   groom, material, settings -> HairAsset -> Simulation, Simulation, ...
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/kernel_choice.h"

namespace ringlet {

/// Whether the hair may have bodies to stay out of: other kernels, which are slower and take longer to
/// compile.
enum class BodyUse { none, some };

/// A handle: copies are of the same asset, which lives as long as any of them, or any simulation of it.
/// Constant, so any thread may use it.
class HairAsset {
 public:
  /// Fails, with what to do, on settings out of range, on a groom with fewer than one strand or with
  /// non-finite points, and when the device lacks memory. Cost: some passes over the groom in double, and
  /// with contacts a search for pairs of strands; 32 bytes a particle and 112 a strand of device memory.
  static Result<HairAsset> build(const ComputeDevice& device, const Groom& groom, const Material& material,
                                 const Settings& settings, const KernelChoice& kernel = {},
                                 BodyUse bodies = BodyUse::none);

  /// Of the groom.
  std::size_t strandCount() const;
  std::size_t particleCount() const;
  /// Strands that are carried rigidly (rest/rigid_strands.h).
  std::size_t rigidStrandCount() const;
  /// Things the user should know of (a core spring capped for this step, gravity preload too large, strands
  /// carried rigidly), a sentence each.
  const std::vector<std::string>& warnings() const;

 private:
  friend class Simulation;
  struct Implementation;
  explicit HairAsset(std::shared_ptr<const Implementation> self) : self_(std::move(self)) {}
  std::shared_ptr<const Implementation> self_;
};

}  // namespace ringlet
