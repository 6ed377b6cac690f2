// For tests of `ringlet conform`: puts a known error into a kernel, to show that it is found.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ringlet::program {

/// The values of --break.
std::vector<std::string> breakableKernels();

/// For gpu::DeviceOptions::changeCode: replaces a constant in the code of kernels with this name.
std::function<void(const std::string&, std::vector<std::uint32_t>&)> breaking(const std::string& kernel);

}  // namespace ringlet::program
