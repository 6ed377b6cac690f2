// Pictures as they were when somebody last looked at them: tests/program/golden/NAME.png. With
// RINGLET_WRITE_GOLDEN=1 the test writes them anew; look at them before they are committed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/program/picture_file.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::test::golden_test {
namespace {

namespace fs = std::filesystem;

// SwiftShader differs by up to 0.013 of 255; one per cent more light by 0.76 to 0.78.
constexpr double kOtherDrivers = 0.3;

class Golden : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = scratchFolder("golden");
    RINGLET_NEEDS_DEVICE(folder_);
  }

  void make(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "make");
    ASSERT_EQ(runProgram(folder_, arguments).exitCode, 0);
  }

  // Renders with the arguments, and compares with golden/NAME.png.
  void expectGolden(const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    const std::string file = name + ".png";
    for (const std::string& each :
         {std::string("-o"), file, std::string("--size"), std::string("128x96"), std::string("--json")})
      arguments.push_back(each);
    const auto result = runProgram(folder_, arguments);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const fs::path golden = fs::path(RINGLET_SOURCE_DIR) / "tests/program/golden" / file;
    if (std::getenv("RINGLET_WRITE_GOLDEN")) {
      fs::copy_file(folder_ / file, golden, fs::copy_options::overwrite_existing);
      GTEST_SKIP() << "SKIPPED: wrote " << golden;
    }
    const Image found = readPng(folder_ / file), expected = readPng(golden);
    const double difference = rmsDifference(found, expected);
    const std::string device = nlohmann::json::parse(result.out)["device"];
    std::printf("%s on %s: %.3f of 255\n", name.c_str(), device.c_str(), difference);
    if (device.starts_with("llvmpipe")) {
      EXPECT_EQ(differing(found, expected), 0) << folder_ / file << " is not " << golden;
    }
    EXPECT_LE(difference, kOtherDrivers) << folder_ / file << " is not " << golden;
  }

  fs::path folder_;
};

TEST_F(Golden, AHeadOfLocks) {
  make({"head", "--strands", "280", "--locks", "280", "--particles", "32", "-o", "head.obj"});
  expectGolden("head", {"head.obj", "--samples", "4"});
}

TEST_F(Golden, FewStrands) {
  make({"head", "--strands", "9", "--particles", "32", "-o", "few.obj"});
  expectGolden("few",
               {"few.obj", "--samples", "2", "--colour", "black", "--azimuth", "-60", "--elevation", "30"});
}

TEST_F(Golden, StrandsThemselves) {
  make({"head", "--strands", "500", "--particles", "24", "-o", "strands.obj"});
  expectGolden("strands", {"strands.obj", "--samples", "3", "--hairs", "0", "--colour", "blond", "--azimuth",
                           "150", "--distance", "0.7"});
}

// Simulated by the reference, whose positions do not depend on the driver.
TEST_F(Golden, AJumpWithBodiesIsBlurred) {
  make({"head", "--strands", "150", "--particles", "24", "-o", "head.obj"});
  std::ofstream(folder_ / "jump.toml")
      << "[groom]\nfile = \"head.obj\"\n[motion]\nkind = \"jump\"\n[simulation]\nframes = 6\n"
         "[[body]]\nshape = \"sphere\"\nradius = 0.085\n[[body]]\nshape = \"box\"\nhalf_extents = [0.2, "
         "0.01, 0.1]\nposition = [0, -0.3, 0]\nmoves = \"still\"\n";
  const auto result = runProgram(folder_, {"simulate", "jump.toml", "--backend", "reference", "--cache",
                                           "float32", "--no-usd", "-o", "jump"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  expectGolden("jump", {"jump", "--scene", "jump.toml", "--frames", "6:6", "--blur", "3", "--samples", "2",
                        "--colour", "red"});
}

}  // namespace
}  // namespace ringlet::test::golden_test
