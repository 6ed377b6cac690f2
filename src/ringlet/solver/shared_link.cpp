// Implements solver/shared_link.h.
#include "ringlet/solver/shared_link.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace ringlet {

// A reusable barrier: every part waits for the last one.
struct SharedLink::Meeting {
  explicit Meeting(std::size_t partCount) : messages(partCount), numbers(partCount) {}

  // Spins before it sleeps: the others are rarely late by more than the time it takes to wake a thread.
  Status wait() {
    std::unique_lock lock(mutex);
    const std::uint64_t now = round;
    if (++arrived == messages.size()) {
      arrived = 0, ++round;
      allHere.notify_all();
    }
    lock.unlock();
    constexpr int kLooks = 1000;
    for (int k = 0; k < kLooks && round == now; ++k) std::this_thread::yield();
    lock.lock();
    allHere.wait(lock, [&] { return round != now || failure; });
    if (failure) return *failure;
    return {};
  }

  std::mutex mutex;
  std::condition_variable allHere;
  std::size_t arrived = 0;
  std::atomic<std::uint64_t> round = 0;
  std::optional<Error> failure;
  // Of each part; valid while all parts read them.
  std::vector<std::span<const Message>> messages;
  std::vector<const void*> numbers;
};

std::vector<std::unique_ptr<SharedLink>> SharedLink::connect(
    const std::vector<std::vector<std::uint32_t>>& parts) {
  const auto meeting = std::make_shared<Meeting>(parts.size());
  std::vector<std::unique_ptr<SharedLink>> links;
  for (std::size_t k = 0; k < parts.size(); ++k)
    links.push_back(std::unique_ptr<SharedLink>(new SharedLink(parts, k, meeting)));
  return links;
}

Status SharedLink::exchange(std::span<const Message> messages) {
  meeting_->messages[own()] = messages;
  if (Status here = meeting_->wait(); !here) return here;
  for (const Message& message : messages) {
    const auto theirs = std::ranges::find(meeting_->messages[message.part], own(), &Message::part);
    std::ranges::copy(theirs->out, message.in.begin());
  }
  return meeting_->wait();  // until all have read
}

template <class Number, class Join>
Status SharedLink::reduce(std::span<Number> numbers, const Join& join) {
  meeting_->numbers[own()] = numbers.data();
  if (Status here = meeting_->wait(); !here) return here;
  joined_.resize(numbers.size_bytes());
  const std::span all(reinterpret_cast<Number*>(joined_.data()), numbers.size());
  std::ranges::copy(numbers, all.begin());
  for (std::size_t part = 0; part < meeting_->numbers.size(); ++part) {
    if (part == own()) continue;
    const auto* theirs = static_cast<const Number*>(meeting_->numbers[part]);
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = join(all[k], theirs[k]);
  }
  if (Status here = meeting_->wait(); !here) return here;  // until all have read
  std::ranges::copy(all, numbers.begin());
  return {};
}

Status SharedLink::sum(std::span<std::uint32_t> numbers) { return reduce(numbers, std::plus<>()); }
Status SharedLink::largest(std::span<std::int32_t> numbers) {
  return reduce(numbers, [](std::int32_t a, std::int32_t b) { return std::max(a, b); });
}

void SharedLink::fail(const Error& why) {
  const std::scoped_lock lock(meeting_->mutex);
  if (!meeting_->failure) meeting_->failure = why;
  meeting_->allHere.notify_all();
}

}  // namespace ringlet
