// `ringlet conform`: what it reports, and that it notices a wrong kernel.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::conform_test {
namespace {

using nlohmann::json;
using test::RunningProgram;
using test::runProgram;
using test::scratchFolder;

class Conform : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = scratchFolder("conform");
    RINGLET_NEEDS_DEVICE(folder_);
  }

  test::ProgramResult conform(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"conform", "--quick", "--json", "report.json"});
    const auto result = runProgram(folder_, arguments);
    report_ = json::parse(test::readText(folder_ / "report.json"), nullptr, false);
    return result;
  }

  // Names of the checks that are wrong, a line each.
  std::string wrong() const {
    std::string names;
    for (const json& check : report_["checks"]) {
      if (check["outcome"] == "WRONG") names += check["name"].get<std::string>() + "\n";
    }
    return names;
  }

  // With an error in this kernel the report says so, and what is wrong are the checks that have one of these
  // words.
  void expectNoticed(const std::string& kernel, const std::vector<std::string>& words) {
    const auto result = conform({"--break", kernel});
    EXPECT_EQ(result.exitCode, 1) << result.out << result.err;
    EXPECT_TRUE(result.out.ends_with("\ndoes not conform\n")) << result.out;
    ASSERT_TRUE(report_.is_object());
    EXPECT_EQ(report_["conforms"], false);
    std::set<std::string> found;
    for (const json& check : report_["checks"]) {
      if (check["outcome"] != "WRONG") continue;
      const std::string name = check["name"];
      const auto word = std::ranges::find_if(
          words, [&](const std::string& one) { return name.find(one) != std::string::npos; });
      EXPECT_NE(word, words.end()) << name << " is wrong without a reason";
      if (word != words.end()) found.insert(*word);
    }
    EXPECT_EQ(found.size(), words.size()) << wrong();
  }

  std::filesystem::path folder_;
  json report_;
};

TEST_F(Conform, WhatIsKnownIsThereWhenItIsKilled) {
  const auto file = folder_ / "report.json";
  RunningProgram program(folder_, {"conform", "--json", "report.json"});
  const auto known = [&] {
    const json report = json::parse(test::readText(file), nullptr, false);
    return report.is_object() ? report["checks"].size() : 0;
  };
  EXPECT_TRUE(program.waitUntil([&] { return std::filesystem::exists(file) && known() >= 2; }));
  program.send(SIGKILL);
  program.wait();
  report_ = json::parse(test::readText(file), nullptr, false);
  ASSERT_TRUE(report_.is_object()) << "it is whole at every moment";
  EXPECT_GE(report_["checks"].size(), 2u);
  EXPECT_TRUE(report_["conforms"].is_null());
  EXPECT_FALSE(report_["facts"]["device"].is_null());
}

TEST_F(Conform, AReportThatCannotBeWrittenIsSaidAtOnce) {
  const auto result = runProgram(folder_, {"conform", "--json", "none/report.json"});
  EXPECT_EQ(result.exitCode, 5) << result.err;
  EXPECT_EQ(result.out.find(" right "), std::string::npos) << result.out;
}

TEST_F(Conform, ThisDeviceDoes) {
  const auto result = conform({});
  EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  EXPECT_TRUE(result.out.ends_with("\nconforms\n")) << result.out;
  ASSERT_TRUE(report_.is_object());
  EXPECT_EQ(report_["conforms"], true);
  EXPECT_EQ(report_["quick"], true);
  EXPECT_EQ(wrong(), "");
  for (const char* fact :
       {"ringlet", "commit", "os", "device", "driver", "vulkan", "subgroup", "heaps", "timestamps"})
    EXPECT_FALSE(report_["facts"][fact].is_null()) << fact;
  std::string names;
  for (const json& check : report_["checks"]) {
    names += check["name"].get<std::string>() + "\n";
    if (check["outcome"] != "right" || check["tolerance"].is_null()) continue;
    EXPECT_LE(check["figure"].get<double>(), check["tolerance"].get<double>()) << check;
  }
  for (const char* part : {"shuffles", "loop exits", "turns", "bits of small integers", "running sums",
                           "atomics", "indirect", "hair alone", "serial: a step", "serial: a frame",
                           "the same bits again", "without texels", "contact lists"})
    EXPECT_NE(names.find(part), std::string::npos) << part << " is not checked:\n" << names;
}

TEST_F(Conform, NoticesAWrongStrandKernel) { expectNoticed("strand_step", {"a step", "a frame"}); }
TEST_F(Conform, NoticesWrongContactLists) { expectNoticed("contact_query", {"contact lists"}); }
TEST_F(Conform, NoticesAWrongProbe) { expectNoticed("probe_turns", {"a loop of 65000 turns"}); }

TEST_F(Conform, WrongUsageIsSaid) {
  const auto result = runProgram(folder_, {"conform", "--quik"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_NE(result.err.find("did you mean --quick?"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace ringlet::conform_test
