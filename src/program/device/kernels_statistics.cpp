// Implements kernels_statistics.h, using the names that drivers give:
//   RADV    VGPRs, SGPRs, Spilled VGPRs, Spilled SGPRs, Scratch size, Code size, Subgroups per SIMD
//   ANV     Instruction Count, Spill count, Fill count, Scratch Memory Size, Max dispatch width
//   NVK     Instruction count, Code size, Number of GPRs, SLM size (local memory), Max warps/SM,
//           Spills to memory, Fills from memory, Spills to reg, Fills from reg
//   NVIDIA  Register Count, Binary Size, Stack Size, Local Memory
#include "program/device/kernels_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace ringlet::program {
namespace {

constexpr double kSchedulers = 4;  // schedulers of an NVIDIA processor (SM), each with its own warps

bool hasPart(std::string_view whole, std::string_view part) { return whole.find(part) != whole.npos; }

// NVIDIA's driver puts another number above the lower 32 bits of local memory.
double valueOf(const gpu::KernelStatistic& one) {
  return hasPart(one.name, "Local Memory") ? std::fmod(one.value, 4294967296.0) : one.value;
}

// Spilled scalar registers go to vector registers, and NVK's "to reg" to registers of another kind; both cost
// little. NVIDIA does not count spills; they are part of a kernel's local memory.
bool isSpilled(const gpu::KernelStatistic& one) {
  if (valueOf(one) <= 0) return false;
  if (hasPart(one.name, "Local Memory")) return true;
  return hasPart(one.name, "pill") && !hasPart(one.name, "SGPR") && !hasPart(one.name, "to reg");
}

bool isOneWave(const gpu::KernelStatistic& one) {
  if (one.name == "Max warps/SM") return one.value <= kSchedulers;
  return one.name == "Subgroups per SIMD" && one.value == 1;
}

}  // namespace

std::vector<std::string> flagsOf(std::span<const gpu::KernelStatistic> statistics) {
  std::vector<std::string> flags;
  if (std::ranges::any_of(statistics, isSpilled)) flags.push_back("spills");
  if (std::ranges::any_of(statistics, isOneWave)) flags.push_back("1 wave");
  return flags;
}

std::string statisticsText(std::span<const gpu::KernelStatistic> statistics) {
  constexpr std::string_view kWorth[] = {"VGPRs",    "GPRs",       "egister",    "pill",      "Fill",
                                         "cratch",   "SLM",        "ocal Memor", "Stack",     "ode size",
                                         "ode Size", "inary Size", "nstruction", "Subgroups", "warps"};
  std::string text;
  for (const gpu::KernelStatistic& one : statistics) {
    if (std::ranges::none_of(kWorth, [&](std::string_view part) { return hasPart(one.name, part); }))
      continue;
    text += fmt::format("{}{} {:.0f}", text.empty() ? "" : ", ", one.name, valueOf(one));
  }
  return text;
}

}  // namespace ringlet::program
