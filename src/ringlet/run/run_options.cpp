// Implements run_options.h.
#include "ringlet/run/run_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "ringlet/output/animation_writer.h"
#include "ringlet/output/precision_names.h"
#include "ringlet/scenes/load/scene_maps.h"

namespace ringlet {
namespace {

bool holds(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

void chooseOutputs(const SceneOutput& output, RunOptions& options) {
  options.width = output.width;
  options.tipWidth = output.tipWidth;
  options.animations.clear();
  for (const std::string& file : output.files)
    if (animationFormatOf(file))
      options.animations.push_back(std::filesystem::path(file).extension().string());
  options.writesLast = holds(output.files, "last.obj");
  options.writesSheet = holds(output.files, "sheet.png");
  if (!output.cache.empty()) options.cache = precisionByName(output.cache);
  options.values = output.values;
  options.usdHead = output.head == "transform" ? UsdHead::transform
                    : output.head == "none"    ? UsdHead::none
                                               : UsdHead::baked;
  options.usesGroomPrims = output.prims == "groom";
  options.hairs = output.hairs.value_or(0);
  options.look = {output.frizz, output.clump, output.blend, output.hairScalpFile};
  options.clipFrames = output.clipFrames.value_or(0);
}

}  // namespace

RunOptions runOptionsOf(const SceneFile& scene) {
  RunOptions options;
  options.folder = scene.output.folder;
  options.up = scene.groom.up == "Z" ? UpAxis::z : UpAxis::y;
  chooseOutputs(scene.output, options);
  for (const SceneGroup& group : scene.groups) {
    const auto runs = parseStrands(group.strands, 1, scene.groups);
    if (runs) options.groups.push_back({group.name, *runs});  // reading the scene has refused others
  }
  return options;
}

bool needsOrigin(const SceneOutput& output) {
  return output.prims == "groom" || holds(output.values, "groom") ||
         (holds(output.values, "unreal") && !output.hairs);
}

Status chooseOrigin(const LoadedGroom& groom, RunOptions& options) {
  if (options.usesGroomPrims && (groom.prims.empty() || !groom.hasUsdPrims))
    return Error{
        "only a USD groom has prims of its own, which prims = \"groom\" of [output] (--usd-prims groom) would change; leave it out"};
  options.origin = &groom;
  return {};
}

std::vector<std::string> animationsOf(const RunOptions& options) {
  std::vector<std::string> names;
  for (const AnimationFormat& format : animationFormats()) {
    const bool isWritten = format.hasPrecisions
                               ? options.cache.has_value()
                               : std::ranges::count(options.animations, format.extension) > 0;
    if (isWritten) names.push_back(std::string("hair") + format.extension);
  }
  return names;
}

std::vector<std::filesystem::path> outputsOf(const RunOptions& options) {
  std::vector<std::filesystem::path> outputs;
  for (const std::string& name : animationsOf(options)) outputs.push_back(options.folder / name);
  if (options.writesLast) outputs.push_back(options.folder / "last.obj");
  if (options.writesSheet) outputs.push_back(options.folder / "sheet.png");
  return outputs;
}

Status chooseFiles(const std::vector<std::string>& names, SceneOutput& output) {
  std::vector<std::string> known{"last.obj", "sheet.png"};
  for (const AnimationFormat& format : animationFormats())
    known.push_back(std::string("hair") + format.extension);
  output.files.clear();
  output.cache.clear();
  for (const std::string& name : names) {
    if (!holds(known, name))
      return Error{fmt::format("a run writes no file '{}'; it can write {}", name, fmt::join(known, ", ")),
                   Fault::input};
    if (animationFormatOf(name) && animationFormatOf(name)->hasPrecisions) {
      output.cache = nameOf(CachePrecision::float32);
    } else {
      output.files.push_back(name);
    }
  }
  return {};
}

// The paper's loops solve no linear system; with contacts, air and bodies the system has other terms.
bool measuresResidual(const LoadedScene& scene, const RunOptions& options) {
  const Settings& settings = scene.settings;
  return options.measuresResidual && !settings.contacts.on && !settings.air.on && !settings.goal.on &&
         scene.bodies.empty() && settings.integrator != Integrator::paper;
}

SceneHairInput hairInputOf(const LoadedScene& scene, const SceneFrames& frames, const RunOptions& options) {
  return {scene, frames, options.measuresContacts, measuresResidual(scene, options)};
}

}  // namespace ringlet
