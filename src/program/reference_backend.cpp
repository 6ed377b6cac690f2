// `--backend reference`: reference::Simulation<double> behind backend.h.
#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "program/backend.h"
#include "reference/step.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet::program {
namespace {

class ReferenceBackend : public Backend {
 public:
  ReferenceBackend(const BackendInput& input, std::vector<std::string> warnings)
      : warnings_(std::move(warnings)),
        simulation_(input.groom, input.material, input.settings, input.start, input.oneStepEarlier) {}

  Status stepFrame(std::span<const HeadPose> stepPoses) override {
    const auto start = std::chrono::steady_clock::now();
    simulation_.stepFrame(stepPoses);
    milliseconds_ +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return {};
  }

  Result<std::vector<Vec3f>> positions() override {
    std::vector<Vec3f> points;
    points.reserve(simulation_.positions().size());
    for (const auto& p : simulation_.positions()) points.push_back(Vec3f(Vec3d{p.x(), p.y(), p.z()}));
    return points;
  }

  Result<SimulationReport> report() override {
    const auto from = simulation_.report();
    return SimulationReport{.maxEdgeStretch = from.nonfinite > 0 ? INFINITY : from.maxEdgeStretch,
                            .limitedShare = from.limitedShare(),
                            .nonfinite = from.nonfinite,
                            .degenerateEdges = from.degenerateEdges};
  }

  Result<ContactReport> contactReport() override { return ContactReport{}; }

  std::map<std::string, double> stageMilliseconds() const override {
    return {{"strand_step", milliseconds_}};
  }
  std::vector<std::string> warnings() const override { return warnings_; }
  std::vector<std::string> deviceMessages() const override { return {}; }
  std::string device() const override { return "CPU, one thread"; }
  std::string driver() const override { return "none"; }
  std::string kernel() const override { return "reference, double precision"; }

 private:
  std::vector<std::string> warnings_;
  reference::Simulation<double> simulation_;
  double milliseconds_ = 0;
};

}  // namespace

Result<std::unique_ptr<Backend>> makeReferenceBackend(const BackendInput& input) {
  if (input.settings.contacts.on || !input.rootShifts.empty()) {
    return Error{fmt::format("the reference has no {} yet; use --backend gpu{}",
                             input.settings.contacts.on ? "contacts" : "roots that move beside the head",
                             input.settings.contacts.on ? ", or --contacts off" : "")};
  }
  auto rest = buildRestState(input.groom, input.material, input.settings);
  if (!rest) return rest.error();
  return std::unique_ptr<Backend>(std::make_unique<ReferenceBackend>(input, std::move(rest->warnings)));
}

}  // namespace ringlet::program
