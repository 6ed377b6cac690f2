// Implements groom/vary_curl.h.
#include "ringlet/groom/vary_curl.h"

#include <numbers>

#include "ringlet/groom/seeded_random.h"

namespace ringlet {

CurlParameters varyCurl(const CurlParameters& curl, const Variation& variation, std::size_t strand) {
  // Always the same draws in the same order, so that one variation does not change the others.
  SeededRandom random(variation.seed, strand);
  const double radiusFactor = 1 + variation.radius * random.between(-1, 1);
  const double lengthFactor = 1 + variation.length * random.between(-1, 1);
  const double phaseTurns = variation.phase * random.uniform();
  const bool isAgainst = random.uniform() < variation.leftHandedShare;

  CurlParameters varied = curl;
  varied.radius *= radiusFactor;
  varied.length *= lengthFactor;
  varied.turns *= lengthFactor;
  varied.phase += 2 * std::numbers::pi * phaseTurns;
  if (isAgainst) varied.handedness = -curl.handedness;
  return varied;
}

}  // namespace ringlet
