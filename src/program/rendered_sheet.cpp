// Implements rendered_sheet.h.
#include "program/rendered_sheet.h"

#include "program/cache_folder.h"
#include "program/render_run.h"
#include "program/run_writers.h"
#include "ringlet/output/sheet.h"

namespace ringlet::program {

Status checkRenderedSheet(const RunOptions& options) {
  const bool isBaked = options.usdHead == UsdHead::baked && (options.writesUsd || options.writesUsdc);
  if (options.cache || (isBaked && options.clipFrames == 0)) return {};
  return Error{
      "--sheet rendered needs an animation with the head's motion in its points: say --cache float32, or "
      "leave out --no-usd, --head and --clips"};
}

Status writeRenderedSheet(const LoadedScene& scene, const RunOptions& options) {
  const auto device = ComputeDevice::open(options.device, cacheFolder());
  if (!device) return device.error();
  RenderPlan plan;
  plan.target.path = options.folder / "sheet.png";
  plan.isSheet = true;
  plan.rest = options.hairs > 0 ? nullptr : &scene.groom;
  plan.scene = &scene;
  plan.size = {kPanelWidth, kPanelHeight, 2};
  plan.showProgress = options.showProgress;
  // A cache, which is last, has the head's motion always and is read fastest.
  const auto drawn = renderAnimation(options.folder / animationsOf(options).back(), *device, plan);
  return drawn ? Status{} : Status{drawn.error()};
}

}  // namespace ringlet::program
