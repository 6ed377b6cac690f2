// ContactParticles: the particles that take part in contacts, with their radii and masses. Iben et al. 2012,
// section 4: every particle is a sphere, the volume it stands for; particles that the spheres before and
// after them cover are pruned. They still move.
//
//    o--o--o--o--o--o--o--o--o--o     particles; edges shorter than a radius
//    O        O        O        O     contact particles, s R apart, R = 2 radii of the strand
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ringlet/rest/dense_strands.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// Arrays in device order. Rest positions are RestState.points[particles[i]].
struct ContactParticles {
  std::vector<std::uint32_t> particles;      // device index of each, ascending
  std::vector<std::uint32_t> strands;        // of each, device order
  std::vector<std::uint32_t> firstOfStrand;  // strandCount + 1 entries, into the two above
  std::vector<float> radii;                  // of each strand [m]
  std::vector<float> masses;                 // m_c of each strand: its mass over its contact particles [kg]
  double baseRadius = 0;                     // of strands of factor 1 whose edges are short enough [m]
  std::vector<std::string> warnings;         // for the user: gaps, or raised radii, with numbers

  std::size_t strandCount() const { return radii.size(); }
};

/// The default radius of all strands: half the mean distance from a root to the nearest other root; where
/// that is 0, half the mean edge [m].
double radiusOfRoots(const RestState& rest);

/// The radius of all strands: the setting; else half the mean distance from a root to its nearest other root;
/// where that is nothing (one strand, or roots in one place) half the mean edge. Times the strand's factor.
///
/// Then strand by strand: the root is a contact particle, and from contact particle i the first j > i with
/// |p_i - p_j| >= s R, or the one before j where j is further than R and not i's neighbour. Hair can slip
/// between two that are farther apart than R, as on strands with longer edges: settings.fillGaps raises the
/// radius of such a strand to half its longest edge; without it a warning says so. (Raised radii on a dense
/// head: 64 partners a particle instead of 14.) Cost: n log n in strands, linear in particles.
ContactParticles chooseContactParticles(const RestState& rest, const ContactSettings& settings);

/// Of each dense strand one contact particle in q = round(1 / settings.detail), at most half of them all;
/// the first of them is chosen by the seed and the strand's place in the groom. Its radius grows by
/// q^kThinnedRadiusPower; each of those that stay is as heavy as q and pushes for q: q^2 of the mass. Cost:
/// linear.
ContactParticles thinWhereDense(const ContactParticles& all, const RestState& rest, const DenseStrands& dense,
                                const ContactSettings& settings);

}  // namespace ringlet
