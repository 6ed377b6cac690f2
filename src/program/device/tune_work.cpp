// Implements tune_work.h.
#include "program/device/tune_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "ringlet/groom/generate.h"

namespace ringlet::program {
namespace {

constexpr double kSpacing = 0.001;  // distance between curls [m]

// The head's pose at the end of the first frame: displaced and turned. With contacts a fiftieth as far:
// impacts at full speed amplify the difference between two shapes (a frame later 2e-4 of the length, 5e-6 at
// a tenth, 3e-6 at a fiftieth).
HeadPose movedAt(TuneWork work) {
  const double share = work == TuneWork::contacts ? 0.02 : 1;
  return {{0.02 * share, 0, 0.005 * share}, {0, std::sin(0.03 * share), 0, std::cos(0.03 * share)}};
}

Result<Groom> hairOf(std::uint32_t particleCount, std::uint32_t strandCount) {
  SwatchParameters swatch;
  swatch.curl.length = kTunedLength;
  swatch.curl.turns = std::min(8.0, particleCount / 4.0);
  swatch.curl.particleCount = static_cast<int>(particleCount);
  swatch.columnCount = static_cast<int>(std::ceil(std::sqrt(strandCount)));
  swatch.rowCount = static_cast<int>(strandCount) / swatch.columnCount;
  swatch.spacing = kSpacing;
  return makeSwatch(swatch);
}

Settings settingsOf(TuneWork work) {
  Settings settings;
  settings.contacts.on = work == TuneWork::contacts || work == TuneWork::volume;
  settings.contacts.method = work == TuneWork::volume ? ContactMethod::volume : ContactMethod::explicitPairs;
  return settings;
}

// A sphere that the head carries, a millimetre beside the hair, on the side to which hair lags behind.
Body besideHair(const Groom& groom) {
  Body body{.name = "tune", .radius = kTunedLength / 4};
  double side = 0;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    for (const Vec3f& point : groom.strand(s)) side = std::min(side, groom.metresPerUnit * point.x);
  }
  body.place.position = {side - kSpacing - body.radius, -kTunedLength / 2, 0};
  return body;
}

// Whether some particle is at the sphere's surface, as those are that the sphere pushes away.
Result<bool> touches(const Body& body, Simulation& simulation) {
  const auto positions = simulation.positions();
  if (!positions) return positions.error();
  const Vec3d centre = rotate(movedAt(TuneWork::bodies).rotation, body.place.position);
  return std::ranges::any_of(*positions, [&](const Vec3f& p) {
    return length(static_cast<Vec3d>(p) - centre) < body.radius + 1e-4;
  });
}

Result<bool> hasMet(TuneWork work, std::span<const Body> bodies, Simulation& simulation) {
  if (work == TuneWork::alone) return true;
  if (work == TuneWork::bodies) return touches(bodies.front(), simulation);
  const auto report = simulation.contactReport();
  if (!report) return report.error();
  return work == TuneWork::contacts ? report->contacts > 0 : report->volumeStrands > 0;
}

}  // namespace

StrandWork strandWorkOf(TuneWork work) {
  switch (work) {
    case TuneWork::alone:
      return StrandWork::hairAlone;
    case TuneWork::contacts:
      return StrandWork::plain;
    case TuneWork::volume:
      return StrandWork::volume;
    case TuneWork::bodies:
      return StrandWork::bodies;
  }
  return StrandWork::plain;
}

Result<Simulation> simulateWork(const ComputeDevice& device, TuneWork work, std::uint32_t particleCount,
                                std::uint32_t strandCount, const KernelChoice& choice) {
  const auto groom = hairOf(particleCount, strandCount);
  if (!groom) return groom.error();
  std::vector<Body> bodies;
  if (work == TuneWork::bodies) bodies.push_back(besideHair(*groom));
  InitialState initial;
  initial.bodies = bodies;
  auto simulation = Simulation::create(device, *groom, {}, settingsOf(work), initial, choice);
  if (!simulation) return simulation.error();
  if (Status stepped = stepWork(work, *simulation); !stepped) return stepped.error();
  const auto met = hasMet(work, bodies, *simulation);
  if (!met) return met.error();
  if (!*met)
    return Error{fmt::format("{} strands met nothing; give it more with --strands", groom->strandCount())};
  return simulation;
}

Status stepWork(TuneWork work, Simulation& simulation) { return simulation.stepFrame(movedAt(work)); }

}  // namespace ringlet::program
