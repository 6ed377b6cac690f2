// ContactStage: the contacts of one groom on one device, between the strand kernel's solves. Model: Iben et
// al. 2012, section 4; which strands may touch is decided in rest/. Mirrored by
// reference/kernels/contact_step.h.
//
//   v^0 of all strands ->  lists: moved too far? then grid and query          (the device decides)
//                      ->  first: who touches; weights, momenta               -> solve -> v^1
//                      ->  next: unmet springs dropped, pair means of v^1      -> solve -> v^2 ... -> move
//
// With the distance taper a contact is what two particles' places say; with the time taper it has a life
// (contact_lives.h).
#pragma once

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
#include "ringlet/solver/contact_kernels.h"
#include "ringlet/solver/contact_lists.h"
#include "ringlet/solver/contact_lives.h"
#include "ringlet/solver/device_groom.h"
#include "ringlet/solver/simulation.h"
#include "ringlet/solver/submission_pace.h"

namespace ringlet {

class ContactStage {
 public:
  /// Fails, with the numbers and what to do, where lists are larger than the device's buffers. `groom` is of
  /// one chunk, and must live as long, in one place. room: as KernelChoice::contactRoom.
  /// isHere: of each strand, device order; others have no lists and no contacts here; none: all are here.
  static Result<ContactStage> create(gpu::Device& device, const RestState& rest, const Settings& settings,
                                     const RestContacts& contacts, const std::vector<bool>& isHere,
                                     DeviceGroom& groom, int room);

  /// Kernels that this stage was the first on its device to ask for.
  std::size_t newKernelCount() const { return newKernels_.size(); }
  /// Those, without work: so that they are compiled before they are needed.
  void recordNothing(gpu::CommandList& list) const;

  /// Parts of a step, in order; each begins and ends with nothing to wait for but what the caller's barriers
  /// say.
  void recordGrid(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step) const;
  void recordLists(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step) const;
  void recordFirst(gpu::CommandList& list, SubmissionPace& pace) const;
  void recordNext(gpu::CommandList& list, SubmissionPace& pace) const;

  /// After a frame and before all that follows here: what it left in the control block.
  void readControl();
  /// Whether it stopped for want of room, and at which step.
  bool isHalted() const { return control_.isHalted != 0; }
  std::uint32_t haltedStep() const { return control_.step; }
  /// Of hair in several parts: what a sample says after recordGrid is summed over them before recordLists.
  struct Sample {
    std::uint32_t sampled = 0, missed = 0;  // as ContactControl has them
  };
  bool samples() const { return sampleStride_ > 0; }
  Sample sample() const { return {control_.sampled, control_.missed}; }
  Status setSample(const Sample& sample);
  /// Makes longer lists, keeping what contacts remember; recordings made before are no longer good.
  Status makeRoom();

  /// Of the buffers made once, and of the lists [bytes].
  std::uint64_t bytes() const;
  std::uint64_t listBytes() const;

  /// Pairs looked at since the simulation began, in all steps, both sides counted.
  std::uint64_t pairTests() const { return pairTests_; }
  std::uint64_t rebuilds() const { return control_.rebuilds; }
  /// Pairs in the lists, and contacts that live, each on both sides.
  std::uint64_t listedSides() const { return control_.listed; }
  Result<std::uint64_t> contactSides() const;
  /// What may change while hair moves; recordings made before are no longer good. Other springs need other
  /// lists.
  Status setSettings(const Settings& settings);
  /// Forgets lists and lives: the hair was put somewhere else.
  Status forget();
  /// All that the next step depends on beside positions, velocities and what the solve left. Where the
  /// archive is read, recordings made before are no longer good.
  Status archive(Archive& archive);

  /// All pairs that are near or contacts, a < b, each once, sorted.
  Result<std::vector<ListedContact>> listed(const RestState& rest) const;

 private:
  struct Buffers {
    gpu::Buffer contacts, neighbours, indices, grid, places, histories, guesses;
  };
  ContactStage() = default;
  using EachBlock =
      std::function<void(std::size_t c, std::uint32_t block, std::uint32_t count, std::uint32_t bits)>;
  Status eachBlock(const EachBlock& tell) const;
  ListMaker listMaker() const { return {device_, particles_.size(), largestList_}; }
  enum ListPart { kHeads, kPairs };
  Status createLists();
  Status bindLists();
  gpu::BufferTable bufferTable() const;
  layout::ContactParameters parameters(std::uint32_t step) const;
  void dispatch(gpu::CommandList& list, ContactKernel kernel, std::uint32_t step,
                std::uint32_t groupCount) const;
  void dispatchIndirect(gpu::CommandList& list, ContactKernel kernel, std::uint32_t step,
                        std::uint64_t offset) const;
  std::uint32_t contactGroups() const;
  double skin() const;         // [m]
  double listedAhead() const;  // [r0]
  Status writeControl();
  const DeviceChunk& hair() const { return groom_->chunks[0]; }

  gpu::Device* device_ = nullptr;
  std::vector<std::shared_ptr<const gpu::Kernel>> kernels_;  // by ContactKernel
  std::vector<std::size_t> newKernels_;
  std::vector<gpu::Bindings> bindings_;  // likewise
  DeviceGroom* groom_ = nullptr;
  std::optional<Buffers> buffers_;
  std::vector<gpu::Buffer> lists_;     // of who is near, by ListPart
  std::optional<ContactLives> lives_;  // with the time taper
  std::uint64_t largestList_ = 0;      // [bytes] a buffer of the lists may have
  layout::ContactControl control_{};   // as the device has it between frames
  std::uint64_t pairTests_ = 0;
  ContactSettings settings_;
  std::vector<std::uint32_t> particles_;  // device index of each contact particle
  double stepSeconds_ = 0;
  std::uint32_t bucketCount_ = 0;
  ListRoom near_;
  float largestRadius_ = 0;
  bool everyPair_ = false;
  std::uint32_t sampleStride_ = 0;
};

}  // namespace ringlet
