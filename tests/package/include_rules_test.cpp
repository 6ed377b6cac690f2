// Who may know whom: reads every #include of the sources and fails on a forbidden one (CONTRIBUTING.md, "Who
// may know whom"), and on an installed header that shows one that is not.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace ringlet::test::include_rules_test {
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

// "ringlet/gpu/device.h" -> "gpu"; "" for anything else, as "ringlet/version.h".
std::string moduleOf(const std::string& include) {
  if (include.rfind("ringlet/", 0) != 0) return "";
  const std::size_t end = include.find('/', 8);
  return end == std::string::npos ? "" : include.substr(8, end - 8);
}

TEST(IncludeRules, ModulesKnowOnlyWhomTheyMay) {
  const std::map<std::string, std::set<std::string>> mayKnow = {
      {"base", {"base"}},
      {"crossings", {"base", "crossings"}},
      {"groom", {"base", "groom"}},
      {"scene", {"base", "scene"}},
      {"bodies", {"base", "groom", "scene", "bodies"}},
      {"motion", {"base", "groom", "scene", "bodies", "motion"}},
      {"rest", {"base", "groom", "scene", "rest"}},
      {"scenes",
       {"base", "groom", "scene", "rest", "bodies", "motion", "measure", "output", "follow", "scenes"}},
      {"gpu", {"base", "gpu"}},
      {"solver", {"base", "groom", "scene", "rest", "gpu", "crossings", "solver"}},
      {"c", {"base", "groom", "scene", "bodies", "rest", "solver", "c"}},
      {"run",
       {"base", "groom", "scene", "rest", "bodies", "motion", "measure", "output", "solver", "scenes",
        "pictures", "run"}},
      {"pictures",
       {"base", "groom", "scene", "bodies", "motion", "measure", "output", "follow", "gpu", "solver",
        "render", "scenes", "pictures"}},
      {"measure", {"base", "groom", "rest", "scene", "bodies", "measure"}},
      {"output", {"base", "groom", "gpu", "motion", "output"}},
      {"follow", {"base", "groom", "scene", "rest", "bodies", "measure", "gpu", "solver", "follow"}},
      {"render", {"base", "bodies", "gpu", "render"}},
  };
  for (const auto& entry : fs::directory_iterator(kRoot / "src/ringlet")) {
    const std::string module = entry.path().filename();
    ASSERT_TRUE(mayKnow.count(module)) << module << " has no rule here";
    for (const fs::path& file : sourcesBelow("src/ringlet/" + module)) {
      std::set<std::string> known = mayKnow.at(module);
      const std::string stem = file.stem().string();
      const bool isOfFiles = module == "c" && (stem.rfind("io_", 0) == 0 || stem == "ringlet_io");
      if (isOfFiles) known.insert({"measure", "output", "run", "scenes"});
      for (const std::string& include : includesOf(file)) {
        const std::string other = moduleOf(include);
        EXPECT_TRUE(other.empty() || known.count(other)) << file << " includes " << include;
        EXPECT_NE(include.rfind("reference/", 0), 0u) << file << " includes the reference: " << include;
        EXPECT_NE(include.rfind("parity/", 0), 0u) << file << " includes " << include;
        EXPECT_NE(include.rfind("Eigen", 0), 0u) << file << " includes " << include;
        if (include.rfind("layout/", 0) == 0) {
          EXPECT_TRUE(module == "rest" || module == "solver" || module == "follow" || module == "render" ||
                      module == "pictures" || file.filename() == "packed.h" ||
                      file.filename() == "packed_contacts.h" || file.filename() == "contact_fields.cpp")
              << file << " includes " << include;
        }
      }
    }
  }
}

// It is written as a program of a user's would be, but for what is not installed.
TEST(IncludeRules, ThePythonModuleKnowsTheLibraryOnly) {
  const std::set<std::string> allowed = {"base", "groom",   "scene",  "scenes", "bodies", "motion",  "run",
                                         "rest", "measure", "output", "solver", "follow", "pictures"};
  for (const fs::path& file : sourcesBelow("src/python")) {
    for (const std::string& include : includesOf(file)) {
      const std::string module = moduleOf(include);
      EXPECT_TRUE(module.empty() || allowed.count(module)) << file << " includes " << include;
      for (const char* other : {"program/", "reference/", "parity/", "layout/", "Eigen"})
        EXPECT_NE(include.rfind(other, 0), 0u) << file << " includes " << include;
    }
  }
  for (const char* folder : {"src/ringlet", "src/program"})
    for (const fs::path& file : sourcesBelow(folder))
      for (const std::string& include : includesOf(file))
        EXPECT_NE(include.rfind("python/", 0), 0u) << file << " includes " << include;
}

// The window knows the library; what the program knows of it comes as a plan (view/viewer.h).
TEST(IncludeRules, TheViewKnowsNoProgram) {
  for (const fs::path& file : sourcesBelow("src/view")) {
    for (const std::string& include : includesOf(file))
      for (const char* other : {"program/", "reference/", "parity/", "Eigen"})
        EXPECT_NE(include.rfind(other, 0), 0u) << file << " includes " << include;
  }
  for (const fs::path& file : sourcesBelow("src/ringlet"))
    for (const std::string& include : includesOf(file))
      EXPECT_NE(include.rfind("view/", 0), 0u) << file << " includes " << include;
}

// A run of the program is the library's: what talks to the solver itself is in one folder.
TEST(IncludeRules, OnlyTheProgramsDevicesKnowTheSolver) {
  std::size_t count = 0;
  for (const fs::path& file : sourcesBelow("src/program")) {
    const bool isOfDevices = file.parent_path().filename() == "device";
    for (const std::string& include : includesOf(file)) {
      if (moduleOf(include) != "solver") continue;
      ++count;
      EXPECT_TRUE(isOfDevices) << file << " includes " << include;
    }
  }
  EXPECT_GT(count, 5u);
}

// Ranks are one more SceneHair: they know the library, and of the program only the run knows them.
TEST(IncludeRules, RanksAreKnownToTheRunAlone) {
  for (const fs::path& file : sourcesBelow("src/mpi")) {
    for (const std::string& include : includesOf(file))
      for (const char* other : {"program/", "reference/", "parity/", "view/", "Eigen"})
        EXPECT_NE(include.rfind(other, 0), 0u) << file << " includes " << include;
  }
  for (const char* folder : {"src/ringlet", "src/program", "src/view", "src/python", "src/parity"}) {
    for (const fs::path& file : sourcesBelow(folder)) {
      const bool isTheRun = file.filename() == "hair_maker.cpp" || file.filename() == "main.cpp";
      for (const std::string& include : includesOf(file))
        EXPECT_TRUE(isTheRun || include.rfind("mpi/", 0) != 0) << file << " includes " << include;
    }
  }
}

// Paths below src, from a list that CMake wrote: "a.h|b.h".
std::set<std::string> listed(const std::string& list) {
  std::set<std::string> paths;
  std::stringstream in(list);
  for (std::string path; std::getline(in, path, '|');) {
    paths.insert(fs::relative(path, kRoot / "src").generic_string());
  }
  EXPECT_GT(paths.size(), 10u) << list;
  return paths;
}

TEST(IncludeRules, InstalledHeadersIncludeInstalledOnes) {
  const std::set<std::string> core = listed(RINGLET_CORE_HEADERS);
  std::set<std::string> both = listed(RINGLET_IO_HEADERS);
  both.insert(core.begin(), core.end());
  for (const std::string& header : both) {
    const std::set<std::string>& seen = core.count(header) ? core : both;
    for (const std::string& include : includesOf(kRoot / "src" / header)) {
      const bool isOfC = include == "stddef.h" || include == "stdint.h";
      const bool isStandard =
          isOfC || (include.find('.') == std::string::npos && include.find('/') == std::string::npos);
      EXPECT_TRUE(isStandard || seen.count(include)) << header << " includes " << include;
    }
  }
}

TEST(IncludeRules, CoreKnowsNothingOfFiles) {
  const std::set<std::string> io = listed(RINGLET_IO_SOURCES);
  for (const std::string& source : listed(RINGLET_CORE_SOURCES)) {
    for (const std::string& include : includesOf(kRoot / "src" / source)) {
      EXPECT_FALSE(io.count(include)) << source << " includes " << include;
      for (const char* format : {"nlohmann/", "png.h", "tiny_gltf", "toml++", "zlib.h", "zstd"})
        EXPECT_NE(include.rfind(format, 0), 0u) << source << " includes " << include;
    }
  }
}

TEST(IncludeRules, ReferenceDerivesEverythingItself) {
  const std::set<std::string> allowed = {"base", "groom", "scene", "follow", "crossings"};
  for (const fs::path& file : sourcesBelow("reference")) {
    for (const std::string& include : includesOf(file)) {
      const std::string module = moduleOf(include);
      if (module.empty() || include == "ringlet/rest/material.h" || include == "ringlet/rest/goal.h" ||
          include == "ringlet/measure/core.h")
        continue;
      EXPECT_TRUE(allowed.count(module)) << file << " includes " << include;
    }
  }
}

}  // namespace
}  // namespace ringlet::test::include_rules_test
