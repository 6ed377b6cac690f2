// Every SPIR-V module that the library embeds is valid, by the SPIR-V tools' own check.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "embedded_modules.h"
#include "tests/support/test_support.h"

namespace ringlet::test::spirv_val_test {
namespace {

TEST(SpirvVal, EmbeddedShadersAreValid) {
  if (std::system("spirv-val --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "SKIPPED, NOTHING WAS TESTED: spirv-val is not installed (Debian: spirv-tools)";
  const auto folder = scratchFolder("spirv_val");
  for (const EmbeddedModule& module : kEmbeddedModules) {
    const auto file = folder / (std::string(module.name) + ".spv");
    const auto bytes = std::as_bytes(module.words);
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    const std::string command = "spirv-val --target-env vulkan1.1 " + file.string() + " 1>&2";
    EXPECT_EQ(std::system(command.c_str()), 0) << module.name;
  }
}

}  // namespace
}  // namespace ringlet::test::spirv_val_test
