// StrandColours: pictures in which the colour of hair is a number of its strand (--colour stretch, contacts,
// strand, error).
//
//     frame -> a number of each strand -> over what the last colour stands for, in [0, 1] -> pigments of
//     hairs
//
// Stretch is found on the device, where the strands are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/pictures/picture_hair.h"
#include "ringlet/render/hair_renderer.h"
#include "ringlet/render/stretch_colours.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet {

/// What may be shown in place of a hair colour.
struct StrandScale {
  const char* name;
  const char* effect;  // what of a strand
  double most;         // that the last colour stands for, where nothing says it; 0: it is no scale
  const char* unit;    // "1" or "m"

  /// "blue 0, red 5 % and more: EFFECT".
  std::string sentence(double mostShown) const;
  /// "5 %".
  std::string withUnit(double number) const;
};
/// None for another name.
const StrandScale* strandScaleNamed(std::string_view name);
std::string strandScaleNames();  // separated by commas

struct StrandColourChoice {
  const StrandScale* scale = nullptr;
  double most = 0;                // that the last colour stands for
  std::filesystem::path against;  // the other animation, of "error"
};

class StrandColours {
 public:
  /// `rest`: the strands at rest, whose unit is `metresPerUnit`; `scene`: whose material and contacts they
  /// have, or null. Buffers of `hair` and `renderer` are kept. Errors: the animation to compare with cannot
  /// be read or is of other strands.
  static Result<StrandColours> create(const StrandColourChoice& choice, const ComputeDevice& device,
                                      const Groom& rest, double metresPerUnit, const LoadedScene* scene,
                                      const PictureHair& hair, HairRenderer& renderer);

  /// The pigments that hairs differ by.
  static std::vector<Absorption> pigmentsOf(const StrandScale& scale);

  /// Of a later frame than before, from 1; `points` of its strands, in their unit. Nothing may be under way.
  Status setFrame(HairRenderer& renderer, int frame, std::span<const Vec3f> points);
  /// After the strands are where they are drawn, before they are drawn. Ends with a barrier.
  void record(gpu::CommandList& list) const;

 private:
  using Numbers = Result<std::vector<float>>;  // one a strand
  StrandColours() = default;

  double most_ = 1;
  std::vector<std::uint32_t> strandOf_;
  std::optional<StretchColours> stretch_;  // one of the two
  std::function<Numbers(int frame, std::span<const Vec3f> points)> numbers_;
};

}  // namespace ringlet
