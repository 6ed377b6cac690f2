// The lines of C++ in the table of docs/library.md, in its order. Reads hair.usdc, curls.toml, scene.toml,
// head.obj and walk.bvh; writes hair.ply and hair.rgc.
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ringlet/bodies/mesh_file.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/measure/groom_doubts.h"
#include "ringlet/motion/motion_file.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/groom_writer.h"
#include "ringlet/rest/material_file.h"
#include "ringlet/run/divided_hair.h"
#include "ringlet/run/run.h"
#include "ringlet/run/scene_run.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/solver/simulation.h"

using namespace ringlet;

namespace {

void check(const auto& result) {
  if (!result) std::puts(result.error().message.c_str()), std::exit(1);
}
void demand(bool isTrue, const char* what) {
  if (!isTrue) std::puts(what), std::exit(1);
}

Groom loadsAGroom() {
  auto read = readGroom("hair.usdc");
  check(read);
  demand(read->statesUnit && read->groom.metresPerUnit == 0.01, "hair.usdc states no unit");
  read->groom.metresPerUnit = 0.01;
  const Groom& groom = read->groom;
  const std::vector<std::string> odd = read->warnings;
  const std::vector<std::string> doubts = doubtsOf(*read, {});
  demand(doubts.empty(), "a good groom is doubted");
  check(writeGroom("hair.ply", groom));
  demand(readGroom("hair.ply")->groom.points == groom.points, "hair.ply is another groom");
  return groom;
}

void loadsAMaterial() {
  auto loaded = loadMaterial("curls.toml");
  check(loaded);
  const Material asItWas = loaded->material;
  auto warning = applyDials(loaded->dials, loaded->material);
  demand(!warning && !(loaded->material == asItWas), "the dials of curls.toml do nothing");
}

Result<Simulation> runsAScene(const Result<ComputeDevice>& device) {
  auto scene = loadScene(*readScene("scene.toml"));
  check(scene);
  SceneFrames frames(*scene);
  auto start = frames.placesAt(frames.first());
  auto hair = Simulation::create(*buildAsset(*device, *scene), stateOf(start, *scene));
  check(hair);
  for (int f = frames.first(); f < scene->frameCount; ++f) check(stepScene(frames, *hair, f));
  RunOptions options{.folder = "out", .animations = {".usdc"}, .checkpointFrames = 10};
  auto run = runScene(*scene, options, hairOn({*device}));
  check(run);
  demand(run->frameCount == scene->frameCount && run->outputs.size() == 3, "the run wrote other files");
  const SceneChange changes[] = {{"material.preset", "coil"}};
  check(readScene("scene.toml", changes));
  check(readScene("scene.toml", {}, SceneReach::ownFolder));
  return hair;
}

void loadsABody(Result<Simulation>& hair) {
  auto mesh = readObjMesh("head.obj", 0.01);
  check(mesh);
  auto grid = makeDistanceGrid(*mesh);
  check(grid);
  Body body{.shape = BodyShape::grid};
  body.grid = std::make_shared<DistanceGrid>(std::move(grid->grid));
  check(hair->setBodies(std::span(&body, 1)));
}

void loadsAMotion(Result<Simulation>& hair) {
  const int frame = 1;
  std::vector<std::string> warnings;
  auto motion = readMotionFile({"walk.bvh"}, false, warnings);
  check(motion);
  check(hair->stepFrame(motion->poseAt(frame / 24.0)));
}

void writesAndReads(const Groom& groom, const std::vector<Vec3f>& points) {
  const double unit = groom.metresPerUnit;
  AnimationOptions options{.framesPerSecond = 30, .metresPerUnit = unit, .frameCount = 48};
  {
    auto film = createAnimation("hair.rgc", groom, options);
    check(film);
    check((*film)->addFrame(points));
    check((*film)->finish());
  }
  auto film = AnimationReader::open("hair.rgc");
  check(film);
  check(film->readFrame(1));
  demand(film->groom().points == points && film->header().framesPerSecond == 30,
         "hair.rgc came back changed");
}

}  // namespace

int main() {
  const auto device = ComputeDevice::open();
  check(device);
  const Groom groom = loadsAGroom();
  loadsAMaterial();
  Result<Simulation> hair = runsAScene(device);
  loadsABody(hair);
  loadsAMotion(hair);
  writesAndReads(groom, groom.points);
  return 0;
}
