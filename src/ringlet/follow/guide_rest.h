// GuideRest: a guide as it was groomed, for the hairs that follow it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/measure/core.h"

namespace ringlet {

struct GuideRest {
  std::vector<double> arcs;  // where its particles stand, from 0 at the root [m]
  double window = 0;         // what its core is smoothed over [m]
  Vec3d root;                // [m]
  MeasuringFrame frame;      // of its core at the root
  std::array<Vec3d, 4> way;  // its core from the root to each quarter of the particles [m]
  // Rising: the particles that begin a piece which is cut off at some time. Each piece has a core of its own,
  // at all times, so that nothing jumps when it is cut.
  std::vector<std::uint32_t> pieces{};

  bool beginsPiece(std::size_t particle) const {
    return std::ranges::binary_search(pieces, static_cast<std::uint32_t>(particle));
  }
};

/// Consecutive particles [begin, end) of a guide that no cut ever parts, and what their core is smoothed
/// over.
struct GuidePiece {
  std::size_t begin = 0, end = 0;
  double window = 0;  // [m]; 0: a single particle, which is its own core
};
std::vector<GuidePiece> piecesOf(const GuideRest& guide);
/// Where the particles of a piece stand, from 0 [m].
std::vector<double> arcsOf(const GuideRest& guide, const GuidePiece& piece);

/// Of a strand's rest points [m], at least two and not all in one place. Cost: n log n.
GuideRest restOfGuide(std::span<const Vec3d> strand);

/// How far two guides part: the angle between where their cores lead, to whichever quarter it is largest
/// [rad], about; 0 for guides side by side.
double partingOf(const GuideRest& a, const GuideRest& b);

/// Takes x, y and z to the frame's normal, binormal and tangent.
Quatd quaternionOf(const MeasuringFrame& frame);

}  // namespace ringlet
