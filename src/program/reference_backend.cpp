// `--backend reference`: reference::Simulation<double> behind backend.h.
#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>

#include "program/backend.h"
#include "program/stopwatch.h"
#include "reference/step.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet::program {
namespace {

class ReferenceBackend : public Backend {
 public:
  ReferenceBackend(const BackendInput& input, const ContactReport& atRest, std::vector<std::string> warnings,
                   std::span<const std::uint32_t> rigidStrands)
      : groom_(&input.groom),
        material_(input.material),
        warnings_(std::move(warnings)),
        rigidStrandCount_(rigidStrands.size()),
        contactsAtRest_(atRest),
        simulation_(input.groom, input.material, input.settings, input.start, input.oneStepEarlier, {},
                    input.bodies) {
    simulation_.carryRigidly(rigidStrands);
    if (!input.rootStarts.empty()) simulation_.placeRoots(input.rootStarts, input.rootsEarlier);
    simulation_.placeBodies(input.bodyStarts);
    if (!input.rootShifts.empty()) simulation_.setRootShifts(input.rootShifts);
  }

  Status submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                     std::span<const BodyPose> rootPoses) override {
    times_.push_back(0);
    {
      Stopwatch watch(times_.back());
      simulation_.stepFrame(stepPoses, bodyPoses, rootPoses);
    }
    inFlight_.push_back(pointsNow());
    return {};
  }
  Status waitFrame() override {
    RINGLET_ASSERT(!inFlight_.empty(), "waitFrame without submitFrame");
    waited_ = std::move(inFlight_.front());
    inFlight_.pop_front();
    milliseconds_ += times_.front();
    times_.pop_front();
    return {};
  }
  Status change(const Settings& settings, const Material& material, double /*keysAt*/) override {
    material_ = material;
    simulation_.change(*groom_, material, settings);
    return {};
  }
  Status setFields(std::span<const ForceField> fields, std::span<const ForceField> from) override {
    for (const ForceField& field : fields) {
      if (Status checked = checkForceField(field); !checked) return checked;
    }
    simulation_.setFields(fields, from);
    return {};
  }
  Status setGoals(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
                  std::span<const Vec3f> from) override {
    simulation_.setGoals(places, strengths, dampingRatio, from);
    return {};
  }
  Status cut(std::span<const StrandCut> cuts) override {
    simulation_.cut(*groom_, material_, cuts);
    return {};
  }
  void framePositions(std::span<Vec3f> all) override { std::ranges::copy(waited_, all.begin()); }
  Result<std::vector<Vec3f>> positions() override { return pointsNow(); }
  Result<std::vector<std::byte>> checkpoint() override {
    Archive archive = Archive::writing();
    simulation_.archive(archive);
    return archive.take();
  }
  Status restore(std::span<const std::byte> checkpoint) override {
    Archive archive = Archive::reading(checkpoint);
    simulation_.archive(archive);
    if (!archive.isWhole()) return Error{kForeignCheckpoint};
    return {};
  }

  Result<SimulationReport> report() override {
    const auto from = simulation_.report();
    return SimulationReport{.maxEdgeStretch = from.nonfinite > 0 ? INFINITY : from.maxEdgeStretch,
                            .limitedShare = from.limitedShare(),
                            .nonfinite = from.nonfinite,
                            .degenerateEdges = from.degenerateEdges};
  }

  Result<ContactReport> contactReport() override {
    const auto from = simulation_.report();
    ContactReport report = contactsAtRest_;
    if (!simulation_.settings().contacts.on) return report;
    report.listed = simulation_.contacts().nearCount;
    report.contacts = from.contacts;
    report.pairTests = simulation_.contacts().pairTests;
    report.rebuilds = from.steps;  // all pairs are found anew in every step
    report.momentumError = from.momentumError;
    return report;
  }

  std::map<std::string, double> stageMilliseconds() const override {
    return {{"strand_step", milliseconds_}};
  }
  std::size_t rigidStrandCount() const override { return rigidStrandCount_; }
  std::vector<std::string> warnings() const override { return warnings_; }
  std::vector<std::string> deviceMessages() const override { return {}; }
  std::optional<std::uint64_t> deviceBytes() const override { return std::nullopt; }
  std::string device() const override { return "CPU, one thread"; }
  std::string driver() const override { return "none"; }
  std::string kernel() const override { return "reference, double precision"; }

 private:
  std::vector<Vec3f> pointsNow() const {
    std::vector<Vec3f> points;
    points.reserve(simulation_.positions().size());
    for (const auto& p : simulation_.positions()) points.push_back(Vec3f(Vec3d{p.x(), p.y(), p.z()}));
    return points;
  }

  const Groom* groom_;
  Material material_;
  std::deque<std::vector<Vec3f>> inFlight_;  // computed, and not waited for
  std::vector<Vec3f> waited_;
  std::vector<std::string> warnings_;
  std::size_t rigidStrandCount_;
  ContactReport contactsAtRest_;
  reference::Simulation<double> simulation_;
  std::deque<double> times_;  // of the frames in flight [ms]
  double milliseconds_ = 0;   // of those waited for
};

}  // namespace

Result<std::unique_ptr<Backend>> makeReferenceBackend(const BackendInput& input) {
  for (const Body& body : input.bodies) {
    if (Status checked = checkBody(body); !checked) return checked.error();
  }
  if (!input.bodies.empty() && input.settings.integrator != Integrator::jacobi)
    return Error{kBodiesNeedJacobi};
  auto rest = buildRestState(input.groom, input.material, input.settings);
  if (!rest) return rest.error();
  ContactReport contacts;
  if (const ContactSettings& settings = input.settings.contacts; settings.on && !rest->strands.empty()) {
    // The reference derives its own; these counts and warnings are those the solver gives.
    const RestContacts atRest = buildRestContacts(*rest, settings);
    contacts = {.contactParticles = atRest.particles.particles.size(),
                .pairsUnpruned = atRest.graph.pairsUnpruned,
                .pairs = atRest.graph.pairs,
                .volumeStrands = atRest.volume.count};
    std::ranges::copy(atRest.warnings(), std::back_inserter(rest->warnings));
  }
  std::vector<std::uint32_t> rigid;
  for (const RigidStrand& strand : rest->rigid) rigid.push_back(strand.strandInGroom);
  return std::unique_ptr<Backend>(
      std::make_unique<ReferenceBackend>(input, contacts, std::move(rest->warnings), rigid));
}

}  // namespace ringlet::program
