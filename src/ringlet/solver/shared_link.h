// SharedLink: a PartLink among threads of one process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/solver/part_link.h"

namespace ringlet {

/// Each part steps its frames on a thread of its own, all at the same time.
class SharedLink : public PartLink {
 public:
  /// One link for each part, in order.
  static std::vector<std::unique_ptr<SharedLink>> connect(
      const std::vector<std::vector<std::uint32_t>>& parts);

  Status exchange(std::span<const Message> messages) override;
  Status sum(std::span<std::uint32_t> numbers) override;
  Status largest(std::span<std::int32_t> numbers) override;
  void fail(const Error& why) override;

 private:
  struct Meeting;
  template <class Number, class Join>
  Status reduce(std::span<Number> numbers, const Join& join);
  SharedLink(std::vector<std::vector<std::uint32_t>> parts, std::size_t own, std::shared_ptr<Meeting> meeting)
      : PartLink(std::move(parts), own), meeting_(std::move(meeting)) {}
  std::shared_ptr<Meeting> meeting_;
  std::vector<std::byte> joined_;  // result of reduce, while the other parts still read `numbers`
};

}  // namespace ringlet
