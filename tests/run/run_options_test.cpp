// Mirrors ringlet/run/run_options.h: whose prims a run may change.
#include "ringlet/run/run_options.h"

#include <gtest/gtest.h>

#include "ringlet/groom/generate.h"

namespace ringlet::run_options_test {
namespace {

// Those of a .hair file and of Alembic are none of USD's, and other files have none.
TEST(RunOptions, OnlyPrimsOfUsdCanBeChanged) {
  struct Case {
    const char* path;  // of its prim; null: it has none
    bool isUsd;
  };
  for (const Case& c : {Case{"/Head/Hair", true}, {"/Head/Hair", false}, {"", false}, {nullptr, true}}) {
    LoadedGroom groom{.groom = *makeCurl({})};
    groom.hasUsdPrims = c.isUsd;
    if (c.path) groom.prims.emplace_back().path = c.path;
    RunOptions options;
    EXPECT_TRUE(chooseOrigin(groom, options));
    EXPECT_EQ(options.origin, &groom);
    options.usesGroomPrims = true;
    EXPECT_EQ(bool(chooseOrigin(groom, options)), c.path && c.isUsd);
  }
}

}  // namespace
}  // namespace ringlet::run_options_test
