// The README's programs are the ones that tests build.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace ringlet::test {
namespace {

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(std::filesystem::path(RINGLET_SOURCE_DIR) / file);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Readme, ShowsTheProgramsThatTestsBuild) {
  const std::string readme = textOf("README.md");
  for (const char* program : {"consumer/main.cpp", "installed/engine.cpp"}) {
    const std::string text = textOf(std::filesystem::path("tests/package") / program);
    EXPECT_GT(text.size(), 100u);
    EXPECT_NE(readme.find("```cpp\n" + text + "```\n"), std::string::npos) << program;
  }
}

}  // namespace
}  // namespace ringlet::test
