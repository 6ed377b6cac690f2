// Implements conform_break.h.
#include "program/device/conform_break.h"

#include <algorithm>
#include <bit>

#include "ringlet/base/assert.h"

namespace ringlet::program {
namespace {

struct Break {
  const char* kernel;
  std::uint32_t from, to;  // the 32 bits of a constant
};
const Break kBreaks[] = {
    {"strand_step", std::bit_cast<std::uint32_t>(0.5f), std::bit_cast<std::uint32_t>(0.51f)},
    {"contact_query", 9, 8},  // number of rows of cells around a particle
    {"probe_turns", 1013904223, 1013904221},
};

// SPIR-V: a header of 5 words; instructions with their length in the upper half of their first word.
constexpr std::size_t kHeaderWords = 5;
constexpr std::uint32_t kOpConstant = 43;

}  // namespace

std::vector<std::string> breakableKernels() {
  std::vector<std::string> names;
  for (const Break& one : kBreaks) names.push_back(one.kernel);
  return names;
}

std::function<void(const std::string&, std::vector<std::uint32_t>&)> breaking(const std::string& kernel) {
  const Break& chosen = *std::ranges::find(kBreaks, kernel, &Break::kernel);
  return [chosen](const std::string& name, std::vector<std::uint32_t>& spirv) {
    if (!name.starts_with(chosen.kernel)) return;
    bool isFound = false;
    for (std::size_t i = kHeaderWords; i < spirv.size() && spirv[i] >> 16 != 0; i += spirv[i] >> 16) {
      if ((spirv[i] & 0xffff) != kOpConstant || spirv[i + 3] != chosen.from) continue;
      spirv[i + 3] = chosen.to;
      isFound = true;
    }
    RINGLET_ASSERT(isFound, "a kernel that is to be broken has lost the constant");
  };
}

}  // namespace ringlet::program
