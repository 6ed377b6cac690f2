// Recorder: a list of commands for the device, recorded once and submitted as often as wanted, with timed
// stages; in one submission or in several (cut).
//
//   begin -> { beginStage, dispatch, barrier, copyBuffer, ..., endStage }* -> submit -> wait
//     ^                                                                         ^          |
//     +---------------------------------- or -----------------------------------+----------+
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"

namespace ringlet::gpu {

/// A struct, rather than bytes already.
template <class T>
concept PushConstants =
    std::is_trivially_copyable_v<T> && !std::is_convertible_v<const T&, std::span<const std::byte>>;

/// For one thread at a time. Kernels, bindings and buffers recorded must live until the last wait.
class Recorder {
 public:
  /// `name` is for messages.
  static Result<Recorder> create(Device& device, const std::string& name);
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;
  ~Recorder();  // waits for what is under way

  /// Forgets what was recorded. What follows sees the finished work of earlier submissions.
  Status begin();

  /// Runs `groupCount` workgroups, at most DeviceProperties::maxGroupCount: the caller splits. None is fine.
  void dispatch(const Kernel& kernel, const Bindings& bindings, std::span<const std::byte> pushConstants,
                std::uint32_t groupCount);
  /// The same with a struct as push constants, laid out as in the shader.
  template <PushConstants T>
  void dispatch(const Kernel& kernel, const Bindings& bindings, const T& pushConstants,
                std::uint32_t groupCount) {
    dispatch(kernel, bindings, std::as_bytes(std::span(&pushConstants, 1)), groupCount);
  }

  /// The same, with the three group counts the device finds at `offset` [bytes, a multiple of 4] of
  /// `groupCounts`: earlier work decides how much is done, and no host waits for it. Each at most
  /// maxGroupCount.
  void dispatchIndirect(const Kernel& kernel, const Bindings& bindings,
                        std::span<const std::byte> pushConstants, const Buffer& groupCounts,
                        std::uint64_t offset);
  template <PushConstants T>
  void dispatchIndirect(const Kernel& kernel, const Bindings& bindings, const T& pushConstants,
                        const Buffer& groupCounts, std::uint64_t offset) {
    dispatchIndirect(kernel, bindings, std::as_bytes(std::span(&pushConstants, 1)), groupCounts, offset);
  }

  /// No workgroup at all; but drivers that compile a kernel at its first dispatch do it here.
  void dispatchNothing(const Kernel& kernel, const Bindings& bindings);

  /// What was recorded before is finished and visible to what follows: kernels, their group counts, and
  /// copies, reads and writes.
  /// The validation layer notices a barrier left out only where one of the two kernels declares the
  /// buffer `readonly` (copies are always watched); so declare it wherever it is true.
  void barrier();

  void copyBuffer(const Buffer& from, const Buffer& to, std::uint64_t bytes, std::uint64_t fromOffset = 0,
                  std::uint64_t toOffset = 0);
  void fillZero(const Buffer& buffer);

  /// What follows is a submission of its own, which sees the finished work of what was recorded before. Not
  /// within a stage.
  void cut();

  /// Times what is recorded up to endStage; stages do not nest.
  void beginStage(const std::string& name);
  void endStage();

  /// Hands the recording to the device, part by part. What it writes can be read by the host after wait.
  Status submit();
  Status wait();
  Status submitAndWait();

  /// What was recorded since begin, in order, for tests: kernels by name, kBarrier, kCopy or kFill.
  static constexpr const char *kBarrier = "barrier", *kCopy = "copy", *kFill = "fill";
  const std::vector<std::string>& recorded() const;

  /// Of the last wait, in the order recorded [ms]: by the device's timestamps, else the submission's time on
  /// the host's clock in equal parts, less what went by before the wait for an earlier submission ended. A
  /// name recorded twice stands here twice.
  const std::vector<std::pair<std::string, double>>& stageMilliseconds() const;
  /// From submit to the end of wait, on the host's clock [ms].
  double submissionMilliseconds() const;

 private:
  struct State;
  Status beginPart();
  Status endPart();
  void bind(const Kernel& kernel, const Bindings& bindings, std::span<const std::byte> pushConstants);
  explicit Recorder(std::unique_ptr<State>);
  std::unique_ptr<State> self_;
};

}  // namespace ringlet::gpu
