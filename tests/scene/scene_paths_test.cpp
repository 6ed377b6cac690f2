// Paths of scene files: all of them are known, and a confined scene names none outside of its folder.
#include "ringlet/scenes/scene_paths.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/test_support.h"

namespace ringlet {
namespace {

namespace fs = std::filesystem;

// A scene with one path, PATH, a key of the program's own table each; `key` as messages have it.
struct PathCase {
  std::string key, scene;
};
std::vector<PathCase> pathCases() {
  const std::string groom = "[groom]\nfile = 'groom.obj'\n";
  return {
      {"groom.file", "[groom]\nfile = 'PATH'\n"},
      {"groom.scalp", "[groom]\ngenerate = 'head'\nscalp = 'PATH'\n"},
      {"motion.file", groom + "[motion]\nfile = 'PATH'\n"},
      {"scalp.file", groom + "[scalp]\nfile = 'PATH'\n"},
      {"goal.file", groom + "[goal]\nfile = 'PATH'\n"},
      {"body.file", groom + "[[body]]\nname = 'b'\nshape = 'mesh'\nfile = 'PATH'\n"},
      {"body.moves.file", groom + "[[body]]\nname = 'b'\nshape = 'sphere'\n[body.moves]\nfile = 'PATH'\n"},
      {"camera.file", groom + "[[camera]]\nname = 'c'\nfile = 'PATH'\n"},
      {"field.file", groom + "[[field]]\nname = 'f'\nkind = 'grid'\nstrength = 1\nfile = 'PATH'\n"},
      {"map.file", groom + "[[map]]\nnumber = 'bend_stiffness'\nfile = 'PATH'\n"},
      {"map.texture", groom + "[[map]]\nnumber = 'bend_stiffness'\ntexture = 'PATH'\n"},
      {"output.hair_scalp_file", groom + "[output]\nhairs = 9\nhair_scalp_file = 'PATH'\n"},
      {"output.folder", groom + "[output]\nfolder = 'PATH'\n"},
      {"material.file", groom + "[material]\nfile = 'PATH'\n"}};
}

std::string withPath(const PathCase& c, const std::string& path) {
  std::string text = c.scene;
  return text.replace(text.find("PATH"), 4, path);
}

// What a map is worked out of is read with the scene, as a material is: it is visited where it is there.
bool isOfMap(const PathCase& c) { return c.key.starts_with("map."); }

TEST(ScenePaths, EveryKeyThatIsAPathIsTried) {
  std::vector<std::string> tried, all;
  for (const PathCase& c : pathCases()) tried.push_back(c.key);
  for (const SceneKey& key : sceneKeys()) {
    if (key.type == "path") all.push_back(key.table + "." + key.key);
  }
  std::erase(tried, "body.moves.file");  // the keys of [motion] once more
  std::ranges::sort(tried);
  std::ranges::sort(all);
  EXPECT_EQ(tried, all);
}

TEST(ScenePaths, AllThatAreReadAreVisited) {
  for (const PathCase& c : pathCases()) {
    if (c.key == "output.folder" || c.key == "material.file" || isOfMap(c)) continue;
    const auto scene = parseScene(withPath(c, "the/path.usda"), "scene.toml", "folder");
    ASSERT_TRUE(scene) << scene.error().message;
    std::vector<fs::path> found;
    forEachFileOf(*scene, [&](const fs::path& path) { found.push_back(path); });
    EXPECT_EQ(std::ranges::count(found, fs::path("folder/the/path.usda")), 1) << c.key;
    EXPECT_EQ(found.size(), c.scene.starts_with("[groom]\nfile = 'groom.obj'") ? 2 : 1) << c.key;
  }
}

TEST(ScenePaths, FilesOfMapsAreVisited) {
  SceneFile scene;
  scene.maps.push_back({.file = "factors.txt", .texture = "picture.png"});
  std::vector<fs::path> found;
  forEachFileOf(scene, [&](fs::path& path) { found.push_back(path), path = "new"; });
  EXPECT_EQ(found, (std::vector<fs::path>{"factors.txt", "picture.png"}));
  EXPECT_EQ(scene.maps[0].texture, "new") << "they may be changed";
}

TEST(ScenePaths, AConfinedSceneNamesNothingOutsideItsFolder) {
  const fs::path around = test::scratchFolder("scene_paths"), folder = around / "scene";
  fs::create_directories(folder / "below");
  fs::create_directories(around / "scene2");
  std::ofstream(around / "m.toml") << "line_density = 1e-5\n";
  for (const char* inside : {"m.toml", "below/m.toml"}) fs::copy_file(around / "m.toml", folder / inside);
  fs::create_symlink("../m.toml", folder / "link.toml");
  fs::create_symlink("..", folder / "up");
  fs::create_symlink("below", folder / "down");
  for (const PathCase& c : pathCases()) {
    const auto read = [&](const std::string& path, SceneReach reach) {
      return parseScene(withPath(c, path), "scene.toml", folder, {}, reach);
    };
    for (const std::string& outside :
         {std::string("../m.toml"), (around / "m.toml").string(), std::string("below/../../m.toml"),
          std::string("link.toml"), std::string("up/m.toml"), std::string("up/new/m.toml"),
          std::string("../scene2/m.toml"), std::string("/etc/passwd")}) {
      const auto refused = read(outside, SceneReach::ownFolder);
      ASSERT_FALSE(refused) << c.key << " " << outside;
      EXPECT_NE(refused.error().message.find(c.key), std::string::npos) << refused.error().message;
      EXPECT_NE(refused.error().message.find("to which --confined keeps it"), std::string::npos)
          << refused.error().message;
      if (c.key != "material.file" && !isOfMap(c)) {
        EXPECT_TRUE(read(outside, SceneReach::anywhere)) << c.key << " " << outside;
      }
    }
    if (isOfMap(c)) continue;  // it is read with the scene, and is no material
    for (const char* inside :
         {"m.toml", "below/m.toml", "./below/../m.toml", "down/m.toml", "up/scene/m.toml"})
      EXPECT_TRUE(read(inside, SceneReach::ownFolder)) << c.key << " " << inside;
  }
}

}  // namespace
}  // namespace ringlet
