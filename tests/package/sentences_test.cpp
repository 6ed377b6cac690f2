// Sentences of the library reach programs in C and Python: they name nothing that is C++'s, and the command's
// options only in forms that base/host_words.h says in other words. Reads every text of the sources.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "ringlet/base/host_words.h"

namespace ringlet::test::sentences_test {
namespace {

namespace fs = std::filesystem;
const fs::path kLibrary = fs::path(RINGLET_SOURCE_DIR) / "src/ringlet";

struct Text {
  fs::path file;
  std::string text;
};

// Without lines that are comments, includes and assertions, whose texts only those read who wrote the call in
// C++.
std::string codeOf(const fs::path& file) {
  std::ifstream in(file);
  std::string code{std::istreambuf_iterator<char>(in), {}};
  code = std::regex_replace(code, std::regex("(^|\n)[ \t]*(//|#include)[^\n]*"), "$1");
  std::string kept;
  std::size_t at = 0;
  for (std::size_t found; (found = code.find("RINGLET_ASSERT(", at)) != code.npos;) {
    kept += code.substr(at, found - at);
    at = std::min(code.find(");", found), code.size());
  }
  return kept + code.substr(std::min(at, code.size()));
}

// Neighbours are one text, as for the compiler.
std::vector<Text> textsOf(const fs::path& file) {
  static const std::regex text("\"((?:[^\"\\\\\n]|\\\\.)*)\"(?:\\s*\"((?:[^\"\\\\\n]|\\\\.)*)\")*");
  static const std::regex part("\"((?:[^\"\\\\\n]|\\\\.)*)\"");
  std::vector<Text> texts;
  const std::string code = codeOf(file);
  for (std::sregex_iterator at(code.begin(), code.end(), text), end; at != end; ++at) {
    std::string whole;
    const std::string found = at->str();
    for (std::sregex_iterator each(found.begin(), found.end(), part); each != end; ++each)
      whole += (*each)[1];
    texts.push_back({fs::relative(file, kLibrary), std::regex_replace(whole, std::regex(R"(\\")"), "\"")});
  }
  return texts;
}

std::vector<Text> readSentences() {
  std::vector<Text> all;
  for (const auto& entry : fs::recursive_directory_iterator(kLibrary)) {
    const auto extension = entry.path().extension();
    if (extension != ".cpp" && extension != ".h") continue;
    for (Text& text : textsOf(entry.path()))
      if (text.text.find(' ') != std::string::npos) all.push_back(std::move(text));
  }
  return all;
}
const std::vector<Text>& sentences() {
  static const std::vector<Text> all = readSentences();
  return all;
}

TEST(Sentences, NameNothingOfCpp) {
  // C and Python say these themselves before the library can.
  const std::set<std::string> spoken = {"KernelChoice::link"};
  const std::regex name(
      R"(\b[A-Z]\w+::\w+|\b(metresPerUnit|firstPoint|stepsPerFrame|frameIsOver|readsBack|stepPoses)\b)");
  std::size_t count = 0;
  for (const Text& text : sentences()) {
    ++count;
    for (std::sregex_iterator at(text.text.begin(), text.text.end(), name), end; at != end; ++at)
      EXPECT_TRUE(spoken.contains(at->str())) << text.file << ": " << text.text;
  }
  EXPECT_GT(count, 500u);
}

TEST(Sentences, NameOptionsThatHaveOtherWords) {
  // Of other programs, or of runs of the command, which no host has; and help of scene files names the
  // command.
  const std::regex others(R"(`[^`]*`|--(summary|flatten|fix|camera|list|overwrite)\b)");
  const std::regex help("scene_fields|scene_text|host_words");
  std::size_t count = 0;
  for (const Text& text : sentences()) {
    if (text.text.find("--") == std::string::npos || std::regex_search(text.file.string(), help)) continue;
    std::string sentence = std::regex_replace(text.text, others, "");
    sentence = std::regex_replace(sentence, std::regex(R"(\{[0-9]*(:[^}]*)?\})"), "7");
    if (sentence.find("--") == std::string::npos) continue;
    ++count;
    EXPECT_EQ(inSceneWords(sentence).find("--"), std::string::npos) << text.file << ": " << text.text;
  }
  EXPECT_GT(count, 10u);
}

}  // namespace
}  // namespace ringlet::test::sentences_test
