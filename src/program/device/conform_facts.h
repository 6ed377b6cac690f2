// What `ringlet conform` says of the program, the machine and the device before it checks anything.
#pragma once

#include <nlohmann/json.hpp>

#include "ringlet/solver/compute_device.h"

namespace ringlet::program {

/// One object: ringlet, commit, kernels, os, device and so on, in the order they are printed in.
nlohmann::ordered_json factsOf(const ComputeDevice& device);

/// A line a fact.
std::string factsText(const nlohmann::ordered_json& facts);

}  // namespace ringlet::program
