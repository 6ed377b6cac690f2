// Who may know whom: reads every #include of the sources and fails on a forbidden one (CONTRIBUTING.md, "Who
// may know whom"), and on a public header that shows Vulkan, Eigen or gpu/.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace ringlet::test {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = RINGLET_SOURCE_DIR;

std::vector<std::string> includesOf(const fs::path& file) {
  static const std::regex pattern(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
  std::vector<std::string> includes;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_search(line, match, pattern)) includes.push_back(match[1]);
  }
  return includes;
}

std::vector<fs::path> sourcesBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    const auto extension = entry.path().extension();
    if (extension == ".h" || extension == ".cpp") files.push_back(entry.path());
  }
  EXPECT_FALSE(files.empty()) << folder;
  return files;
}

// "ringlet/gpu/device.h" -> "gpu"; "" for anything else.
std::string moduleOf(const std::string& include) {
  if (include.rfind("ringlet/", 0) != 0) return "";
  return include.substr(8, include.find('/', 8) - 8);
}

TEST(IncludeRules, ModulesKnowOnlyWhomTheyMay) {
  const std::map<std::string, std::set<std::string>> mayKnow = {
      {"base", {"base"}},
      {"groom", {"base", "groom"}},
      {"scene", {"base", "scene"}},
      {"bodies", {"base", "groom", "scene", "bodies"}},
      {"motion", {"base", "scene", "bodies", "motion"}},
      {"rest", {"base", "groom", "scene", "rest"}},
      {"scenes", {"base", "groom", "scene", "rest", "bodies", "scenes"}},
      {"gpu", {"base", "gpu"}},
      {"solver", {"base", "groom", "scene", "rest", "gpu", "solver"}},
      {"measure", {"base", "groom", "rest", "scene", "bodies", "measure"}},
      {"output", {"base", "groom", "gpu", "output"}},
  };
  for (const auto& entry : fs::directory_iterator(kRoot / "src/ringlet")) {
    const std::string module = entry.path().filename();
    ASSERT_TRUE(mayKnow.count(module)) << module << " has no rule here";
    for (const fs::path& file : sourcesBelow("src/ringlet/" + module)) {
      for (const std::string& include : includesOf(file)) {
        const std::string other = moduleOf(include);
        EXPECT_TRUE(other.empty() || mayKnow.at(module).count(other)) << file << " includes " << include;
        EXPECT_NE(include.rfind("reference/", 0), 0u) << file << " includes the reference: " << include;
        EXPECT_NE(include.rfind("parity/", 0), 0u) << file << " includes " << include;
        EXPECT_NE(include.rfind("Eigen", 0), 0u) << file << " includes " << include;
        if (include.rfind("shared/", 0) == 0) {
          EXPECT_TRUE(module == "rest" || module == "solver") << file << " includes " << include;
        }
      }
    }
  }
}

TEST(IncludeRules, PublicHeadersShowNeitherVulkanNorGpu) {
  for (const fs::path& file : sourcesBelow("src/ringlet")) {
    if (file.extension() != ".h" || file.string().find("/gpu/") != std::string::npos) continue;
    // Inside the solver these are private: they hold the device's buffers and kernels.
    const bool isPrivate = file.filename() == "device_groom.h" || file.filename() == "device_world.h" ||
                           file.filename() == "device_roots.h" || file.filename() == "frame_input.h" ||
                           file.filename() == "frame_slot.h" || file.filename() == "strand_kernels.h" ||
                           file.filename() == "simulation_implementation.h" ||
                           file.filename() == "contact_stage.h" || file.filename() == "contact_lists.h" ||
                           file.filename() == "contact_lives.h" || file.filename() == "contact_kernels.h" ||
                           file.filename() == "volume_stage.h" || file.filename() == "volume_kernels.h" ||
                           file.filename() == "device_buffers.h";
    for (const std::string& include : includesOf(file)) {
      EXPECT_EQ(include.find("vulkan"), std::string::npos) << file << " includes " << include;
      EXPECT_EQ(include.find("volk"), std::string::npos) << file << " includes " << include;
      EXPECT_TRUE(isPrivate || moduleOf(include) != "gpu") << file << " includes " << include;
      EXPECT_EQ(include.find("zstd"), std::string::npos) << file << " includes " << include;
      // Readers of TOML have a header of their own, which no public one shows.
      EXPECT_TRUE(include.rfind("toml++", 0) != 0 || file.filename() == "toml_file.h") << file;
      EXPECT_TRUE(include != "ringlet/rest/toml_file.h" || file.filename() == "material_table.h") << file;
      EXPECT_NE(include, "ringlet/rest/material_table.h") << file;
    }
  }
}

TEST(IncludeRules, ReferenceDerivesEverythingItself) {
  const std::set<std::string> allowed = {"base", "groom", "scene"};
  for (const fs::path& file : sourcesBelow("reference")) {
    for (const std::string& include : includesOf(file)) {
      const std::string module = moduleOf(include);
      if (module.empty() || include == "ringlet/rest/material.h") continue;
      EXPECT_TRUE(allowed.count(module)) << file << " includes " << include;
    }
  }
}

}  // namespace
}  // namespace ringlet::test
