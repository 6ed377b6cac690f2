// Implements strand_colours.h.
#include "ringlet/pictures/strand_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "ringlet/measure/contact_quality.h"
#include "ringlet/output/animation_reader.h"

namespace ringlet {
namespace {

using Numbers = Result<std::vector<float>>;
using Source = std::function<Numbers(int, std::span<const Vec3f>)>;

constexpr StrandScale kScales[] = {
    {"stretch", "by how much the strand's longest edge is longer than at rest", 0.05, "1"},
    {"contacts", "how deep the strand is in others beyond rest, over the sum of the radii", 1, "1"},
    {"strand", "each strand in a colour of its own", 0, ""},
    {"error", "how far the strand's farthest particle is from the other run", 0.01, "m"},
};

// A pseudo-random number in [0, 1): generated roots follow a pattern, which multiples of one number would
// show.
float placeOf(std::size_t strand) {
  std::uint32_t x = static_cast<std::uint32_t>(strand) * 0x9e3779b9u + 1;
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return static_cast<float>((x ^ x >> 16) >> 8) / 16777216.0f;
}

std::vector<Vec3f> inMetres(std::span<const Vec3f> points, double metresPerUnit) {
  std::vector<Vec3f> metres;
  for (const Vec3f& p : points) metres.push_back(Vec3f(Vec3d(p) * metresPerUnit));
  return metres;
}

Source placesOfStrands(std::size_t count) {
  return [count](int, std::span<const Vec3f>) -> Numbers {
    std::vector<float> places;
    for (std::size_t s = 0; s < count; ++s) places.push_back(placeOf(s));
    return places;
  };
}

Result<Source> overlaps(const Groom& rest, double metresPerUnit, const LoadedScene* scene) {
  Groom groom = rest;
  groom.metresPerUnit = metresPerUnit;
  auto ruler =
      ContactRuler::make(groom, scene ? scene->material : Material{}, scene ? scene->settings : Settings{});
  if (!ruler) return ruler.error();
  const auto shared = std::make_shared<const ContactRuler>(std::move(*ruler));
  return Source([shared, metresPerUnit](int, std::span<const Vec3f> points) -> Numbers {
    return shared->overlapOfStrands(inMetres(points, metresPerUnit));
  });
}

Result<Source> distances(const std::filesystem::path& against, const Groom& strands, double metresPerUnit) {
  auto opened = AnimationReader::open(against);
  if (!opened) return opened.error();
  if (opened->groom().firstPoint != strands.firstPoint)
    return Error{fmt::format(
        "{} is of {} strands with {} particles in all, the run of {} with {}; only the same strands can be "
        "compared",
        against.string(), opened->groom().strandCount(), opened->groom().firstPoint.back(),
        strands.strandCount(), strands.firstPoint.back())};
  const auto other = std::make_shared<AnimationReader>(std::move(*opened));
  return Source([other, against, metresPerUnit](int frame, std::span<const Vec3f> points) -> Numbers {
    if (frame > other->frameCount())
      return Error{fmt::format("{} has {} frames; there is no frame {} to compare with", against.string(),
                               other->frameCount(), frame)};
    if (Status read = other->readFrame(frame); !read) return read.error();
    const Groom& there = other->groom();
    const double unit = other->header().metresPerUnit;
    std::vector<float> farthest;
    for (std::size_t s = 0; s < there.strandCount(); ++s) {
      double most = 0;
      for (std::uint32_t i = there.firstPoint[s]; i < there.firstPoint[s + 1]; ++i)
        most = std::max(most, length(Vec3d(points[i]) * metresPerUnit - Vec3d(there.points[i]) * unit));
      farthest.push_back(static_cast<float>(most));
    }
    return farthest;
  });
}

}  // namespace

std::string StrandScale::sentence(double mostShown) const {
  if (most == 0) return effect;
  return fmt::format("blue 0, red {} and more: {}", withUnit(mostShown), effect);
}

std::string StrandScale::withUnit(double number) const {
  const bool isLength = std::string_view(unit) == "m";
  return fmt::format("{:.4g} {}", number * (isLength ? 1000 : 100), isLength ? "mm" : "%");
}

const StrandScale* strandScaleNamed(std::string_view name) {
  const auto* found =
      std::ranges::find_if(kScales, [&](const StrandScale& each) { return each.name == name; });
  return found == std::end(kScales) ? nullptr : found;
}

std::string strandScaleNames() {
  std::string names;
  for (const StrandScale& scale : kScales) names += (names.empty() ? "" : ", ") + std::string(scale.name);
  return names;
}

std::vector<Absorption> StrandColours::pigmentsOf(const StrandScale& scale) {
  return scale.most == 0 ? rainbowPigments() : scalePigments();
}

Result<StrandColours> StrandColours::create(const StrandColourChoice& choice, const ComputeDevice& device,
                                            const ColouredStrands& strands, const PictureHair& hair,
                                            HairRenderer& renderer) {
  const auto& [rest, metresPerUnit, scene] = strands;
  StrandColours self;
  self.most_ = choice.most > 0 ? choice.most : 1;
  self.strandOf_ = hair.strandOf();
  if (rest.strandCount() != hair.strandCount())
    return Error{fmt::format("the groom has {} strands, the animation {}: they do not belong together",
                             rest.strandCount(), hair.strandCount())};
  const std::string_view name = choice.scale->name;
  if (name == "stretch") {
    std::vector<Vec3d> metres;
    for (const Vec3f& p : rest.points) metres.push_back(Vec3d(p) * metresPerUnit);
    auto stretch = StretchColours::create(device.gpu(), hair.strandPoints(), metres, rest.firstPoint,
                                          self.strandOf_, renderer.drawnHairs());
    if (!stretch) return stretch.error();
    self.stretch_.emplace(std::move(*stretch));
    return self;
  }
  auto source = name == "contacts" ? overlaps(rest, metresPerUnit, scene)
                : name == "error"  ? distances(choice.against, rest, metresPerUnit)
                                   : Result<Source>(placesOfStrands(hair.strandCount()));
  if (!source) return source.error();
  self.numbers_ = std::move(*source);
  return self;
}

Status StrandColours::setFrame(HairRenderer& renderer, int frame, std::span<const Vec3f> points) {
  if (!numbers_) return {};
  const Numbers numbers = numbers_(frame, points);
  if (!numbers) return numbers.error();
  std::vector<float> pigments;
  pigments.reserve(strandOf_.size());
  for (const std::uint32_t strand : strandOf_)
    pigments.push_back(std::clamp((*numbers)[strand] / static_cast<float>(most_), 0.0f, 1.0f));
  return renderer.setPigments(pigments);
}

void StrandColours::record(gpu::CommandList& list) const {
  if (stretch_) stretch_->record(list, most_);
}

}  // namespace ringlet
