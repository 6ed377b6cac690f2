// What --help says of --json, of every command that has such a list: no key is without a line, no line
// without a sentence. Keys of objects count with the place they are in.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/program/run_program.h"

namespace ringlet::program::report_keys_test {
namespace {

using nlohmann::json;
using test::runProgram;

constexpr std::size_t kSentenceAt = 28;           // the column in which a key's sentence begins
const std::set<std::string> kFree{".stages_ms"};  // whose keys are names of stages

// Lists of keys as they stand in help, by place: ".worst.droop_mm".
class Keys {
 public:
  void read(const std::string& help) {
    std::istringstream lines(help);
    bool isList = false;
    std::vector<std::string> places;  // of the last key of every depth
    for (std::string line; std::getline(lines, line);) {
      isList = line.starts_with("--json keys") || (isList && line.starts_with("  "));
      if (isList && line.starts_with("  ")) add(line, places);
    }
  }

  std::size_t count() const { return sentences_.size(); }

  // Names every key of the object that no line is of.
  void expectIn(const json& value, const std::string& place, std::set<std::string>& seen) const {
    if (value.is_array()) {
      for (const json& element : value) expectIn(element, place, seen);
    }
    if (!value.is_object() || kFree.count(place)) return;
    for (const auto& [key, part] : value.items()) {
      const auto same = sameAs_.find(place);
      std::string at = place + "." + key;
      if (same != sameAs_.end() && !sentences_.count(at) && sentences_.count(same->second + "." + key))
        at = same->second + "." + key;
      EXPECT_TRUE(sentences_.count(at)) << "no line of a help is of " << at;
      seen.insert(at);
      expectIn(part, at, seen);
    }
  }

  // Names every key of which no object was.
  void expectOnly(const std::set<std::string>& seen) const {
    for (const auto& [place, sentence] : sentences_)
      EXPECT_TRUE(seen.count(place)) << "no object had " << place << ": " << sentence;
  }

 private:
  void add(const std::string& line, std::vector<std::string>& places) {
    const std::size_t indent = line.find_first_not_of(' '), end = line.find(' ', indent);
    const std::string key = line.substr(indent, end - indent);
    const std::size_t depth = indent / 2 - 1;
    ASSERT_LE(depth, places.size()) << line;
    places.resize(depth);
    const std::string place = (places.empty() ? "" : places.back()) + "." + key;
    places.push_back(place);
    ASSERT_EQ(line.find_first_not_of(' ', end), kSentenceAt) << line;
    const std::string sentence = line.substr(kSentenceAt);
    EXPECT_TRUE(std::regex_search(sentence, std::regex("\\.( \\(the keys of \\w+\\))?( \\[\\S+\\])?$|:$")))
        << line;
    sentences_.emplace(place, sentence);
    std::smatch same;
    if (!std::regex_search(sentence, same, std::regex("the keys of (\\w+)"))) return;
    for (const auto& [other, ignored] : sentences_)
      if (other != place && other.ends_with("." + same[1].str())) sameAs_.emplace(place, other);
    EXPECT_TRUE(sameAs_.count(place)) << line;
  }

  std::map<std::string, std::string> sentences_;
  std::map<std::string, std::string> sameAs_;  // places whose keys are those of another
};

class ReportKeys : public testing::Test {
 protected:
  json said(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    const auto result = runProgram(folder_, arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return json::parse(result.out, nullptr, false);
  }

  // All keys of these objects have lines in the help of these commands, and all lines of one command are of
  // keys.
  void expectInHelp(const std::vector<const char*>& commands,
                    const std::vector<std::vector<std::string>>& runs) {
    Keys keys;
    for (const char* command : commands) keys.read(runProgram(folder_, {command, "--help"}).out);
    EXPECT_GT(keys.count(), 5u);
    std::set<std::string> seen;
    for (const auto& arguments : runs) {
      SCOPED_TRACE(testing::PrintToString(arguments));
      const json object = said(arguments);
      EXPECT_TRUE(object.is_object());
      keys.expectIn(object, "", seen);
    }
    if (commands.size() == 1) keys.expectOnly(seen);
  }

  void make(const std::string& file) {
    ASSERT_EQ(runProgram(folder_, {"make", "swatch", "--columns", "4", "--rows", "1", "-o", file}).exitCode,
              0);
  }
  void simulate(const std::string& contacts) {
    ASSERT_EQ(runProgram(folder_, {"simulate", "groom.obj", "--backend", "reference", "--frames", "2",
                                   "--motion", "shake", "--contacts", contacts, "-o", contacts})
                  .exitCode,
              0);
  }

  std::filesystem::path folder_ = test::scratchFolder("report_keys");
};

TEST_F(ReportKeys, OfSimulateAndScene) {
  make("groom.obj");
  std::ofstream(folder_ / "scene.toml")
      << "[groom]\nfile = 'groom.obj'\n[[body]]\nshape = 'plane'\nposition = [0, -9, 0]\n";
  expectInHelp({"simulate"}, {{"simulate", "scene.toml", "--backend", "reference", "--frames", "1",
                               "--contacts", "on", "--no-crossings", "-o", "out"}});
  expectInHelp({"simulate", "measure", "scene"},
               {{"scene", "hanging_curl", "--backend", "reference", "--seconds", "0.05"},
                {"scene", "--list"},
                {"scene", "--keys"},
                {"scene", "bounce", "--write", "bounce.toml"}});
}

TEST_F(ReportKeys, OfMeasure) {
  make("groom.obj");
  for (const char* contacts : {"off", "explicit"}) simulate(contacts);
  if (std::system("command -v gnuplot > /dev/null") != 0)
    GTEST_SKIP() << "SKIPPED: gnuplot is not installed, so that not every key is there";
  ASSERT_EQ(runProgram(folder_, {"measure", "--benchmark", "bench", "--write"}).exitCode, 0);
  std::filesystem::copy_file(folder_ / "bench/hang_8/carried.usdc", folder_ / "bench/hang_8/hair.usdc");
  expectInHelp({"measure"}, {{"measure", "groom.obj", "explicit", "--against", "explicit", "--without", "off",
                              "--strands", "--plot", "plot.svg"},
                             {"measure", "--benchmark", "bench"}});
}

TEST_F(ReportKeys, OfInfo) {
  make("groom.obj");
  simulate("off");
  expectInHelp({"info"}, {{"info", "groom.obj", "--fix", "fixed.obj"},
                          {"info", "groom.obj", "--unit", "0.02"},
                          {"info", "off/hair.usda"}});
}

TEST_F(ReportKeys, OfConvert) {
  make("groom.obj");
  simulate("off");
  expectInHelp({"convert"}, {{"convert", "off/hair.usda", "hair.rgc"},
                             {"convert", "off/hair.usda", "--info"},
                             {"convert", "groom.obj", "groom.hair"}});
}

TEST_F(ReportKeys, OfRender) {
  RINGLET_NEEDS_DEVICE(folder_);
  make("groom.obj");
  simulate("off");
  expectInHelp({"render"}, {{"render", "off", "--groom", "groom.obj", "--size", "64x48", "--samples", "1",
                             "--frames", "1:1", "--ground", "--colour", "stretch", "-o", "pictures"}});
}

}  // namespace
}  // namespace ringlet::program::report_keys_test
