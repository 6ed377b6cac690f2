// VolumeStage: strands in contact as a volume, on one device, between the strand kernel's solves
// (shaders/equations/volume.glsl). rest/volume_strands.h chooses these strands. Mirrored by
// reference/kernels/volume_step.h.
//
//   v^0 of all strands ->  brought: displacements, guesses; particles by cell
//                      ->  means: to the grid's nodes and back                 -> solve -> v^1
//                      ->  brought by v^1, means                               -> solve -> v^2 ... -> move
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "layout/volume.h"
#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/rest/rest_volume.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/contacts/volume_kernels.h"
#include "ringlet/solver/contacts/volume_sorts.h"
#include "ringlet/solver/plan/submission_pace.h"
#include "ringlet/solver/strands/device_groom.h"

namespace ringlet {

/// How well the volume's sums could hold its hair, since the simulation began: how often a particle's a was
/// cut, the largest component of a as a share of ContactSettings::volumeMostRate, and the largest cell as a
/// multiple of the size asked for.
struct VolumeReach {
  std::uint32_t cut = 0;
  double largest = 0, coarsest = 0;
};

/// What hair as a volume is part of: a groom of one chunk and the buffer of the head's poses (HeadInput),
/// which must live as long as the stage, in one place.
struct VolumeHair {
  DeviceGroom& groom;
  const gpu::Buffer& poses;
  bool isDivided = false;  // other devices step other strands of the volume, which RestVolume lacks
  double range = 1;        // as KernelChoice::volumeRange
};

class VolumeStage {
 public:
  /// Fails, with the numbers and what to do, where the device lacks memory.
  static Result<VolumeStage> create(gpu::Device& device, const RestState& rest, const Settings& settings,
                                    const RestVolume& volume, const VolumeHair& hair);

  /// Number of kernels that no other simulation on this device had made before.
  std::size_t newKernelCount() const { return newKernels_.size(); }
  /// Dispatches these without work, so that the driver compiles them before they are needed.
  void recordNothing(gpu::CommandList& list) const;

  /// Call it before a frame of this many steps is recorded or submitted. `untilSort`: steps of the frame
  /// before the first that sorts; a recording is valid only for frames with the same number.
  void beginFrame(std::uint32_t steps) { sorts_.beginFrame(steps); }
  std::uint32_t untilSort() const { return sorts_.until(); }

  /// An iteration of a step's solve.
  struct Iteration {
    std::uint32_t step = 0;
    bool isFirst = false;  // of the step
  };
  /// Record the stages of a step (plan/frame_plan.h). The caller records the barriers before and after each.
  /// The kernels do nothing if contacts of pairs have halted. recordBrought: contributions of the particles
  /// in an iteration.
  void recordBrought(gpu::CommandList& list, SubmissionPace& pace, Iteration at) const;
  /// recordSort: once in a step that sorts. In each iteration recordSums sums contributions at the grid's
  /// nodes, and recordMeans gives the particles the means.
  bool sorts(std::uint32_t step) const { return sorts_.sorts(step); }
  void recordSort(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step) const;
  void recordSums(gpu::CommandList& list, SubmissionPace& pace, Iteration at) const;
  void recordMeans(gpu::CommandList& list, SubmissionPace& pace, Iteration at) const;

  /// For divided hair: recordControl copies the control block to the host, at the end of every submission;
  /// recordReach copies the reach back, before recordSort.
  void recordControl(gpu::CommandList& list) const;
  void recordReach(gpu::CommandList& list) const;
  /// Between submissions, after recordBrought of a step's first iteration: the range of cells of the
  /// particles here as {-least, greatest}; set it to the largest values of all parts before recordReach.
  std::array<std::int32_t, 6> reach() const;
  void setReach(const std::array<std::int32_t, 6>& reach);
  /// After recordSums: the sums, to be replaced by their totals over all parts before recordMeans; in the
  /// first iteration of a step that sorts the densities likewise.
  std::span<std::uint32_t> sums();
  std::span<std::uint32_t> densities();

  /// Removes fallen particles from the volume; device indices, ascending: of each strand all that is left of
  /// it beyond a place. The next step sorts.
  Status release(std::span<const std::uint32_t> particles);
  /// Changes the live settings, while no kernel runs. Invalidates earlier recordings.
  Status setSettings(const Settings& settings);
  /// Clears displacements, after the hair was moved to another state.
  Status forget();
  /// Archives the state that the next step depends on besides positions, velocities and the result of the
  /// last solve.
  Status archive(Archive& archive);

  /// Whether the sums could hold what particles contributed, since the simulation began.
  Result<VolumeReach> reached() const;

  std::uint64_t bytes() const;
  /// The buffers that its kernels use.
  gpu::BufferTable bufferTable() const;

 private:
  struct Buffers {
    gpu::Buffer particles, states, brought, cells, parcels, nodes, cornerSums, control, located, sums,
        controlRead, numbers;
  };
  VolumeStage() = default;
  Status makeKernels(gpu::Device& device);
  Status makeBuffers(gpu::Device& device, const RestState& rest, const Settings& settings,
                     const RestVolume& volume);
  std::uint64_t cellWords() const;
  std::uint64_t cornerSumBytes() const;
  std::uint64_t sumBytes() const;
  layout::VolumeParameters parameters(Iteration at) const;
  void dispatch(gpu::CommandList& list, VolumeKernel kernel, Iteration at, std::uint32_t groups) const;
  void dispatchParticles(gpu::CommandList& list, VolumeKernel kernel, Iteration at) const;
  void dispatchIndirect(gpu::CommandList& list, VolumeKernel kernel, Iteration at,
                        std::uint64_t offset) const;
  layout::VolumeControl& hostControl() const;

  std::vector<std::shared_ptr<const gpu::Kernel>> kernels_;  // by VolumeKernel
  std::vector<std::size_t> newKernels_;
  std::vector<gpu::Bindings> bindings_;  // likewise
  DeviceGroom* groom_ = nullptr;
  const gpu::Buffer* poses_ = nullptr;
  std::optional<Buffers> buffers_;
  std::vector<float> densities_;  // at rest
  layout::VolumeNumbers numbers_{};
  float largestMass_ = 0;
  VolumeSorts sorts_{};
  double longestStrand_ = 0;  // as RestVolume's
  double range_ = 1;          // KernelChoice::volumeRange
  bool isDivided_ = false;
};

}  // namespace ringlet
