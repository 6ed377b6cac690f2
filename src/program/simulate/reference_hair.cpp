// `--backend reference`: reference::Simulation<double> as hair of a scene.
#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>

#include "program/simulate/reference_hair.h"
#include "reference/step.h"
#include "ringlet/base/archive.h"
#include "ringlet/base/stopwatch.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/run/scene_run.h"

namespace ringlet::program {
namespace {

class ReferenceHair : public SceneHair {
 public:
  ReferenceHair(const SceneHairInput& input, const ScenePlaces& start, const ContactReport& atRest,
                std::vector<std::string> warnings, std::span<const std::uint32_t> rigidStrands)
      : groom_(&input.scene.groom),
        material_(input.scene.material),
        isStepByStep_(input.isStepByStep),
        warnings_(std::move(warnings)),
        rigidStrandCount_(rigidStrands.size()),
        contactsAtRest_(atRest),
        simulation_(input.scene.groom, input.scene.material, input.settings(), start.head, start.headEarlier,
                    {}, input.scene.bodies) {
    simulation_.carryRigidly(rigidStrands);
    if (!start.roots.empty()) simulation_.placeRoots(start.roots, start.rootsEarlier);
    simulation_.placeBodies(start.bodies);
    if (!input.scene.rootShifts.empty()) simulation_.setRootShifts(input.scene.rootShifts);
    if (input.scene.start) beginShot(start, input.scene);
  }

  Status submit(const SceneFrame& frame) override {
    if (Status taken = takeChange(frame.change, isStepByStep_, *this); !taken) return taken;
    if (Status set = frame.forces.set(*this); !set) return set;
    times_.push_back(0);
    {
      Stopwatch watch(times_.back());
      simulation_.stepFrame(frame.heads, frame.bodies, frame.roots, frame.bodyPoints());
    }
    inFlight_.push_back(pointsNow());
    return {};
  }
  Status wait() override {
    RINGLET_ASSERT(!inFlight_.empty(), "wait without submit");
    waited_ = std::move(inFlight_.front());
    inFlight_.pop_front();
    milliseconds_ += times_.front();
    times_.pop_front();
    return {};
  }
  void framePositions(std::span<Vec3f> all) override { std::ranges::copy(waited_, all.begin()); }
  Result<std::vector<Vec3f>> positions() override { return pointsNow(); }
  Result<std::vector<std::byte>> checkpoint() override {
    Archive archive = Archive::writing();
    simulation_.archive(archive);
    return archive.take();
  }
  Status restore(const SceneFrames& frames, int frame, std::span<const std::byte> checkpoint) override {
    if (Status taken = takeChangesBefore(frames, frame, isStepByStep_, *this); !taken) return taken;
    Archive archive = Archive::reading(checkpoint);
    simulation_.archive(archive);
    if (!archive.isWhole()) return Error{kForeignCheckpoint};
    return {};
  }
  Result<HairReports> reports() override { return HairReports{report(), contactReport()}; }
  HairTimes times() const override { return {.stages = {{"strand_step", milliseconds_}}}; }
  HairFacts facts() const override {
    return {.device = "CPU, one thread",
            .driver = "none",
            .kernel = "reference, double precision",
            .rigidStrandCount = rigidStrandCount_,
            .warnings = warnings_};
  }

  // The functions that takeChange and FrameForces need.
  Status cut(std::span<const StrandCut> cuts) {
    simulation_.cut(*groom_, material_, cuts);
    return {};
  }
  Status setNumbers(const Settings& settings, const Material& material) {
    if (settings == simulation_.settings() && material == material_) return {};
    material_ = material;
    simulation_.change(*groom_, material, settings);
    return {};
  }
  Status setFields(std::span<const ForceField> fields, std::span<const ForceField> from) {
    for (const ForceField& field : fields) {
      if (Status checked = checkForceField(field); !checked) return checked;
    }
    simulation_.setFields(fields, from);
    return {};
  }
  Status setGoals(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
                  std::span<const Vec3f> from) {
    simulation_.setGoals(places, strengths, dampingRatio, from);
    return {};
  }

 private:
  void beginShot(const ScenePlaces& places, const LoadedScene& scene) {
    const auto fieldOf = [](const std::vector<Vec3f>& points) {
      reference::Field<double> field;
      for (const Vec3f& p : points) field.push_back(reference::toEigen<double>(p));
      return field;
    };
    const HairState begun = startOf({pointsNow(), pointsOf(simulation_.velocities())}, places, scene);
    simulation_.setState(fieldOf(begun.positions), fieldOf(begun.velocities));
  }

  SimulationReport report() {
    const auto from = simulation_.report();
    return SimulationReport{.maxEdgeStretch = from.nonfinite > 0 ? INFINITY : from.maxEdgeStretch,
                            .limitedShare = from.limitedShare(),
                            .nonfinite = from.nonfinite,
                            .degenerateEdges = from.degenerateEdges};
  }

  ContactReport contactReport() {
    const auto from = simulation_.report();
    ContactReport report = contactsAtRest_;
    if (!simulation_.settings().contacts.on) return report;
    report.listed = simulation_.contacts().nearCount;
    report.contacts = from.contacts;
    report.pairTests = simulation_.contacts().pairTests;
    report.rebuilds = from.steps;  // every step searches all pairs
    report.momentumError = from.momentumError;
    report.ways = simulation_.ways();
    return report;
  }

  static std::vector<Vec3f> pointsOf(const reference::Field<double>& field) {
    std::vector<Vec3f> points;
    points.reserve(field.size());
    for (const auto& p : field) points.push_back(Vec3f(Vec3d{p.x(), p.y(), p.z()}));
    return points;
  }
  std::vector<Vec3f> pointsNow() const { return pointsOf(simulation_.positions()); }

  const Groom* groom_;
  Material material_;
  bool isStepByStep_;
  std::deque<std::vector<Vec3f>> inFlight_;  // stepped, but not waited for yet
  std::vector<Vec3f> waited_;
  std::vector<std::string> warnings_;
  std::size_t rigidStrandCount_;
  ContactReport contactsAtRest_;
  reference::Simulation<double> simulation_;
  std::deque<double> times_;  // of the frames in flight [ms]
  double milliseconds_ = 0;   // of all frames waited for
};

}  // namespace

Result<std::unique_ptr<SceneHair>> makeReferenceHair(const SceneHairInput& input) {
  const LoadedScene& scene = input.scene;
  const Settings settings = input.settings();
  if (settings.contacts.on && scene.keys && scene.keys->changeContacts())
    return Error{"numbers of contacts change over time on the GPU only (--backend gpu)"};
  for (const Body& body : scene.bodies) {
    if (Status checked = checkBody(body); !checked) return checked.error();
  }
  if (!scene.bodies.empty() && settings.integrator != Integrator::jacobi) return Error{kBodiesNeedJacobi};
  auto rest = buildRestState(scene.groom, scene.material, settings);
  if (!rest) return rest.error();
  ContactReport contacts;
  if (const ContactSettings& pairs = settings.contacts; pairs.on && !rest->strands.empty()) {
    // The reference derives its own contacts; these counts and warnings are computed as the solver does.
    const RestContacts atRest = buildRestContacts(*rest, pairs);
    contacts = {.contactParticles = atRest.particles.particles.size(),
                .pairsUnpruned = atRest.graph.pairsUnpruned,
                .pairs = atRest.graph.pairs,
                .volumeStrands = atRest.volume.count};
    std::ranges::copy(atRest.warnings(), std::back_inserter(rest->warnings));
  }
  std::vector<std::uint32_t> rigid;
  for (const RigidStrand& strand : rest->rigid) rigid.push_back(strand.strandInGroom);
  const ScenePlaces start = input.frames.placesAt(input.frames.first());
  return std::unique_ptr<SceneHair>(
      std::make_unique<ReferenceHair>(input, start, contacts, std::move(rest->warnings), rigid));
}

}  // namespace ringlet::program
