// Compiles one variant of the strand kernel and ends; nothing runs. For drivers that print what they compile
// (RADV_DEBUG=asm), on null hardware too. Used by scripts/count_instructions.sh.
#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/solver/strands/strand_kernels.h"

int main(int argc, char** argv) {
  using namespace ringlet;
  if (argc < 4 || argc > 5) {
    fmt::print(stderr, "usage: {} LANES RUN alone|contacts|air|bodies [SUBGROUP]\n", argv[0]);
    return 2;
  }
  const auto number = [&](int i) { return static_cast<std::uint32_t>(std::atoi(argv[i])); };
  const StrandShape shape{number(1), number(2)};
  const std::string_view work = argv[3];
  StrandKernelOptions options;
  options.oneSmoothing = true;
  options.contacts = work == "contacts";
  options.air = work == "air";
  options.bodies = work == "bodies";
  const auto device = gpu::Device::open("", {.allowNull = true});
  if (!device) {
    fmt::print(stderr, "no device: {}\n", device.error().message);
    return 1;
  }
  gpu::KernelDescription description = describeStrandKernel(shape, options);
  if (argc == 5) description.subgroupSize = number(4);
  const auto kernel = gpu::Kernel::create(**device, description);
  if (!kernel) fmt::print(stderr, "{}: {}\n", shape.describe(), kernel.error().message);
  return kernel ? 0 : 1;
}
