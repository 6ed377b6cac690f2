// Implements solver/contacts/crossing_stage.h.
#include "ringlet/solver/contacts/crossing_stage.h"

namespace ringlet {
namespace {

CrossingHair hairOf(const RestState& rest, const Settings& settings) {
  CrossingHair hair{.firstPoint = {0}, .bundles = {}, .takesPart = {}, .masses = {}, .lengths = {}};
  for (std::size_t s = 0; s < rest.strands.size(); ++s) {
    const layout::StrandRest& strand = rest.strands[s];
    for (std::uint32_t i = 0; i < strand.particleCount; ++i) {
      const layout::ParticleRest& particle = rest.particles[strand.firstParticle + i];
      const bool isPinned = i < static_cast<std::uint32_t>(settings.rootCount);
      hair.masses.push_back(isPinned ? 0 : double{particle.mass} * double{strand.massUnit});
      hair.lengths.push_back(i + 1 < strand.particleCount ? double{particle.edgeLength} : 0);
    }
    hair.firstPoint.push_back(static_cast<std::uint32_t>(hair.masses.size()));
  }
  const std::vector<std::uint32_t> bundles = bundlesOf(settings.contacts, rest.groomStrandCount);
  for (const std::uint32_t strand : rest.strandInGroom)
    if (!bundles.empty()) hair.bundles.push_back(bundles[strand]);
  return hair;
}

Vec3d pointOf(const layout::vec4& v) { return {double{v.x}, double{v.y}, double{v.z}}; }

}  // namespace

CrossingStage::CrossingStage(const RestState& rest, const Settings& settings)
    : hair_(hairOf(rest, settings)) {}

void CrossingStage::beginFrame(std::span<const HeadPose> heads) {
  turns_.clear();
  for (std::size_t k = 1; k < heads.size(); ++k)
    turns_.push_back(normalized(heads[k].rotation * heads[k - 1].rotation.conjugate()));
}

Status CrossingStage::begin(const DeviceGroom& groom) {
  starts_.clear();
  return groom.downloadEach(&DeviceChunk::positions,
                            [&](std::size_t, const layout::vec4& v) { starts_.push_back(pointOf(v)); });
}

Status CrossingStage::keepApart(DeviceGroom& groom, const Settings& settings, std::uint32_t step) {
  std::vector<Vec3d> wanted;
  const auto take = [&](std::size_t, const layout::vec4& v) { wanted.push_back(pointOf(v)); };
  if (Status status = groom.downloadEach(&DeviceChunk::positions, take); !status) return status;
  std::vector<Vec3d> placed = wanted;
  hair_.maxStretch = settings.maxStretch;
  report_.add(keepFromCrossing(hair_, turns_[step], starts_, placed));
  starts_ = placed;
  if (placed == wanted) return {};
  const double T = settings.stepSeconds();
  const auto stored = [&](std::size_t i) {
    const Vec3f x = static_cast<Vec3f>(placed[i]);
    return layout::vec4{x.x, x.y, x.z, 0};
  };
  if (Status status = groom.uploadEach(&DeviceChunk::positions, stored); !status) return status;
  std::size_t place = 0;
  const auto quickened = [&](layout::vec4 v) {
    const Vec3d change = placed[place] - wanted[place];
    ++place;
    if (change == Vec3d{}) return v;
    const Vec3f speed = static_cast<Vec3f>(pointOf(v) + change / T);
    return layout::vec4{speed.x, speed.y, speed.z, v.w};
  };
  return groom.changeEach(&DeviceChunk::velocities, quickened);
}

}  // namespace ringlet
