// Implements solver/shared_link.h.
#include "ringlet/solver/shared_link.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

namespace ringlet {

// A reusable barrier: all wait for the last.
struct SharedLink::Meeting {
  explicit Meeting(std::size_t partCount) : sections(partCount) {}

  Status wait() {
    std::unique_lock lock(mutex);
    const std::uint64_t now = round;
    if (++arrived == sections.size()) {
      arrived = 0, ++round;
      allHere.notify_all();
    }
    allHere.wait(lock, [&] { return round != now || failure; });
    if (failure) return *failure;
    return {};
  }

  std::mutex mutex;
  std::condition_variable allHere;
  std::size_t arrived = 0;
  std::uint64_t round = 0;
  std::optional<Error> failure;
  std::vector<std::span<const std::byte>> sections;  // of each part
};

std::vector<std::unique_ptr<SharedLink>> SharedLink::connect(
    const std::vector<std::vector<std::uint32_t>>& parts) {
  const auto meeting = std::make_shared<Meeting>(parts.size());
  std::vector<std::unique_ptr<SharedLink>> links;
  for (std::size_t k = 0; k < parts.size(); ++k)
    links.push_back(std::unique_ptr<SharedLink>(new SharedLink(parts, k, meeting)));
  return links;
}

Status SharedLink::exchange(std::span<std::byte> all, std::span<const std::size_t> ends) {
  const auto sectionOf = [&](std::size_t k) {
    const std::size_t begin = k > 0 ? ends[k - 1] : 0;
    return all.subspan(begin, ends[k] - begin);
  };
  meeting_->sections[own()] = sectionOf(own());
  if (Status here = meeting_->wait(); !here) return here;
  for (std::size_t k = 0; k < ends.size(); ++k)
    if (k != own()) std::ranges::copy(meeting_->sections[k], sectionOf(k).begin());
  return meeting_->wait();  // until all have read
}

void SharedLink::fail(const Error& why) {
  const std::scoped_lock lock(meeting_->mutex);
  if (!meeting_->failure) meeting_->failure = why;
  meeting_->allHere.notify_all();
}

}  // namespace ringlet
