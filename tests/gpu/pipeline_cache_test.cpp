// The file of a driver's compiled kernels: whole or nothing, and whatever is in it, a device opens.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "ringlet/base/whole_file.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/pipeline_cache_file.h"
#include "tests/support/gpu_test.h"

namespace ringlet::gpu::pipeline_cache_test {
namespace {

std::filesystem::path scratch(const char* name) {
  const auto folder = std::filesystem::temp_directory_path() / "ringlet_pipeline_cache_test" / name;
  std::filesystem::remove_all(folder);
  return folder;
}

const PipelineCacheOwner kOwner{1, 2, 9, {3, 4, 5}};

std::vector<std::byte> sample(std::size_t size) {
  std::vector<std::byte> bytes(size, std::byte{7});
  const std::uint32_t header[] = {32, 1, kOwner.vendor, kOwner.device};
  std::memcpy(bytes.data(), header, sizeof header);
  std::memcpy(&bytes[sizeof header], kOwner.uuid.data(), kOwner.uuid.size());
  return bytes;
}

TEST(PipelineCacheFile, ComesBackAsItWas) {
  const auto folder = scratch("back");
  const auto bytes = sample(1000);
  ASSERT_TRUE(writePipelineCache(folder / "made" / "a.bin", kOwner, bytes)) << "the folder is made";
  EXPECT_EQ(readPipelineCache(folder / "made" / "a.bin", kOwner), bytes);
  EXPECT_TRUE(writePipelineCache(folder / "made" / "a.bin", kOwner, sample(50)));
  EXPECT_EQ(readPipelineCache(folder / "made" / "a.bin", kOwner).size(), 50u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "made"), {}), 1)
      << "nothing beside it";
}

TEST(PipelineCacheFile, WhatIsBrokenIsNothing) {
  const auto folder = scratch("broken");
  EXPECT_TRUE(readPipelineCache(folder / "none.bin", kOwner).empty());
  std::filesystem::create_directories(folder / "a_folder.bin");
  EXPECT_TRUE(readPipelineCache(folder / "a_folder.bin", kOwner).empty());
  auto bytes = sample(40);
  bytes.resize(31);
  ASSERT_TRUE(writePipelineCache(folder / "short.bin", kOwner, bytes));
  EXPECT_TRUE(readPipelineCache(folder / "short.bin", kOwner).empty());
  bytes = sample(40);
  bytes[4] = std::byte{2};
  ASSERT_TRUE(writePipelineCache(folder / "version.bin", kOwner, bytes));
  EXPECT_TRUE(readPipelineCache(folder / "version.bin", kOwner).empty());
  ASSERT_TRUE(writePipelineCache(folder / "others.bin", kOwner, sample(40)));
  EXPECT_EQ(readPipelineCache(folder / "others.bin", kOwner).size(), 40u);
  EXPECT_TRUE(readPipelineCache(folder / "others.bin", {1, 2, 9, {3, 4, 6}}).empty());
  EXPECT_TRUE(readPipelineCache(folder / "others.bin", {1, 3, 9, {3, 4, 5}}).empty());
  EXPECT_TRUE(readPipelineCache(folder / "others.bin", {1, 2, 8, {3, 4, 5}}).empty())
      << "another driver version";
  EXPECT_FALSE(writePipelineCache(folder / "a_folder.bin", kOwner, sample(40)));
  EXPECT_FALSE(writePipelineCache("/proc/nowhere/a.bin", kOwner, sample(40)));
}

// Whatever happens to the file, the driver gets what it wrote or nothing.
TEST(PipelineCacheFile, NeitherCutNorChangedBytesAreHandedOver) {
  const auto file = scratch("torn") / "a.bin";
  auto bytes = sample(200);
  for (std::size_t i = 32; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * 7);
  ASSERT_TRUE(writePipelineCache(file, kOwner, bytes));
  const auto whole = readWholeFile(file);
  ASSERT_TRUE(whole) << whole.error().message;
  ASSERT_EQ(readPipelineCache(file, kOwner), bytes);

  for (std::size_t length = 0; length < whole->size(); ++length) {
    ASSERT_TRUE(writeWholeFile(file, std::span(*whole).first(length)));
    EXPECT_TRUE(readPipelineCache(file, kOwner).empty()) << "cut to " << length << " bytes";
  }
  for (std::size_t at = 0; at < whole->size(); ++at) {
    for (const std::byte flip : {std::byte{1}, std::byte{128}, std::byte{255}}) {
      auto changed = *whole;
      changed[at] ^= flip;
      ASSERT_TRUE(writeWholeFile(file, changed));
      EXPECT_TRUE(readPipelineCache(file, kOwner).empty()) << "byte " << at << " changed";
    }
  }
  auto longer = *whole;
  longer.push_back(std::byte{0});
  ASSERT_TRUE(writeWholeFile(file, longer));
  EXPECT_TRUE(readPipelineCache(file, kOwner).empty()) << "a byte too many";
  ASSERT_TRUE(writeWholeFile(file, bytes));
  EXPECT_TRUE(readPipelineCache(file, kOwner).empty()) << "the driver's bytes alone";
}

class PipelineCache : public test::GpuTest {};

// Of the right shape, but no driver's.
TEST_F(PipelineCache, DevicesOpenWhateverTheFolderHolds) {
  const auto folder = scratch("device");
  auto first = Device::open("", {}, folder);
  ASSERT_TRUE(first) << first.error().message;
  const auto file = (*first)->pipelineCacheFile();
  EXPECT_EQ(file.parent_path(), folder);
  first->reset();
  ASSERT_TRUE(writePipelineCache(file, kOwner, sample(4096)));
  auto second = Device::open("", {}, folder);
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_TRUE((*second)->validationMessages().empty());
}

}  // namespace
}  // namespace ringlet::gpu::pipeline_cache_test
