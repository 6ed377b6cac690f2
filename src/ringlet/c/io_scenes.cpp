// Implements c/ringlet_io.h: scenes, and hair that goes through them.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "ringlet/base/host_words.h"
#include "ringlet/c/io_handles.h"
#include "ringlet/c/poses.h"
#include "ringlet/run/scene_run.h"

namespace ringlet::c {
namespace {

Result<std::vector<SceneChange>> changesOf(const ringlet_scene_reading& reading) {
  std::vector<SceneChange> changes;
  for (std::uint32_t k = 0; k < reading.change_count; ++k) {
    const std::string_view change = reading.changes && reading.changes[k] ? reading.changes[k] : "";
    const std::size_t equals = change.find('=');
    if (equals == std::string_view::npos)
      return Error{fmt::format("change {} of the scene is '{}'; expected key=value", k, change)};
    changes.push_back({std::string(change.substr(0, equals)), std::string(change.substr(equals + 1))});
  }
  return changes;
}

SceneReach reachOf(const ringlet_scene_reading& reading) {
  return reading.is_confined ? SceneReach::ownFolder : SceneReach::anywhere;
}

Outcome make(const Result<SceneFile>& file, const char* path, const ringlet_scene_reading& reading,
             ringlet_scene** scene) {
  if (!file) return inSceneWords(file.error());
  auto loaded = loadScene(*file);
  if (!loaded) return inSceneWords(loaded.error());
  for (std::string& sentence : loaded->warnings) sentence = inSceneWords(sentence);
  warnOf(loaded->warnings, reading.warn, reading.user);
  auto shared = std::make_shared<const LoadedScene>(std::move(*loaded));
  *scene = new ringlet_scene{shared, ShownGroom(shared->groom), *file, path};
  return {};
}

template <class Pose>
void show(const std::vector<Pose>& poses, ringlet_pose* to) {
  for (const Pose& pose : poses) {
    const Vec3d& p = pose.position;
    const Quatd& r = pose.rotation;
    *to++ = {{p.x, p.y, p.z}, {r.x, r.y, r.z, r.w}};
  }
}

Outcome checkFrame(std::int32_t frame) {
  if (frame >= -kMostFrame && frame <= kMostFrame) return {};
  return Outcome::invalid(fmt::format("frame is {}; it takes {} to {}", frame, -kMostFrame, kMostFrame));
}

// Whether the scene steps this hair: what it hands over fits.
Outcome checkHair(const ringlet_scene& scene, const ringlet_hair& hair) {
  if (hair.scene != scene.loaded)
    return Outcome::invalid(
        "the hair is of another scene; expected what ringlet_scene_hair of this one made");
  if (hair.bodyCount != scene.loaded->bodies.size())
    return Outcome::invalid(
        fmt::format("the hair has {} bodies and the scene {}: bodies of a scene's hair are the scene's",
                    hair.bodyCount, scene.loaded->bodies.size()));
  const int steps = scene.loaded->settings.stepsPerFrame, now = hair.simulation.settings().stepsPerFrame;
  if (steps == now) return {};
  return Outcome::invalid(fmt::format(
      "the hair has {} steps a frame and the scene {}: leave steps_per_frame as it is", now, steps));
}

}  // namespace
}  // namespace ringlet::c

using namespace ringlet;
using namespace ringlet::c;

ringlet_result ringlet_scene_read(const char* path, const ringlet_scene_reading* reading,
                                  ringlet_scene** scene) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong =
            checkArguments("ringlet_scene_read takes a path, how to read and a place for the scene",
                           {given("path", path), sizedOrNull("reading", reading), given("scene", scene)});
        !wrong.isFine())
      return wrong;
    const ringlet_scene_reading how = taken(reading);
    const auto changes = changesOf(how);
    if (!changes) return Outcome::invalid(changes.error().message);
    return make(readScene(path, *changes, reachOf(how)), path, how, scene);
  });
}

ringlet_result ringlet_scene_parse(const char* text, const char* folder, const ringlet_scene_reading* reading,
                                   ringlet_scene** scene) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong =
            checkArguments("ringlet_scene_parse takes a text, how to read and a place for the scene",
                           {given("text", text), sizedOrNull("reading", reading), given("scene", scene)});
        !wrong.isFine())
      return wrong;
    const ringlet_scene_reading how = taken(reading);
    const auto changes = changesOf(how);
    if (!changes) return Outcome::invalid(changes.error().message);
    return make(parseScene(text, "the scene", folder ? folder : "", *changes, reachOf(how)), "", how, scene);
  });
}

void ringlet_scene_release(ringlet_scene* scene) { delete scene; }

ringlet_result ringlet_scene_get(const ringlet_scene* scene, ringlet_scene_facts* facts) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_scene_get takes a scene and facts to fill",
                                       {given("scene", scene), sized("facts", facts)});
        !wrong.isFine())
      return wrong;
    const LoadedScene& of = *scene->loaded;
    give(facts, {.struct_size = 0,
                 .frames_per_second = of.settings.framesPerSecond,
                 .frame_count = of.frameCount,
                 .pre_roll_frames = -SceneFrames(of).first(),
                 .steps_per_frame = static_cast<uint32_t>(of.settings.stepsPerFrame),
                 .body_count = static_cast<uint32_t>(of.bodies.size()),
                 .strand_count = static_cast<uint32_t>(of.groom.strandCount()),
                 .moving_roots = of.scalp.has_value(),
                 .bending_body_count = static_cast<uint32_t>(of.moving.size())});
    return {};
  });
}

ringlet_result ringlet_scene_groom(const ringlet_scene* scene, ringlet_groom* groom) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_scene_groom takes a scene and a groom to fill",
                                       {given("scene", scene), sized("groom", groom)});
        !wrong.isFine())
      return wrong;
    give(groom, scene->shown.show());
    return {};
  });
}

ringlet_result ringlet_scene_settings(const ringlet_scene* scene, ringlet_settings** settings) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_scene_settings takes a scene and a place for settings",
                                       {given("scene", scene), given("settings", settings)});
        !wrong.isFine())
      return wrong;
    *settings = new ringlet_settings{scene->loaded->settings};
    return {};
  });
}

ringlet_result ringlet_scene_material(const ringlet_scene* scene, ringlet_material** material) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_scene_material takes a scene and a place for a material",
                                       {given("scene", scene), given("material", material)});
        !wrong.isFine())
      return wrong;
    *material = new ringlet_material{scene->loaded->material};
    return {};
  });
}

ringlet_result ringlet_scene_frame_poses(const ringlet_scene* scene, int32_t frame, ringlet_pose* step_poses,
                                         ringlet_pose* body_poses, ringlet_pose* root_poses) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong =
            checkArguments("ringlet_scene_frame_poses takes a scene and a place for the head's poses",
                           {given("scene", scene), given("step_poses", step_poses)});
        !wrong.isFine())
      return wrong;
    if (Outcome wrong = checkFrame(frame); !wrong.isFine()) return wrong;
    const auto poses = SceneFrames(*scene->loaded).at(frame);
    if (!poses) return poses.error();
    show(poses->heads, step_poses);
    if (body_poses) show(poses->bodies, body_poses);
    if (root_poses) show(poses->roots, root_poses);
    return {};
  });
}

ringlet_result ringlet_scene_frame_points(const ringlet_scene* scene, int32_t frame, uint32_t bending_body,
                                          double* xyz, uint32_t* vertex_count) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong =
            checkArguments("ringlet_scene_frame_points takes a scene and a place for the number of vertices",
                           {given("scene", scene), given("vertex_count", vertex_count)});
        !wrong.isFine())
      return wrong;
    if (Outcome wrong = checkFrame(frame); !wrong.isFine()) return wrong;
    const std::vector<MovingBody>& moving = scene->loaded->moving;
    if (bending_body >= moving.size())
      return Outcome::invalid(
          fmt::format("there is no bending body {}; the scene has {}", bending_body, moving.size()));
    *vertex_count = static_cast<uint32_t>(moving[bending_body].mesh->pointCount());
    if (!xyz) return {};
    const auto made = SceneFrames(*scene->loaded).at(frame);
    if (!made) return made.error();
    for (const Vec3d& p : made->points[bending_body]) *xyz++ = p.x, *xyz++ = p.y, *xyz++ = p.z;
    return {};
  });
}

ringlet_result ringlet_scene_build(ringlet_device* device, const ringlet_scene* scene,
                                   const ringlet_asset_options* options, ringlet_asset** asset) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong =
            checkArguments("ringlet_scene_build takes a device, a scene and a place for the asset",
                           {given("device", device), given("scene", scene), sizedOrNull("options", options),
                            given("asset", asset)});
        !wrong.isFine())
      return wrong;
    const LoadedScene& of = *scene->loaded;
    ringlet_asset_options chosen = taken(options);
    const Features needs = featuresOf(of);
    for (std::size_t k = 0; k < kFeatureNames.size(); ++k)
      if (needs.*kFeatureNames[k].member) chosen.features |= std::uint32_t{1} << k;
    Outcome outcome = c::buildAsset(device->device, of.groom, of.settings, of.material, chosen, asset);
    if (outcome.isFine()) (*asset)->scene = scene->loaded;
    return outcome;
  });
}

ringlet_result ringlet_scene_hair(const ringlet_scene* scene, ringlet_asset* asset, ringlet_hair** hair) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_scene_hair takes a scene, its asset and a place for the hair",
                                       {given("scene", scene), given("asset", asset), given("hair", hair)});
        !wrong.isFine())
      return wrong;
    if (asset->scene != scene->loaded)
      return Outcome::invalid(
          "the asset is of another scene; expected what ringlet_scene_build of this one made");
    const LoadedScene& of = *scene->loaded;
    const SceneFrames frames(of);
    const ScenePlaces start = frames.placesAt(frames.first());
    ringlet_hair* made = nullptr;
    if (Outcome wrong = createHair(*asset, stateOf(start, of), &made); !wrong.isFine()) return wrong;
    std::unique_ptr<ringlet_hair> kept(made);
    if (Status begun = beginShot(start, of, kept->simulation); !begun) return begun;
    for (int frame = frames.first(); frame < 0; ++frame) {
      if (Status stepped = stepScene(frames, kept->simulation, frame); !stepped) return stepped;
    }
    *hair = kept.release();
    return {};
  });
}

ringlet_result ringlet_scene_step(const ringlet_scene* scene, ringlet_hair* hair, int32_t frame) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_scene_step takes a scene and its hair",
                                       {given("scene", scene), given("hair", hair)});
        !wrong.isFine())
      return wrong;
    if (Outcome wrong = checkFrame(frame); !wrong.isFine()) return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    if (Outcome outcome = checkHair(*scene, *hair); !outcome.isFine()) return outcome;
    return stepScene(SceneFrames(*scene->loaded), hair->simulation, frame);
  });
}
