// Measured costs of shapes: what is read is what was written, and a spoilt file says where it is.
#include "ringlet/solver/plan/shape_cost_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/test_support.h"

namespace ringlet::shape_cost_file_test {
namespace {

using test::scratchFolder;

TEST(ShapeCostFile, ReadsBackEveryBit) {
  const auto path = scratchFolder("shape_costs") / "made" / "shapes.toml";
  const std::vector<DeviceCosts> written{
      {"a \"quoted\" device", "driver\\1", "00ff", {{{4, 16}, 1.0 / 3}, {kAnySerialShape, 46}}, 32},
      {"another", "", "1", {}}};
  ASSERT_TRUE(writeShapeCosts(path, written));
  const auto read = readShapeCosts(path);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2u);
  for (std::size_t d = 0; d < 2; ++d) {
    EXPECT_TRUE((*read)[d].isOf(written[d]));
    EXPECT_EQ((*read)[d].subgroupSize, written[d].subgroupSize);
    ASSERT_EQ((*read)[d].costs.size(), written[d].costs.size());
    for (std::size_t i = 0; i < written[d].costs.size(); ++i) {
      EXPECT_EQ((*read)[d].costs[i].shape, written[d].costs[i].shape);
      EXPECT_EQ((*read)[d].costs[i].nanoseconds, written[d].costs[i].nanoseconds);
    }
  }
}

TEST(ShapeCostFile, SaysWhatIsWrongAndWhere) {
  const auto path = scratchFolder("shape_costs") / "shapes.toml";
  const std::string old = "[[device]]\nname = \"d\"\ndriver = \"d\"\nkernels = \"k\"\n";
  const std::string head = old + "subgroup = 8\n";
  const std::pair<std::string, std::string> cases[] = {
      {"", "expected a [[device]]"},
      {"device = 5\n", "expected a [[device]]"},
      {"device = [5]\n", "line 1: found the number 5"},
      {"[[device", "line 1: found no TOML"},
      {"[[device]]\nname = 5\n", "expected name, a text"},
      {old + "shapes = []\n", "line 1: expected subgroup, a whole number from 0 to 128"},
      {old + "subgroup = 129\n", "expected subgroup, a whole number from 0 to 128"},
      {head, "line 1: expected shapes, a list"},
      {head + "shapes = [3]\n", "line 6: found the number 3; expected a shape"},
      {head + "shapes = [\n{ lanes = 4, run = 8 }]\n", "line 7: expected nanoseconds, a number above 0"},
      {head + "shapes = [{ lanes = 4, run = 8, nanoseconds = nan }]\n", "nanoseconds, a number above 0"},
      {head + "shapes = [{ lanes = 4, run = 8, nanoseconds = -1 }]\n", "nanoseconds, a number above 0"},
      {head + "shapes = [{ lanes = 3, run = 8, nanoseconds = 1 }]\n", "a power of two"},
      {head + "shapes = [{ lanes = 0, run = 8, nanoseconds = 1 }]\n", "lanes, a whole number from 1 to 128"},
      {head + "shapes = [{ lanes = 4, run = 1e9, nanoseconds = 1 }]\n", "run, a whole number from 4 to 64"},
  };
  for (const auto& [text, message] : cases) {
    std::ofstream(path) << text;
    const auto read = readShapeCosts(path);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().message.find(path.string()), 0u) << read.error().message;
    EXPECT_NE(read.error().message.find(message), std::string::npos) << read.error().message;
  }
  EXPECT_FALSE(readShapeCosts(path.parent_path() / "none.toml"));
}

}  // namespace
}  // namespace ringlet::shape_cost_file_test
