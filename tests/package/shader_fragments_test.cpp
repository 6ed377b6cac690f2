// Every .glsl of shaders/ compiles by itself, with the definitions of each kernel that includes it: a
// fragment includes what it uses, and needs nothing to be declared before it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/test_support.h"

namespace ringlet::test::shader_fragments_test {
namespace {

const std::filesystem::path kShaders = std::filesystem::path(RINGLET_SOURCE_DIR) / "shaders";

using Names = std::set<std::string>;

struct KernelText {
  std::string stem;
  Names definitions;
};

std::vector<KernelText> kernelTexts() {
  std::vector<KernelText> texts;
  std::istringstream rows(RINGLET_KERNEL_TEXTS);
  for (std::string row; std::getline(rows, row, '|');) {
    std::istringstream words(row);
    KernelText text;
    words >> text.stem;
    for (std::string definition; words >> definition;) text.definitions.insert(definition);
    texts.push_back(text);
  }
  return texts;
}

std::string compiler(const Names& definitions) {
  std::string command = std::string(RINGLET_GLSLANG) + " -I" + kShaders.string() + " ";
  for (const std::string& definition : definitions) command += "-D" + definition + " ";
  return command;
}

// Relative to shaders/: the fragments whose text a kernel has, as the preprocessor names them.
Names fragmentsOf(const KernelText& kernel, const std::filesystem::path& folder) {
  const auto listed = folder / "preprocessed";
  const std::string file = (kShaders / "kernels" / (kernel.stem + ".comp")).string();
  const std::string command = compiler(kernel.definitions) + "-E " + file + " > " + listed.string();
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  Names fragments;
  std::ifstream lines(listed);
  for (std::string line; std::getline(lines, line);) {
    const auto begin = line.find(kShaders.string() + "/");
    const auto end = line.rfind(".glsl\"");
    if (!line.starts_with("#line") || begin == std::string::npos || end == std::string::npos) continue;
    const auto path = begin + kShaders.string().size() + 1;
    fragments.insert(line.substr(path, end - path) + ".glsl");
  }
  return fragments;
}

// The text of a file and of all it includes, whatever is defined.
void addText(const std::string& file, Names& seen, std::string& text) {
  if (!seen.insert(file).second) return;
  const std::string own = readText(kShaders / file);
  text += own;
  const std::string include = "#include \"";
  for (auto at = own.find(include); at != std::string::npos; at = own.find(include, at + 1)) {
    const auto begin = at + include.size();
    addText(own.substr(begin, own.find('"', begin) - begin), seen, text);
  }
}

// Those of the definitions that the fragment's text names.
Names definitionsFor(const std::string& fragment, const Names& definitions) {
  Names seen, named;
  std::string text;
  addText(fragment, seen, text);
  for (const std::string& definition : definitions)
    if (text.find(definition) != std::string::npos) named.insert(definition);
  return named;
}

bool compilesByItself(const std::string& fragment, const Names& definitions,
                      const std::filesystem::path& folder) {
  const auto alone = folder / "alone.comp";
  std::ofstream(alone) << "#version 450\n"
                          "#extension GL_GOOGLE_include_directive : require\n"
                          "#extension GL_EXT_control_flow_attributes : require\n"
                          "#include \""
                       << fragment << "\"\nvoid main() {}\n";
  const std::string command = compiler(definitions) + "--quiet --target-env vulkan1.1 -o " +
                              (folder / "alone.spv").string() + " " + alone.string();
  return std::system((command + " 1>&2").c_str()) == 0;
}

TEST(ShaderFragments, CompileByThemselves) {
  const auto folder = scratchFolder("shader_fragments");
  std::map<std::string, std::set<Names>> waysOf;  // a fragment's definitions, in one kernel and another
  for (const KernelText& kernel : kernelTexts())
    for (const std::string& fragment : fragmentsOf(kernel, folder))
      waysOf[fragment].insert(definitionsFor(fragment, kernel.definitions));
  for (const auto& [fragment, ways] : waysOf)
    for (const Names& definitions : ways)
      EXPECT_TRUE(compilesByItself(fragment, definitions, folder))
          << fragment << " with " << testing::PrintToString(definitions);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kShaders)) {
    if (entry.path().extension() != ".glsl") continue;
    const std::string fragment = entry.path().lexically_relative(kShaders).generic_string();
    EXPECT_TRUE(waysOf.contains(fragment)) << fragment << " is included by no kernel";
  }
}

// A compiler takes 1 for gl_WorkGroupSize where the size is declared further down.
TEST(ShaderFragments, WhatNamesTheWorkgroupsSizeIncludesIt) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kShaders)) {
    if (entry.path().extension() != ".glsl" || entry.path().stem() == "workgroup") continue;
    const std::string text = readText(entry.path());
    if (text.find("gl_WorkGroupSize") == std::string::npos) continue;
    EXPECT_LT(text.find("#include \"shared/workgroup.glsl\""), text.find("gl_WorkGroupSize")) << entry.path();
  }
}

}  // namespace
}  // namespace ringlet::test::shader_fragments_test
