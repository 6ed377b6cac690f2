// Implements rendered_sheet.h.
#include "program/simulate/rendered_sheet.h"

#include "program/device/open_device.h"
#include "program/render/picture_run.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/sheet.h"

namespace ringlet::program {

namespace {

// The last animation that can be read again. A cache, which comes last, always contains the head's motion and
// is the fastest to read.
std::optional<std::string> readableOf(const RunOptions& options) {
  std::vector<std::string> names = animationsOf(options);
  std::erase_if(names, [](const std::string& name) { return !isAnimation(name); });
  return names.empty() ? std::nullopt : std::optional(names.back());
}

}  // namespace

Status checkRenderedSheet(const RunOptions& options) {
  const bool isBaked = options.usdHead == UsdHead::baked && options.clipFrames == 0;
  if (options.cache || (isBaked && readableOf(options))) return {};
  return Error{
      "--sheet rendered needs an animation with the head's motion in its points: say --cache float32, or "
      "leave out --no-usd, --head and --clips"};
}

Status writeRenderedSheet(const LoadedScene& scene, const SimulateOptions& options) {
  const auto device = openDevice(options.device);
  if (!device) return device.error();
  RenderPlan plan;
  plan.target.path = options.folder / "sheet.png";
  plan.isSheet = true;
  plan.rest = options.hairs > 0 || scene.level ? nullptr : &scene.groom;
  plan.scene = &scene;
  plan.size = {kPanelWidth, kPanelHeight, 2};
  const auto drawn =
      drawAnimation(options.folder / readableOf(options).value(), *device, plan, options.showProgress);
  return drawn ? Status{} : Status{drawn.error()};
}

}  // namespace ringlet::program
