// Hair of every kind the solver has ways of its own for, and heads it grows on.
#pragma once

#include <string>
#include <vector>

#include "parity/contacts.h"
#include "parity/sample_bodies.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/parity.h"

namespace ringlet::test {

struct Hair {
  const char* name;
  Groom groom;
  Settings settings{};
  KernelChoice kernel{};
  std::vector<Body> bodies{};
};

// Takes a strand of 64 particles in any form, and less than half of 1,200 particles in lanes.
inline constexpr std::uint64_t kSmallBuffer = 64 * 288;

inline std::vector<Hair> hairs() {
  const Groom groom = randomGroom({31, 5, 64, 2, 17}, 3);
  Settings pairs;
  pairs.contacts.on = true;
  pairs.contacts.method = ContactMethod::explicitPairs;
  Settings volume = pairs;
  volume.contacts.method = ContactMethod::volume;
  Settings air;
  air.air.on = true;
  return {{"lanes", groom},
          {"serial", groom, {}, {KernelChoice::Form::serial}},
          {"roots that move", groom, {}, {.features = {.roots = true}}},
          {"forces", groom, {}, {.features = {.forces = true}}},
          {"chunks", randomGroom(std::vector<int>(40, 30), 3), {}, {.mostBufferBytes = kSmallBuffer}},
          {"pairs", parity::denseSwatch(16), pairs},
          {"volume", parity::denseSwatch(16), volume},
          {"bodies and air", groom, air, {}, sampleBodies()},
          {"of many heads", groom, {}, {.heads = 4}}};
}

// Two heads on different ways; the second is born moving, with shifted roots.
struct Head {
  Vec3d way;
  double shift = 0;

  HeadPose at(double t) const { return {way * t, fromRotationVector(Vec3d{0, 3 * way.x * t, 0}), shift * t}; }
};
inline const Head kHeads[] = {{{1, 0, 0}}, {{-0.5, 0.3, 0.2}, 1}};

inline Result<Simulation> make(const HairAsset& asset, const Hair& hair, const Head& head) {
  const std::vector<Vec3d> shifts(head.shift != 0 ? hair.groom.strandCount() : 0, {0.01, 0, 0.02});
  auto simulation = Simulation::create(asset, {.head = head.at(0),
                                               .oneStepEarlier = head.at(-hair.settings.stepSeconds()),
                                               .bodies = hair.bodies,
                                               .rootShifts = shifts});
  if (simulation && hair.kernel.features.forces) {
    const std::vector<Vec3f> forces(hair.groom.points.size(), static_cast<Vec3f>(head.way * 20.0));
    if (Status status = simulation->setForces(forces); !status) return status.error();
  }
  return simulation;
}

inline Result<HairAsset> build(const ComputeDevice& device, const Hair& hair) {
  KernelChoice kernel = hair.kernel;
  kernel.features.bodies = !hair.bodies.empty();
  return HairAsset::build(device, hair.groom, varyingMaterial(), hair.settings, kernel);
}

}  // namespace ringlet::test
