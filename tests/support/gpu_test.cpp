// Implements support/gpu_test.h.
#include "tests/support/gpu_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

#include "ringlet/solver/plan/shape_plan.h"

namespace ringlet::test {
namespace {

// The process's device, or why there is none.
std::optional<ComputeDevice> sharedDevice;
std::optional<Error> openingError;
std::shared_ptr<gpu::ValidationLog> sharedLog;

void openSharedDevice() {
  if (sharedDevice || openingError) return;
  setenv("RINGLET_VALIDATION", "1", 1);
  auto opened = ComputeDevice::open();
  if (!opened) {
    openingError = opened.error();
    return;
  }
  sharedDevice = *opened;
  sharedLog = sharedDevice->gpu().validationLog();
}

// Closes the device after all tests: then the layer names what was leaked.
class CloseDevice : public ::testing::Environment {
 public:
  void TearDown() override {
    if (!sharedDevice) return;
    const std::size_t before = sharedLog->messages().size();
    const std::weak_ptr<gpu::Device> closed = sharedDevice->gpu().weak_from_this();
    sharedDevice.reset();
    EXPECT_TRUE(closed.expired())
        << "a buffer, kernel or recorder outlived the tests and holds the device open";
    expectNoMessages(*sharedLog, before);
  }
};
[[maybe_unused]] const auto* const kCloseDevice = ::testing::AddGlobalTestEnvironment(new CloseDevice);

}  // namespace

void expectParts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
  }
}

void expectNoMessages(const gpu::ValidationLog& log, std::size_t from) {
  const auto messages = log.messages();
  for (std::size_t i = from; i < messages.size(); ++i) ADD_FAILURE() << "validation layer: " << messages[i];
}

void GpuTest::SetUp() {
  openSharedDevice();
  if (sharedDevice) {
    messagesBefore_ = sharedLog->messages().size();
    return;
  }
  const char* required = std::getenv("RINGLET_REQUIRE_GPU");
  if (required && std::string_view(required) == "1") {
    FAIL() << "RINGLET_REQUIRE_GPU=1, but: " << openingError->message;
  }
  GTEST_SKIP() << "SKIPPED, NOTHING WAS TESTED: " << openingError->message;
}

void GpuTest::TearDown() {
  if (sharedDevice) expectNoMessages(*sharedLog, messagesBefore_);
}

ComputeDevice& GpuTest::device() { return *sharedDevice; }

bool GpuTest::makes(const KernelChoice& kernel, const Groom& groom) {
  if (device().limits().isCpu) return true;
  std::vector<std::uint32_t> counts;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    counts.push_back(groom.firstPoint[s + 1] - groom.firstPoint[s]);
  std::ranges::sort(counts);
  const auto planned = planRanges(counts, device().limits(), kernel);
  if (!planned) fmt::print("LEFT OUT: {}\n", planned.error().message);
  return static_cast<bool>(planned);
}

}  // namespace ringlet::test
