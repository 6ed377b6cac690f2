// StrandColours: pictures in which a number of each strand gives its colour (--colour stretch, contacts,
// strand, error).
//
//     frame -> a number of each strand -> over the number of the last colour, in [0, 1] -> pigments of hairs
//
// Stretch is computed on the device, where the strands are.
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
  const char* effect;  // meaning of the number, of a strand
  double most;         // default for the number of the last colour; 0: the number is no scale
  const char* unit;    // "1" or "m"

  /// "blue 0, red 5 % and more: EFFECT".
  std::string sentence(double mostShown) const;
  /// "5 %".
  std::string withUnit(double number) const;
};
/// Null for an unknown name.
const StrandScale* strandScaleNamed(std::string_view name);
std::string strandScaleNames();  // separated by commas

struct StrandColourChoice {
  const StrandScale* scale = nullptr;
  double most = 0;                // number of the last colour
  std::filesystem::path against;  // the other animation, for "error"
};

/// Strands that colours tell something of.
struct ColouredStrands {
  const Groom& rest;
  double metresPerUnit = 0.01;
  const LoadedScene* scene = nullptr;  // whose material and contacts they have, or null
};

class StrandColours {
 public:
  /// Buffers of `hair` and `renderer` are kept. Errors: the animation to compare with cannot be read or is of
  /// other strands.
  static Result<StrandColours> create(const StrandColourChoice& choice, const ComputeDevice& device,
                                      const ColouredStrands& strands, const PictureHair& hair,
                                      HairRenderer& renderer);

  /// The pigments between which the scale interpolates.
  static std::vector<Absorption> pigmentsOf(const StrandScale& scale);

  /// Sets the numbers of a frame, which counts from 1 and must be later than the last; `points`: of the
  /// strands, in their unit. The device must be idle.
  Status setFrame(HairRenderer& renderer, int frame, std::span<const Vec3f> points);
  /// Call between moving and drawing the strands. Ends with a barrier.
  void record(gpu::CommandList& list) const;

 private:
  using Numbers = Result<std::vector<float>>;  // one per strand
  StrandColours() = default;

  double most_ = 1;
  std::vector<std::uint32_t> strandOf_;
  std::optional<StretchColours> stretch_;  // either this or numbers_
  std::function<Numbers(int frame, std::span<const Vec3f> points)> numbers_;
};

}  // namespace ringlet
