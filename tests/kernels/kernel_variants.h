// Forms of the strand kernel, and strands of lengths about their boundaries.
#pragma once

#include <iterator>
#include <vector>

#include "ringlet/solver/kernel_choice.h"

namespace ringlet::test {

struct Variant {
  const char* name;
  KernelChoice kernel;
};
inline const Variant kVariants[] = {
    {"automatic", {}},
    {"lanes of 4", {KernelChoice::Form::automatic, 4}},
    {"lanes of 8", {KernelChoice::Form::automatic, 8}},
    {"lanes of 16", {KernelChoice::Form::automatic, 16}},
    {"1 lane of 17", {KernelChoice::Form::automatic, 17, 1}},
    {"2 lanes of 17", {KernelChoice::Form::automatic, 17, 2}},
    {"2 lanes of 70 in memory", {KernelChoice::Form::memory, 70, 2}},
    {"4 lanes of 33 in memory", {KernelChoice::Form::memory, 33, 4}},
    {"serial", {KernelChoice::Form::serial}},
};

// Counts that divide no group, and lengths around every run boundary; mixed in one groom.
inline std::vector<int> awkwardLengths(int strands) {
  const int lengths[] = {2, 3, 31, 100, 128, 16, 17, 64, 65, 5, 33, 127};
  std::vector<int> result;
  for (int s = 0; s < strands; ++s) result.push_back(lengths[s % std::size(lengths)]);
  return result;
}

}  // namespace ringlet::test
