// Implements scenes/load/scene_guides.h.
#include "ringlet/scenes/load/scene_guides.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

#include "ringlet/base/quoted.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/scenes/load/scene_parts.h"
#include "ringlet/scenes/load/strand_values.h"

namespace ringlet {
namespace {

using Guides = std::vector<std::uint32_t>;

// The strands of the groom that are simulated: guides, and after them the sample.
using Simulated = std::vector<std::uint32_t>;

// The same runs of strands, by the numbers of those that are simulated.
std::vector<StrandRun> runsAmong(const Simulated& simulated, std::span<const StrandRun> runs) {
  std::vector<StrandRun> among;
  for (std::uint32_t k = 0; k < simulated.size(); ++k) {
    const auto next = std::ranges::upper_bound(runs, simulated[k], {}, &StrandRun::first);
    if (next == runs.begin() || simulated[k] > std::prev(next)->last) continue;
    const float factor = std::prev(next)->factor;
    if (!among.empty() && among.back().last + 1 == k && among.back().factor == factor)
      among.back().last = k;
    else
      among.push_back({k, k, factor});
  }
  return among;
}

std::vector<float> factorsAmong(const Simulated& simulated, std::span<const float> factors) {
  std::vector<float> among;
  if (factors.empty()) return among;
  for (const std::uint32_t s : simulated) among.push_back(factors[s]);
  return among;
}

std::vector<ContactBundle> bundlesAmong(const Simulated& simulated, std::span<const ContactBundle> bundles) {
  std::vector<ContactBundle> among;
  for (const ContactBundle& bundle : bundles) {
    const std::set<std::uint32_t> members(bundle.begin(), bundle.end());
    ContactBundle own;
    for (std::uint32_t k = 0; k < simulated.size(); ++k)
      if (members.count(simulated[k])) own.push_back(k);
    if (!own.empty()) among.push_back(std::move(own));
  }
  return among;
}

void takeFactors(const Simulated& simulated, LoadedScene& loaded) {
  for (StrandFactors& factors : loaded.material.factors)
    factors.runs = std::make_shared<const std::vector<StrandRun>>(runsAmong(simulated, *factors.runs));
  std::erase_if(loaded.material.factors, [](const StrandFactors& factors) { return factors.runs->empty(); });
  ContactSettings& contacts = loaded.settings.contacts;
  if (contacts.bundles)
    contacts.bundles =
        std::make_shared<const std::vector<ContactBundle>>(bundlesAmong(simulated, *contacts.bundles));
  if (contacts.bundles && contacts.bundles->empty()) contacts.bundles = nullptr;
  if (contacts.radiusFactors)
    contacts.radiusFactors =
        std::make_shared<const std::vector<float>>(factorsAmong(simulated, *contacts.radiusFactors));
  loaded.hairs.densities = factorsAmong(simulated, loaded.hairs.densities);
  loaded.hairs.clumps = factorsAmong(simulated, loaded.hairs.clumps);
}

Result<Guides> guidesOfPrimvar(const SceneGroom& scene, std::size_t strandCount) {
  const auto groom = readGroom(scene.file, readingOf(scene, true));
  if (!groom) return groom.error();
  const auto values = valuesOfPrimvar(*groom, scene.guidesPrimvar);
  if (!values) return values.error();
  Guides guides;
  for (std::uint32_t s = 0; s < std::min(values->size(), strandCount); ++s)
    if ((*values)[s] != 0) guides.push_back(s);
  if (guides.empty())
    return Error{fmt::format("{}: the primvar {} is 0 for all {} strands, so that none is a guide",
                             scene.file.string(), ringlet::quoted(scene.guidesPrimvar), strandCount)};
  return guides;
}

Result<LevelOfDetail> levelOf(const SceneGroom& scene, const Groom& groom, std::size_t ofFile) {
  if (ofFile > 0) {
    Guides guides(ofFile);
    std::iota(guides.begin(), guides.end(), static_cast<std::uint32_t>(groom.strandCount() - ofFile));
    auto level = levelOfDetailOfGuides(groom, std::move(guides));
    if (level) level->leaveOutGuides();
    return level;
  }
  if (scene.guidesPrimvar.empty()) return levelOfDetailOfCount(groom, static_cast<std::size_t>(scene.guides));
  auto guides = guidesOfPrimvar(scene, groom.strandCount());
  if (!guides) return guides.error();
  return levelOfDetailOfGuides(groom, std::move(*guides));
}

}  // namespace

bool hasGuides(const SceneGroom& groom) {
  return groom.guides > 0 || !groom.guidesFile.empty() || !groom.guidesPrimvar.empty();
}

Status checkGuides(const SceneFile& scene) {
  const SceneGroom& groom = scene.groom;
  const int ways = (groom.guides > 0) + !groom.guidesFile.empty() + !groom.guidesPrimvar.empty();
  if (ways > 1)
    return Error{"found several of groom.guides, guides_file and guides_primvar; expected one of them"};
  const auto refuse = [](const char* what) {
    return Error{fmt::format("guides do not go together with {}, which names strands of the groom", what)};
  };
  if (ways == 0 && groom.guidesSample > 0)
    return Error{
        "groom.guides_sample has no effect without guides; expected one of guides, guides_file and "
        "guides_primvar"};
  if (ways == 0) return {};
  if (!scene.cuts.empty()) return refuse("[[cut]]");
  if (!scene.timeKeys.empty() && !scene.maps.empty()) return refuse("a [[map]] beside keys over time");
  if (groom.guidesFile.empty()) return {};
  if (!scene.maps.empty()) return refuse("a [[map]]: they have a file of their own");
  if (!scene.groups.empty()) return refuse("a [[group]]: they have a file of their own");
  return {};
}

Result<std::optional<Groom>> readGuides(const SceneGroom& scene, double metresPerUnit,
                                        std::vector<std::string>& warnings) {
  if (scene.guidesFile.empty()) return std::optional<Groom>();
  auto read = readGroom(scene.guidesFile, readingOf(scene, false));
  if (!read) return Error{fmt::format("the guides: {}", read.error().message), read.error().fault};
  for (const std::string& warning : read->warnings)
    warnings.push_back(fmt::format("the guides: {}", warning));
  const double scale =
      read->statesUnit && !scene.metresPerUnit ? read->groom.metresPerUnit / metresPerUnit : 1;
  for (Vec3f& point : read->groom.points) point = Vec3f(Vec3d(point) * scale);
  read->groom.metresPerUnit = metresPerUnit;
  placeGroom(scene, read->groom);
  return std::optional(std::move(read->groom));
}

Status takeGuides(const SceneFile& scene, std::size_t ofFile, LoadedScene& loaded) {
  auto level = levelOf(scene.groom, loaded.groom, ofFile);
  if (!level) return level.error();
  level->addSample(loaded.groom, static_cast<std::size_t>(scene.groom.guidesSample));
  if (ofFile == 0) {
    Simulated simulated = level->guides;
    simulated.insert(simulated.end(), level->sample.begin(), level->sample.end());
    takeFactors(simulated, loaded);
  }
  loaded.groom = level->groom;
  loaded.geometry = nullptr;  // it was that of all strands
  loaded.level = std::make_shared<const LevelOfDetail>(std::move(*level));
  return {};
}

}  // namespace ringlet
