// program/run_facts.h: what a run that is resumed must have as before.
#include "program/run_facts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ringlet::program {
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
  scene.bodies[0].motion.emplace().file = "motion of a body";
  scene.maps.resize(1);
  scene.maps[0].file = "map";
  scene.maps[0].texture = "texture";
  scene.fields.resize(1);
  scene.fields[0].file = "field";
  const auto inputs = inputFilesOf("input", scene);
  for (const char* file : {"input", "groom", "scalp of roots", "motion", "skinned scalp", "goal", "body",
                           "motion of a body", "map", "texture", "field"})
    EXPECT_NE(std::ranges::find(inputs, file), inputs.end()) << file;
  EXPECT_EQ(inputs.size(), 11u);
}

}  // namespace
}  // namespace ringlet::program
