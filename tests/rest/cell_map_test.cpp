// rest/cell_map.h against a map of the standard library.
#include "ringlet/rest/cell_map.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace ringlet::cell_map_test {
namespace {

TEST(CellMap, HoldsWhatAMapHolds) {
  std::mt19937_64 random(1);
  CellMap<double> cells;
  for (int round = 0; round < 3; ++round) {  // in the memory of the round before
    EXPECT_EQ(cells.find(0), nullptr);
    std::map<std::uint64_t, double> expected;
    for (int i = 0; i < 20000; ++i) {
      // Neighbours along an axis, everything in one row, the largest key.
      const std::uint64_t key = i % 3 == 0   ? random() % 5000
                                : i % 3 == 1 ? (random() % 500) << 42
                                             : (~0ull >> 1);
      cells.at(key, 0) += i;
      expected[key] += i;
    }
    for (const auto& [key, sum] : expected) {
      ASSERT_NE(cells.find(key), nullptr) << key;
      EXPECT_EQ(*cells.find(key), sum) << key;
    }
    EXPECT_EQ(cells.find(5001), nullptr);
    cells.clear();
  }
}

TEST(CellMap, AValueThatIsThereStays) {
  CellMap<std::uint32_t> cells;
  EXPECT_EQ(cells.at(7, 3), 3u);
  EXPECT_EQ(cells.at(7, 4), 3u);
}

}  // namespace
}  // namespace ringlet::cell_map_test
