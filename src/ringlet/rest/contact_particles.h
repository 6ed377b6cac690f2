// ContactParticles: the particles that take part in contacts, with their radii and masses. Iben et al. 2012,
// section 4: every particle is a sphere, the volume it represents; particles that are covered by the spheres
// before and after them are pruned. They still move.
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
  std::vector<float> masses;                 // m_c of each strand: its mass divided by its number of contact
                                             // particles [kg]
  double baseRadius = 0;                     // of strands with factor 1 and edges that are short enough [m]
  std::vector<std::string> warnings;         // for the user: gaps, or raised radii, with numbers

  std::size_t strandCount() const { return radii.size(); }
};

/// The default radius of all strands: half the mean distance of a root to its nearest other root; if that is
/// 0, half the mean edge [m].
double radiusOfRoots(const RestState& rest);

/// The radius of a strand is the setting, or else radiusOfRoots, times the strand's factor.
///
/// Then strand by strand: the root is a contact particle. After contact particle i comes the first j > i with
/// |p_i - p_j| >= s R; if j is farther than R and not next to i, the particle before j. Hair can slip between
/// two contact particles that are farther apart than R, as on strands with longer edges: settings.fillGaps
/// raises the radius of such a strand to half its longest edge; without it a warning says so. (Raised radii
/// on a dense head: 64 partners a particle instead of 14.) Cost: n log n in strands, linear in particles.
ContactParticles chooseContactParticles(const RestState& rest, const ContactSettings& settings);

/// Keeps one contact particle in q = round(1 / settings.detail) of each dense strand, with q at most half
/// their number; the seed and the strand's index in the groom choose the first one. The radius grows by
/// q^kThinnedRadiusPower. Each particle kept is as heavy as q and pushes for q: its mass is q^2 times as
/// large. Cost: linear.
ContactParticles thinWhereDense(const ContactParticles& all, const RestState& rest, const DenseStrands& dense,
                                const ContactSettings& settings);

}  // namespace ringlet
