// What the crate's writer packs, its reader unpacks: bytes and integers of every length and size.
#include "ringlet/groom/usd/usdc_codec.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "ringlet/groom/lz4_block.h"

namespace ringlet::usdc_codec_test {
namespace {

TEST(UsdcCodec, BytesOfEveryLengthComeBack) {
  std::mt19937 random(1);
  for (const std::size_t count : {0, 1, 14, 15, 16, 269, 270, 271, 524, 525, 526, 70'000}) {
    std::vector<std::byte> bytes(count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() & 255);
    const auto packed = packUsdc(bytes);
    const auto found = unpackUsdc(packed, count);
    ASSERT_TRUE(found) << count;
    EXPECT_EQ(*found, bytes) << count;
    EXPECT_FALSE(count > 0 && unpackUsdc(packed, count - 1)) << "more than was asked for";
  }
}

TEST(UsdcCodec, IntegersOfEverySizeComeBack) {
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min(),
                         kMost = std::numeric_limits<std::int32_t>::max();
  std::vector<std::int32_t> values;
  EXPECT_EQ(unpackUsdcIntegers(packUsdcIntegers(values), 0), values);
  for (const std::int32_t value : {0, 0, 1, -1, 127, -128, 128, 40'000, kMost, kLeast, kLeast, kMost, -2}) {
    values.push_back(value);
    EXPECT_EQ(unpackUsdcIntegers(packUsdcIntegers(values), values.size()), values) << values.size();
  }
}

}  // namespace
}  // namespace ringlet::usdc_codec_test
