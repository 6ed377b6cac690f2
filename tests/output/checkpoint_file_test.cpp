// Checkpoints as files: what goes in comes out, and no damage is taken for a checkpoint.
#include "ringlet/output/checkpoint_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "ringlet/base/whole_file.h"
#include "tests/support/test_support.h"

namespace ringlet::test::checkpoint_file_test {
namespace {

::ringlet::Checkpoint sample() {
  return {.facts = {{"frames", "24"}, {"kernel", "lanes 4 x 16"}, {"empty", ""}},
          .everyFrames = 10,
          .frame = 20,
          .computed = std::vector<std::byte>(100, std::byte{7}),
          .written = std::vector<std::byte>(3, std::byte{9})};
}

TEST(CheckpointFile, RoundTrip) {
  const auto path = scratchFolder("checkpoint") / "c.rgk";
  const auto before = sample();
  ASSERT_TRUE(writeCheckpoint(path, before));
  const auto after = readCheckpoint(path);
  ASSERT_TRUE(after) << after.error().message;
  EXPECT_EQ(after->facts, before.facts);
  EXPECT_EQ(after->everyFrames, before.everyFrames);
  EXPECT_EQ(after->frame, before.frame);
  EXPECT_EQ(after->computed, before.computed);
  EXPECT_EQ(after->written, before.written);
}

TEST(CheckpointFile, EveryDamagedByteAndEveryLengthIsRefused) {
  const auto path = scratchFolder("checkpoint_damage") / "c.rgk";
  ASSERT_TRUE(writeCheckpoint(path, sample()));
  const auto whole = *readWholeFile(path);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    auto damaged = whole;
    damaged[i] ^= std::byte{0x10};
    ASSERT_TRUE(writeWholeFile(path, damaged));
    EXPECT_FALSE(readCheckpoint(path)) << "byte " << i;
    ASSERT_TRUE(writeWholeFile(path, std::span(whole).first(i)));
    EXPECT_FALSE(readCheckpoint(path)) << i << " bytes";
  }
  auto longer = whole;
  longer.push_back({});
  ASSERT_TRUE(writeWholeFile(path, longer));
  EXPECT_FALSE(readCheckpoint(path)) << "a byte more";
}

TEST(CheckpointFile, DifferencesAreSaid) {
  const std::vector<RunFact> a = sample().facts;
  EXPECT_EQ(differencesOf(a, a), "");
  std::vector<RunFact> b = a;
  b[0].value = "30";
  b.push_back({"wind", "1"});
  EXPECT_EQ(differencesOf(b, a), "frames is 30 and was 24; wind is 1 and was not given");
  EXPECT_EQ(differencesOf(a, b), "frames is 24 and was 30; wind is not given and was 1");
  std::vector<RunFact> many;
  for (int i = 0; i < 7; ++i) many.push_back({std::to_string(i), "x"});
  EXPECT_NE(differencesOf(many, {}).find("; and 3 more"), std::string::npos);
}

}  // namespace
}  // namespace ringlet::test::checkpoint_file_test
