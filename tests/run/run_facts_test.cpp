// program/run_facts.h: what a run that is resumed must have as before.
#include "ringlet/run/run_facts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/test_support.h"

namespace ringlet::run_facts_test {
namespace {

TEST(RunFacts, EveryFileThatMovesHairIsAnInput) {
  SceneFile scene;
  scene.groom.file = "groom";
  scene.groom.scalp = "scalp of roots";
  scene.motion.file = "motion";
  scene.scalp.file = "skinned scalp";
  scene.goalFile = "goal";
  scene.bodies.resize(1);
  scene.bodies[0].file = "body";
  scene.bodies[0].moves.emplace().file = "motion of a body";
  scene.maps.resize(1);
  scene.maps[0].file = "map";
  scene.maps[0].texture = "texture";
  scene.fields.resize(1);
  scene.fields[0].file = "field";
  scene.output.hairScalpFile = "scalp of hairs";
  scene.cameras.resize(1);
  scene.cameras[0].file = "camera";
  const auto inputs = inputFilesOf("input", scene);
  for (const char* file : {"input", "groom", "scalp of roots", "motion", "skinned scalp", "goal", "body",
                           "motion of a body", "map", "texture", "field", "scalp of hairs"})
    EXPECT_NE(std::ranges::find(inputs, file), inputs.end()) << file;
  EXPECT_EQ(inputs.size(), 12u) << "a camera moves nothing";
}

// Every file of a scene, and every file that one of them names.
TEST(RunFacts, EveryFileCountsByItsContent) {
  const std::filesystem::path folder = test::scratchFolder("run_facts");
  std::filesystem::create_directory(folder / "below");
  std::vector<std::filesystem::path> files;
  const auto write = [&](const std::string& name, const std::string& text) {
    files.push_back(folder / name);
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
  };
  // A glTF file with a buffer beside it, one inside it, and one below it, whose name is escaped.
  const auto writeGltf = [&](const std::string& name) {
    const std::string stem = name.substr(0, name.find('.'));
    write(stem + ".bin", "way");
    write("below/" + stem + " way.bin", "way");
    return write(name, "{\"asset\": {\"version\": \"2.0\"}, \"buffers\": [{\"byteLength\": 3, \"uri\": \"" +
                           stem +
                           ".bin\"}, {\"byteLength\": 3, \"uri\": "
                           "\"data:application/octet-stream;base64,AAAA\"}, {\"byteLength\": 3, "
                           "\"uri\": \"below/" +
                           stem + "%20way.bin\"}]}");
  };
  SceneFile scene;
  scene.groom.file = write("groom.obj", "groom");
  scene.groom.scalp = write("scalp.obj", "scalp");
  scene.motion.file = writeGltf("motion.gltf");
  scene.scalp.file = writeGltf("skin.of_any_name");
  scene.goalFile = write("goal.usda", "goal");
  scene.output.hairScalpFile = write("hairs.obj", "hairs");
  scene.bodies.resize(3);
  scene.bodies[0].file = writeGltf("body.GLTF");
  scene.bodies[0].moves.emplace().file = writeGltf("moves.vrm");
  scene.bodies[1].moves.emplace().file = write("moves.bvh", "moves");
  // A layer with value clips, stated and by a template.
  for (const char* clip : {"clip.usda", "below/clip.1.usda", "below/clip.2.usda"}) write(clip, "clip");
  scene.bodies[2].file = write(
      "clipped.usda",
      "#usda 1.0\ndef Mesh \"M\" ( clips = {\n dictionary a = { string primPath = \"/M\"\n asset[] assetPaths = "
      "[@clip.usda@]\n double2[] active = [(1, 0)] }\n dictionary b = { string primPath = \"/M\"\n string "
      "templateAssetPath = \"below/clip.#.usda\"\n double templateStartTime = 1\n double templateEndTime = 2\n "
      "double templateStride = 1 } } ) {}\n");
  scene.maps.resize(2);
  scene.maps[0].file = write("map.txt", "map");
  scene.maps[1].texture = write("map.png", "picture");
  scene.fields.resize(1);
  scene.fields[0].file = write("field.txt", "field");

  const auto facts = [&] {
    const auto found = factsOf(scene, inputFilesOf({}, scene));
    EXPECT_TRUE(found) << found.error().message;
    return found ? *found : std::vector<RunFact>{};
  };
  const auto before = facts();
  EXPECT_EQ(files.size(), 24u);
  for (const auto& file : files) {
    const std::string bytes = test::readText(file);
    std::ofstream(file, std::ios::binary) << bytes + " ";  // JSON and USD as before, where it is that
    std::vector<std::string> differ;
    const auto after = facts();
    ASSERT_EQ(after.size(), before.size()) << file;
    for (std::size_t k = 0; k < after.size(); ++k)
      if (after[k].value != before[k].value) differ.push_back(after[k].name);
    EXPECT_EQ(differ, std::vector<std::string>{"the content of " + file.string()});
    std::ofstream(file, std::ios::binary) << bytes;
  }
}

}  // namespace
}  // namespace ringlet::run_facts_test
