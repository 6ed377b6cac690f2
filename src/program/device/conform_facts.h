// Facts about the program, the machine and the device that `ringlet conform` prints before its checks.
#pragma once

#include <nlohmann/json.hpp>

#include "ringlet/solver/compute_device.h"

namespace ringlet::program {

/// One object: ringlet, commit, kernels, os, device and so on, in the order in which they are printed.
nlohmann::ordered_json factsOf(const ComputeDevice& device);

/// One line per fact.
std::string factsText(const nlohmann::ordered_json& facts);

}  // namespace ringlet::program
