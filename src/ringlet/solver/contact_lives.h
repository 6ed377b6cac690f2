// ContactLives: what contacts of the time taper remember from step to step, on the device (contact_life.comp,
// contact_gather.comp). Each contact particle has a list of its contacts of this step and one of the step
// before. Mirrored by reference/kernels/contact_step.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "layout/contacts.h"
#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/solver/contact_lists.h"

namespace ringlet {

class ContactLives {
 public:
  static Result<ContactLives> create(const ListMaker& maker, int room);

  const ListRoom& room() const { return room_; }
  std::uint64_t bytes() const;
  void addTo(gpu::BufferTable& table) const;

  /// Makes room for what the step wanted that stopped, keeping the contacts of the step before it.
  Status makeRoom(const layout::ContactControl& control);
  Status forget();
  /// Contacts and their room.
  Status archive(Archive& archive);

  /// Contacts of all contact particles in the step of this parity, both sides counted.
  Result<std::uint64_t> count(std::uint32_t parity) const;
  /// Tells each of them: (contact particle, its life).
  Status each(std::uint32_t parity,
              const std::function<void(std::size_t, const layout::ContactLife&)>& tell) const;

 private:
  enum Part { kHeads, kLives, kForces };  // forces of this step
  Status createLists();
  std::size_t headCount() const { return 2 * maker_.contactCount * (1 + room_.most); }
  std::size_t rowCount() const { return std::size_t{room_.blocks} * layout::kLiveBlock; }

  ListMaker maker_;
  ListRoom room_;
  std::vector<gpu::Buffer> parts_;  // by Part
};

}  // namespace ringlet
