// LoadedGroom: what a reader returns, the groom and what was odd about its file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/groom/usd/usd_matrix.h"

namespace ringlet {

/// Which of a strand's two ends in the file is its root.
enum class RootEnd : std::uint8_t {
  first,
  last,
  head  // the one that is nearer to the head, a ball on which most strands have an end (root_ends.h)
};

/// "first", "last" or "head"; none of another word.
constexpr std::optional<RootEnd> rootEndOf(std::string_view name) {
  if (name == "first") return RootEnd::first;
  if (name == "last") return RootEnd::last;
  if (name == "head") return RootEnd::head;
  return std::nullopt;
}

/// GroomReading::pointsPerStrand is no larger.
inline constexpr std::uint32_t kMostPointsPerStrand = 1'000'000;

/// How a groom is wanted.
struct GroomReading {
  bool upIsZ = false;                 // a file that states its up axis is turned to this one, Y or Z
  bool keepsPrims = false;            // LoadedGroom::prims
  std::uint32_t pointsPerStrand = 0;  // of a file that holds points only; 0: such a file is refused
  RootEnd rootEnd = RootEnd::first;   // strands whose root is the last point are turned round
};

/// What a file says of its curves beside their points: a primvar, ids, widths. Names are USD's, of Alembic's
/// parameters as well.
struct GroomValue {
  std::string name, type, interpolation;  // "primvars:displayColor", "color3f[]", "uniform"
  std::vector<double> numbers;            // one element after the other; or
  std::vector<std::string> texts;
};

/// A prim of a USD file or an object of an Alembic file whose curves are strands of the groom, or all strands
/// of a .hair file that has colours.
struct GroomPrim {
  std::string path;  // "/Head/Hair"; none in .hair
  std::uint32_t firstStrand = 0, strandCount = 0;
  UsdTransform toGroom;            // from where its points stand to the groom's
  bool isWhole = true;             // every curve is a strand and every point a particle
  std::vector<GroomValue> values;  // that fit its strands
};

/// A groom that can be used, and what a person should hear about its file, a sentence each.
struct LoadedGroom {
  Groom groom;
  std::vector<std::string> warnings{};
  bool statesUnit = false;         // groom.metresPerUnit is what the file says; else it is only the usual one
  bool statesUp = false;           // the file says which axis points up
  bool isTurned = false;           // from that one to the other
  bool hasUsdPrims = false;        // its prims are USD's, which a layer may change
  std::vector<GroomPrim> prims{};  // in the order of their strands, where they are asked for
};

}  // namespace ringlet
