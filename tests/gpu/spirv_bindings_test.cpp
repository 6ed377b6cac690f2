// Which buffers a shader binds, read from its SPIR-V. No device needed.
#include "ringlet/gpu/spirv_bindings.h"

#include <gtest/gtest.h>

#include <ostream>
#include <vector>

#include "ringlet_shaders/many_bindings_test.h"
#include "ringlet_shaders/scale_values_test.h"

namespace ringlet::gpu {

void PrintTo(const KernelBinding& binding, std::ostream* out) {
  *out << binding.number << " (kind " << static_cast<int>(binding.kind) << ")";
}

}  // namespace ringlet::gpu

namespace ringlet::test {
namespace {

using gpu::KernelBinding;
using enum gpu::BindingKind;

TEST(SpirvBindings, NumberAndKind) {
  const std::vector<KernelBinding> expected{{0, storage}, {1, storage}, {2, uniform}};
  EXPECT_EQ(gpu::bindingsOf(k_scale_values_test), expected);
}

// Reached directly, through functions, as an argument, by length or atomic, or behind a constant; not what is
// declared only (11, 12), or used by a function that is not called (13).
TEST(SpirvBindings, OnlyWhatTheEntryPointReaches) {
  const std::vector<KernelBinding> expected{{1, storage}, {3, uniform}, {4, texels},   {5, texels},
                                            {7, storage}, {9, storage}, {10, storage}, {20, storage}};
  EXPECT_EQ(gpu::bindingsOf(k_many_bindings_test), expected);
}

}  // namespace
}  // namespace ringlet::test
