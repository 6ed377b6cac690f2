// Where buckets start (scan/bucket_starts.glsl), in both kernels that have it, against a prefix sum: with as
// many blocks as one workgroup sums with one invocation each, with fewer and with more. The last workgroup
// must see what all others wrote, and leave nothing behind: each runs twice.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "layout/contacts.h"
#include "layout/volume.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/solver/contacts/contact_kernels.h"
#include "ringlet/solver/contacts/volume_kernels.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::bucket_starts_test {
namespace {

using Words = std::vector<std::uint32_t>;

// A kernel, and where its numbers stand in a buffer for so many buckets.
struct Scan {
  const char* name;
  gpu::KernelDescription kernel;
  std::uint32_t bindNumbers, bindControl, bindUniform;
  std::size_t controlBytes, finishedAt;
  bool endsWithAll;  // one more start and sum, of what lies beyond the last bucket
};

class BucketStarts : public GpuTest {
 protected:
  // The buffer after the kernel ran on these counts.
  template <class Parameters, class Uniform>
  Words after(const Scan& scan, const Words& before, std::uint32_t blocks, const Uniform& uniform,
              gpu::Buffer& control) {
    auto kernel = gpu::Kernel::create(gpu(), scan.kernel);
    auto numbers = createFilled(gpu(), before, "numbers");
    auto unused = createZero(gpu(), 4096, "unused");
    auto uniforms = createFilled(gpu(), std::vector{uniform}, "uniform");
    EXPECT_TRUE(kernel && numbers && unused && uniforms);
    gpu::BufferTable buffers{
        {scan.bindNumbers, *numbers}, {scan.bindControl, control}, {scan.bindUniform, *uniforms}};
    for (const auto& [number, kind] : (*kernel)->bindings()) buffers.emplace(number, *unused);
    auto bindings = gpu::Bindings::create(**kernel, buffers);
    auto recorder = gpu::Recorder::create(gpu(), "starts");
    EXPECT_TRUE(bindings && recorder && recorder->begin());
    recorder->dispatch(**kernel, *bindings, Parameters{}, blocks);
    EXPECT_TRUE(recorder->submitAndWait());
    return *downloadAll<std::uint32_t>(*numbers, before.size());
  }

  template <class Parameters, class Uniform>
  void expectPrefixSums(const Scan& scan, std::uint32_t blocks, const Uniform& uniform) {
    const std::uint32_t buckets = blocks * layout::kBucketBlock, more = scan.endsWithAll ? 1 : 0;
    const std::size_t sumsAt = 2 * std::size_t{buckets} + more;
    auto control = createZero(gpu(), scan.controlBytes, "control");
    ASSERT_TRUE(control);
    std::mt19937 random(blocks);
    for (int round = 0; round < 2; ++round) {
      Words numbers(sumsAt + blocks + more, 77);  // as they were left by another time
      for (std::uint32_t b = 0; b < buckets; ++b) numbers[b] = static_cast<std::uint32_t>(random() % 5);
      Words starts(buckets + 1);
      std::partial_sum(numbers.begin(), numbers.begin() + buckets, starts.begin() + 1);
      const Words found = after<Parameters>(scan, numbers, blocks, uniform, *control);
      std::size_t wrong = 0, left = 0;
      for (std::uint32_t b = 0; b < buckets + more; ++b) {
        const std::uint32_t start = found[buckets + b] + found[sumsAt + b / layout::kBucketBlock];
        wrong += start != starts[b];
        left += b < buckets && found[b] != 0;
      }
      const std::string label = fmt::format("{}, {} blocks, round {}", scan.name, blocks, round);
      EXPECT_EQ(wrong, 0u) << label << ": starts";
      EXPECT_EQ(left, 0u) << label << ": counts that are not 0 afterwards";
      EXPECT_EQ((*downloadAll<std::uint32_t>(*control, scan.controlBytes / 4))[scan.finishedAt / 4], 0u)
          << label;
    }
  }
};

TEST_F(BucketStarts, ArePrefixSums) {
  const Scan contacts{"contact_scan",
                      describeContactKernel(ContactKernel::scan, {}),
                      layout::kBindGrid,
                      layout::kBindControl,
                      layout::kBindContactNumbers,
                      sizeof(layout::ContactControl),
                      offsetof(layout::ContactControl, finished),
                      true};
  const Scan volume{"volume_scan",
                    describeVolumeKernel(VolumeKernel::scan, false, false),
                    layout::kBindVolumeCells,
                    layout::kBindVolumeControl,
                    layout::kBindVolumeNumbers,
                    sizeof(layout::VolumeControl),
                    offsetof(layout::VolumeControl, finished),
                    false};
  for (const std::uint32_t blocks : {1u, 2u, 63u, 64u, 65u, 500u}) {
    layout::ContactNumbers ofContacts{};
    ofContacts.bucketCount = blocks * layout::kBucketBlock;
    expectPrefixSums<layout::ContactParameters>(contacts, blocks, ofContacts);
    layout::VolumeNumbers ofVolume{};
    ofVolume.cellCapacity = blocks * layout::kBucketBlock;
    expectPrefixSums<layout::VolumeParameters>(volume, blocks, ofVolume);
  }
}

}  // namespace
}  // namespace ringlet::test::bucket_starts_test
