// Which contact particles are near enough to touch within a step, or to have touched: a superset of all
// contacts, found by a grid. Mirrors the contact kernels' grid and pair list; nothing but time depends on
// how. Iben et al. 2012, section 4; seeing ahead is ours.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/fields.h"
#include "reference/rest_contacts.h"

namespace ringlet::reference {

/// A particle that takes part in contacts.
struct ContactParticle {
  std::uint32_t index = 0;   // in the groom
  std::uint32_t strand = 0;  // in the groom
  bool isPinned = false;
  double radius = 0;                                    // [m]
  double mass = 0;                                      // m_c [kg]
  Vector3<double> restPlace = Vector3<double>::Zero();  // [m]
};

/// Two particles, by their places in a list of ContactParticle; a before b.
struct ContactPair {
  std::uint32_t a = 0, b = 0;
  auto operator<=>(const ContactPair&) const = default;
};

/// Groom order. `firstPoint` as in Groom.
template <class Real>
std::vector<ContactParticle> listContactParticles(const RestContacts& rest,
                                                  const std::vector<RestStrand<Real>>& strands,
                                                  std::span<const std::uint32_t> firstPoint);

bool mayTouch(const RestContacts& rest, const ContactParticle& a, const ContactParticle& b);

/// What the grid found, and how often it looked: from both sides of a pair.
struct NearPairs {
  std::vector<ContactPair> pairs;
  std::uint64_t tests = 0;
};

/// All pairs that may touch and are no further apart than the sum of their `reaches` [m], ascending. Entries
/// of places [m] and reaches follow `particles`. A particle without a reach, or whose place or reach is not
/// finite, has no pairs.
NearPairs nearPairs(const RestContacts& rest, const std::vector<ContactParticle>& particles,
                    const Field<double>& places, const Scalars<double>& reaches);

}  // namespace ringlet::reference
