// Implements picture_run.h.
#include "program/render/picture_run.h"

#include <optional>

#include "program/cli/interruption.h"
#include "program/cli/progress_bar.h"

namespace ringlet::program {

Result<RenderOutcome> drawAnimation(const std::filesystem::path& animation, const ComputeDevice& device,
                                    RenderPlan plan, bool showProgress) {
  std::optional<ProgressBar> bar;
  const char* what = plan.isSheet ? "picture of the sheet" : "picture";
  plan.isStopped = wasInterrupted;
  plan.progress = [&](int finished, int count) {
    if (!bar) bar.emplace(0, count, showProgress, what);
    if (finished > 0) bar->show(finished);
  };
  return renderAnimation(animation, device, plan);
}

}  // namespace ringlet::program
