// What it costs the host to change settings or material while hair moves, a frame: the call, and what the
// frame after it takes longer, as it is recorded anew. Verified before it is timed: hair that was changed is
// where hair is that was made so. Run: build/release/bench/live_bench [STRANDS [PARTICLES]]
#include <fmt/format.h>

#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "bench/clocks.h"
#include "ringlet/groom/generate.h"
#include "ringlet/solver/simulation.h"

namespace {

using namespace ringlet;

constexpr int kFrames = 31;
constexpr double kAlike = 2e-5;  // [m]

HeadPose headAt(int frame) {
  return {Vec3d{0.01 * frame, 0, 0}, fromRotationVector(Vec3d{0, 0.05 * frame, 0})};
}

struct Times {
  std::vector<double> call, submit;  // [ms] of the host's
};

// Frames, each after `change`.
Result<Times> run(Simulation& simulation, const std::function<Status(Simulation&, int frame)>& change) {
  Times times;
  for (int frame = 1; frame <= kFrames; ++frame) {
    double start = bench::wallSeconds();
    if (Status status = change(simulation, frame); !status) return status.error();
    times.call.push_back(1e3 * (bench::wallSeconds() - start));
    const std::vector<HeadPose> poses(simulation.settings().stepsPerFrame, headAt(frame));
    start = bench::wallSeconds();
    if (Status status = simulation.submitFrame(poses); !status) return status.error();
    times.submit.push_back(1e3 * (bench::wallSeconds() - start));
    if (Status status = simulation.waitFrame(); !status) return status.error();
  }
  return times;
}

// How far hair that is made stiff is from hair that was, after some frames [m].
Result<double> apart(const ComputeDevice& device, const Groom& groom, const Settings& settings) {
  Material stiff;
  stiff.bendStiffness *= 2;
  auto late = Simulation::create(device, groom, {}, settings);
  if (!late) return late.error();
  if (Status status = late->setMaterial(stiff); !status) return status.error();
  auto early = Simulation::create(device, groom, stiff, settings);
  if (!early) return early.error();
  double farthest = 0;
  for (int frame = 1; frame <= 3; ++frame) {
    if (Status status = late->stepFrame(headAt(frame)); !status) return status.error();
    if (Status status = early->stepFrame(headAt(frame)); !status) return status.error();
  }
  const auto a = late->positions(), b = early->positions();
  if (!a || !b) return a ? b.error() : a.error();
  for (std::size_t i = 0; i < a->size(); ++i)
    farthest = std::max<double>(farthest, length((*a)[i] - (*b)[i]));
  return farthest;
}

Status tell(const ComputeDevice& device, const Groom& groom, const char* name, const Settings& settings) {
  if (!settings.contacts.on) {
    const auto distance = apart(device, groom, settings);
    if (!distance) return distance.error();
    if (!(*distance < kAlike))
      return Error{fmt::format("hair made stiffer is {} m from hair that is stiff", *distance)};
  }
  auto simulation = Simulation::create(device, groom, {}, settings);
  if (!simulation) return simulation.error();
  const auto nothing = run(*simulation, [](Simulation&, int) { return Status{}; });
  if (!nothing) return nothing.error();
  const auto gravity = run(*simulation, [](Simulation& hair, int frame) {
    Settings other = hair.settings();
    other.gravity.x = 0.1 * frame;
    return hair.setSettings(other);
  });
  if (!gravity) return gravity.error();
  const auto stiffness = run(*simulation, [](Simulation& hair, int frame) {
    Material other = hair.material();
    other.bendStiffness = 5 + 0.1 * frame;
    return hair.setMaterial(other);
  });
  if (!stiffness) return stiffness.error();
  const double still = bench::median(nothing->submit);
  const auto print = [&](const char* what, const Times& times) {
    fmt::print("  {:<16} {:<10} {:8.3f} {:18.3f}\n", name, what, bench::median(times.call),
               bench::median(times.submit) - still);
  };
  print("gravity", *gravity);
  print("stiffness", *stiffness);
  return {};
}

Status runAll(int strands, int particles) {
  const auto device = ComputeDevice::open();
  if (!device) return device.error();
  HeadParameters parameters;
  parameters.strandCount = strands;
  parameters.curl.particleCount = particles;
  const auto groom = makeHead(parameters);
  if (!groom) return groom.error();
  fmt::print("{} x {} on {}, medians of {} frames, each with a change\n", strands, particles, device->name(),
             kFrames);
  fmt::print("  {:<16} {:<10} {:>8} {:>18}\n", "contacts", "change", "call [ms]", "longer frame [ms]");
  Settings off, together, pairs;
  together.contacts.on = pairs.contacts.on = true;
  pairs.contacts.method = ContactMethod::explicitPairs;
  if (Status status = tell(*device, *groom, "off", off); !status) return status;
  if (Status status = tell(*device, *groom, "auto", together); !status) return status;
  return tell(*device, *groom, "explicit", pairs);
}

}  // namespace

int main(int count, char** arguments) {
  const auto number = [&](int i, int otherwise) { return count > i ? std::atoi(arguments[i]) : otherwise; };
  const Status status = runAll(number(1, 1000), number(2, 64));
  if (status) return 0;
  fmt::print(stderr, "live_bench: {}\n", status.error().message);
  return 1;
}
