// `ringlet make`: what it promises is in the file.
#include <gtest/gtest.h>

#include "ringlet/groom/groom_file.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::make_test {
namespace {

using test::runProgram;
using test::scratchFolder;

TEST(Make, WritesEveryKindInBothFormats) {
  const auto folder = scratchFolder("make");
  struct Case {
    std::vector<std::string> arguments;
    std::size_t strands, particles;
  };
  for (const std::string file : {"groom.obj", "groom.hair"}) {
    for (const Case& c :
         {Case{{"make", "curl", "--turns", "2", "--particles", "20"}, 1, 20},
          Case{
              {"make", "swatch", "--columns", "3", "--rows", "2", "--turns", "2", "--particles", "9"}, 6, 54},
          Case{{"make", "head", "--strands", "25", "--turns", "0", "--particles", "16"}, 25, 400}}) {
      auto arguments = c.arguments;
      arguments.insert(arguments.end(), {"-o", file});
      const auto result = runProgram(folder, arguments);
      EXPECT_EQ(result.exitCode, 0) << result.err;
      EXPECT_EQ(result.err, "");
      auto loaded = readGroom(folder / file);
      ASSERT_TRUE(loaded) << loaded.error().message;
      EXPECT_EQ(loaded->groom.strandCount(), c.strands);
      EXPECT_EQ(loaded->groom.points.size(), c.particles);
    }
  }
}

TEST(Make, UnitScalesTheFile) {
  const auto folder = scratchFolder("make_unit");
  ASSERT_EQ(runProgram(folder, {"make", "curl", "--unit", "0.001", "-o", "mm.obj"}).exitCode, 0);
  ASSERT_EQ(runProgram(folder, {"make", "curl", "--unit", "1", "-o", "m.obj"}).exitCode, 0);
  auto millimetres = readGroom(folder / "mm.obj"), metres = readGroom(folder / "m.obj");
  ASSERT_TRUE(millimetres && metres);
  EXPECT_NEAR(millimetres->groom.points.back().y, -250, 1e-3) << "a curl is 0.25 m long by default";
  EXPECT_NEAR(metres->groom.points.back().y, -0.25, 1e-6);
}

TEST(Make, WarnsOfCurlsCutTooCoarsely) {
  const auto folder = scratchFolder("make_coarse");
  for (const char* kind : {"curl", "swatch", "head"}) {
    const auto result = runProgram(folder, {"make", kind, "--particles", "30", "-o", "coarse.obj"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, std::string("ringlet make ") + kind +
                              ": warning: 30 particles are 3.75 for each of the 8 turns; a curl holds its "
                              "shape from 4, 32 in all\n");
  }
}

TEST(Make, SaysWhereItCannotWrite) {
  const auto folder = scratchFolder("make_nowhere");
  const auto result = runProgram(folder, {"make", "curl", "-o", "no/such/curl.obj"});
  EXPECT_EQ(result.exitCode, 5);
  EXPECT_NE(result.err.find("ringlet make curl: no/such/curl.obj"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace ringlet::make_test
