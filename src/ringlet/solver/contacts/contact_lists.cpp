// Implements solver/contacts/contact_lists.h.
#include "ringlet/solver/contacts/contact_lists.h"

#include <fmt/format.h>

#include <utility>

#include "ringlet/gpu/device_buffers.h"
#include "ringlet/solver/plan/groom_chunks.h"

namespace ringlet {

Result<std::vector<gpu::Buffer>> ListMaker::make(std::span<const Part> parts, std::uint32_t longest) const {
  std::uint64_t total = 0;
  for (const auto& [name, bytes] : parts) {
    total += bytes;
    if (bytes <= largestBuffer) continue;
    return Error{fmt::format(
        "the {} of {} contact particles, up to {} for one, need a buffer of {} MiB, and this device's are {} "
        "MiB at most; use a smaller contact radius, or prune more",
        name, contactCount, longest, bytes >> 20, largestBuffer >> 20)};
  }
  const std::string what = fmt::format("the lists of {} contact particles", contactCount);
  if (Status status = checkMemory(what, total, gpu::availableStorageBytes(*device)); !status)
    return status.error();
  std::vector<gpu::Buffer> made;
  for (const auto& [name, bytes] : parts) {
    auto list = createZero(*device, bytes, name);
    if (!list) return list.error();
    made.push_back(std::move(*list));
  }
  return made;
}

}  // namespace ringlet
