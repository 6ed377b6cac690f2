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

/// Each part has its own. If all parts have the same groom, settings and frames, and devices of one kind,
/// each strand has the same bits as in undivided hair.
class PartLink {
 public:
  virtual ~PartLink() = default;

  /// The strands of each part, groom order; each strand is in exactly one part.
  const std::vector<std::vector<std::uint32_t>>& parts() const { return parts_; }
  /// The index of this part.
  std::size_t own() const { return own_; }

  /// Exchanges sections. `all` has a section per part; section k ends at `ends[k]` [bytes]. The caller has
  /// filled its own; on return all are filled. All parts call this equally often, with the same ends, and
  /// wait for each other. Fails if a part has failed.
  virtual Status exchange(std::span<std::byte> all, std::span<const std::size_t> ends) = 0;
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
