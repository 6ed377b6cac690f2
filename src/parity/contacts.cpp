// Implements parity/contacts.h.
#include "parity/contacts.h"
#include "parity/parity.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "reference/step.h"
#include "ringlet/groom/generate.h"
#include "ringlet/solver/diagnostics.h"

namespace ringlet::parity {
namespace {

// Whether two strands overlap at rest, when enlarged.
bool mayMeet(const Groom& rest, const ContactSettings& settings, std::uint32_t a, std::uint32_t b) {
  for (const Vec3f p : rest.strand(a)) {
    for (const Vec3f q : rest.strand(b)) {
      if (length(static_cast<Vec3d>(p - q)) < settings.enlargement * kListedR) return true;
    }
  }
  return false;
}

}  // namespace

Groom farApart(std::size_t strandCount) {
  Groom groom;
  groom.metresPerUnit = 1;
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(double(strandCount))));
  for (std::size_t s = 0; s < strandCount; ++s) {
    const std::size_t layer = s / side / side;
    const Vec3f root(Vec3d{0.1 * double(s % side), 0.1 * double(s / side % side), 0.1 * double(layer)});
    groom.addStrand(std::vector<Vec3f>{root, root + Vec3f{0, -0.02f, 0}});
  }
  return groom;
}

Settings shortSteps() {
  Settings settings;
  settings.framesPerSecond = 1e6;
  settings.stepsPerFrame = 1;
  settings.contacts.on = true;
  settings.contacts.method = ContactMethod::explicitPairs;
  settings.contacts.radius = kListedR / 2;
  settings.contacts.prunePairs = false;
  return settings;
}

Result<Simulation> stepAt(const ComputeDevice& device, const std::vector<Vec3f>& points,
                          const Settings& settings) {
  auto simulation = Simulation::create(device, farApart(points.size() / 2), {}, settings);
  if (!simulation) return simulation;
  if (Status set = simulation->setState({points, std::vector<Vec3f>(points.size())}); !set)
    return set.error();
  if (Status stepped = simulation->stepFrame(HeadPose{}); !stepped) return stepped.error();
  return simulation;
}

// Squared distances are in float, as the kernel has them.
Result<ListComparison> compareLists(const ComputeDevice& device, const std::vector<Vec3f>& points,
                                    const Settings& settings) {
  const auto simulation = stepAt(device, points, settings);
  if (!simulation) return simulation.error();
  const auto contacts = Diagnostics(*simulation).listedContacts();
  if (!contacts) return contacts.error();
  const auto report = simulation->contactReport();
  if (!report) return report.error();
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const ListedContact& c : *contacts) found.insert({c.a, c.b});

  ListComparison lists{.extra = found.size(), .repeated = contacts->size() - found.size()};
  if (report->listed != found.size()) ++lists.repeated;
  const Groom rest = farApart(points.size() / 2);
  const float reach = static_cast<float>(settings.contacts.listedReach() * kListedR + kListedSkin),
              bound = reach * reach;
  for (std::uint32_t a = 0; a < points.size(); ++a) {
    for (std::uint32_t b = a + 1; b < points.size(); ++b) {
      if (a / 2 == b / 2 || (a % 2 == 0 && b % 2 == 0)) continue;
      const Vec3f d = points[a] - points[b];
      const float squared = d.x * d.x + d.y * d.y + d.z * d.z;
      if (!(squared < bound * 1.00001f)) continue;
      if (settings.contacts.prunePairs && !mayMeet(rest, settings.contacts, a / 2, b / 2)) continue;
      const bool isListed = found.contains({a, b});
      const bool isOnEdge = squared > bound * 0.99999f;
      lists.extra -= isListed;
      lists.onEdge += isOnEdge;
      lists.near += !isOnEdge;
      lists.missed += !isOnEdge && !isListed;
    }
  }
  return lists;
}

Groom denseSwatch(int particles) {
  SwatchParameters parameters;
  parameters.curl.particleCount = particles;
  parameters.columnCount = 4, parameters.rowCount = 3;
  parameters.spacing = 0.012;
  return *makeSwatch(parameters);
}

Groom bunchAndStrands() {
  Groom groom;
  groom.metresPerUnit = 1;
  const auto add = [&](double x, double z, int s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 16; ++i) {
      const double turn = 0.9 * i + s;
      strand.push_back(Vec3f(Vec3d{x + 0.004 * std::cos(turn), -0.006 * i, z + 0.004 * std::sin(turn)}));
    }
    groom.addStrand(strand);
  };
  for (int s = 0; s < 60; ++s) {
    const int row = s / 8;
    add(0.0012 * (s % 8), 0.0012 * row, s);
  }
  for (int s = 0; s < 4; ++s) add(-0.022, 0.006 * s - 0.006, s);
  return groom;
}

Settings meetingSettings() {
  Settings settings;
  settings.contacts.on = true;
  settings.contacts.method = ContactMethod::explicitPairs;
  settings.contacts.radius = 0.004;
  settings.contacts.prunePairs = false;
  return settings;
}

Result<double> shakenError(
    const ComputeDevice& device, const Groom& groom, const Settings& settings, const KernelChoice& kernel,
    int frameCount, const std::function<void(Simulation&, reference::Simulation<double>&)>& afterFrame) {
  auto simulation = Simulation::create(device, groom, {}, settings, {}, kernel);
  if (!simulation) return simulation.error();
  reference::Simulation<double> reference(groom, {}, settings);
  if (kernel.features.goals) {  // the groom itself, a few weights a centimetre
    std::vector<Vec3f> places;
    for (const Vec3f& p : groom.points) places.push_back(p * static_cast<float>(groom.metresPerUnit));
    const std::vector<float> strengths(places.size(), 3.f);
    if (Status set = simulation->setGoals(places, strengths); !set) return set.error();
    reference.setGoals(places, strengths, 1);
  }
  if (kernel.features.fields) {
    // Gentle ones: a strong field presses pairs to where float and double go different ways.
    std::vector<ForceField> fields = sampleFields({}, 0);
    std::erase_if(fields, [](const ForceField& f) { return f.name != "along" && f.name != "vortex"; });
    if (Status set = simulation->setFields(fields); !set) return set.error();
    reference.setFields(fields);
  }
  HeadPose before;
  // Ones at which no pair is within rounding of touching or not in any step: from there on float and double
  // would go different ways.
  const double amplitude = settings.contacts.taper == ContactTaper::time ? 0.032 : 0.031;
  const bool arePairs = settings.contacts.method != ContactMethod::volume;
  const Vec3d turn = arePairs ? Vec3d{0, 0.05, 0} : Vec3d{0.02, 0.05, 0.01};
  double worst = 0;
  for (int frame = 1; frame <= frameCount; ++frame) {
    const HeadPose next{{0, 0, amplitude * std::sin(0.5 * frame)}, fromRotationVector(turn * double(frame))};
    if (Status stepped = simulation->stepFrame(next); !stepped) return stepped.error();
    std::vector<HeadPose> poses;
    for (int k = 1; k <= settings.stepsPerFrame; ++k)
      poses.push_back(interpolate(before, next, double(k) / settings.stepsPerFrame));
    reference.stepFrame(poses);
    before = next;
    const auto positions = simulation->positions();
    if (!positions) return positions.error();
    for (std::size_t i = 0; i < positions->size(); ++i) {
      const double apart = (reference::toEigen<double>((*positions)[i]) - reference.positions()[i]).norm();
      worst = apart <= worst ? worst : std::isnan(apart) ? INFINITY : apart;
    }
    afterFrame(*simulation, reference);
  }
  return worst;
}

}  // namespace ringlet::parity
