// Implements solver/contacts/contact_lives.h.
#include "ringlet/solver/contacts/contact_lives.h"

#include <algorithm>
#include <span>
#include <utility>

#include "ringlet/gpu/device_buffers.h"

namespace ringlet {
namespace {

// The initial room: blocks for each contact particle's list, and contact particles for each block of the
// store.
constexpr std::uint32_t kFirstMostLifeBlocks = 4, kParticlesPerBlock = 4;

}  // namespace

Result<ContactLives> ContactLives::create(const ListMaker& maker, int room) {
  ContactLives self;
  self.maker_ = maker;
  const auto blocks = static_cast<std::uint32_t>(maker.contactCount / kParticlesPerBlock + 1);
  self.room_ = ListRoom{blocks, kFirstMostLifeBlocks}.times(room);
  if (Status status = self.createLists(); !status) return status.error();
  return self;
}

Status ContactLives::createLists() {
  parts_.clear();  // frees them before the new ones are made
  const ListMaker::Part parts[] = {{"live contacts' lists", headCount() * sizeof(std::uint32_t)},
                                   {"live contacts", 2 * rowCount() * sizeof(layout::ContactLife)},
                                   {"contact forces", rowCount() * sizeof(layout::ContactForce)}};
  auto made = maker_.make(parts, room_.most * layout::kLiveBlock);
  if (!made) return made.error();
  parts_ = std::move(*made);
  return {};
}

std::uint64_t ContactLives::bytes() const {
  return parts_[kHeads].bytes() + parts_[kLives].bytes() + parts_[kForces].bytes();
}

void ContactLives::addTo(gpu::BufferTable& table) const {
  using namespace layout;
  table.insert({{kBindLiveLists, parts_[kHeads]},
                {kBindLives, parts_[kLives]},
                {kBindForces, parts_[kForces]},
                {kBindLifeTexels, parts_[kLives]},
                {kBindForceTexels, parts_[kForces]}});
}

Status ContactLives::makeRoom(const layout::ContactControl& control) {
  const ListRoom old = room_;
  const ListRoom wanted = old.grownTo(control.liveBlocks, control.longestLive, layout::kLiveBlock);
  if (wanted == old) return {};
  const std::uint32_t before = control.parity ^ 1;
  auto heads = downloadAll<std::uint32_t>(parts_[kHeads], headCount());
  if (!heads) return heads.error();
  auto lives = downloadAll<layout::ContactLife>(parts_[kLives], rowCount(), before * rowCount());
  if (!lives) return lives.error();
  room_ = wanted;
  if (Status status = createLists(); !status) return status;

  std::vector<std::uint32_t> newHeads(headCount());
  for (std::size_t list = before; list < 2 * maker_.contactCount; list += 2) {
    std::copy_n(heads->begin() + static_cast<std::ptrdiff_t>(list * (1 + old.most)), 1 + old.most,
                newHeads.begin() + static_cast<std::ptrdiff_t>(list * (1 + room_.most)));
  }
  if (Status status = parts_[kHeads].upload(std::as_bytes(std::span(newHeads))); !status) return status;
  return parts_[kLives].upload(std::as_bytes(std::span(*lives)),
                               before * rowCount() * sizeof(layout::ContactLife));
}

Status ContactLives::forget() { return parts_[kHeads].fillZero(); }

Status ContactLives::archive(Archive& archive) {
  ListRoom room = room_;
  archive.value(room);
  if (archive.isShort()) return {};
  if (room != room_) {
    room_ = room;
    if (Status status = createLists(); !status) return status;
  }
  for (const Part part : {kHeads, kLives}) {
    if (Status status = archiveBuffer(archive, parts_[part]); !status) return status;
  }
  return {};
}

Result<std::uint64_t> ContactLives::count(std::uint32_t parity) const {
  auto heads = downloadAll<std::uint32_t>(parts_[kHeads], headCount());
  if (!heads) return heads.error();
  std::uint64_t sum = 0;
  for (std::size_t list = parity; list < 2 * maker_.contactCount; list += 2)
    sum += (*heads)[list * (1 + room_.most)];
  return sum;
}

Status ContactLives::each(std::uint32_t parity,
                          const std::function<void(std::size_t, const layout::ContactLife&)>& tell) const {
  auto heads = downloadAll<std::uint32_t>(parts_[kHeads], headCount());
  if (!heads) return heads.error();
  auto lives = downloadAll<layout::ContactLife>(parts_[kLives], rowCount(), parity * rowCount());
  if (!lives) return lives.error();
  for (std::size_t c = 0; c < maker_.contactCount; ++c) {
    const std::size_t list = (2 * c + parity) * (1 + room_.most);
    for (std::uint32_t j = 0; j < (*heads)[list]; ++j) {
      const std::size_t block = (*heads)[list + 1 + j / layout::kLiveBlock];
      tell(c, (*lives)[block * layout::kLiveBlock + j % layout::kLiveBlock]);
    }
  }
  return {};
}

}  // namespace ringlet
