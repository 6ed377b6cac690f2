// Mirrors ringlet/run/step_dump.h.
#include "ringlet/run/step_dump.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "ringlet/run/scene_run.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/solver/diagnostics.h"
#include "tests/support/gpu_test.h"
#include "tests/support/test_support.h"

namespace ringlet::step_dump_test {
namespace {

namespace fs = std::filesystem;

class StepDump : public test::GpuTest {
 protected:
  static LoadedScene sceneOf(const std::string& more) {
    const auto file = parseScene(
        "[groom]\ngenerate = \"swatch\"\ncolumns = 2\nrows = 2\nparticles = 12\nturns = 2\n"
        "[motion]\nkind = \"shake\"\n" +
            more,
        "scene.toml");
    EXPECT_TRUE(file) << file.error().message;
    auto scene = loadScene(*file);
    EXPECT_TRUE(scene) << scene.error().message;
    scene->frameCount = 3;
    return std::move(*scene);
  }
  // What the device holds after so many frames, stepped as wholes.
  std::vector<BufferContent> afterFrames(const LoadedScene& scene, int frames) {
    const SceneFrames all(scene);
    const auto asset = buildAsset(device(), scene);
    EXPECT_TRUE(asset);
    auto hair = Simulation::create(*asset, stateOf(all.placesAt(all.first()), scene));
    EXPECT_TRUE(hair);
    for (int frame = all.first(); frame < frames; ++frame) EXPECT_TRUE(stepScene(all, *hair, frame));
    return *Diagnostics(*hair).bufferContents();
  }
  static std::string textOf(const std::vector<BufferContent>& contents, const std::string& name) {
    const auto found = std::ranges::find(contents, name, &BufferContent::name);
    EXPECT_NE(found, contents.end()) << name;
    if (found == contents.end()) return {};
    return {reinterpret_cast<const char*>(found->bytes.data()), found->bytes.size()};
  }

  const fs::path folder_ = test::scratchFolder("step_dump");
};

// After a frame's last step hair is where the whole frame brings it, and a step before it is elsewhere.
TEST_F(StepDump, HoldsWhatTheRunHasThen) {
  for (const char* more : {"", "pre_roll = 0.1\n", "[contacts]\non = true\n"}) {
    SCOPED_TRACE(more);
    const LoadedScene scene = sceneOf(more);
    const std::vector<BufferContent> run = afterFrames(scene, 2);
    const auto steps = 2 * static_cast<std::uint64_t>(scene.settings.stepsPerFrame);
    fs::remove_all(folder_);
    for (const std::uint64_t step : {steps - 1, steps}) {
      const Status dumped = dumpStep(scene, {device()}, step, folder_ / std::to_string(step));
      ASSERT_TRUE(dumped) << dumped.error().message;
    }
    for (const char* name : {"positions", "velocities"}) {
      const auto read = [&](std::uint64_t step) {
        return test::readText(folder_ / std::to_string(step) / (std::string(name) + ".bin"));
      };
      EXPECT_TRUE(read(steps) == textOf(run, name)) << name;
      EXPECT_FALSE(read(steps - 1) == textOf(run, name)) << name;
    }
    const std::string list = test::readText(folder_ / std::to_string(steps) / "buffers.txt");
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(list, '\n')), run.size());
    for (const BufferContent& buffer : run) {
      std::string file = buffer.name + ".bin";
      std::ranges::replace(file, ' ', '_');
      EXPECT_NE(list.find(" " + file + "\n"), std::string::npos) << file;
      EXPECT_EQ(fs::file_size(folder_ / std::to_string(steps) / file), buffer.bytes.size()) << file;
    }
  }
}

TEST_F(StepDump, WhatCannotBeWrittenIsSaid) {
  const LoadedScene scene = sceneOf("");
  const auto tooMany = dumpStep(scene, {device()}, 1000, folder_ / "far");
  ASSERT_FALSE(tooMany);
  test::expectParts(tooMany.error().message, {"after step 1000", "the scene has"});
  EXPECT_FALSE(fs::exists(folder_ / "far"));
  fs::create_directories(folder_ / "there");
  const auto there = dumpStep(scene, {device()}, 1, folder_ / "there");
  ASSERT_FALSE(there);
  test::expectParts(there.error().message, {"there", "name another folder"});
}

}  // namespace
}  // namespace ringlet::step_dump_test
