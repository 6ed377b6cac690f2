// GpuTest: the fixture of every test that needs a device. The validation layer is on, with its
// synchronisation validation, and a message of it fails the test. Without a device the test is skipped,
// loudly; under RINGLET_REQUIRE_GPU=1 it fails.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "ringlet/gpu/device.h"
#include "ringlet/groom/groom.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/kernel_choice.h"

namespace ringlet::test {

class GpuTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// Opened by the first test of the process that asks, closed after the last; its end is watched for leaks.
  ComputeDevice& device();
  gpu::Device& gpu() { return device().gpu(); }
  /// Whether the device makes this form of the strand kernel for the groom's strands: a processor makes all,
  /// a GPU none of long runs. A test says what it leaves out for that, and goes on.
  bool makes(const KernelChoice& kernel, const Groom& groom);

 private:
  std::size_t messagesBefore_ = 0;
};

/// Fails unless every part stands in the text.
void expectParts(const std::string& text, const std::vector<std::string>& parts);

/// For a device a test opens for itself: fails, quoting them, if the validation layer had anything to say.
void expectNoMessages(const gpu::ValidationLog& log, std::size_t from = 0);

}  // namespace ringlet::test
