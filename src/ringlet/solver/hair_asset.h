// HairAsset: the constants of some hair on one device: rest state, pairs of strands that may touch, kernel
// shapes, constants in device memory. Any number of simulations, each of one head, share an asset.
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

/// A handle: copies refer to the same asset, which lives as long as any copy or any simulation of it. It is
/// constant, so any thread may use it.
class HairAsset {
 public:
  /// Fails, with advice, on settings out of range, on a groom with fewer than one strand or with
  /// non-finite points, and when the device lacks memory. Cost: some passes over the groom in double, and
  /// with contacts a search for pairs of strands; 36 bytes a particle and 112 a strand of device memory.
  static Result<HairAsset> build(const ComputeDevice& device, const Groom& groom, const Material& material,
                                 const Settings& settings, const KernelChoice& kernel = {});

  /// Counts of the groom.
  std::size_t strandCount() const;
  std::size_t particleCount() const;
  /// Number of strands that are carried rigidly (rest/rigid_strands.h).
  std::size_t rigidStrandCount() const;
  /// Warnings for the user (a core spring capped for this step, gravity preload too large, strands carried
  /// rigidly), a sentence each.
  const std::vector<std::string>& warnings() const;

 private:
  friend class Simulation;
  struct Implementation;
  explicit HairAsset(std::shared_ptr<const Implementation> self) : self_(std::move(self)) {}
  std::shared_ptr<const Implementation> self_;
};

}  // namespace ringlet
