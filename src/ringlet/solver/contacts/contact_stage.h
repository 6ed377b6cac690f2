// ContactStage: the contacts of one groom on one device, between the strand kernel's solves. Model: Iben et
// al. 2012, section 4; which strands may touch is decided in rest/. Mirrored by
// reference/kernels/contact_step.h.
//
//   v^0 of all strands ->  lists: moved too far? then grid and query          (the device decides)
//                      ->  first: who touches; weights, momenta               -> solve -> v^1
//                      ->  next: holding springs dropped, pair means of v^1    -> solve -> v^2 ... -> move
//
// With the distance taper a contact follows from the positions of its two particles; with the time taper it
// has a state of its own (contact_lives.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "layout/contacts.h"
#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/contacts/contact_kernels.h"
#include "ringlet/solver/contacts/contact_lists.h"
#include "ringlet/solver/contacts/contact_lives.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/plan/submission_pace.h"
#include "ringlet/solver/strands/device_groom.h"

namespace ringlet {

class ContactStage {
 public:
  /// Fails, with the numbers and what to do, where lists are larger than the device's buffers. `groom` has
  /// one chunk, must outlive this and must not move. room: as KernelChoice::contactRoom. For divided hair
  /// `rest` and `contacts` are those of a part (rest/rest_part.h), which has no lists and no contacts of its
  /// halo.
  static Result<ContactStage> create(gpu::Device& device, const RestState& rest, const Settings& settings,
                                     const RestContacts& contacts, DeviceGroom& groom, int room);

  /// Number of kernels that no other simulation on this device had made before.
  std::size_t newKernelCount() const { return newKernels_.size(); }
  /// Dispatches these without work, so that the driver compiles them before they are needed.
  void recordNothing(gpu::CommandList& list) const;

  /// Record the stages of a step (plan/frame_plan.h). The caller records the barriers before and after each.
  /// whose: whose contact particles are measured (layout::kOfAll, kOfHere, kOfElsewhere).
  void recordMotion(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step,
                    std::uint32_t whose) const;
  void recordGrid(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step) const;
  void recordLists(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step) const;
  void recordFirst(gpu::CommandList& list, SubmissionPace& pace) const;
  void recordNext(gpu::CommandList& list, SubmissionPace& pace) const;

  /// Reads the control block that a frame left. Call it after a frame, before the functions below.
  void readControl();
  /// Whether the frame halted for lack of room, and at which step.
  bool isHalted() const { return control_.isHalted != 0; }
  std::uint32_t haltedStep() const { return control_.step; }
  /// For divided hair: the largest motion and speed, as ContactControl has them, after recordMotion.
  using Largest = std::array<std::int32_t, 2>;
  Largest largest() const;
  Status setLargest(const Largest& largest);
  /// For divided hair: the counts of the sample after recordGrid, to be summed over the parts before
  /// recordLists.
  struct Sample {
    std::uint32_t sampled = 0, missed = 0;  // see ContactControl
  };
  bool samples() const { return sampleStride_ > 0; }
  Sample sample() const { return {control_.sampled, control_.missed}; }
  Status setSample(const Sample& sample);
  /// Enlarges the lists and keeps the state of contacts. Invalidates earlier recordings.
  Status makeRoom();

  /// Size of the constant buffers, and of the lists [bytes].
  std::uint64_t bytes() const;
  /// The buffers that its kernels use.
  gpu::BufferTable bufferTable() const;
  std::uint64_t listBytes() const;

  /// Number of pairs that the search has tested since the simulation began; each counts for both particles.
  std::uint64_t pairTests() const { return pairTests_; }
  std::uint64_t rebuilds() const { return control_.rebuilds; }
  /// Number of pairs in the lists, and of contacts; each counts for both particles.
  std::uint64_t listedSides() const { return control_.listed; }
  Result<std::uint64_t> contactSides() const;
  /// Changes the live settings. Invalidates earlier recordings; a change of stiffness or damping ratio also
  /// invalidates the lists.
  Status setSettings(const Settings& settings);
  /// Clears lists and contacts, after the hair was moved to another state.
  Status forget();
  /// Archives the state that the next step depends on besides positions, velocities and the result of the
  /// last solve. Reading invalidates earlier recordings.
  Status archive(Archive& archive);

  /// All listed pairs and contacts, a < b, each once, sorted.
  Result<std::vector<ListedContact>> listed(const RestState& rest) const;

 private:
  struct Buffers {
    gpu::Buffer contacts, neighbours, indices, grid, places, histories, guesses, sampled, numbers;
  };
  ContactStage() = default;
  Status makeKernels(gpu::Device& device, bool inGroups);
  Status makeBuffers(gpu::Device& device, const RestState& rest, const Settings& settings,
                     const RestContacts& contacts, const std::vector<std::uint32_t>& ofSamples);
  using EachBlock =
      std::function<void(std::size_t c, std::uint32_t block, std::uint32_t count, std::uint32_t bits)>;
  Status eachBlock(const EachBlock& tell) const;
  ListMaker listMaker() const { return {device_, particles_.size(), largestList_}; }
  enum ListPart { kHeads, kPairs };
  Status createLists();
  Status bindLists();
  layout::ContactNumbers numbers() const;
  void dispatch(gpu::CommandList& list, ContactKernel kernel, std::uint32_t step,
                std::uint32_t groupCount) const;
  void dispatchIndirect(gpu::CommandList& list, ContactKernel kernel, std::uint32_t step,
                        std::uint64_t offset) const;
  std::uint32_t contactGroups() const;
  double skin() const;         // [m]
  double listedAhead() const;  // [r0]
  Status writeControl();
  Status writeNumbers();
  const DeviceChunk& hair() const { return groom_->chunks[0]; }

  gpu::Device* device_ = nullptr;
  std::vector<std::shared_ptr<const gpu::Kernel>> kernels_;  // by ContactKernel
  std::vector<std::size_t> newKernels_;
  std::vector<gpu::Bindings> bindings_;  // likewise
  DeviceGroom* groom_ = nullptr;
  std::optional<Buffers> buffers_;
  std::vector<gpu::Buffer> lists_;     // of neighbours, by ListPart
  std::optional<ContactLives> lives_;  // with the time taper
  std::uint64_t largestList_ = 0;      // limit of a buffer of the lists [bytes]
  layout::ContactControl control_{};   // as on the device between frames
  std::uint64_t pairTests_ = 0;
  ContactSettings settings_;
  std::vector<std::uint32_t> particles_;  // device index of each contact particle
  double stepSeconds_ = 0;
  std::uint32_t bucketCount_ = 0;
  ListRoom near_;
  float largestRadius_ = 0;
  bool everyPair_ = false, isDivided_ = false;
  std::uint32_t sampleStride_ = 0;
  std::uint32_t mostSampled_ = 0;
  std::uint32_t mostMotionGroups_ = 0;
};

}  // namespace ringlet
