// The settings of contacts, each said once: its row in the table (scene/settings_fields.h), and below what
// the kernels get of it (scene/packed_contacts.h).
#include "layout/contacts.h"
#include "ringlet/base/standard_gravity.h"
#include "ringlet/scene/packed_contacts.h"
#include "ringlet/scene/settings_fields.h"

namespace ringlet {
namespace {

constexpr double kMostOverlaps = 1e6;

// How much a share of a contact changes in a step when it goes from 0 to 1 in this time.
float changeIn(double seconds, double stepSeconds) {
  return seconds > 0 ? static_cast<float>(stepSeconds / seconds) : 1.0f;
}

}  // namespace

std::span<const SettingField<ContactSettings>> contactFields() {
  using C = ContactSettings;
  using F = SettingField<C>;
  static const F all[] = {
      F{"on", "", "true where [contacts] stands", "Whether strands collide with each other. Needs jacobi.",
        &C::on},
      F{"method",
        "",
        "",
        "How strands meet: auto, as a volume where they are dense at rest and pair by pair elsewhere; "
        "explicit, pair by pair; volume, all as a volume.",
        &C::method,
        {},
        "auto, explicit, volume"},
      F{"radius",
        "m",
        "half the mean distance of neighbouring roots",
        "Radius of the contact spheres of a strand.",
        &C::radius,
        {1e-6, 1}},
      F{"fill_gaps", "", "",
        "Whether strands whose particles are farther apart than two radii get a larger radius, so that "
        "nothing passes between. Slow in dense grooms.",
        &C::fillGaps},
      F{"spacing",
        "1",
        "",
        "Distance of contact spheres along a strand, as a share of their diameter. A smaller share makes "
        "more spheres.",
        &C::spacing,
        {0.01, 1}},
      F{"detail",
        "1",
        "",
        "Share of contact particles that dense strands keep for contacts pair by pair. With 0.5 a frame of "
        "dense hair takes less than half the time, and more hair passes through.",
        &C::detail,
        {0.05, 1}},
      F{"no_crossings", "", "",
        "Whether hair is kept from going through hair by construction: after each step ways are changed until "
        "no edge of one strand can pass through one of another. On the CPU, and slow where hair is dense.",
        &C::noCrossings},
      F{"prune_pairs", "", "", "Whether only strands that are near each other at rest may touch.",
        &C::prunePairs},
      F{"enlargement",
        "1",
        "",
        "Factor on the radii while overlaps at rest are counted.",
        &C::enlargement,
        {1, 100}},
      F{"min_overlaps",
        "",
        "",
        "Number of overlapping spheres at rest from which two strands may touch.",
        &C::minOverlaps,
        {1, kMostOverlaps}},
      F{"max_neighbours",
        "",
        "",
        "Largest number of strands that one strand may touch, those with most overlaps first; 0: no limit.",
        &C::maxNeighbours,
        {0, kMostOverlaps}},
      F{"drop_share", "1", "", "Share of the remaining pairs of strands that is dropped at random.",
        &C::dropShare, kShareRange},
      F{"seed", "", "", "Seed of drop_share and detail.", &C::seed, kSeedRange},
      F{"stiffness",
        "w / R",
        "",
        "Stiffness of a contact, as a multiple of a sphere's weight over the sum of the two radii.",
        &C::stiffness,
        {0, 1e7}}
          .live(),
      F{"damping_ratio",
        "1",
        "",
        "Damping ratio along the contact's normal; 1 is critical.",
        &C::dampingRatio,
        {0, 100}}
          .live(),
      F{"friction", "1", "",
        "Damping of strands that slide along each other pair by pair, as a share of the damping along the "
        "normal.",
        &C::friction, kShareRange}
          .live(),
      F{"taper",
        "",
        "",
        "How a contact fades in and out: with the distance, or in time as in the paper, which is slower and "
        "works pair by pair only.",
        &C::taper,
        {},
        "distance, time"},
      F{"ramp_seconds",
        "s",
        "",
        "Time from the first touch to full stiffness.",
        &C::rampSeconds,
        {0, 10},
        "",
        "time"}
          .live(),
      F{"stiffness_release_seconds",
        "s",
        "",
        "Time after the last touch in which the stiffness fades.",
        &C::stiffnessReleaseSeconds,
        {0, 10},
        "",
        "time"}
          .live(),
      F{"damping_release_seconds",
        "s",
        "",
        "Time after that in which the damping fades.",
        &C::dampingReleaseSeconds,
        {0, 10},
        "",
        "time"}
          .live(),
      F{"break_factor",
        "1",
        "",
        "A contact ends at this multiple of its rest length.",
        &C::breakFactor,
        {1, 10},
        "",
        "time"},
      F{"volume_cell",
        "m",
        "four radii, or more where particles are further apart",
        "Cell size of the grid of hair that meets as a volume: the range of the coupling.",
        &C::volumeCell,
        {1e-5, 10}},
      F{"volume_drag",
        "1/s",
        "",
        "Drag of hair that meets as a volume, towards the velocity of the hair around it.",
        &C::volumeDrag,
        {0, 1e5}}
          .live(),
      F{"volume_stiffness",
        "1/s^2",
        "",
        "Stiffness of hair that meets as a volume, towards the displacement of the hair around it.",
        &C::volumeStiffness,
        {0, 1e9}}
          .live(),
      F{"volume_memory_seconds",
        "s",
        "",
        "Time in which a displacement is forgotten.",
        &C::volumeMemorySeconds,
        {0.001, 1000}}
          .live(),
      F{"iterations",
        "",
        "2; 1 where all hair meets as a volume",
        "Solves of a step that couple strands. More iterations are slower and lose less momentum.",
        &C::iterations,
        {1, 1000}}
          .live(),
  };
  return all;
}

layout::ContactNumbers packed(const ContactSettings& settings, double stepSeconds) {
  layout::ContactNumbers p{};
  p.seconds = static_cast<float>(stepSeconds);
  p.stiffness = static_cast<float>(settings.stiffness * kStandardGravity);
  p.dampingRatio = static_cast<float>(settings.dampingRatio);
  p.friction = static_cast<float>(settings.friction);
  p.ramp = changeIn(settings.rampSeconds, stepSeconds);
  p.stiffnessRelease = changeIn(settings.stiffnessReleaseSeconds, stepSeconds);
  p.dampingRelease = changeIn(settings.dampingReleaseSeconds, stepSeconds);
  p.reachFactor = static_cast<float>(settings.listedReach());
  p.breakFactor = static_cast<float>(settings.reach());
  p.seenAhead = static_cast<float>(kContactSeenAhead);
  p.warmth = static_cast<float>(kContactWarmth);
  return p;
}

}  // namespace ringlet
