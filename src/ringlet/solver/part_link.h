// PartLink: how the parts of divided hair hand each other what strands in contact need of one another
// (KernelChoice::link). Over threads of a process: shared_link.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet {

/// Every part has one of its own. Parts have the same groom, settings and frames, and devices of one kind;
/// then each strand has the bits that it has undivided.
class PartLink {
 public:
  virtual ~PartLink() = default;

  /// Strands of each part, groom order; every strand is in one.
  const std::vector<std::vector<std::uint32_t>>& parts() const { return parts_; }
  /// Which of them this is.
  std::size_t own() const { return own_; }

  /// `all` has a section for each part; section k ends at `ends[k]` [bytes]. The own one is filled; on return
  /// all are. Every part calls it as often, with the same ends, and waits for the others. Fails where one has
  /// failed.
  virtual Status exchange(std::span<std::byte> all, std::span<const std::size_t> ends) = 0;
  /// This part has failed: others do not wait for it any more.
  virtual void fail(const Error& why) = 0;

 protected:
  PartLink(std::vector<std::vector<std::uint32_t>> parts, std::size_t own)
      : parts_(std::move(parts)), own_(own) {}

 private:
  std::vector<std::vector<std::uint32_t>> parts_;
  std::size_t own_ = 0;
};

}  // namespace ringlet
