// NumbersInput: settings, material and counts of a frame, as strand kernels read them.
#pragma once

#include "layout/strands.h"
#include "ringlet/solver/inputs/frame_input.h"

namespace ringlet {

class NumbersInput : public FrameInput {
 public:
  static Result<NumbersInput> create(const InputSource& from) {
    NumbersInput self;
    Status made = self.stage(from, sizeof(layout::HairNumbers), "numbers");
    return made ? Result<NumbersInput>(std::move(self)) : made.error();
  }

  /// Sets the numbers for the next frame that is written.
  void set(const layout::HairNumbers& numbers) { now_ = numbers; }

  void writeFrame(std::size_t slot, const FrameContext&) override {
    staged_[0].of<layout::HairNumbers>(slot)[0] = now_;
  }
  gpu::BufferTable bufferTable(std::size_t) const override {
    return {{layout::kBindNumbers, staged_[0].seen()}};
  }
  std::uint64_t largestBuffer() const override { return 0; }  // never read as texels

 private:
  layout::HairNumbers now_{};
};

}  // namespace ringlet
