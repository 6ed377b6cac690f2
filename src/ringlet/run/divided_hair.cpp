// Implements run/divided_hair.h.
#include "ringlet/run/divided_hair.h"

#include <fmt/format.h>

#include <utility>

#include "ringlet/rest/whole_rest.h"
#include "ringlet/run/split_hair.h"
#include "ringlet/run/strand_parts.h"

namespace ringlet {

Result<WholeRest> wholeRestOf(const SceneHairInput& input) {
  const LoadedScene& scene = input.scene;
  const auto geometry = scene.geometry ? std::span(*scene.geometry) : std::span<const StrandGeometry>();
  return buildWholeRest(scene.groom, scene.material, input.settings(), geometry);
}

Result<std::unique_ptr<SceneHair>> makeDividedHair(const SceneHairInput& input,
                                                   std::vector<DeviceHairChoice> choices) {
  if (choices.size() == 1) return makeDeviceHair(input, std::move(choices[0]));
  const std::size_t count = choices.size(), strands = input.scene.groom.strandCount();
  if (count > strands)
    return Error{fmt::format("{} devices are more than the groom's {} strands", count, strands)};
  const auto rest = wholeRestOf(input);
  if (!rest) return rest.error();
  const auto parts = divideStrands(input.scene.groom, input.settings(), *rest, count);
  if (!parts) return parts.error();
  SceneHairInput withRest = input;
  withRest.rest = &*rest;
  return makeSplitHair(withRest, *parts, std::move(choices));
}

HairMaker hairOn(std::vector<ComputeDevice> devices, const KernelChoice& kernel) {
  return [devices = std::move(devices),
          kernel](const SceneHairInput& input) -> Result<std::unique_ptr<SceneHair>> {
    std::vector<DeviceHairChoice> choices;
    for (const ComputeDevice& device : devices) choices.push_back({device, kernel});
    if (choices.empty()) {
      auto opened = ComputeDevice::open();
      if (!opened) return opened.error();
      choices.push_back({std::move(*opened), kernel});
    }
    return makeDividedHair(input, std::move(choices));
  };
}

}  // namespace ringlet
