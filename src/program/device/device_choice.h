// On which devices hair is stepped, and by which kernels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/kernel_choice.h"

namespace ringlet::program {

struct DeviceChoice {
  std::string device{};
  std::vector<std::string> devices{};     // in its place: on which the strands are divided
  std::optional<ComputeDevice> opened{};  // in its place: runs on one device share its compiled kernels
  KernelChoice kernel{};
  bool usesTuned = true;  // strand shapes by what `ringlet tune` measured
};

}  // namespace ringlet::program
