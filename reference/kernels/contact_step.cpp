// Implements kernels/contact_step.h.
#include "reference/kernels/contact_step.h"

#include <utility>

namespace ringlet::reference {
namespace {

// D and the sums of push n.
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

// J = sum push n + sum Q (w_a + w_b) - 2 D v of each particle, w the iterate before v: the momentum contacts
// gave it. Pairs cancel once w = v. Returns |sum J| / sum |J|; freeOnly: without what particles that follow
// the head got, which a device does not know.
template <class Real>
double contactMomentumError(const Contacts<Real>& contacts, const Field<double>& momenta,
                            const Field<double>& velocities, bool freeOnly) {
  Vector3<double> sum = Vector3<double>::Zero();
  double size = 0;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    if (freeOnly && contacts.isPinned[i]) continue;
    const Vector3<double> given = momenta[i] - 2 * contacts.weights[i] * velocities[i];
    sum += given;
    size += given.norm();
  }
  return size > 0 ? sum.norm() / size : 0;
}

// 2 D beside the strands' own systems.
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

// Beside what contacts give: D is half of what stands in the system.
template <class Real>
void addVolume(const VolumeSystem& volume, Contacts<Real>& contacts, Field<double>& momenta) {
  for (std::size_t i = 0; i < momenta.size(); ++i) {
    contacts.weights[i] += 0.5 * volume.weights[i] * Matrix3<double>::Identity();
    momenta[i] += volume.momenta[i];
  }
}

// v^0 [m/s], as the contacts of the step before let expect it to change.
template <class Real>
Field<double> guessVelocities(const Field<Real>& velocities, const Contacts<Real>& contacts) {
  Field<double> guess;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    guess.push_back(velocities[i].template cast<double>());
    if (!contacts.changes.empty()) guess[i] += kContactWarmth * contacts.changes[i];
  }
  return guess;
}

}  // namespace

template <class Real>
Contacts<Real> makeContacts(const std::vector<RestStrand<Real>>& strands,
                            std::span<const std::uint32_t> firstPoint, const ContactSettings& settings) {
  Contacts<Real> contacts;
  contacts.rest = makeRestContacts(strands, settings);
  contacts.particles = listContactParticles(contacts.rest, strands, firstPoint);
  contacts.volume = makeVolume(strands, firstPoint, contacts.rest);
  contacts.pairByPair = contacts.volume.isEmpty();
  for (std::uint32_t s = 0; s < strands.size(); ++s) {
    for (std::uint32_t t = 0; t < s; ++t)
      contacts.pairByPair = contacts.pairByPair || contacts.rest.mayTouch(s, t);
  }
  contacts.isPinned.assign(firstPoint.back(), false);
  for (std::size_t s = 0; s < strands.size(); ++s) {
    for (std::size_t i = 0; i < strands[s].pinnedCount(); ++i) contacts.isPinned[firstPoint[s] + i] = true;
  }
  return contacts;
}

template <class Real>
void updateContacts(const ContactSettings& settings, Real stepSeconds, const Field<Real>& positions,
                    const Field<Real>& velocities, Contacts<Real>& contacts) {
  // Far enough for every pair that may touch within the step, and for every one that is not yet broken.
  Field<double> places;
  Scalars<double> reaches;
  for (const ContactParticle& particle : contacts.particles) {
    places.push_back(positions[particle.index].template cast<double>());
    reaches.push_back(settings.reach() * particle.radius +
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
    const bool hasMemory = settings.taper == ContactTaper::time;
    const ContactLife<Real> life = hasMemory
                                       ? nextLife(settings, isKnown ? before->life : ContactLife<Real>{},
                                                  touching, place.distance, constants.restLength, stepSeconds)
                                       : lifeAt(touching, place.distance, constants.restLength);
    if (life.isOver()) continue;
    live.push_back({pair, life, place.normal,
                    contactWeights(settings, constants, life, isKnown || !hasMemory, touching, place.distance,
                                   stepSeconds)});
  }
  contacts.live = std::move(live);
}

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

template <class Real>
void rememberChanges(const Field<Real>& velocities, Contacts<Real>& contacts) {
  contacts.changes.clear();
  for (std::size_t i = 0; i < velocities.size(); ++i)
    contacts.changes.push_back((velocities[i] - contacts.freeVelocities[i]).template cast<double>());
  Field<double> ends;
  for (const Vector3<Real>& v : velocities) ends.push_back(v.template cast<double>());
  if (!contacts.volumeSystem.momenta.empty()) endVolume(contacts.volumeSystem, ends, contacts.volume);
}

template <class Real>
void solveContacts(const ContactSettings& settings, const VolumeFrame& frame,
                   std::span<const std::uint32_t> firstPoint, std::vector<StrandSystem>& systems,
                   const SolveStrand& solve, const Field<Real>& positions, Contacts<Real>& contacts,
                   Field<Real>& velocities) {
  contacts.freeVelocities = velocities;
  gatherContacts(velocities.size(), contacts);
  contacts.momentumError = contacts.freeMomentumError = 0;
  if (contacts.live.empty() && contacts.volume.isEmpty()) return;
  Field<double> places;
  for (const Vector3<Real>& x : positions) places.push_back(x.template cast<double>());
  Field<double> free;
  for (const Vector3<Real>& v : velocities) free.push_back(v.template cast<double>());
  beginVolume(settings, frame, places, free, contacts.changes, contacts.volume);

  Field<double> solved = guessVelocities(velocities, contacts), momenta;
  const int iterations = settings.iterationCount(contacts.pairByPair);
  for (int iteration = 0; iteration < iterations; ++iteration) {
    if (iteration > 0) dropUnmet(solved, contacts);
    gatherContacts(velocities.size(), contacts);
    momenta = pairMomenta(contacts, solved);
    if (iteration > 0) bringVolume(solved, contacts.volume);
    contacts.volumeSystem = volumeMeans(settings, frame, places, contacts.volume);
    addVolume(contacts.volumeSystem, contacts, momenta);
    setContactWeights(firstPoint, contacts, systems);
    for (std::size_t s = 0; s < systems.size(); ++s) {
      const std::size_t first = firstPoint[s], count = firstPoint[s + 1] - first;
      const auto strandMomenta = std::span(momenta).subspan(first, count);
      systems[s].contactMomenta.assign(strandMomenta.begin(), strandMomenta.end());
      solve(s, std::span(solved).subspan(first, count));
    }
  }
  contacts.momentumError = contactMomentumError(contacts, momenta, solved, false);
  contacts.freeMomentumError = contactMomentumError(contacts, momenta, solved, true);
  for (std::size_t i = 0; i < solved.size(); ++i) velocities[i] = solved[i].template cast<Real>();
}

template <class Real>
void archiveContacts(Archive& archive, Contacts<Real>& contacts) {
  std::vector<ContactPair> pairs;
  std::vector<ContactLife<Real>> lives;
  for (const Contact<Real>& contact : contacts.live) {
    pairs.push_back(contact.pair);
    lives.push_back(contact.life);
  }
  archive.list(pairs);
  archive.list(lives);
  contacts.live.resize(std::min(pairs.size(), lives.size()));
  for (std::size_t i = 0; i < contacts.live.size(); ++i) {
    contacts.live[i].pair = pairs[i];
    contacts.live[i].life = lives[i];
  }
  std::vector<double> changes(numbersOf(contacts.changes).begin(), numbersOf(contacts.changes).end());
  archive.list(changes);
  contacts.changes.resize(changes.size() / 3);
  std::ranges::copy(std::span(changes).first(3 * contacts.changes.size()),
                    numbersOf(contacts.changes).begin());
  archive.value(contacts.nearCount);
  archive.value(contacts.pairTests);
  archive.value(contacts.momentumError);
  archive.value(contacts.freeMomentumError);
  contacts.volume.archive(archive);
}

#define RINGLET_INSTANTIATE(Real)                                                                            \
  template Contacts<Real> makeContacts(const std::vector<RestStrand<Real>>& strands,                         \
                                       std::span<const std::uint32_t> firstPoint,                            \
                                       const ContactSettings& settings);                                     \
  template void updateContacts(const ContactSettings& settings, Real stepSeconds,                            \
                               const Field<Real>& positions, const Field<Real>& velocities,                  \
                               Contacts<Real>& contacts);                                                    \
  template Field<double> pairMomenta(const Contacts<Real>& contacts, const Field<double>& velocities);       \
  template bool dropUnmet(const Field<double>& velocities, Contacts<Real>& contacts);                        \
  template void rememberChanges(const Field<Real>& velocities, Contacts<Real>& contacts);                    \
  template void archiveContacts(Archive& archive, Contacts<Real>& contacts);                                 \
  template void solveContacts(const ContactSettings& settings, const VolumeFrame& frame,                     \
                              std::span<const std::uint32_t> firstPoint, std::vector<StrandSystem>& systems, \
                              const SolveStrand& solve, const Field<Real>& positions,                        \
                              Contacts<Real>& contacts, Field<Real>& velocities)
RINGLET_INSTANTIATE(float);
RINGLET_INSTANTIATE(double);
#undef RINGLET_INSTANTIATE

}  // namespace ringlet::reference
