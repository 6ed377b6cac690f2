// Sliders, what they change, what can be undone, and the scene that is saved of it.
#include "view/sliders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

#include "ringlet/rest/material_parameters.h"
#include "ringlet/scene/settings_fields.h"
#include "ringlet/scenes/file/scene_file.h"
#include "tests/support/test_support.h"
#include "view/edit_history.h"

namespace ringlet::view::sliders_test {
namespace {

std::map<std::string, Slider> allSliders() {
  std::map<std::string, Slider> all;
  for (const SliderGroup& group : sliderGroups())
    for (const Slider& slider : group.sliders) all.emplace(slider.name, slider);
  return all;
}

// A value that is allowed, and not the one there is.
double another(const Slider& slider, double value) {
  if (slider.kind == Slider::Kind::toggle) return 1 - value;
  if (slider.kind == Slider::Kind::choice) return value > 0 ? 0 : 1;
  if (slider.kind == Slider::Kind::whole) return value > slider.shown.low ? value - 1 : value + 1;
  return value > (slider.shown.low + slider.shown.high) / 2 ? slider.shown.low : slider.shown.high;
}

TEST(Sliders, ThereIsOneForEveryNumberOfTheTables) {
  const auto all = allSliders();
  for (const auto& parameter : dialParameters())
    EXPECT_TRUE(all.count(std::string("material.dials.") + parameter.key));
  for (const auto& parameter : materialParameters())
    EXPECT_TRUE(all.count(std::string("material.") + parameter.key));
  for (const auto& parameter : variationParameters())
    EXPECT_TRUE(all.count(std::string("material.variation.") + parameter.key));
  for (const auto& field : contactFields())
    EXPECT_TRUE(all.count(std::string("contacts.") + field.key)) << field.key;
  for (const auto& field : airFields()) {
    const std::string name = std::string("air.") + field.key;
    EXPECT_TRUE(all.count(name) || all.count(name + ".z")) << name;
  }
  EXPECT_EQ(all.count("simulation.integrator") + all.count("simulation.gravity"), 2u);
}

TEST(Sliders, EachChangesItsOwnNumberAndNoOther) {
  const auto all = allSliders();
  for (const auto& [name, slider] : all) {
    for (const std::size_t material : {0, 1}) {
      const Edits before;
      Edits after = before;
      const double wanted = another(slider, slider.get(before, material).value_or(slider.standard));
      ASSERT_TRUE(slider.allowed.contains(wanted)) << name;
      slider.set(after, material, wanted);
      EXPECT_EQ(slider.get(after, material), wanted) << name;
      std::set<std::string> changed;
      for (const auto& [other, of] : all)
        if (of.get(after, material) != of.get(before, material)) changed.insert(other);
      EXPECT_EQ(changed, std::set<std::string>{name});
      const bool isMaterials = name.starts_with("material.");
      EXPECT_EQ(slider.get(after, 1 - material) == slider.get(before, 1 - material), isMaterials) << name;
    }
  }
}

TEST(Sliders, ShowTheNumberThereIsAndSayWhetherItActsAtOnce) {
  const auto all = allSliders();
  for (const auto& [name, slider] : all) {
    EXPECT_FALSE(slider.effect.empty()) << name;
    EXPECT_LT(slider.shown.low, slider.shown.high) << name;
    EXPECT_GE(slider.shown.low, slider.allowed.low) << name;
    EXPECT_LE(slider.shown.high, slider.allowed.high) << name;
    if (const auto value = slider.get(Edits{}, 0)) {
      EXPECT_TRUE(slider.shown.contains(*value)) << name << " " << *value;
    }
  }
  for (const char* live : {"material.dials.hold", "material.bend_stiffness", "air.wind.x", "air.fall_speed",
                           "contacts.stiffness", "contacts.friction", "simulation.gravity", "simulation.fps"})
    EXPECT_TRUE(all.at(live).isLive) << live;
  for (const char* fixed :
       {"material.line_density", "air.on", "air.turbulence", "contacts.on", "contacts.radius",
        "simulation.roots", "simulation.preload", "simulation.integrator"})
    EXPECT_FALSE(all.at(fixed).isLive) << fixed;
}

TEST(Sliders, AreInUseWhereTheirNumberIs) {
  const auto all = allSliders();
  Edits edits;
  EXPECT_FALSE(isInUse(all.at("simulation.force_loops"), edits));
  EXPECT_FALSE(isInUse(all.at("contacts.ramp_seconds"), edits));
  EXPECT_TRUE(isInUse(all.at("contacts.stiffness"), edits));
  all.at("simulation.integrator").set(edits, 0, 2);
  EXPECT_EQ(edits.simulation.integrator, "paper");
  EXPECT_TRUE(isInUse(all.at("simulation.force_loops"), edits));
  all.at("contacts.taper").set(edits, 0, 1);
  EXPECT_TRUE(isInUse(all.at("contacts.ramp_seconds"), edits));
}

TEST(EditHistory, UndoesAndDoesAgainStepByStep) {
  EditHistory<int> history(1);
  EXPECT_FALSE(history.canUndo());
  history.set(2);
  history.set(3);
  history.commit();
  history.set(4);
  history.commit();
  const std::size_t version = history.version();
  history.undo();
  EXPECT_EQ(history.now(), 3) << "a drag is one step";
  EXPECT_NE(history.version(), version);
  history.undo();
  EXPECT_EQ(history.now(), 1);
  history.undo();
  EXPECT_EQ(history.now(), 1);
  history.redo();
  history.redo();
  EXPECT_EQ(history.now(), 4);
  history.undo();
  history.set(5);
  history.commit();
  EXPECT_FALSE(history.canRedo());
  history.undo();
  EXPECT_EQ(history.now(), 3);
}

// Every slider at another place, saved, read again: the same numbers.
TEST(SavedScene, GivesTheSameNumbersBack) {
  const auto folder = test::scratchFolder("view_saved");
  SceneFile scene;
  scene.groom.generate = "curl";
  Edits edits = editsOf(scene);
  const auto all = allSliders();
  for (const auto& [name, slider] : all) {
    if (slider.kind == Slider::Kind::choice || name == "simulation.seconds" || !isInUse(slider, edits))
      continue;
    slider.set(edits, 1, another(slider, slider.get(edits, 1).value_or(slider.standard)));
  }
  edits.materials[1].material.coreElongationLow = 1.02;
  edits.materials[1].material.coreElongationHigh = 1.5;
  const auto path = folder / "saved.toml";
  const Status saved = saveScene(scene, edits, 1, path);
  ASSERT_TRUE(saved) << saved.error().message;
  const auto read = readScene(path);
  ASSERT_TRUE(read) << read.error().message;
  const Edits found = editsOf(*read);
  for (const auto& [name, slider] : all) EXPECT_EQ(slider.get(found, 0), slider.get(edits, 1)) << name;
  EXPECT_EQ(read->groom.generate, "curl");
  EXPECT_FALSE(saveScene(scene, edits, 0, folder / "none" / "saved.toml"));
}

// Every file that a scene names is found from where the saved scene is, and after both were moved; one that
// shares nothing but the root with it stays where it is.
TEST(SavedScene, FindsItsFiles) {
  const auto folder = test::scratchFolder("view_travels");
  std::filesystem::create_directories(folder / "show" / "files");
  std::filesystem::create_directories(folder / "show" / "views");
  SceneFile scene;
  scene.bodies.resize(2);
  for (SceneBody& body : scene.bodies) body.moves.emplace();
  scene.cameras.resize(1);
  scene.fields.resize(1);
  scene.maps.resize(2);
  // As a scene in the folder "shots" and as a command line in "show" have them.
  int count = 0;
  const auto name = [&](std::filesystem::path& path) {
    const std::string file = std::to_string(++count) + ".bin";
    std::ofstream(folder / "show" / "files" / file) << count;
    path = folder / "show" / "shots" / ".." / "files" / file;
  };
  for (std::filesystem::path* path :
       {&scene.groom.file, &scene.groom.scalp, &scene.motion.file, &scene.scalp.file, &scene.goalFile,
        &scene.output.hairScalpFile, &scene.cameras[0].file, &scene.fields[0].file, &scene.maps[0].file,
        &scene.maps[1].texture, &scene.bodies[0].file, &scene.bodies[1].file, &scene.bodies[0].moves->file})
    name(*path);
  scene.motion.kind.clear();
  scene.goal.on = true;
  scene.bodies[1].moves->file = "/elsewhere/../library/m.bvh";
  const auto saved = folder / "show" / "views" / "saved.toml";
  ASSERT_TRUE(saveScene(scene, editsOf(scene), 0, saved));
  const std::string text = test::readText(saved);
  EXPECT_NE(text.find("\"/library/m.bvh\""), std::string::npos) << text;
  EXPECT_EQ(text.find(folder.string()), std::string::npos) << text;
  for (int file = 1; file <= count; ++file)
    EXPECT_NE(text.find("\"../files/" + std::to_string(file) + ".bin\""), std::string::npos) << file << text;
}

}  // namespace
}  // namespace ringlet::view::sliders_test
