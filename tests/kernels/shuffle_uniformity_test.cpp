// Every shuffle of every kernel is asked by all lanes of a subgroup: lavapipe answers the others too, GPUs do
// not.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "embedded_modules.h"
#include "ringlet_shaders/uniformity_probe_test.h"
#include "tests/support/shuffle_uniformity.h"

namespace ringlet::test::shuffle_uniformity_test {
namespace {

using Names = std::vector<std::string>;

TEST(ShuffleUniformity, OfEveryKernel) {
  std::size_t shuffling = 0;
  for (const EmbeddedModule& kernel : kEmbeddedModules) {
    if (std::string(kernel.name).starts_with("probe_")) continue;  // they are to find out what drivers do
    EXPECT_EQ(divergentShuffles(kernel.words), Names{}) << kernel.name;
    shuffling += std::string(kernel.name).starts_with("strand_step");
  }
  EXPECT_GT(shuffling, 10u);
}

TEST(ShuffleUniformity, FindsThoseThatSomeLanesLeaveOut) {
  Names found = divergentShuffles(k_uniformity_probe_test);
  std::ranges::sort(found);
  for (std::string& name : found) name.resize(name.find('('));
  EXPECT_EQ(found, (Names{"behindReturn", "inChoice", "inIf", "inLoop", "throughCall"}));
}

}  // namespace
}  // namespace ringlet::test::shuffle_uniformity_test
