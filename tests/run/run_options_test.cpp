// Mirrors ringlet/run/run_options.h: whose prims a run may change.
#include "ringlet/run/run_options.h"

#include <gtest/gtest.h>

#include "ringlet/groom/generate.h"

namespace ringlet::run_options_test {
namespace {

// Those of a .hair file have no path, and other files have none.
TEST(RunOptions, OnlyPrimsOfUsdCanBeChanged) {
  for (const char* path : {"/Head/Hair", "", "no prim"}) {
    LoadedGroom groom{.groom = *makeCurl({})};
    if (std::string(path) != "no prim") groom.prims.emplace_back().path = path;
    RunOptions options;
    EXPECT_TRUE(chooseOrigin(groom, options));
    EXPECT_EQ(options.origin, &groom);
    options.usesGroomPrims = true;
    EXPECT_EQ(bool(chooseOrigin(groom, options)), path[0] == '/') << path;
  }
}

}  // namespace
}  // namespace ringlet::run_options_test
