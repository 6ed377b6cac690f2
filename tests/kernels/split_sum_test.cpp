// The arithmetic of sums that 32 bits have no room for, on the device: as many terms as a sum may have before
// it is carried, which no volume of a test has. Mirrors shaders/maths/split_sum.glsl.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet_shaders/split_sum_probe_test.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::split_sum_test {
namespace {

using Four = std::array<std::int32_t, 4>;
struct Split {
  Four high{}, low{};
};
struct Carried {
  Four high{}, low{}, bits{};
};

// `count` terms of the same value in each component, as kernels add them up.
Split sumOf(std::uint32_t count, Four terms) {
  Split sum;
  for (std::size_t k = 0; k < 4; ++k) {
    sum.high[k] = static_cast<std::int32_t>(count) * (terms[k] >> 16);
    sum.low[k] = std::bit_cast<std::int32_t>(count * static_cast<std::uint32_t>(terms[k] & 0xffff));
  }
  return sum;
}

class SplitSum : public GpuTest {
 protected:
  std::vector<Carried> carried(const std::vector<Split>& sums) {
    auto in = createFilled(gpu(), sums, "pairs");
    auto out = createZero(gpu(), sums.size() * sizeof(Carried), "carried");
    auto kernel = gpu::Kernel::create(gpu(), {.name = "split_sum_probe",
                                              .spirv = k_split_sum_probe_test,
                                              .pushConstantBytes = 4,
                                              .constants = {{0, 64}}});
    EXPECT_TRUE(in && out && kernel);
    auto bindings = gpu::Bindings::create(**kernel, {{0, *in}, {1, *out}});
    auto recorder = gpu::Recorder::create(gpu(), "sums");
    EXPECT_TRUE(bindings && recorder && recorder->begin());
    recorder->dispatch(**kernel, *bindings, static_cast<std::uint32_t>(sums.size()),
                       static_cast<std::uint32_t>(sums.size() + 63) / 64);
    EXPECT_TRUE(recorder->submitAndWait());
    return *downloadAll<Carried>(*out, sums.size());
  }
};

TEST_F(SplitSum, HasRoomForAsManyTermsAsItSays) {
  constexpr Four kTerms{0x0000ffff, -1, 1 << 14, -0x12345678 / 65537};
  const std::uint32_t counts[] = {0, 1, 2, 32768, 32769, 40000, 65536, 65537};
  std::vector<Split> sums;
  for (const std::uint32_t count : counts) sums.push_back(sumOf(count, kTerms));
  const std::vector<Carried> found = carried(sums);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int64_t sum = std::int64_t{counts[i]} * kTerms[k], high = found[i].high[k],
                         low = found[i].low[k];
      EXPECT_EQ(65536 * high + low, sum) << counts[i] << " terms of " << kTerms[k];
      EXPECT_TRUE(low >= 0 && low < 65536) << low;
      EXPECT_EQ(std::bit_cast<float>(found[i].bits[k]), float(high) * 65536.0f + float(low));
    }
  }
}

}  // namespace
}  // namespace ringlet::test::split_sum_test
