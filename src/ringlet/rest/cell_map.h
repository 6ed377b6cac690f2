// CellMap: maps keys of a grid's cells to values, in one block of memory. A standard map allocates each cell
// by itself, which took most of the time where densities at rest are summed.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ringlet {

/// Keys are below 2^63.
template <class Value>
class CellMap {
 public:
  /// The value of a cell; a cell without a value first gets `otherwise`.
  Value& at(std::uint64_t key, Value otherwise) {
    if (2 * used_ >= slots_.size()) grow();
    Slot& slot = slots_[slotOf(key)];
    if (slot.key != key) {
      slot = {key, otherwise};
      ++used_;
    }
    return slot.value;
  }
  /// Null if the cell has no value.
  const Value* find(std::uint64_t key) const {
    if (slots_.empty()) return nullptr;
    const Slot& slot = slots_[slotOf(key)];
    return slot.key == key ? &slot.value : nullptr;
  }
  /// Removes all values and keeps the memory.
  void clear() {
    slots_.assign(slots_.size(), {});
    used_ = 0;
  }

 private:
  static constexpr std::uint64_t kNoKey = ~std::uint64_t{0};
  struct Slot {
    std::uint64_t key = kNoKey;
    Value value{};
  };

  // Linear probing. Knuth, "Sorting and Searching", 1973: multiplicative hashing.
  std::size_t slotOf(std::uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = key * 0x9e3779b97f4a7c15u >> (64 - std::countr_zero(slots_.size()));
    while (slots_[slot].key != key && slots_[slot].key != kNoKey) slot = (slot + 1) & mask;
    return slot;
  }
  void grow() {
    std::vector<Slot> before(slots_.empty() ? 64 : 2 * slots_.size());
    std::swap(before, slots_);
    for (const Slot& slot : before)
      if (slot.key != kNoKey) slots_[slotOf(slot.key)] = slot;
  }

  std::vector<Slot> slots_;  // their number is a power of two; at most half are used
  std::size_t used_ = 0;
};

}  // namespace ringlet
