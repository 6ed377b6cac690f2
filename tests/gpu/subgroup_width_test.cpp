// The subgroup width kernels are given by default, of devices as their drivers state them.
#include "ringlet/gpu/subgroup_width.h"

#include <gtest/gtest.h>

namespace ringlet::gpu::subgroup_width_test {
namespace {

struct Case {
  const char* device;
  std::uint32_t vendor, reported, smallest, largest;
  bool canChoose;
  std::uint32_t chosen;
};

constexpr std::uint32_t kAmd = 0x1002, kIntel = 0x8086, kNvidia = 0x10de, kQualcomm = 0x5143, kArm = 0x13b5;
constexpr std::uint32_t kMesa = 0x10005, kGoogle = 0x1ae0;

DeviceProperties propertiesOf(const Case& c) {
  DeviceProperties p;
  p.vendorId = c.vendor;
  p.reportedSubgroupSize = c.reported;
  p.minSubgroupSize = c.smallest;
  p.maxSubgroupSize = c.largest;
  p.canChooseSubgroupSize = c.canChoose;
  return p;
}

TEST(SubgroupWidth, IsChosenByVendorAndRange) {
  for (const Case& c : {
           Case{"AMD gfx10 and later", kAmd, 64, 32, 64, true, 32},
           Case{"AMD gfx10 that reports 32", kAmd, 32, 32, 64, true, 32},
           Case{"AMD gfx9 and before", kAmd, 64, 64, 64, true, 64},
           Case{"AMD without a choice", kAmd, 64, 32, 64, false, 64},
           Case{"Intel Gen 9 to Xe", kIntel, 32, 8, 32, true, 8},
           Case{"Intel Xe2", kIntel, 32, 16, 32, true, 16},
           Case{"Intel without a choice", kIntel, 32, 8, 32, false, 32},
           Case{"NVIDIA", kNvidia, 32, 32, 32, true, 32},
           Case{"Adreno, wider than a workgroup", kQualcomm, 128, 64, 128, true, 64},
           Case{"Adreno without a choice", kQualcomm, 128, 64, 128, false, 128},
           Case{"Adreno that has only 128", kQualcomm, 128, 128, 128, true, 128},
           Case{"Mali", kArm, 16, 16, 16, true, 16},
           Case{"lavapipe", kMesa, 8, 8, 8, true, 8},
           Case{"SwiftShader", kGoogle, 4, 4, 4, false, 4},
           Case{"a range that leaves out what is reported", kMesa, 8, 16, 32, true, 16},
       }) {
    const DeviceProperties p = propertiesOf(c);
    EXPECT_EQ(defaultSubgroupSize(p), c.chosen) << c.device;
    EXPECT_TRUE(hasSubgroupSize(p, defaultSubgroupSize(p)))
        << c.device << ": a width the device does not have";
  }
}

TEST(SubgroupWidth, PowersOfTwoOfTheRangeCanBeAskedFor) {
  const DeviceProperties intel = propertiesOf({"", kIntel, 32, 8, 32, true, 8});
  const DeviceProperties fixed = propertiesOf({"", kIntel, 32, 8, 32, false, 32});
  for (std::uint32_t width = 0; width <= 128; ++width) {
    EXPECT_EQ(hasSubgroupSize(intel, width), width == 8 || width == 16 || width == 32) << width;
    EXPECT_EQ(hasSubgroupSize(fixed, width), width == 32) << width;
  }
}

}  // namespace
}  // namespace ringlet::gpu::subgroup_width_test
