// Which device is opened, what is said when there is none, and what is known of it.
#include "tests/support/gpu_test.h"

#include <cctype>
#include <cstdlib>
#include <optional>
#include <string>

#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device_lack.h"

namespace ringlet::test::device_test {
namespace {

// Sets an environment variable, or unsets it, until the end of a scope.
class ScopedVariable {
 public:
  ScopedVariable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    value ? setenv(name, value, 1) : unsetenv(name);
  }
  ~ScopedVariable() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }
  ScopedVariable(const ScopedVariable&) = delete;
  ScopedVariable& operator=(const ScopedVariable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

using Devices = GpuTest;

TEST_F(Devices, ListedAsTheyOpen) {
  const auto devices = ComputeDevice::list();
  ASSERT_FALSE(devices.empty());
  for (std::size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, static_cast<int>(i));
    EXPECT_FALSE(devices[i].name.empty());
    EXPECT_FALSE(devices[i].driver.empty());
    EXPECT_EQ(devices[i].usable, devices[i].why.empty()) << devices[i].why;
    if (!devices[i].usable) continue;
    auto opened = ComputeDevice::open(std::to_string(i));
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(opened->name(), devices[i].name);
    EXPECT_EQ(opened->driver(), devices[i].driver);
    EXPECT_TRUE(opened->validationMessages().empty());
  }
}

TEST_F(Devices, OpenByPartOfTheNameInAnyCase) {
  std::string part = device().name().substr(1, 6);
  for (char& c : part) c = static_cast<char>(std::islower(c) ? std::toupper(c) : std::tolower(c));
  auto opened = ComputeDevice::open(part);
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened->name(), device().name());
}

TEST_F(Devices, WrongNameSaysWhatThereIs) {
  auto opened = ComputeDevice::open("Voodoo 2");
  ASSERT_FALSE(opened);
  expectParts(opened.error().message, {"'Voodoo 2'", device().name(), "Choose"});
}

TEST_F(Devices, IndexOutOfRangeSaysTheRange) {
  const std::string last = std::to_string(ComputeDevice::list().size() - 1);
  auto opened = ComputeDevice::open("987");
  ASSERT_FALSE(opened);
  expectParts(opened.error().message, {"'987'", "(0 to " + last + ")"});
  EXPECT_FALSE(ComputeDevice::open("-1"));
}

TEST_F(Devices, EnvironmentChoosesWhereNothingElseDoes) {
  {
    const ScopedVariable variable("RINGLET_DEVICE", "Voodoo 2");
    auto opened = ComputeDevice::open();
    ASSERT_FALSE(opened);
    expectParts(opened.error().message, {"'Voodoo 2' (from $RINGLET_DEVICE)"});
    EXPECT_TRUE(ComputeDevice::open(device().name())) << "an explicit choice comes first";
  }
  {
    const ScopedVariable variable("RINGLET_DEVICE", device().name().c_str());
    auto opened = ComputeDevice::open();
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(opened->name(), device().name());
  }
  const ScopedVariable variable("RINGLET_DEVICE", "");
  EXPECT_TRUE(ComputeDevice::open()) << "an empty variable is none";
}

TEST_F(Devices, PropertiesMeetTheNeeds) {
  const gpu::DeviceProperties& p = gpu().properties();
  EXPECT_GE(p.apiVersion, gpu::kNeededApiVersion);
  EXPECT_GE(p.maxStorageBuffers, gpu::kNeededStorageBuffers);
  EXPECT_GE(p.maxGroupInvocations, gpu::kNeededGroupInvocations);
  EXPECT_GE(p.maxPushConstantBytes, gpu::kNeededPushConstantBytes);
  // What Vulkan promises of every device.
  EXPECT_GE(p.maxStorageBufferRange, 1u << 27);
  EXPECT_GE(p.maxUniformBufferRange, 1u << 14);
  EXPECT_GE(p.maxAllocationBytes, 1u << 30);
  EXPECT_GE(p.maxSharedMemoryBytes, 1u << 14);
  EXPECT_GE(p.maxGroupCount, 65535u);
  EXPECT_EQ(p.subgroupSize & (p.subgroupSize - 1), 0u);
  EXPECT_GE(p.subgroupSize, 1u);
  EXPECT_LE(p.subgroupSize, 128u);
}

// Null hardware, which only compiles, has 0 bytes.
TEST(DeviceLack, SaysWhatIsMissing) {
  gpu::DeviceProperties enough;
  enough.memoryBytes = 1;
  enough.maxStorageBuffers = gpu::kNeededStorageBuffers;
  enough.maxGroupInvocations = gpu::kNeededGroupInvocations;
  enough.maxPushConstantBytes = gpu::kNeededPushConstantBytes;
  EXPECT_EQ(gpu::findLack(enough, {}), "");

  gpu::DeviceProperties null = enough;
  null.memoryBytes = 0;
  EXPECT_EQ(gpu::findLack(null, {}), "it has no memory");
  EXPECT_EQ(gpu::findLack(null, {.allowNull = true}), "");
  null.maxStorageBuffers = 3;
  expectParts(gpu::findLack(null, {}), {"it has no memory; maxPerStageDescriptorStorageBuffers is 3",
                                        std::to_string(gpu::kNeededStorageBuffers)});
}

// The messages of machines without the parts, by hiding the parts from the loader.
TEST_F(Devices, NoDriverSaysWhatToInstall) {
  const ScopedVariable drivers("VK_DRIVER_FILES", "/nonexistent/driver.json");
  const ScopedVariable driversOfOldLoaders("VK_ICD_FILENAMES", "/nonexistent/driver.json");
  auto opened = ComputeDevice::open();
  ASSERT_FALSE(opened);
  expectParts(opened.error().message, {"mesa-vulkan-drivers"});
  EXPECT_TRUE(ComputeDevice::list().empty());
}

TEST_F(Devices, NoValidationLayerSaysWhatToInstall) {
  const ScopedVariable layers("VK_LAYER_PATH", "/nonexistent");
  auto opened = ComputeDevice::open();
  ASSERT_FALSE(opened);
  expectParts(opened.error().message, {"vulkan-validationlayers", "RINGLET_VALIDATION"});
  const ScopedVariable validation("RINGLET_VALIDATION", nullptr);
  EXPECT_TRUE(ComputeDevice::open()) << "without validation the layer is not needed";
}

TEST_F(Devices, StaysOpenForWhatUsesIt) {
  auto opened = gpu::Device::open();
  ASSERT_TRUE(opened) << opened.error().message;
  const auto log = (*opened)->validationLog();
  ASSERT_TRUE(log);
  {
    auto buffer = gpu::Buffer::create(**opened, 100, gpu::BufferKind::storage, "survivor");
    ASSERT_TRUE(buffer) << buffer.error().message;
    const std::weak_ptr<gpu::Device> watched = *opened;
    opened->reset();
    EXPECT_FALSE(watched.expired());
    EXPECT_TRUE(buffer->fillZero());
  }
  expectNoMessages(*log);
}

}  // namespace
}  // namespace ringlet::test::device_test
