// Paths of scene files: all of them are known, and a confined scene names none outside of its folder.
#include "ringlet/scenes/load/scene_paths.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/scene_path_cases.h"
#include "tests/support/test_support.h"

namespace ringlet::scene_paths_test {
namespace {

namespace fs = std::filesystem;
using test::PathCase;
using test::pathCases;
using test::withPath;

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
    const std::size_t others =
        c.scene.starts_with("[groom]\nfile = 'groom.obj'") + (c.key.ends_with(".cache"));  // and its mesh
    EXPECT_EQ(found.size(), 1 + others) << c.key;
  }
}

TEST(ScenePaths, FilesOfMapsAreVisited) {
  SceneFile scene;
  SceneMap& map = scene.maps.emplace_back();
  map.file = "factors.txt", map.texture = "picture.png";
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
      EXPECT_NE(refused.error().message.find("to which it is confined"), std::string::npos)
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

// It would end the path for the system, and not for us.
TEST(ScenePaths, APathHoldsNoNul) {
  for (const PathCase& c : pathCases()) {
    PathCase escaped = c;  // only texts in "" know \u0000
    for (char& letter : escaped.scene)
      if (letter == '\'') letter = '"';
    for (const char* path : {"nul\\u0000name", "c.obj\\u0000.hair", "\\u0000", "\\U00000000.toml"}) {
      const auto refused = parseScene(withPath(escaped, path), "scene.toml", "folder");
      ASSERT_FALSE(refused) << c.key << " " << path;
      EXPECT_NE(refused.error().message.find("\\x00"), std::string::npos) << refused.error().message;
      EXPECT_NE(refused.error().message.find("expected a path"), std::string::npos)
          << refused.error().message;
    }
  }
}

}  // namespace
}  // namespace ringlet::scene_paths_test
