// Implements run/split_hair.h.
#include "ringlet/run/split_hair.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "ringlet/base/archive.h"
#include "ringlet/run/threaded_hair.h"
#include "ringlet/solver/shared_link.h"

namespace ringlet {
namespace {

// A single text if all are equal, else all of them joined.
std::string joinedOnce(const std::vector<std::string>& all) {
  return std::set(all.begin(), all.end()).size() == 1 ? all[0] : fmt::format("{}", fmt::join(all, " + "));
}

// The report of all parts together.
SimulationReport sumOf(std::span<const SimulationReport> parts, std::span<const double> edgeCounts) {
  SimulationReport all;
  double edges = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const SimulationReport& own = parts[k];
    all.maxEdgeStretch = std::max(all.maxEdgeStretch, own.maxEdgeStretch);
    all.velocityResidual = std::max(all.velocityResidual, own.velocityResidual);
    all.nonfinite += own.nonfinite, all.degenerateEdges += own.degenerateEdges;
    all.limitedShare += own.limitedShare * edgeCounts[k], edges += edgeCounts[k];
    const bool isFirst = all.firstNonfiniteStrand < 0 || own.firstNonfiniteStrand < all.firstNonfiniteStrand;
    if (own.firstNonfiniteStrand >= 0 && isFirst) {
      all.firstNonfiniteStrand = own.firstNonfiniteStrand;
      all.firstNonfiniteParticle = own.firstNonfiniteParticle;
    }
  }
  all.limitedShare /= edges;
  return all;
}

class SplitHair : public SceneHair {
 public:
  SplitHair(PartLinks links, std::vector<HairPart> parts, const std::vector<std::uint32_t>& firstPoint)
      : links_(std::move(links)), parts_(std::move(parts)), firstPoint_(firstPoint) {}

  Status submit(const SceneFrame& frame) override {
    if (!frame.change.cuts.empty()) return isNotCut();
    return each([&](SceneHair& hair) { return hair.submit(frame); });
  }
  Status wait() override {
    return each([](SceneHair& hair) { return hair.wait(); });
  }
  void framePositions(std::span<Vec3f> all) override {
    for (HairPart& part : parts_) part.hair->framePositions(all);
  }
  Result<std::vector<Vec3f>> positions() override {
    auto all = parts_[0].hair->positions();
    for (std::size_t k = 1; k < parts_.size() && all; ++k) {
      auto own = parts_[k].hair->positions();
      if (!own) return own.error();
      take(parts_[k], *own, *all);
    }
    return all;
  }
  Result<std::vector<std::byte>> checkpoint() override {
    Archive archive = Archive::writing();
    for (HairPart& part : parts_) {
      auto state = part.hair->checkpoint();
      if (!state) return state.error();
      archive.list(part.strands);
      archive.list(*state);
    }
    return archive.take();
  }
  Status restore(const SceneFrames& frames, int frame, std::span<const std::byte> checkpoint) override {
    Archive archive = Archive::reading(checkpoint);
    for (HairPart& part : parts_) {
      std::vector<std::uint32_t> strands;
      std::vector<std::byte> state;
      archive.list(strands);
      archive.list(state);
      if (archive.isShort() || strands != part.strands) break;
      if (Status restored = part.hair->restore(frames, frame, state); !restored) return restored;
    }
    if (!archive.isWhole())
      return Error{
          "the checkpoint is of hair that was divided otherwise; go on with as many devices or ranks, and "
          "with the ringlet that began the run"};
    return {};
  }
  Result<HairReports> reports() override {
    std::vector<SimulationReport> hairs;
    std::vector<double> edges;
    ContactReport contacts;
    for (HairPart& part : parts_) {
      const auto own = part.hair->reports();
      if (!own) return own.error();
      if (hairs.empty())
        contacts = own->contacts;
      else
        contacts.add(own->contacts);
      hairs.push_back(own->hair);
      edges.push_back(edgesOf(part));
    }
    return HairReports{sumOf(hairs, edges), contacts};
  }
  // Parts work at the same time, so the longest time of each stage counts.
  HairTimes times() const override {
    HairTimes longest;
    for (const HairPart& part : parts_)
      for (const auto& [stage, ms] : part.hair->times().stages)
        longest.stages[stage] = std::max(longest.stages[stage], ms);
    return longest;
  }
  bool tellsTimesOfFrames() const override {
    return std::ranges::all_of(parts_, [](const HairPart& part) { return part.hair->tellsTimesOfFrames(); });
  }
  // Warnings and rigid strands are those of the whole groom.
  HairFacts facts() const override {
    HairFacts all = parts_[0].hair->facts();
    std::vector<std::string> devices{all.device}, drivers{all.driver}, kernels{all.kernel};
    all.deviceBytes = all.deviceBytes.value_or(0);
    for (std::size_t k = 1; k < parts_.size(); ++k) {
      const HairFacts own = parts_[k].hair->facts();
      devices.push_back(own.device), drivers.push_back(own.driver), kernels.push_back(own.kernel);
      all.isTuned = all.isTuned || own.isTuned;
      all.compileMilliseconds += own.compileMilliseconds;
      *all.deviceBytes += own.deviceBytes.value_or(0);
      for (const std::string& message : own.messages)
        if (std::ranges::find(all.messages, message) == all.messages.end()) all.messages.push_back(message);
    }
    all.device = fmt::format("{}", fmt::join(devices, " + "));
    all.driver = joinedOnce(drivers);
    all.kernel = joinedOnce(kernels);
    return all;
  }

 private:
  static Error isNotCut() { return Error{"hair that is divided among devices is not cut; use one device"}; }

  // Part 0 runs on this thread, so the others are started first. Every part is called even after an error,
  // since the others wait for it.
  template <class Do>
  Status each(const Do& act) {
    Status all;
    for (auto part = parts_.rbegin(); part != parts_.rend(); ++part) {
      if (Status done = act(*part->hair); !done && all) all = done;
    }
    return all;
  }

  // Copies the part's own strands; its positions of other strands are unknown.
  void take(const HairPart& part, const std::vector<Vec3f>& from, std::vector<Vec3f>& to) const {
    for (const std::uint32_t s : part.strands)
      std::copy(from.begin() + firstPoint_[s], from.begin() + firstPoint_[s + 1],
                to.begin() + firstPoint_[s]);
  }
  double edgesOf(const HairPart& part) const {
    double edges = 0;
    for (const std::uint32_t s : part.strands) edges += firstPoint_[s + 1] - firstPoint_[s] - 1;
    return edges;
  }

  PartLinks links_;
  std::vector<HairPart> parts_;
  std::vector<std::uint32_t> firstPoint_;  // of each strand in the groom
};

}  // namespace

Result<std::unique_ptr<SceneHair>> makeHairPart(const SceneHairInput& input, DeviceHairChoice choice,
                                                std::span<const std::uint32_t> strands, PartLink* link) {
  choice.kernel.link = link;
  if (!link) choice.kernel.part = strands;
  return makeDeviceHair(input, std::move(choice));
}

std::unique_ptr<SceneHair> joinParts(PartLinks links, std::vector<HairPart> parts, const Groom& groom) {
  return std::make_unique<SplitHair>(std::move(links), std::move(parts), groom.firstPoint);
}

Result<std::unique_ptr<SceneHair>> makeSplitHair(const SceneHairInput& input, const StrandParts& parts,
                                                 std::vector<DeviceHairChoice> choices) {
  PartLinks links;
  if (input.settings().contacts.on)
    for (auto& link : SharedLink::connect(parts)) links.push_back(std::move(link));
  std::vector<HairPart> made;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    auto hair =
        makeHairPart(input, std::move(choices[k]), parts[k], links.empty() ? nullptr : links[k].get());
    if (!hair) return hair.error();
    if (!links.empty() && k > 0) hair = onThread(std::move(*hair));
    made.push_back({std::move(*hair), parts[k]});
  }
  return joinParts(std::move(links), std::move(made), input.scene.groom);
}

}  // namespace ringlet
