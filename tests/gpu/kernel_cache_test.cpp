// A device compiles each kernel once, whoever asks and from whichever thread, and closes all the same.
#include "ringlet/gpu/kernel_cache.h"

#include <thread>
#include <vector>

#include "ringlet/gpu/kernel.h"
#include "ringlet_shaders/scale_values_test.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::kernel_cache_test {
namespace {

using gpu::Kernel;

gpu::KernelDescription describeKernel(std::uint32_t offset) {
  return {.name = "scale_values",
          .spirv = k_scale_values_test,
          .pushConstantBytes = 8,
          .constants = {{0, 64}, {1, offset}},
          .groupSize = 64};
}

class KernelCache : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    auto opened = gpu::Device::open();
    ASSERT_TRUE(opened) << opened.error().message;
    own_ = *opened;
  }
  // The kernels are gone with the device, and no message tells of a leak.
  void TearDown() override {
    if (own_) {
      const auto log = own_->validationLog();
      const std::weak_ptr<gpu::Device> closed = own_;
      own_.reset();
      EXPECT_TRUE(closed.expired()) << "the kernels kept hold the device open";
      expectNoMessages(*log);
    }
    GpuTest::TearDown();
  }
  std::shared_ptr<const Kernel> make(const gpu::KernelDescription& description) {
    auto kernel = Kernel::create(*own_, description);
    EXPECT_TRUE(kernel) << kernel.error().message;
    return kernel ? *kernel : nullptr;
  }
  std::size_t compiledCount() const { return own_->kernels().compiledCount(); }

  std::shared_ptr<gpu::Device> own_;
};

TEST_F(KernelCache, TheSameKernelIsCompiledOnce) {
  EXPECT_FALSE(Kernel::isCompiled(*own_, describeKernel(1)));
  const auto first = make(describeKernel(1));
  EXPECT_TRUE(Kernel::isCompiled(*own_, describeKernel(1)));
  auto renamed = describeKernel(1);
  renamed.name = "another name";
  EXPECT_EQ(make(renamed), first);
  EXPECT_EQ(compiledCount(), 1u);
}

// Whatever decides what the driver makes of it.
TEST_F(KernelCache, AnyDifferenceMakesAnotherKernel) {
  std::vector<gpu::KernelDescription> descriptions(6, describeKernel(1));
  descriptions[1].constants[1].value = 2;
  descriptions[2].groupSize = 32;
  descriptions[3].pushConstantBytes = 12;
  descriptions[4].wantsFullSubgroups = true;
  std::vector<std::uint32_t> code(std::begin(k_scale_values_test), std::end(k_scale_values_test));
  code[2] += 1;  // the generator's mark, which means nothing
  descriptions[5].spirv = code;
  for (std::size_t d = 0; d < descriptions.size(); ++d) {
    SCOPED_TRACE(d);
    EXPECT_FALSE(Kernel::isCompiled(*own_, descriptions[d]));
    make(descriptions[d]);
    EXPECT_EQ(compiledCount(), d + 1);
  }
}

TEST_F(KernelCache, ThreadsThatAskAtOnceShareOneCompilation) {
  constexpr std::size_t kThreads = 8;
  for (std::uint32_t round = 0; round < 20; ++round) {
    std::vector<std::shared_ptr<const Kernel>> found(kThreads);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < kThreads; ++t)
      threads.emplace_back([&, t] { found[t] = make(describeKernel(round)); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(compiledCount(), round + 1);
    for (const auto& kernel : found) EXPECT_EQ(kernel, found[0]);
  }
}

TEST_F(KernelCache, AFailureIsTriedAgain) {
  auto tooLarge = describeKernel(1);
  tooLarge.groupSize = own_->properties().maxGroupInvocations + 1;
  EXPECT_FALSE(Kernel::create(*own_, tooLarge));
  EXPECT_FALSE(Kernel::isCompiled(*own_, tooLarge));
  const auto again = Kernel::create(*own_, tooLarge);
  ASSERT_FALSE(again);
  EXPECT_FALSE(again.error().message.empty());
  make(describeKernel(1));
}

// The other way about: a kernel somebody keeps holds the device open.
TEST_F(KernelCache, AKernelHoldsItsDeviceOpen) {
  auto kernel = make(describeKernel(1));
  const std::weak_ptr<gpu::Device> device = own_;
  own_.reset();
  EXPECT_FALSE(device.expired());
  kernel.reset();
  EXPECT_TRUE(device.expired());
}

}  // namespace
}  // namespace ringlet::test::kernel_cache_test
