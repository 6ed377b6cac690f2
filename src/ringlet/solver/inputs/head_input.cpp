// Implements solver/inputs/head_input.h.
#include "ringlet/solver/inputs/head_input.h"

#include <algorithm>
#include <utility>

#include "layout/strands.h"
#include "ringlet/base/packed.h"
#include "ringlet/solver/inputs/frame_inputs.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

void HeadHistory::jump(const HeadPose& to) {
  const Quatd turned = normalized(to.rotation * now.rotation.conjugate());
  const Vec3d step = rotate(turned, now.position - oneStepEarlier.position);
  const Quatd turn = turned * this->turn() * turned.conjugate();
  now = to;
  oneStepEarlier = {to.position - step, normalized(turn.conjugate() * to.rotation), to.shift};
}

// A head that shares buffers with others writes its poses into its part of them.
Result<HeadInput> HeadInput::create(const InputSource& from) {
  HeadInput self;
  self.history_ = {from.initial.oneStepEarlier.value_or(from.initial.head), from.initial.head};
  if (!from.place) {
    if (Status status = self.stage(from, layout::kMaxStepPoses * sizeof(layout::StepPose), "poses"); !status)
      return status.error();
    return self;
  }
  auto part = from.place->part(1);
  if (!part) return part.error();
  auto poses = StagedBuffer::create(from.device, std::move(part->poses), from.slots, "poses");
  if (!poses) return poses.error();
  self.staged_.push_back(std::move(*poses));
  return self;
}

void HeadInput::writeFrame(std::size_t slot, const FrameContext& frame) {
  const double T = frame.stepSeconds;
  const auto out = staged_[0].of<layout::StepPose>(slot);
  const auto write = [&](std::size_t pose, Vec3d change) {
    out[pose] = {packed(now().rotation), packed(history_.turn()), packed3(change),
                 static_cast<float>(now().shift)};
  };
  write(0, {});
  for (std::size_t k = 0; k < frame.steps(); ++k) {
    const Vec3d before = history_.velocity(T);
    history_ = {now(), frame.heads[2 + k]};
    history_.now.rotation = normalized(now().rotation);
    write(1 + k, history_.velocity(T) - before);
  }
}

bool HeadInput::isQuiet(const FrameContext& frame) const {
  const auto isHere = [&](const HeadPose& pose) {
    return pose.position == now().position && normalized(pose.rotation) == now().rotation &&
           pose.shift == now().shift;
  };
  return isHere(history_.oneStepEarlier) && std::ranges::all_of(frame.heads.subspan(2), isHere);
}

gpu::BufferTable HeadInput::bufferTable(std::size_t) const {
  return {{layout::kBindPoses, poses()}, {layout::kBindHeadPoseTexels, poses()}};
}

}  // namespace ringlet
