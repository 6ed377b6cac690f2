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

#include "reference/equations/contact_spring.h"
#include "reference/kernels/contact_pairs.h"
#include "reference/strand_solve.h"
#include "ringlet/scene/settings.h"

namespace ringlet::reference {

/// A pair that touches, or touched and has not broken.
template <class Real>
struct Contact {
  ContactPair pair;  // places in Contacts::particles
  ContactLife<Real> life{};
  Vector3<Real> normal = Vector3<Real>::Zero();  // from b to a, start of the step [1]
  ContactWeights<Real> weights{};
};

/// Contacts of all strands, from step to step, with what the last step found; fields in groom order.
template <class Real>
struct Contacts {
  RestContacts rest;
  std::vector<ContactParticle> particles;
  std::vector<Contact<Real>> live;  // ascending by pair
  std::uint64_t nearCount = 0;      // pairs near enough to be asked, in the last step
  std::uint64_t pairTests = 0;      // pairs looked at for that, in all steps

  Field<Real> freeVelocities;  // v^0 [m/s]
  Field<double> changes;       // of v^0 by contacts and stretch limit, in the step before; or none [m/s]
  Field<double> pushes;        // sum of push n [kg m/s]
  std::vector<Matrix3<double>> weights;  // D [kg]
  double momentumError = 0;              // |sum J| over sum |J|, J the momentum a particle got [1]
};

template <class Real>
Contacts<Real> makeContacts(const std::vector<RestStrand<Real>>& strands,
                            std::span<const std::uint32_t> firstPoint, const ContactSettings& settings) {
  Contacts<Real> contacts;
  contacts.rest = makeRestContacts(strands, settings);
  contacts.particles = listContactParticles(contacts.rest, strands, firstPoint);
  return contacts;
}

/// Lives and weights of a step of T [s], from positions [m] at its start and the velocities of the step
/// without contacts [m/s].
template <class Real>
void updateContacts(const ContactSettings& settings, Real stepSeconds, const Field<Real>& positions,
                    const Field<Real>& velocities, Contacts<Real>& contacts) {
  // Far enough for every pair that may touch within the step, and for every one that is not yet broken.
  Field<double> places;
  Scalars<double> reaches;
  for (const ContactParticle& particle : contacts.particles) {
    places.push_back(positions[particle.index].template cast<double>());
    reaches.push_back(settings.breakFactor * particle.radius +
                      static_cast<double>(stepSeconds * velocities[particle.index].norm()));
  }

  std::vector<Contact<Real>> live;
  auto before = contacts.live.begin();  // both lists ascend
  const NearPairs near = nearPairs(contacts.rest, contacts.particles, places, reaches);
  contacts.nearCount = near.pairs.size();
  contacts.pairTests += near.tests;
  for (const ContactPair& pair : near.pairs) {
    const ContactParticle &a = contacts.particles[pair.a], &b = contacts.particles[pair.b];
    const auto constants = contactConstants<Real>(settings, (a.mass + b.mass) / 2, a.radius + b.radius,
                                                  (a.restPlace - b.restPlace).norm());
    const ContactPlace<Real> place =
        contactPlace<Real>(positions[a.index] - positions[b.index], velocities[a.index] - velocities[b.index],
                           a.index < b.index);
    const bool touching = isTouching(place, constants.restLength, stepSeconds);

    while (before != contacts.live.end() && before->pair < pair) ++before;
    const bool isKnown = before != contacts.live.end() && before->pair == pair;
    const ContactLife<Real> life = nextLife(settings, isKnown ? before->life : ContactLife<Real>{}, touching,
                                            place.distance, constants.restLength, stepSeconds);
    if (life.isOver()) continue;
    live.push_back(
        {pair, life, place.normal,
         contactWeights(settings, constants, life, isKnown, touching, place.distance, stepSeconds)});
  }
  contacts.live = std::move(live);
}

/// D and the sums of push n.
template <class Real>
void gatherContacts(std::size_t particleCount, Contacts<Real>& contacts) {
  contacts.weights.assign(particleCount, Matrix3<double>::Zero());
  contacts.pushes.assign(particleCount, Vector3<double>::Zero());
  for (const Contact<Real>& contact : contacts.live) {
    const std::uint32_t a = contacts.particles[contact.pair.a].index;
    const std::uint32_t b = contacts.particles[contact.pair.b].index;
    const Matrix3<double> weight = contactMatrix(contact.weights, contact.normal).template cast<double>();
    const Vector3<double> push = (contact.weights.push * contact.normal).template cast<double>();
    contacts.weights[a] += weight;
    contacts.weights[b] += weight;
    contacts.pushes[a] += push;
    contacts.pushes[b] -= push;
  }
}

/// sum push n + sum Q (v_a + v_b) of every particle [kg m/s].
template <class Real>
Field<double> pairMomenta(const Contacts<Real>& contacts, const Field<double>& velocities) {
  Field<double> momenta = contacts.pushes;
  for (const Contact<Real>& contact : contacts.live) {
    const std::uint32_t a = contacts.particles[contact.pair.a].index;
    const std::uint32_t b = contacts.particles[contact.pair.b].index;
    const Vector3<double> momentum = contactMatrix(contact.weights, contact.normal).template cast<double>() *
                                     (velocities[a] + velocities[b]);
    momenta[a] += momentum;
    momenta[b] += momentum;
  }
  return momenta;
}

/// J = sum push n + sum Q (w_a + w_b) - 2 D v of each particle, w the iterate before v: the momentum contacts
/// gave it. Pairs cancel once w = v. Returns |sum J| / sum |J|.
template <class Real>
double contactMomentumError(const Contacts<Real>& contacts, const Field<double>& momenta,
                            const Field<double>& velocities) {
  Vector3<double> sum = Vector3<double>::Zero();
  double size = 0;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const Vector3<double> given = momenta[i] - 2 * contacts.weights[i] * velocities[i];
    sum += given;
    size += given.norm();
  }
  return size > 0 ? sum.norm() / size : 0;
}

/// Takes back springs that at velocities [m/s] would hold two together. Whether there were any.
template <class Real>
bool dropUnmet(const Field<double>& velocities, Contacts<Real>& contacts) {
  bool dropped = false;
  for (Contact<Real>& contact : contacts.live) {
    const Vector3<double> parting = velocities[contacts.particles[contact.pair.a].index] -
                                    velocities[contacts.particles[contact.pair.b].index];
    const double separation = contact.normal.template cast<double>().dot(parting);
    if (contact.weights.isMet(static_cast<Real>(separation))) continue;
    contact.weights.spring = contact.weights.push = 0;
    dropped = true;
  }
  return dropped;
}

/// 2 D beside the strands' own systems.
template <class Real>
void setContactWeights(std::span<const std::uint32_t> firstPoint, const Contacts<Real>& contacts,
                       std::vector<StrandSystem>& systems) {
  for (std::size_t s = 0; s < systems.size(); ++s) {
    systems[s].contactWeights.clear();
    for (std::uint32_t i = firstPoint[s]; i < firstPoint[s + 1]; ++i) {
      systems[s].contactWeights.push_back(2 * contacts.weights[i]);
    }
  }
}

/// v^0 [m/s], as the contacts of the step before let expect it to change.
template <class Real>
Field<double> guessVelocities(const Field<Real>& velocities, const Contacts<Real>& contacts) {
  Field<double> guess;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    guess.push_back(velocities[i].template cast<double>());
    if (!contacts.changes.empty()) guess[i] += kContactWarmth * contacts.changes[i];
  }
  return guess;
}

/// After the step's move: what its velocities v [m/s] are to v^0.
template <class Real>
void rememberChanges(const Field<Real>& velocities, Contacts<Real>& contacts) {
  contacts.changes.clear();
  for (std::size_t i = 0; i < velocities.size(); ++i)
    contacts.changes.push_back((velocities[i] - contacts.freeVelocities[i]).template cast<double>());
}

/// Strand-block Jacobi from a guess. `systems` are those of the solve without contacts; what contacts add to
/// them is written beside it. velocities [m/s]: v^0 in, the last iterate out. `solve(s, velocities)` solves
/// strand s.
template <class Real, class SolveOne>
void solveContacts(int iterationCount, std::span<const std::uint32_t> firstPoint,
                   std::vector<StrandSystem>& systems, SolveOne solve, Contacts<Real>& contacts,
                   Field<Real>& velocities) {
  contacts.freeVelocities = velocities;
  gatherContacts(velocities.size(), contacts);
  contacts.momentumError = 0;
  if (contacts.live.empty()) return;
  setContactWeights(firstPoint, contacts, systems);

  Field<double> solved = guessVelocities(velocities, contacts), momenta;
  for (int iteration = 0; iteration < iterationCount; ++iteration) {
    if (iteration > 0 && dropUnmet(solved, contacts)) {
      gatherContacts(velocities.size(), contacts);
      setContactWeights(firstPoint, contacts, systems);
    }
    momenta = pairMomenta(contacts, solved);
    for (std::size_t s = 0; s < systems.size(); ++s) {
      const std::size_t first = firstPoint[s], count = firstPoint[s + 1] - first;
      const auto strandMomenta = std::span(momenta).subspan(first, count);
      systems[s].contactMomenta.assign(strandMomenta.begin(), strandMomenta.end());
      solve(s, std::span(solved).subspan(first, count));
    }
  }
  contacts.momentumError = contactMomentumError(contacts, momenta, solved);
  for (std::size_t i = 0; i < solved.size(); ++i) velocities[i] = solved[i].template cast<Real>();
}

}  // namespace ringlet::reference
