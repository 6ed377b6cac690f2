// For tests of `ringlet conform`: kernels with a known error, to show that it notices.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ringlet::program {

/// What --break takes.
std::vector<std::string> breakableKernels();

/// For gpu::DeviceOptions::changeCode: in kernels of this name one constant of the code becomes another.
std::function<void(const std::string&, std::vector<std::uint32_t>&)> breaking(const std::string& kernel);

}  // namespace ringlet::program
