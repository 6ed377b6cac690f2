// What is made of drivers' statistics, by the names that each gives them.
#include <gtest/gtest.h>

#include "program/device/kernels_statistics.h"

namespace ringlet::program::kernels_statistics_test {
namespace {

using Statistics = std::vector<gpu::KernelStatistic>;
using Flags = std::vector<std::string>;

TEST(KernelsStatistics, SpillsAreWhatGoesThroughMemory) {
  EXPECT_EQ(flagsOf(Statistics{{"Spilled VGPRs", 16}}), Flags{"spills"}) << "RADV";
  EXPECT_EQ(flagsOf(Statistics{{"Spilled VGPRs", 0}, {"Spilled SGPRs", 40}}), Flags{}) << "RADV";
  EXPECT_EQ(flagsOf(Statistics{{"Spill count", 3}}), Flags{"spills"}) << "ANV";
  EXPECT_EQ(flagsOf(Statistics{{"Spills to memory", 0}, {"Spills to reg", 12}, {"SLM size", 0}}), Flags{})
      << "NVK";
  EXPECT_EQ(flagsOf(Statistics{{"Spills to memory", 4}, {"Spills to reg", 12}}), Flags{"spills"}) << "NVK";
  EXPECT_EQ(flagsOf(Statistics{{"Register Count", 255}, {"Local Memory Size", 128}}), Flags{"spills"})
      << "NVIDIA";
  EXPECT_EQ(flagsOf(Statistics{{"Register Count", 255}, {"Local Memory Size", 0}}), Flags{}) << "NVIDIA";
  // As driver 580.159 has it, for an H100.
  EXPECT_EQ(flagsOf(Statistics{{"Local Memory Size", 68719476736.0}}), Flags{}) << "NVIDIA";
  EXPECT_EQ(flagsOf(Statistics{{"Local Memory Size", 68719477024.0}}), Flags{"spills"}) << "NVIDIA";
  EXPECT_EQ(statisticsText(Statistics{{"Local Memory Size", 68719477024.0}}), "Local Memory Size 288");
}

TEST(KernelsStatistics, OneWaveIsOneOfAScheduler) {
  EXPECT_EQ(flagsOf(Statistics{{"Subgroups per SIMD", 1}}), Flags{"1 wave"}) << "RADV";
  EXPECT_EQ(flagsOf(Statistics{{"Subgroups per SIMD", 2}}), Flags{}) << "RADV";
  EXPECT_EQ(flagsOf(Statistics{{"Max warps/SM", 4}}), Flags{"1 wave"}) << "NVK";
  EXPECT_EQ(flagsOf(Statistics{{"Max warps/SM", 8}}), Flags{}) << "NVK";
}

TEST(KernelsStatistics, TheLineHasRegistersSpillsMemoryAndCode) {
  EXPECT_EQ(statisticsText(Statistics{{"Instruction count", 4039},
                                      {"Static cycle count", 12000},
                                      {"Max warps/SM", 8},
                                      {"Number of GPRs", 255},
                                      {"SLM size", 16},
                                      {"Fills from memory", 4},
                                      {"Spills to reg", 3},
                                      {"Code size", 76800}}),
            "Instruction count 4039, Max warps/SM 8, Number of GPRs 255, SLM size 16, Fills from memory 4, "
            "Spills to reg 3, Code size 76800");
  EXPECT_EQ(statisticsText(Statistics{{"Register Count", 168},
                                      {"Binary Size", 65536},
                                      {"Stack Size", 0},
                                      {"Input Count", 1},
                                      {"Local Memory Size", 8}}),
            "Register Count 168, Binary Size 65536, Stack Size 0, Local Memory Size 8");
}

}  // namespace
}  // namespace ringlet::program::kernels_statistics_test
