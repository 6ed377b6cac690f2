// VolumeStage: strands that meet as a volume, on one device, between the strand kernel's solves
// (shaders/equations/volume.glsl). Which strands those are is decided in rest/volume_strands.h. Mirrored by
// reference/kernels/volume_step.h.
//
//   v^0 of all strands ->  brought: displacements, guesses; particles by cell
//                      ->  means: to the grid's nodes and back                 -> solve -> v^1
//                      ->  brought by v^1, means                               -> solve -> v^2 ... -> move
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "layout/volume.h"
#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/rest/rest_volume.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/device_groom.h"
#include "ringlet/solver/submission_pace.h"
#include "ringlet/solver/volume_kernels.h"

namespace ringlet {

class VolumeStage {
 public:
  /// Fails, with the numbers and what to do, where the device lacks memory. `groom` is of one chunk, and must
  /// live as long, in one place.
  /// isHere: of each strand, device order; what others bring comes from elsewhere; none: all are here.
  static Result<VolumeStage> create(gpu::Device& device, const RestState& rest, const Settings& settings,
                                    const RestVolume& volume, const std::vector<bool>& isHere,
                                    DeviceGroom& groom);

  /// Kernels that this stage was the first on its device to ask for.
  std::size_t newKernelCount() const { return newKernels_.size(); }
  /// Those, without work: so that they are compiled before they are needed.
  void recordNothing(gpu::CommandList& list) const;

  /// Parts of a step, in order; each begins and ends with nothing to wait for but what the caller's barriers
  /// say. Nothing happens where contacts of pairs have halted.
  /// What the particles here bring in an iteration, the first of a step or a later one.
  void recordBrought(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step, bool isFirst) const;
  /// Where strands are divided, after it: what all bring, once `brought` has it.
  void recordTake(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step, bool isFirst) const;
  /// Once a step, then the means of what was brought.
  void recordSort(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step) const;
  void recordMeans(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step) const;

  /// What the particles bring, and after it where they are: a vec4 each (layout::kBindVolumeBrought).
  const gpu::Buffer& brought() const { return buffers_->brought; }

  /// What may change while hair moves; recordings made before are no longer good.
  void setSettings(const Settings& settings);
  /// Forgets displacements: the hair was put somewhere else.
  Status forget();
  /// All that the next step depends on beside positions, velocities and what the solve left.
  Status archive(Archive& archive);

  std::uint64_t bytes() const;

 private:
  struct Buffers {
    gpu::Buffer particles, states, brought, cells, parcels, nodes, control, located, here;
  };
  VolumeStage() = default;
  gpu::BufferTable bufferTable() const;
  layout::VolumeParameters parameters(std::uint32_t step) const;
  void dispatch(gpu::CommandList& list, VolumeKernel kernel, std::uint32_t step, std::uint32_t groups) const;
  void dispatchHere(gpu::CommandList& list, VolumeKernel kernel, std::uint32_t step) const;
  void dispatchIndirect(gpu::CommandList& list, VolumeKernel kernel, std::uint32_t step,
                        std::uint64_t offset) const;
  bool isDivided() const { return kernels_.size() == kVolumeKernelCount; }

  std::vector<std::shared_ptr<const gpu::Kernel>> kernels_;  // by VolumeKernel
  std::vector<std::size_t> newKernels_;
  std::vector<gpu::Bindings> bindings_;  // likewise
  DeviceGroom* groom_ = nullptr;
  std::optional<Buffers> buffers_;
  std::vector<float> densities_;  // at rest
  layout::VolumeParameters parameters_{};
};

}  // namespace ringlet
