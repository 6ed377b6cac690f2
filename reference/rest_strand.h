// The rest state of one strand: its constants per edge, masses, rest targets and preload. The reference's own
// derivation from groom points and material; a test compares it with ringlet/rest, whose job is the same, so
// that a fault there cannot hide. Numbers like "(3.1)" are sections of Iben et al. 2012.
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "reference/fields.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/settings.h"

namespace ringlet::reference {

/// What a strand is at rest. Particles 0..N-1, edges 0..N-2. Lengths in metres, in the groom's own axes.
template <class Real>
struct RestStrand {
  std::size_t rootCount = 1;  // particles that follow the head; 0: it was cut off and falls
  Field<Real> points;         // N: p_i [m]
  Field<Real> edges;          // N-1: p_{i+1} - p_i [m]
  Scalars<Real> masses;       // N: m_i [kg]; 1 for Integrator::paper
  Scalars<Real>
      edgeLengths;  // N-1: l_i, for constants and stretch limit, floored at 0.01 of the mean edge [m]

  // N-1 each: k [N/m] and c [N s/m]. bendDamping is what the step uses, compensated for the implicit
  // integrators.
  Scalars<Real> stretchStiffness, stretchDamping;
  Scalars<Real> bendStiffness, bendDamping;
  Scalars<Real> coreStiffness, coreDamping;

  Real bendSmoothingShare = 1, coreSmoothingShare = 1;  // beta_b, beta_c [1]
  Scalars<Real> stretchRestLengths;                     // N-1: |rest edge| less preload [m]
  Field<Real> restTargets;                              // N-1: target in the frame F_{i-1} [m]
  Scalars<Real> coreRestLengths;                        // N-1: |b_i| at rest [m]
  Real coreLength = 0;                                  // sum of coreRestLengths [m]

  // What the above was derived from. Numbers of the material that act as they are, the step reads from here.
  Material material;                                        // of this strand
  double arcLength = 0;                                     // S [m]
  double meanEdgeLength = 0;                                // l [m]
  double bendSmoothingLength = 0, coreSmoothingLength = 0;  // alpha_b, alpha_c [m]
  bool changesHand = false;                                 // the rest curl has a perversion
  bool coreIsCapped = false;  // K_c was lowered, because the step is too long for it

  /// A number of the material.
  Real of(double Material::*number) const { return static_cast<Real>(material.*number); }

  // Of what falls: how its rest shape was turned when it was cut. Its frames and filters begin along its own
  // first edge.
  Rotation<double> restTurn = Rotation<double>::Identity();

  bool falls() const { return rootCount == 0; }
  std::size_t particleCount() const { return points.size(); }
  std::size_t edgeCount() const { return edges.size(); }
  std::size_t pinnedCount() const { return std::min(rootCount, particleCount()); }
};

/// Of a strand's particles those that cuts left together, [begin, end).
struct StrandPiece {
  std::size_t begin = 0, end = std::numeric_limits<std::size_t>::max();
};

/// The rest state of one strand for Settings, derived in double and rounded to Real last. A piece of it has
/// the springs, masses and shape of the whole.
template <class Real>
RestStrand<Real> makeRestStrand(std::span<const Vec3f> points, double metresPerUnit, const Material& material,
                                const PaperMaterial& paper, const Settings& settings,
                                const StrandPiece& piece = {});

}  // namespace ringlet::reference
