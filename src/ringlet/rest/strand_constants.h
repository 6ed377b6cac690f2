// The laws that turn a material in continuum units into one strand's constants, so that its effect does not
// depend on how finely a strand is divided into edges; and their layout on the device. Mirrored,
// independently, by reference/rest_strand.h.
#pragma once

#include <span>

#include "layout/strands.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/curl_shape.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// One strand's constants in SI units. Those of an edge are these times its scale: 1 / edge length, or 1 for
/// `paper`.
struct StrandConstants {
  double arcLength = 0;                                     // S [m]
  double meanEdgeLength = 0;                                // l, of the chords [m]
  double bendSmoothingLength = 0, coreSmoothingLength = 0;  // alpha_b, alpha_c [m]
  double bendBeta = 1, coreBeta = 1;                        // 1 - exp(-l / alpha)
  double stretchStiffness = 0, stretchDamping = 0;          // K [N], C [N s]; for `paper` k [N/m], c [N s/m]
  double bendStiffness = 0, bendDamping = 0;
  double coreStiffness = 0, coreDamping = 0;
  double coreStiffnessAsked = 0;  // before it was capped for the step
  double longestCoreStep = 0;     // longest outer step with the core spring in full [s]
  double longestBendStep = 0;     // longest outer step at which targets, which a step keeps constant, cannot
                                  // feed bending [s]
};

/// The least length of an edge in its constants and its stretch limit, as a share of the mean edge. Without
/// it, coincident points in a file would give springs of infinite stiffness.
inline constexpr double kShortestEdge = 0.01;

/// The smoothing length below which the bending of a single helix may feed on itself [unit of the shape].
double smoothingLengthOf(const CurlShape& shape, double arcLength);

/// The same for a real strand, whose curl varies: the length that suffices for nine tenths of its curled
/// length, turn by turn [unit]. Perversions are left out: they are flat for half a turn, where the rule gives
/// no useful length.
double smoothingLengthOf(const CurlAlong& curl, double arcLength);

/// The properties of a strand's rest shape that its constants depend on.
struct StrandGeometry {
  double arcLength = 0;         // S [m]
  double meanEdgeLength = 0;    // l, of the chords [m]
  double smoothingLength = 0;   // from its curl [m]
  bool hasPerversions = false;  // its curl changes hand
};

/// `points`: the strand at rest [m]; `arcs`: arc length of each edge [m]. Cost: its curl is measured.
StrandGeometry strandGeometry(std::span<const Vec3d> points, std::span<const double> arcs);

StrandConstants strandConstants(const StrandGeometry& geometry, const Material& material,
                                const Settings& settings);

/// Packs the constants that depend on the material for the device: divided by the mass unit [kg].
void setSprings(layout::StrandRest& rest, const StrandConstants& constants, double massUnit);

}  // namespace ringlet
