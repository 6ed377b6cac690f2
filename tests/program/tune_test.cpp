// `ringlet tune`: what it measures, remembers and tells, and who uses it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "ringlet/solver/plan/shape_cost_file.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::tune_test {
namespace {

using nlohmann::json;
using test::RunningProgram;
using test::runProgram;
using test::scratchFolder;

// A cache folder of its own, two strands of 5 and 3 particles, and a device.
class Tune : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = scratchFolder("tune");
    const char* value = std::getenv("RINGLET_CACHE_DIR");
    if (value) before_ = value;
    setenv("RINGLET_CACHE_DIR", (folder_ / "cache").c_str(), 1);
    RINGLET_NEEDS_DEVICE(folder_);
    std::ofstream(folder_ / "groom.obj") << "v 0 0 0\nv 0 -1 0.2\nv 0.1 -2 0\nv 0 -3 0.1\nv 0 -4 0\n"
                                            "v 2 0 0\nv 2 -1 0\nv 2.1 -2 0\nl 1 2 3 4 5\nl 6 7 8\n";
  }
  void TearDown() override {
    before_.empty() ? unsetenv("RINGLET_CACHE_DIR") : setenv("RINGLET_CACHE_DIR", before_.c_str(), 1);
  }

  // Ends with its rounds, not with its time.
  json tune(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "tune");
    arguments.insert(arguments.end(), {"--strands", "2", "--seconds", "600", "--json"});
    const auto result = runProgram(folder_, arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return json::parse(result.out, nullptr, false);
  }

  json simulate(std::vector<std::string> arguments = {}) {
    arguments.insert(arguments.begin(),
                     {"simulate", "groom.obj", "--frames", "1", "--overwrite", "--json", "-o", "out"});
    const auto result = runProgram(folder_, arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    err_ = test::withoutCompileNotes(result.err);
    return json::parse(result.out, nullptr, false);
  }

  // The device as it would be remembered, with these costs.
  DeviceCosts here(std::vector<ShapeCost> costs) {
    const json run = simulate({"--untuned"});
    return {run["device"], run["driver"], strandKernelHash(), std::move(costs)};
  }

  void remember(const std::vector<DeviceCosts>& devices) {
    const Status written = writeShapeCosts(file(), devices);
    ASSERT_TRUE(written) << written.error().message;
  }

  std::filesystem::path file() const { return folder_ / "cache" / "strand_shapes.toml"; }

  std::filesystem::path folder_;
  std::string before_, err_;
};

TEST_F(Tune, RemembersWhatItMeasuredAndRunsUseIt) {
  EXPECT_EQ(simulate()["tuned"], false);
  const json tuned = tune({"--particles", "5"});
  EXPECT_EQ(tuned["file"], file().string());
  EXPECT_EQ(tuned["left_out"], 0);
  EXPECT_GE(tuned["rounds"].get<int>(), 3);
  ASSERT_GE(tuned["shapes"].size(), 2u);
  for (const json& shape : tuned["shapes"]) {
    EXPECT_EQ(shape["particles"], 5);
    EXPECT_GT(shape["ns_per_particle_step"].get<double>(), 0) << shape;
    EXPECT_GT(shape["model_ns_per_particle_step"].get<double>(), 0) << shape;
    EXPECT_LE(shape["difference"].get<double>(), 1e-5) << shape;
    EXPECT_NE(shape["against"], shape["shape"]);
  }
  EXPECT_EQ(tuned["shapes"].back()["shape"], "serial") << "with the longest strands";

  const auto known = readShapeCosts(file());
  ASSERT_TRUE(known) << known.error().message;
  ASSERT_EQ(known->size(), 1u);
  EXPECT_EQ(known->front().device, tuned["device"]);
  EXPECT_EQ(known->front().driver, tuned["driver"]);
  ASSERT_EQ(known->front().costs.size(), tuned["shapes"].size());
  for (std::size_t i = 0; i < known->front().costs.size(); ++i) {
    const ShapeCost& cost = known->front().costs[i];
    const double particles = cost.shape.serial() ? 1 : 5;
    EXPECT_EQ(cost.shape.describe(), tuned["shapes"][i]["shape"]);
    EXPECT_NEAR(cost.nanoseconds / particles / tuned["shapes"][i]["ns_per_particle_step"].get<double>(), 1,
                1e-12);
  }

  EXPECT_EQ(simulate()["tuned"], true);
  EXPECT_EQ(simulate({"--untuned"})["tuned"], false);
  const auto scene =
      runProgram(folder_, {"scene", "hanging_curl", "--particles", "5", "--seconds", "0.05", "--json"});
  EXPECT_EQ(json::parse(scene.out, nullptr, false)["tuned"], true) << scene.err;
  const auto untuned = runProgram(
      folder_, {"scene", "hanging_curl", "--particles", "5", "--seconds", "0.05", "--json", "--untuned"});
  EXPECT_EQ(json::parse(untuned.out, nullptr, false)["tuned"], false) << untuned.err;
}

// Of hair alone costs are remembered, of other work they are told.
TEST_F(Tune, EveryWorkIsTimed) {
  const std::vector<std::string> works{"alone", "contacts", "volume", "bodies"};
  const auto tuned = runProgram(folder_, {"tune", "--work", "bodies,alone,volume,contacts", "--particles",
                                          "9", "--strands", "64", "--seconds", "600", "--json"});
  EXPECT_EQ(tuned.exitCode, 0) << tuned.err;
  const json said = json::parse(tuned.out, nullptr, false);
  ASSERT_TRUE(said.is_object()) << tuned.err;
  std::vector<std::string> seen;
  std::vector<json> alone;
  for (const json& shape : said["shapes"]) {
    if (seen.empty() || seen.back() != shape["work"]) seen.push_back(shape["work"]);
    if (shape["work"] == "alone") alone.push_back(shape);
    EXPECT_GT(shape["ns_per_particle_step"].get<double>(), 0) << shape;
    EXPECT_LE(shape["difference"].get<double>(), shape["work"] == "bodies" ? 1e-4 : 1e-5) << shape;
  }
  EXPECT_EQ(seen, works) << "each work's shapes stand together";
  EXPECT_EQ(said["troubles"].size(), 0u) << said["troubles"];
  const auto known = readShapeCosts(file());
  ASSERT_TRUE(known) << known.error().message;
  ASSERT_EQ(known->size(), 1u);
  ASSERT_EQ(known->front().costs.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    const ShapeCost& cost = known->front().costs[i];
    const double ofParticle = cost.nanoseconds / (cost.shape.serial() ? 1 : 9);
    EXPECT_NEAR(ofParticle / alone[i]["ns_per_particle_step"].get<double>(), 1, 1e-12) << alone[i];
  }

  std::filesystem::remove(file());
  const json others = tune({"--work", "volume", "--particles", "9"});
  EXPECT_TRUE(others["file"].is_null()) << others;
  EXPECT_EQ(others["subgroup"], 0);
  EXPECT_FALSE(std::filesystem::exists(file())) << "nothing was measured of hair alone";
}

// A strand has no other to meet; hair alone is timed all the same.
TEST_F(Tune, HairThatMeetsNothingIsATrouble) {
  const auto result = runProgram(folder_, {"tune", "--work", "alone,contacts", "--particles", "5",
                                           "--strands", "1", "--seconds", "600", "--json"});
  EXPECT_EQ(result.exitCode, 1) << result.err;
  EXPECT_NE(result.err.find("contacts: strands of 5 particles"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("met nothing"), std::string::npos) << result.err;
  const json said = json::parse(result.out, nullptr, false);
  ASSERT_TRUE(said.is_object()) << result.err;
  EXPECT_GE(said["shapes"].size(), 2u);
  for (const json& shape : said["shapes"]) EXPECT_EQ(shape["work"], "alone") << shape;
  ASSERT_GE(said["troubles"].size(), 2u);
  for (const json& trouble : said["troubles"]) EXPECT_EQ(trouble["work"], "contacts") << trouble;
  EXPECT_EQ(said["file"], file().string()) << "of hair alone there was no trouble";
  EXPECT_TRUE(std::filesystem::exists(file()));
}

TEST_F(Tune, WhatIsKnownIsThereWhenItIsKilled) {
  const auto report = folder_ / "tune.json";
  RunningProgram program(folder_, {"tune", "--particles", "5", "--strands", "2", "--seconds", "600",
                                   "--quiet", "--report", "tune.json"});
  const auto known = [&] {
    const json said = json::parse(test::readText(report), nullptr, false);
    return said.is_object() ? said["shapes"].size() : 0;
  };
  EXPECT_TRUE(program.waitUntil([&] { return std::filesystem::exists(report) && known() >= 1; }));
  program.send(SIGKILL);
  program.wait();
  const json said = json::parse(test::readText(report), nullptr, false);
  ASSERT_TRUE(said.is_object()) << "it is whole at every moment";
  EXPECT_EQ(said["shapes"][0]["particles"], 5);
  EXPECT_TRUE(said["file"].is_null());
  EXPECT_FALSE(std::filesystem::exists(file()));
}

// A shape that the driver does not make. The layer (tests/fault_layer) lets the third kernel fail and all
// after it.
TEST_F(Tune, AShapeThatFailsIsNotedAndTheOthersAreTimed) {
  setenv("VK_LAYER_PATH", RINGLET_LAYER_DIR, 1);
  setenv("VK_INSTANCE_LAYERS", "VK_LAYER_RINGLET_fault", 1);
  setenv("RINGLET_FAULT", "vkCreateComputePipelines:3:-13", 1);
  const auto result = runProgram(folder_, {"tune", "--particles", "5", "8", "--strands", "2", "--seconds",
                                           "600", "--report", "tune.json"});
  unsetenv("RINGLET_FAULT");
  unsetenv("VK_INSTANCE_LAYERS");
  EXPECT_EQ(result.exitCode, 11) << result.err;
  EXPECT_NE(result.err.find("nothing was remembered"), std::string::npos) << result.err;
  const json said = json::parse(test::readText(folder_ / "tune.json"), nullptr, false);
  ASSERT_TRUE(said.is_object()) << result.err;
  EXPECT_GE(said["shapes"].size(), 1u);
  EXPECT_GE(said["troubles"].size(), 1u);
  EXPECT_EQ(said["shapes"].size() + said["troubles"].size(), 5u);
  for (const json& shape : said["shapes"]) EXPECT_GT(shape["ns_per_particle_step"].get<double>(), 0) << shape;
  for (const json& trouble : said["troubles"])
    EXPECT_NE(trouble["message"].get<std::string>().find(trouble["shape"]), std::string::npos) << trouble;
  EXPECT_FALSE(std::filesystem::exists(file()));
}

// Each of three shapes, whichever is the fastest in truth.
TEST_F(Tune, ShapesAreChosenByTheFile) {
  const std::vector<StrandShape> shapes{{1, 5}, {2, 4}, kAnySerialShape};
  const DeviceCosts device = here({});
  for (const StrandShape& cheap : shapes) {
    DeviceCosts stated = device;
    for (const StrandShape& shape : shapes) stated.costs.push_back({shape, shape == cheap ? 1e-3 : 1e9});
    remember({stated});
    const json run = simulate();
    EXPECT_EQ(run["kernel"].get<std::string>().find(cheap.describe()), 0u) << run["kernel"];
    EXPECT_EQ(run["tuned"], true);
    EXPECT_EQ(err_, "");
  }
}

TEST_F(Tune, IsUsedForHairAloneWhereThereIsAChoice) {
  remember({here({{{1, 5}, 10}, {{2, 4}, 20}})});
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--contacts", "on"},
                                                    {"--integrator", "paper"},
                                                    {"--kernel", "serial"},
                                                    {"--lanes", "2", "--run", "5"},
                                                    {"--backend", "reference"}}) {
    EXPECT_EQ(simulate(arguments)["tuned"], false) << arguments.front();
  }
  EXPECT_EQ(simulate({"--lanes", "2"})["tuned"], true);
}

TEST_F(Tune, OtherDevicesDriversAndKernelsAreLeftAside) {
  const DeviceCosts device = here({{{2, 4}, 1}, {kAnySerialShape, 1e9}});
  DeviceCosts otherDevice = device, otherDriver = device, otherKernels = device;
  otherDevice.device = "Voodoo 2", otherDriver.driver = "none 1.0", otherKernels.kernels = "0123456789abcdef";
  remember({otherDevice});
  EXPECT_EQ(simulate()["tuned"], false);
  EXPECT_EQ(err_, "");
  for (const DeviceCosts& other : {otherDriver, otherKernels}) {
    remember({other});
    const json run = simulate();
    EXPECT_EQ(run["tuned"], false);
    EXPECT_EQ(run["warnings"], json::array());
    EXPECT_NE(err_.find("was tuned with another driver or ringlet"), std::string::npos) << err_;
  }
  const auto quiet =
      runProgram(folder_, {"simulate", "groom.obj", "--frames", "1", "--quiet", "--overwrite", "-o", "out"});
  EXPECT_EQ(quiet.err, "");

  // They stay beside what is measured here, and old figures of this device go.
  remember({otherDevice, otherDriver, otherKernels, device});
  tune({"--particles", "5"});
  const auto known = readShapeCosts(file());
  ASSERT_TRUE(known) << known.error().message;
  ASSERT_EQ(known->size(), 4u);
  EXPECT_TRUE(known->front().isOf(device));
  EXPECT_EQ(known->front().costs.size(), 3u);
  EXPECT_EQ((*known)[1].device, "Voodoo 2");
}

TEST_F(Tune, BrokenFileIsAWarningAndReplaced) {
  std::filesystem::create_directories(folder_ / "cache");
  std::ofstream(file()) << "[[device]]\nname = \"x\"\n[[device";
  const json run = simulate();
  EXPECT_EQ(run["tuned"], false);
  ASSERT_EQ(run["warnings"].size(), 1u);
  const std::string warning = run["warnings"][0];
  EXPECT_NE(warning.find(file().string() + ": line 3"), std::string::npos) << warning;
  EXPECT_NE(err_.find("left aside"), std::string::npos) << err_;
  EXPECT_EQ(simulate({"--untuned"})["warnings"], json::array());

  tune({"--particles", "5"});
  EXPECT_EQ(simulate()["tuned"], true);
}

TEST_F(Tune, TakesLengthsFromAGroom) {
  std::vector<int> particles;
  const json tuned = tune({"groom.obj"});
  for (const json& shape : tuned["shapes"]) particles.push_back(shape["particles"]);
  EXPECT_EQ(std::set<int>(particles.begin(), particles.end()), (std::set<int>{3, 5}));
  EXPECT_TRUE(std::ranges::is_sorted(particles));
}

TEST_F(Tune, TableIsShownWhereItCannotBeKept) {
  std::ofstream(folder_ / "cache") << "no folder";
  const auto result = runProgram(folder_, {"tune", "--particles", "5", "--strands", "2", "--seconds", "0.1"});
  EXPECT_EQ(result.exitCode, 5);
  EXPECT_NE(result.out.find("lanes 1 x 5"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("remembered"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("strand_shapes.toml"), std::string::npos) << result.err;
}

// However quick the device is, every shape is timed or told to be left out, and the first two are timed.
TEST_F(Tune, TimeIsBounded) {
  const auto result =
      runProgram(folder_, {"tune", "--particles", "5", "8", "--strands", "2", "--seconds", "0.1", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const json tuned = json::parse(result.out, nullptr, false);
  const std::size_t timed = tuned["shapes"].size(), leftOut = tuned["left_out"];
  EXPECT_EQ(timed + leftOut, 5u) << tuned;
  EXPECT_GE(timed, 2u);
  EXPECT_EQ(tuned["shapes"][0]["against"], tuned["shapes"][1]["shape"]);
  EXPECT_EQ(leftOut > 0, result.err.find("give it more with --seconds") != std::string::npos) << result.err;
}

TEST_F(Tune, WrongCommandLinesAndHairAreRefused) {
  struct Case {
    std::vector<std::string> arguments;
    int exitCode;
    std::string message;
  };
  for (const Case& c : {
           Case{{"--particles", "1"}, 2, "--particles: must be a whole number from 2 to 3000"},
           Case{{"--particles", "16", "many"}, 2, "--particles: must be a whole number from 2 to 3000"},
           Case{{"--seconds", "0"}, 2, "--seconds: must be a number from 0.1"},
           Case{{"--strands", "0"}, 2, "--strands: must be a whole number from 1"},
           Case{{"groom.obj", "--particles", "5"}, 2, "excludes"},
           Case{{"--particle", "5"}, 2, "did you mean --particles?"},
           Case{{"none.obj"}, 4, "none.obj: cannot read it"},
           Case{{"--device", "Voodoo 2"}, 1, "Voodoo 2"},
           Case{{"--particles", "3000", "--strands", "1"}, 1, "nothing to choose"},
       }) {
    std::vector<std::string> arguments{"tune"};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const auto result = runProgram(folder_, arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find(c.message), std::string::npos) << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(file()));
}

}  // namespace
}  // namespace ringlet::tune_test
