// Implements makeCurl and makeSwatch of groom/generate.h; makeHead is in generate_head.cpp.
#include "ringlet/groom/generate.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "ringlet/groom/coarse_curls.h"
#include "ringlet/groom/generate_check.h"
#include "ringlet/groom/vary_curl.h"

namespace ringlet {
namespace {

// A helix hanging from `top`. Seen along -Y, the way it goes, X turns to Z clockwise: right-handed.
void addCurl(Groom& groom, Vec3d top, const CurlParameters& curl) {
  std::vector<Vec3f> strand;
  strand.reserve(static_cast<std::size_t>(curl.particleCount));
  for (int i = 0; i < curl.particleCount; ++i) {
    const double s = double(i) / (curl.particleCount - 1);
    const double angle = curl.phase + 2 * std::numbers::pi * curl.turns * s * curl.handedness;
    const Vec3d p =
        top + Vec3d{curl.radius * std::cos(angle), -curl.length * s, curl.radius * std::sin(angle)};
    strand.push_back(Vec3f(p / curl.metresPerUnit));
  }
  groom.addStrand(strand);
}

}  // namespace

std::optional<std::string> coarseCurlWarning(const CurlParameters& parameters) {
  const double wanted = std::ceil(kParticlesPerTurn * parameters.turns);
  if (parameters.particleCount >= wanted) return std::nullopt;
  return fmt::format(
      "{} particles are {:.3g} for each of the {} turns; a curl holds its shape from {}, {} in all",
      parameters.particleCount, parameters.particleCount / parameters.turns, parameters.turns,
      kParticlesPerTurn, wanted);
}

Result<Groom> makeCurl(const CurlParameters& parameters) {
  if (Status status = checkParameters(parameters); !status) return status.error();
  Groom groom;
  groom.metresPerUnit = parameters.metresPerUnit;
  addCurl(groom, {}, parameters);
  return groom;
}

Result<Groom> makeSwatch(const SwatchParameters& parameters) {
  if (Status status = checkParameters(parameters); !status) return status.error();
  Groom groom;
  groom.metresPerUnit = parameters.curl.metresPerUnit;
  for (int row = 0; row < parameters.rowCount; ++row) {
    for (int column = 0; column < parameters.columnCount; ++column) {
      const Vec3d top{(column - (parameters.columnCount - 1) / 2.0) * parameters.spacing, 0,
                      (row - (parameters.rowCount - 1) / 2.0) * parameters.spacing};
      addCurl(groom, top, varyCurl(parameters.curl, parameters.variation, groom.strandCount()));
    }
  }
  return groom;
}

}  // namespace ringlet
