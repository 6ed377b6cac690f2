// Finds shuffles that not all lanes of a subgroup come to, in a kernel's SPIR-V.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ringlet::test {

/// The functions with a shuffle, or a call that leads to one, in blocks that some lanes may leave out:
/// beneath a choice or a loop's end that differs between lanes. Specialization and push constants are the
/// same in all, loads from one place too, and what isAnyOfSubgroup returns. Of variables it counts every
/// store, wherever it stands.
std::vector<std::string> divergentShuffles(std::span<const std::uint32_t> spirv);

}  // namespace ringlet::test
