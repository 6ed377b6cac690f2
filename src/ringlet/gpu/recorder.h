// Recorder: a list of commands for the device (command_list.h), recorded once and submitted as often as
// wanted, with timed stages; in one submission or in several (cut).
//
//   begin -> commands -> submit -> wait
//     ^                    ^         |
//     +-------- or --------+---------+
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/device.h"

namespace ringlet::gpu {

/// Commands are added between begin and submit; all they use must live until the last wait.
class Recorder : public CommandList {
 public:
  /// `name` is for messages.
  static Result<Recorder> create(Device& device, const std::string& name);
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;
  ~Recorder();  // waits for submissions in progress

  /// Clears the recording. The new commands see the finished work of earlier submissions.
  Status begin();

  /// Hands the recording to the device, part by part. What it writes can be read by the host after wait.
  Status submit();
  Status wait();
  Status submitAndWait();

  /// Of the last wait, in the order recorded [ms]: by the device's timestamps, else the submission's time on
  /// the host's clock in equal parts, less what went by before the wait for an earlier submission ended. A
  /// name recorded twice stands here twice.
  const std::vector<std::pair<std::string, double>>& stageMilliseconds() const;
  /// When each of these began, on the device's clock, else from the submission on [ms].
  const std::vector<double>& stageStarts() const;
  /// From submit to the end of wait, on the host's clock [ms].
  double submissionMilliseconds() const;
  /// On the host's clock, what the last submit took, and how long the last wait stood at its fence [ms].
  double submitMilliseconds() const;
  double fenceMilliseconds() const;

 private:
  struct State;
  Status beginPart();
  Status endPart();
  Status write();
  explicit Recorder(std::unique_ptr<State>);
  std::unique_ptr<State> self_;
};

}  // namespace ringlet::gpu
