// Tests base/half.h against Eigen's halves.
#include "ringlet/base/half.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>

namespace ringlet::test::half_test {
namespace {

std::uint16_t eigenBits(float value) { return Eigen::half(value).x; }

TEST(Half, IsEigensEverywhere) {
  std::mt19937 random(1);
  for (int k = 0; k < 1'000'000; ++k) {
    const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::isnan(value)) continue;
    ASSERT_EQ(halfBits(value), eigenBits(value)) << value;
  }
  // Every half, the middle between it and the next, and a little to either side.
  for (std::uint32_t bits = 0; bits < 0x7c00; ++bits) {
    const float low = static_cast<float>(
        Eigen::half(Eigen::half_impl::raw_uint16_to_half(static_cast<std::uint16_t>(bits))));
    const float high = bits + 1 < 0x7c00
                           ? static_cast<float>(Eigen::half(
                                 Eigen::half_impl::raw_uint16_to_half(static_cast<std::uint16_t>(bits + 1))))
                           : 65536.0f;
    const float middle = (low + high) / 2;
    for (const float value : {low, middle, std::nextafter(middle, 0.0f), std::nextafter(middle, 1e9f)}) {
      ASSERT_EQ(halfBits(value), eigenBits(value)) << value;
      ASSERT_EQ(halfBits(-value), eigenBits(-value)) << value;
    }
  }
  EXPECT_EQ(halfBits(std::numeric_limits<float>::infinity()), 0x7c00);
  EXPECT_EQ(halfBits(std::numeric_limits<float>::quiet_NaN()) & 0x7c00, 0x7c00);
}

}  // namespace
}  // namespace ringlet::test::half_test
