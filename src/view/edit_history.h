// EditHistory: what can be undone and done again.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace ringlet::view {

template <class State>
class EditHistory {
 public:
  explicit EditHistory(State now) : now_(std::move(now)) {}

  const State& now() const { return now_; }
  /// Of a change that goes on, such as a slider that is dragged: kept with the next commit.
  void set(State state) {
    now_ = std::move(state);
    ++version_;
  }
  /// Another number whenever now() may be another.
  std::size_t version() const { return version_; }
  /// What was before the changes since the last commit can be had back.
  void commit() {
    done_.push_back(std::exchange(committed_, now_));
    if (done_.size() > kMost) done_.erase(done_.begin());
    undone_.clear();
  }
  bool canUndo() const { return !done_.empty(); }
  bool canRedo() const { return !undone_.empty(); }
  void undo() { move(done_, undone_); }
  void redo() { move(undone_, done_); }

 private:
  static constexpr std::size_t kMost = 1000;

  void move(std::vector<State>& from, std::vector<State>& to) {
    if (from.empty()) return;
    to.push_back(committed_);
    now_ = committed_ = std::move(from.back());
    from.pop_back();
    ++version_;
  }

  State now_;
  State committed_ = now_;
  std::vector<State> done_, undone_;
  std::size_t version_ = 0;
};

}  // namespace ringlet::view
