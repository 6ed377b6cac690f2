// PartLink: the exchange of data between the parts of divided hair with contacts (KernelChoice::link).
// Between threads of one process: shared_link.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet {

/// Each part has its own link. If all parts have the same groom, settings and frames, and devices of one
/// kind, each strand has the same bits as in undivided hair.
class PartLink {
 public:
  virtual ~PartLink() = default;

  /// The strands of each part, groom order; each strand is in exactly one part.
  const std::vector<std::vector<std::uint32_t>>& parts() const { return parts_; }
  /// The index of this part.
  std::size_t own() const { return own_; }

  /// `out`: data for another part; `in`: where that part's data for this one is written.
  struct Message {
    std::size_t part = 0;
    std::span<const std::byte> out;
    std::span<std::byte> in;
  };
  /// Exchanges messages. All parts call this and the functions below equally often, and wait for each other.
  /// Two parts either both have a message for each other, of the sizes that both expect, or neither has.
  /// Fails for all if a part has failed.
  virtual Status exchange(std::span<const Message> messages) = 0;
  /// Replaces each number by the sum over all parts, modulo 2^32, or by the largest. All parts pass equally
  /// many numbers.
  virtual Status sum(std::span<std::uint32_t> numbers) = 0;
  virtual Status largest(std::span<std::int32_t> numbers) = 0;
  /// Tells the others that this part has failed, so that they stop waiting for it.
  virtual void fail(const Error& why) = 0;

 protected:
  PartLink(std::vector<std::vector<std::uint32_t>> parts, std::size_t own)
      : parts_(std::move(parts)), own_(own) {}

 private:
  std::vector<std::vector<std::uint32_t>> parts_;
  std::size_t own_ = 0;
};

}  // namespace ringlet
