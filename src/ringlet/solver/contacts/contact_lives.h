// ContactLives: the state that contacts of the time taper keep from step to step, on the device
// (contact_life.comp, contact_gather.comp). Each contact particle has a list of its contacts of this step and
// one of those of the last step. Mirrored by reference/kernels/contact_step.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "layout/contacts.h"
#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/solver/contacts/contact_lists.h"

namespace ringlet {

class ContactLives {
 public:
  static Result<ContactLives> create(const ListMaker& maker, int room);

  const ListRoom& room() const { return room_; }
  std::uint64_t bytes() const;
  void addTo(gpu::BufferTable& table) const;

  /// Enlarges the lists to what the interrupted step needed, and keeps the contacts of the step before it.
  Status makeRoom(const layout::ContactControl& control);
  Status forget();
  /// Number of contacts and the room for them.
  Status archive(Archive& archive);

  /// Number of contacts in the step of this parity; a contact counts once for each of its two particles.
  Result<std::uint64_t> count(std::uint32_t parity) const;
  /// Calls tell(contact particle, life) for each of them.
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
