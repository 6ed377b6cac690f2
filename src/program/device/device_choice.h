// The devices and kernels with which hair is stepped.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/kernel_choice.h"

namespace ringlet::program {

struct DeviceChoice {
  std::string device{};
  std::vector<std::string> devices{};     // in place of `device`: the strands are divided among these
  std::optional<ComputeDevice> opened{};  // in place of `device`: several runs share its compiled kernels
  KernelChoice kernel{};
  bool usesTuned = true;  // choose strand shapes by the measurements of `ringlet tune`
};

}  // namespace ringlet::program
