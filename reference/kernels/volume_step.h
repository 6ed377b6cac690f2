// The strands that meet as a volume, in one outer step: displacements and guesses at its start, then, in each
// iteration of the solve, the means of a grid in the head's frame. Mirrors the volume's kernels; in double,
// over nodes in a map. The equations: equations/volume.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/fields.h"
#include "reference/rest_contacts.h"
#include "reference/rest_strand.h"
#include "ringlet/base/archive.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet::reference {

/// The head in a step.
struct VolumeFrame {
  Rotation<double> now, next;  // at its start and end
  double seconds = 0;
  bool sorts =
      true;  // particles go to where they are on the grid; else they stay where the step before had them

  /// Velocity of a point at x that the head carries rigidly, along world axes [m/s].
  Vector3<double> carried(const Vector3<double>& x) const {
    return (next * (now.conjugate() * x) - x) / seconds;
  }
};

/// Some consecutive particles of such a strand, represented by their mean. Of these, `pinned` at the start
/// follow the head, and those from `present` on have fallen.
struct VolumeParticle {
  std::uint32_t first = 0;  // groom order
  std::uint32_t count = 1, present = 1, pinned = 0;
  double mass = 0, ownDensity = 0;    // [kg], at rest [kg/m^3]
  double restDensity = 0;             // of all of them [kg/m^3]
  double density = 0;                 // about it in the last step [kg/m^3]
  double share = 0;                   // o of this step
  bool isKnown = false;               // false: the hair was just put there
  double gain = 0;                    // g of the last iteration [kg]
  Vector3<double> given{0, 0, 0};     // J of the last step: momentum - g v [kg m/s]
  Vector3<double> velocity{0, 0, 0};  // that the means are of; in the first iteration guessed [m/s]
  Matrix3<double> gradient = Matrix3<double>::Zero();  // C, in the head's frame [1/s]
  Vector3<double> memory{0, 0, 0};                     // s [m]
  Vector3<double> place{0, 0, 0};                      // in the head's frame, at the start of the step [m]
  Vector3<double> gridPlace{0, 0, 0};                  // and on the grid [m]

  /// Of those present, from values in groom order; 0 if none is.
  Vector3<double> mean(const Field<double>& values) const;
};

struct Volume {
  double cell = 0;              // h [m]
  std::uint32_t untilSort = 0;  // steps until particles next go to where they are on the grid
  std::vector<VolumeParticle> particles;

  bool isEmpty() const { return particles.empty(); }
  void forget();
  /// The particles [begin, end) are of it no more: they have fallen. These are all that is left of a strand
  /// beyond a place. The next step sorts.
  void release(std::uint32_t begin, std::uint32_t end);
  void archive(Archive& archive);
};

/// Of strands in groom order.
template <class Real>
Volume makeVolume(const std::vector<RestStrand<Real>>& strands, std::span<const std::uint32_t> firstPoint,
                  const RestContacts& rest);

/// The start of a step. Of the groom: positions [m], v^0 and the change of it by the last step, or none
/// [m/s].
void beginVolume(const ContactSettings& settings, const VolumeFrame& frame, const Field<double>& positions,
                 const Field<double>& freeVelocities, const Field<double>& changes, Volume& volume);

/// Before a later iteration: the velocities of the last iterate [m/s].
void bringVolume(const Field<double>& velocities, Volume& volume);

/// Of each particle of the groom: what the volume adds to its mass [kg], g, and to its right-hand side [kg
/// m/s].
struct VolumeSystem {
  Scalars<double> weights;
  Field<double> momenta;
};

/// From the velocities that beginVolume or bringVolume set. Sets the density about each particle, and C.
VolumeSystem volumeMeans(const ContactSettings& settings, const VolumeFrame& frame,
                         const Field<double>& positions, Volume& volume);

/// The end of a step: what each particle got from the last iteration's means, at the velocities [m/s] that it
/// ended with.
void endVolume(const VolumeSystem& system, const Field<double>& velocities, Volume& volume);

}  // namespace ringlet::reference
