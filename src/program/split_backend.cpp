// `--devices`, and several ranks: the strands of a groom on several devices, behind backend.h; each has the
// bits that it has on one. Where strands meet, parts are stepped at the same time and hand each other what
// they do (solver/part_link.h).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>
#include <utility>

#include "parts/strand_parts.h"
#include "program/backend.h"
#include "program/ranks.h"
#include "program/remote_backend.h"
#include "program/threaded_backend.h"
#include "ringlet/base/archive.h"
#include "ringlet/solver/shared_link.h"

namespace ringlet::program {
namespace {

using Parts = std::vector<std::vector<std::uint32_t>>;  // strands of each

struct Part {
  std::unique_ptr<Backend> hair;
  std::vector<std::uint32_t> strands;
};
using Links = std::vector<std::unique_ptr<PartLink>>;

// What all say; once, where they say the same.
std::string joined(const std::vector<Part>& parts, std::string (Backend::*says)() const, bool isOnce) {
  std::vector<std::string> all;
  for (const Part& part : parts) all.push_back((part.hair.get()->*says)());
  if (isOnce && std::set(all.begin(), all.end()).size() == 1) return all[0];
  return fmt::format("{}", fmt::join(all, " + "));
}

class SplitBackend : public Backend {
 public:
  SplitBackend(Links links, std::vector<Part> parts, const std::vector<std::uint32_t>& firstPoint)
      : links_(std::move(links)), parts_(std::move(parts)), firstPoint_(firstPoint) {}

  Status submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                     std::span<const BodyPose> rootPoses) override {
    return each([&](Backend& hair) { return hair.submitFrame(stepPoses, bodyPoses, rootPoses); });
  }
  Status waitFrame() override {
    return each([](Backend& hair) { return hair.waitFrame(); });
  }
  Status change(const Settings& settings, const Material& material, double keysAt) override {
    return each([&](Backend& hair) { return hair.change(settings, material, keysAt); });
  }
  Status setFields(std::span<const ForceField> fields, std::span<const ForceField> from) override {
    return each([&](Backend& hair) { return hair.setFields(fields, from); });
  }
  Status setGoals(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
                  std::span<const Vec3f> from) override {
    return each([&](Backend& hair) { return hair.setGoals(places, strengths, dampingRatio, from); });
  }
  void framePositions(std::span<Vec3f> all) override {
    for (Part& part : parts_) part.hair->framePositions(all);
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
    for (Part& part : parts_) {
      auto state = part.hair->checkpoint();
      if (!state) return state.error();
      archive.list(part.strands);
      archive.list(*state);
    }
    return archive.take();
  }
  Status restore(std::span<const std::byte> checkpoint) override {
    Archive archive = Archive::reading(checkpoint);
    for (Part& part : parts_) {
      std::vector<std::uint32_t> strands;
      std::vector<std::byte> state;
      archive.list(strands);
      archive.list(state);
      if (archive.isShort() || strands != part.strands) break;
      if (Status restored = part.hair->restore(state); !restored) return restored;
    }
    if (!archive.isWhole())
      return Error{
          "the checkpoint is of hair that was divided otherwise; go on with as many devices or ranks, and "
          "with the ringlet that began the run"};
    return {};
  }
  Result<SimulationReport> report() override {
    SimulationReport all;
    double edges = 0;
    for (Part& part : parts_) {
      const auto own = part.hair->report();
      if (!own) return own.error();
      all.maxEdgeStretch = std::max(all.maxEdgeStretch, own->maxEdgeStretch);
      all.velocityResidual = std::max(all.velocityResidual, own->velocityResidual);
      all.nonfinite += own->nonfinite, all.degenerateEdges += own->degenerateEdges;
      const double count = edgesOf(part);
      all.limitedShare += own->limitedShare * count, edges += count;
      const bool isFirst =
          all.firstNonfiniteStrand < 0 || own->firstNonfiniteStrand < all.firstNonfiniteStrand;
      if (own->firstNonfiniteStrand >= 0 && isFirst) {
        all.firstNonfiniteStrand = own->firstNonfiniteStrand;
        all.firstNonfiniteParticle = own->firstNonfiniteParticle;
      }
    }
    all.limitedShare /= edges;
    return all;
  }
  Result<ContactReport> contactReport() override {
    auto all = parts_[0].hair->contactReport();
    for (std::size_t k = 1; k < parts_.size() && all; ++k) {
      const auto own = parts_[k].hair->contactReport();
      if (!own) return own.error();
      all->add(*own);
    }
    return all;
  }
  // They work side by side.
  std::map<std::string, double> stageMilliseconds() const override {
    std::map<std::string, double> longest;
    for (const Part& part : parts_)
      for (const auto& [stage, ms] : part.hair->stageMilliseconds())
        longest[stage] = std::max(longest[stage], ms);
    return longest;
  }
  std::size_t rigidStrandCount() const override {
    return parts_[0].hair->rigidStrandCount();  // of the whole groom
  }
  std::vector<std::string> warnings() const override { return parts_[0].hair->warnings(); }
  std::vector<std::string> deviceMessages() const override {
    std::vector<std::string> all;
    for (const Part& part : parts_)
      for (std::string& message : part.hair->deviceMessages())
        if (std::ranges::find(all, message) == all.end()) all.push_back(std::move(message));
    return all;
  }
  std::vector<std::uint32_t> ownStrands() const override { return parts_[0].strands; }
  std::string device() const override { return joined(parts_, &Backend::device, false); }
  std::string driver() const override { return joined(parts_, &Backend::driver, true); }
  std::string kernel() const override { return joined(parts_, &Backend::kernel, true); }
  bool isTuned() const override {
    return std::ranges::any_of(parts_, [](const Part& part) { return part.hair->isTuned(); });
  }
  double compileMilliseconds() const override {
    double sum = 0;
    for (const Part& part : parts_) sum += part.hair->compileMilliseconds();
    return sum;
  }
  std::optional<std::uint64_t> deviceBytes() const override {
    std::uint64_t sum = 0;
    for (const Part& part : parts_) sum += part.hair->deviceBytes().value_or(0);
    return sum;
  }

 private:
  // The first comes last: it does at once what it is told, while others are under way. All are told, so that
  // none waits for one that was not.
  template <class Do>
  Status each(const Do& act) {
    Status all;
    for (auto part = parts_.rbegin(); part != parts_.rend(); ++part) {
      if (Status done = act(*part->hair); !done && all) all = done;
    }
    return all;
  }

  // The part's own strands of `from`; of others nothing is known there.
  void take(const Part& part, const std::vector<Vec3f>& from, std::vector<Vec3f>& to) const {
    for (const std::uint32_t s : part.strands)
      std::copy(from.begin() + firstPoint_[s], from.begin() + firstPoint_[s + 1],
                to.begin() + firstPoint_[s]);
  }
  double edgesOf(const Part& part) const {
    double edges = 0;
    for (const std::uint32_t s : part.strands) edges += firstPoint_[s + 1] - firstPoint_[s] - 1;
    return edges;
  }

  Links links_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> firstPoint_;  // of the groom
};

Result<std::unique_ptr<Backend>> makePart(const BackendInput& input, const GpuChoice& gpu,
                                          const std::string& device, std::span<const std::uint32_t> strands,
                                          PartLink* link) {
  GpuChoice own = gpu;
  own.device = device;
  own.opened.reset();
  own.kernel.link = link;
  if (!link) own.kernel.part = strands;
  return makeGpuBackend(input, own);
}

// The parts that rank 0 chooses, on every rank: another METIS might choose others.
Result<Parts> dividedByFirst(const BackendInput& input, std::size_t count) {
  Archive written = Archive::writing();
  if (ranks().own == 0) {
    const auto parts = divideStrands(input.groom, input.material, input.settings, count);
    std::string why = parts ? std::string() : parts.error().message;
    std::vector<std::uint32_t> partOf(parts ? input.groom.strandCount() : 0);
    for (std::uint32_t part = 0; parts && part < parts->size(); ++part)
      for (const std::uint32_t strand : (*parts)[part]) partOf[strand] = part;
    written.text(why);
    written.values(std::span(partOf));
  }
  const std::vector<std::byte> bytes = fromFirst(written.take());
  if (isToldToLeave()) return Error{"rank 0 has ended"};
  Archive read = Archive::reading(bytes);
  std::string why;
  read.text(why);
  if (!why.empty()) return Error{why};
  std::vector<std::uint32_t> partOf(input.groom.strandCount());
  read.values(std::span(partOf));
  if (!read.isWhole()) return Error{"rank 0 has another groom than this rank"};
  Parts parts(count);
  for (std::uint32_t strand = 0; strand < partOf.size(); ++strand) parts[partOf[strand]].push_back(strand);
  return parts;
}

Status checkParts(const BackendInput& input, std::size_t count, const char* what) {
  const std::size_t strands = input.groom.strandCount();
  if (count <= strands) return {};
  return Error{fmt::format("{} {} are more than the groom's {} strands", count, what, strands)};
}

}  // namespace

Result<std::unique_ptr<Backend>> makeSplitBackend(const BackendInput& input, const GpuChoice& gpu,
                                                  std::span<const std::string> devices) {
  if (Status enough = checkParts(input, devices.size(), "devices"); !enough) return enough.error();
  const auto divided = divideStrands(input.groom, input.material, input.settings, devices.size());
  if (!divided) return divided.error();
  const Parts& strands = *divided;
  Links links;
  if (input.settings.contacts.on)
    for (auto& link : SharedLink::connect(strands)) links.push_back(std::move(link));
  std::vector<Part> parts;
  for (std::size_t k = 0; k < devices.size(); ++k) {
    auto made = makePart(input, gpu, devices[k], strands[k], links.empty() ? nullptr : links[k].get());
    if (!made) return made.error();
    if (!links.empty() && k > 0) made = onThread(std::move(*made));
    parts.push_back({std::move(*made), strands[k]});
  }
  return std::unique_ptr<Backend>(
      std::make_unique<SplitBackend>(std::move(links), std::move(parts), input.groom.firstPoint));
}

Result<std::unique_ptr<Backend>> makeRankBackend(const BackendInput& input, const GpuChoice& gpu,
                                                 std::span<const std::string> devices) {
  const auto [own, count] = ranks();
  const auto rank = static_cast<std::size_t>(own), rankCount = static_cast<std::size_t>(count);
  if (Status enough = checkParts(input, rankCount, "ranks"); !enough) return enough.error();
  const auto divided = dividedByFirst(input, rankCount);
  if (!divided) return divided.error();
  const Parts& strands = *divided;
  Links links;
  if (input.settings.contacts.on) links.push_back(linkRanks(strands));
  const std::string& device = devices.empty() ? gpu.device : devices[rank % devices.size()];
  auto hair = makePart(input, gpu, device, strands[rank], links.empty() ? nullptr : links[0].get());
  std::vector<Part> parts;
  if (hair) parts.push_back({std::move(*hair), strands[rank]});
  for (int other = 1; own == 0 && other < count; ++other) {
    const std::vector<std::uint32_t>& its = strands[static_cast<std::size_t>(other)];
    auto made = makeRemoteBackend(other, input.groom, its);
    if (!made && hair) hair = made.error();
    if (made) parts.push_back({std::move(*made), its});
  }
  if (!hair) return hair.error();
  return std::unique_ptr<Backend>(
      std::make_unique<SplitBackend>(std::move(links), std::move(parts), input.groom.firstPoint));
}

}  // namespace ringlet::program
