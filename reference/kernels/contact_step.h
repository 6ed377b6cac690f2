// The contacts of one outer step, between the strands' own solves and their move, in two stages:
// updateContacts gives every pair its life and weights, solveContacts the velocities that follow. Mirrors the
// contact kernels. Iben et al. 2012, section 4, for the springs and their life; the solve is ours:
//
//     (L + 2 D) v^{k+1} = base + sum push n + sum Q (v_a^k + v_b^k)         D = sum Q of the particle
//
// all strands at once, from a guess: v^0, the solve without contacts, and most of what the step before
// changed it by. A pair's mean velocity, and not the other's velocity, is what the iteration holds: its
// eigenvalues are then in [0, 1) whatever the stiffness and the number of contacts, and a symmetric hit is
// right after one iteration. Its fixed point is L v = base + sum (push n - Q (v_a - v_b)).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "reference/equations/contact_spring.h"
#include "reference/kernels/contact_pairs.h"
#include "reference/kernels/volume_step.h"
#include "reference/strand_solve.h"
#include "ringlet/base/archive.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet::reference {

/// A pair that touches, or touched and has not broken.
template <class Real>
struct Contact {
  ContactPair pair;  // places in Contacts::particles
  ContactLife<Real> life{};
  Vector3<Real> normal = Vector3<Real>::Zero();  // from b to a, start of the step [1]
  ContactWeights<Real> weights{};
};

/// The contacts of all strands, with the results of the last step; fields in groom order.
template <class Real>
struct Contacts {
  RestContacts rest;
  std::vector<ContactParticle> particles;
  std::vector<Contact<Real>> live;  // ascending by pair
  std::uint64_t nearCount = 0;      // pairs near enough to be asked, in the last step
  std::uint64_t pairTests = 0;      // pairs looked at for that, in all steps

  Volume volume;               // of strands that meet as one
  VolumeSystem volumeSystem;   // of the last iteration
  bool pairByPair = true;      // some strands may meet so
  std::vector<bool> isPinned;  // of each particle: it follows the head

  Field<Real> freeVelocities;  // v^0 [m/s]
  Field<double> changes;       // of v^0 by contacts and stretch limit, in the step before; or none [m/s]
  Field<double> pushes;        // sum of push n [kg m/s]
  std::vector<Matrix3<double>> weights;  // D [kg]
  double momentumError = 0;              // |sum J| over sum |J|, J the momentum a particle got [1]
  double freeMomentumError = 0;          // without those that follow the head
};

template <class Real>
Contacts<Real> makeContacts(const std::vector<RestStrand<Real>>& strands,
                            std::span<const std::uint32_t> firstPoint, const ContactSettings& settings);

/// Lives and weights of a step of T [s], from positions [m] at its start and the velocities of the step
/// without contacts [m/s].
template <class Real>
void updateContacts(const ContactSettings& settings, Real stepSeconds, const Field<Real>& positions,
                    const Field<Real>& velocities, Contacts<Real>& contacts);

/// sum push n + sum Q (v_a + v_b) of every particle [kg m/s].
template <class Real>
Field<double> pairMomenta(const Contacts<Real>& contacts, const Field<double>& velocities);

/// Takes back springs that at velocities [m/s] would hold two together. Whether there were any.
template <class Real>
bool dropUnmet(const Field<double>& velocities, Contacts<Real>& contacts);

/// After the step's move: stores the change of velocities v [m/s] from v^0.
template <class Real>
void rememberChanges(const Field<Real>& velocities, Contacts<Real>& contacts);

/// What one step leaves to the next, to an archive or back.
template <class Real>
void archiveContacts(Archive& archive, Contacts<Real>& contacts);

/// Solves strand s of the system with the terms of contacts; `velocities` are those of the strand [m/s].
using SolveStrand = std::function<void(std::size_t s, std::span<Vector3<double>> velocities)>;

/// Strand-block Jacobi from a guess. `systems` are those of the solve without contacts; what contacts and the
/// volume add to them is written beside it. positions [m]: at the step's start; velocities [m/s]: v^0 in, the
/// last iterate out.
template <class Real>
void solveContacts(const ContactSettings& settings, const VolumeFrame& frame,
                   std::span<const std::uint32_t> firstPoint, std::vector<StrandSystem>& systems,
                   const SolveStrand& solve, const Field<Real>& positions, Contacts<Real>& contacts,
                   Field<Real>& velocities);

}  // namespace ringlet::reference
