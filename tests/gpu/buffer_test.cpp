// Buffers: what goes in comes out, mapped and staged, and what does not fit is refused with numbers.
#include "tests/support/gpu_test.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "ringlet/gpu/buffer.h"

namespace ringlet::test::buffer_test {
namespace {

using gpu::Buffer;
using gpu::BufferKind;
using gpu::BufferUse;

// Bytes without a short period, different for every seed.
std::vector<std::byte> someBytes(std::size_t count, unsigned seed) {
  std::vector<std::byte> bytes(count);
  for (std::size_t i = 0; i < count; ++i)
    bytes[i] = static_cast<std::byte>((i * 7 + i / 251 + seed * 31) & 255);
  return bytes;
}

// Uploads a whole, then a part at an odd place; reads the whole and the part.
void expectRoundTrips(gpu::Device& device, BufferKind kind, std::size_t size) {
  SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)) + ", bytes " + std::to_string(size));
  auto buffer = Buffer::create(device, size, kind, "round trip");
  ASSERT_TRUE(buffer) << buffer.error().message;
  EXPECT_EQ(buffer->bytes(), size);

  std::vector<std::byte> expected = someBytes(size, 1);
  Status up = buffer->upload(expected);
  ASSERT_TRUE(up) << up.error().message;
  const std::size_t offset = size / 3;
  const std::vector<std::byte> part = someBytes(size / 2, 2);
  up = buffer->upload(part, offset);
  ASSERT_TRUE(up) << up.error().message;
  std::copy(part.begin(), part.end(), expected.begin() + static_cast<std::ptrdiff_t>(offset));

  std::vector<std::byte> found(size);
  Status down = buffer->download(found);
  ASSERT_TRUE(down) << down.error().message;
  EXPECT_TRUE(found == expected);
  std::vector<std::byte> foundPart(part.size());
  down = buffer->download(foundPart, offset);
  ASSERT_TRUE(down) << down.error().message;
  EXPECT_TRUE(foundPart == part);

  const Status zeroed = buffer->fillZero();
  ASSERT_TRUE(zeroed) << zeroed.error().message;
  down = buffer->download(found);
  ASSERT_TRUE(down) << down.error().message;
  EXPECT_TRUE(found == std::vector<std::byte>(size));
}

constexpr std::size_t kSizes[] = {0, 1, 2, 3, 4, 15, 16, 17, 1001, 65537};

using Buffers = GpuTest;

TEST_F(Buffers, RoundTrip) {
  for (std::size_t size : kSizes) {
    expectRoundTrips(gpu(), BufferKind::storage, size);
    expectRoundTrips(gpu(), BufferKind::stream, size);
  }
}

// The way a graphics card goes, on every device.
TEST_F(Buffers, RoundTripThroughStaging) {
  auto opened = gpu::Device::open("", {.alwaysStage = true});
  ASSERT_TRUE(opened) << opened.error().message;
  for (std::size_t size : kSizes) expectRoundTrips(**opened, BufferKind::storage, size);
  expectRoundTrips(**opened, BufferKind::storage, (80u << 20) + 5);  // more than one piece of staging
  auto buffer = Buffer::create(**opened, 64, BufferKind::storage, "unmapped");
  ASSERT_TRUE(buffer) << buffer.error().message;
  EXPECT_TRUE(buffer->mapped().empty());
  expectNoMessages(*(*opened)->validationLog());
}

// Parts are where they were asked for, on both ways, and outlive what they are parts of.
TEST_F(Buffers, APartIsTheSameMemory) {
  auto staging = gpu::Device::open("", {.alwaysStage = true});
  ASSERT_TRUE(staging) << staging.error().message;
  for (gpu::Device* device : {&gpu(), staging->get()}) {
    auto whole = Buffer::create(*device, 4096, BufferKind::storage, "whole");
    ASSERT_TRUE(whole) << whole.error().message;
    std::vector<std::byte> expected = someBytes(4096, 1);
    ASSERT_TRUE(whole->upload(expected));
    const std::uint64_t offset = 2 * whole->alignment();
    ASSERT_LE(offset + 100, 4096u);
    auto part = Buffer::part(*whole, offset, 100, "part");
    ASSERT_TRUE(part) << part.error().message;
    EXPECT_EQ(part->bytes(), 100u);
    std::vector<std::byte> found(100);
    ASSERT_TRUE(part->download(found));
    const auto at = expected.begin() + static_cast<std::ptrdiff_t>(offset);
    EXPECT_TRUE(std::equal(found.begin(), found.end(), at));

    const std::vector<std::byte> other = someBytes(100, 2);
    ASSERT_TRUE(part->upload(other));
    std::copy(other.begin(), other.end(), at);
    std::vector<std::byte> all(4096);
    ASSERT_TRUE(whole->download(all));
    EXPECT_TRUE(all == expected);
    { const Buffer gone = std::move(*whole); }
    ASSERT_TRUE(part->download(found));
    EXPECT_TRUE(found == other);
  }
  expectNoMessages(*(*staging)->validationLog());
}

TEST_F(Buffers, StreamIsMapped) {
  auto buffer = Buffer::create(gpu(), 33, BufferKind::stream, "stream");
  ASSERT_TRUE(buffer) << buffer.error().message;
  ASSERT_EQ(buffer->mapped().size(), 33u);
  buffer->mapped()[32] = std::byte{42};
  std::vector<std::byte> last(1);
  ASSERT_TRUE(buffer->download(last, 32));
  EXPECT_EQ(last[0], std::byte{42});
}

TEST_F(Buffers, MoveLeavesOneOwner) {
  auto first = Buffer::create(gpu(), 16, BufferKind::storage, "first");
  auto second = Buffer::create(gpu(), 32, BufferKind::storage, "second");
  ASSERT_TRUE(first && second);
  const std::vector<std::byte> expected = someBytes(32, 3);
  ASSERT_TRUE(second->upload(expected));
  *first = std::move(*second);
  EXPECT_EQ(first->name(), "second");
  std::vector<std::byte> found(32);
  ASSERT_TRUE(first->download(found));
  EXPECT_TRUE(found == expected);
}

// What kernels see in parts only may be larger than what they may see at once.
TEST_F(Buffers, MayBeLargerInParts) {
  const std::uint64_t bytes = gpu().properties().maxStorageBufferRange + 16;
  if (bytes > std::min<std::uint64_t>(gpu().properties().maxAllocationBytes, 1u << 30))
    GTEST_SKIP() << "kernels see all that this device allocates, or a test should not ask for it";
  EXPECT_FALSE(Buffer::create(gpu(), bytes, BufferKind::stream, "seen as a whole"));
  const auto large = Buffer::create(gpu(), bytes, BufferKind::stream, "seen in parts", BufferUse::inParts);
  ASSERT_TRUE(large) << large.error().message;
  EXPECT_EQ(large->mapped().size(), bytes);
}

TEST_F(Buffers, TooLargeIsRefusedWithBothNumbers) {
  const auto& limits = gpu().properties();
  const std::uint64_t limit = std::min(limits.maxStorageBufferRange, limits.maxAllocationBytes);
  for (std::uint64_t bytes : {limit + 1, ~std::uint64_t{0}}) {
    auto buffer = Buffer::create(gpu(), bytes, BufferKind::storage, "giant");
    ASSERT_FALSE(buffer);
    expectParts(buffer.error().message, {"'giant'", std::to_string(bytes), std::to_string(limit)});
  }
}

// What is taken is counted for as long as it is kept, so that what is left can be told beforehand.
TEST_F(Buffers, WhatIsLeftOfTheMemoryIsKnown) {
  constexpr std::uint64_t kBytes = 8 << 20;
  const auto opened = gpu::Device::open("", {.withoutMemoryBudget = true});
  ASSERT_TRUE(opened) << opened.error().message;
  gpu::Device& device = **opened;
  const std::uint64_t before = gpu::availableStorageBytes(device);
  {
    const auto buffer = Buffer::create(device, kBytes, BufferKind::storage, "counted");
    ASSERT_TRUE(buffer) << buffer.error().message;
    EXPECT_LE(gpu::availableStorageBytes(device), before - kBytes);
  }
  EXPECT_EQ(gpu::availableStorageBytes(device), before);
  const auto stream = Buffer::create(device, kBytes, BufferKind::stream, "counted");
  ASSERT_TRUE(stream) << stream.error().message;
  EXPECT_EQ(gpu::availableStorageBytes(device) <= before - kBytes, gpu::isOneMemory(device));
}

TEST_F(Buffers, PastTheEndIsTheCallersFault) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // the driver has threads
  auto buffer = Buffer::create(gpu(), 16, BufferKind::storage, "small");
  ASSERT_TRUE(buffer) << buffer.error().message;
  std::vector<std::byte> bytes(16);
  EXPECT_DEATH((void)buffer->upload(bytes, 1), "past the buffer's end");
  EXPECT_DEATH((void)buffer->download(bytes, ~std::uint64_t{0}), "past the buffer's end");
}

}  // namespace
}  // namespace ringlet::test::buffer_test
