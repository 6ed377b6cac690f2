// RestState: the constant data of a groom, in the layout of the device.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "layout/strands.h"
#include "ringlet/base/in_parallel.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/rest/edge_factors.h"
#include "ringlet/rest/material.h"
#include "ringlet/rest/strand_constants.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// A strand that is carried by its root in its rest shape (rest/rigid_strands.h).
struct RigidStrand {
  std::uint32_t strandInGroom = 0, firstInGroom = 0;
  std::vector<Vec3f> points;  // rest positions [m]
};

/// Arrays in device order, of the simulated strands. Strands are ordered by rising particle count, so that
/// strands of similar length are dispatched together; strands of equal count are in groom order, or in the
/// order asked for.
struct RestState {
  std::vector<layout::StrandRest> strands;
  std::vector<layout::ParticleRest> particles;
  std::vector<EdgeFactors> edgeFactors;      // of each particle's edge; empty without such profiles
  std::vector<Vec3f> points;                 // rest positions [m]
  std::vector<std::uint32_t> strandInGroom;  // groom's index of each strand
  std::vector<std::uint32_t> firstInGroom;   // groom's index of each strand's root particle
  std::vector<RigidStrand> rigid;            // those carried rigidly, in groom order
  std::size_t groomStrandCount = 0, groomParticleCount = 0;
  // About the whole groom, even if only a part of it is simulated here (rest/rest_part.h):
  std::vector<std::uint32_t> wholeCounts;  // particles of every simulated strand, here or not, rising
  bool oneSmoothing = false;               // bendBeta equals coreBeta for all of them
  std::vector<RigidStrand> elsewhere;      // strands that are simulated elsewhere, in groom order
  // In addition to `elsewhere`, the last of the strands above are simulated elsewhere too: a part's halo
  // (rest/rest_halo.h). Particle counts rise within its border, within its other strands and within its halo.
  std::size_t haloCount = 0;
  double longestCalmStep = 0;            // longest outer step that needs no warning [s]
  std::vector<std::string> warnings;     // for the user, with numbers
  std::size_t materialWarningCount = 0;  // number of warnings that depend on the material; they come first
};

/// Number of strands that are simulated here: the first ones.
inline std::size_t hereCount(const RestState& rest) { return rest.strands.size() - rest.haloCount; }

/// The geometry of each strand, in groom order. It depends on no setting and no material, so several rest
/// states of one groom can share it. The result does not depend on threadCount. Fails where buildRestState
/// fails on a groom. Cost: nearly half of buildRestState's.
Result<std::vector<StrandGeometry>> measureGeometry(const Groom& groom, unsigned threadCount = coreCount());

/// Fails on settings out of range, an empty groom, points that are not finite or more than 1e9 m away, and
/// where half the strands have no length. Cost: three passes over the groom, in double. `order`: the groom's
/// index of each strand, by rising particle count (see rest/strand_order.h); empty: groom order among strands
/// of equal count. `geometry`: the groom's, if it is known; empty: it is measured.
Result<RestState> buildRestState(const Groom& groom, const Material& material, const Settings& settings,
                                 std::span<const std::uint32_t> order = {},
                                 std::span<const StrandGeometry> geometry = {});

/// The groom of a rest state, in metres.
Groom groomOf(const RestState& state);

/// The fewest outer steps per frame that resolve the motion (1/192 s each; `paper`: 1/720 s) and cause no
/// warning: the core spring acts in full and bending is stable, for all strands except those too quick to be
/// simulated (rest/rigid_strands.h). The result is at most four times the number that the motion needs; a
/// groom that needs more causes a warning. Fails where buildRestState does. Cost: two passes over the groom.
/// `geometry`: as for buildRestState.
Result<int> chooseStepsPerFrame(const Groom& groom, const Material& material, Settings settings,
                                std::span<const StrandGeometry> geometry = {});

/// Fails, with a sentence, if a number of the settings or the material is out of range.
Status checkSettings(const Settings& settings, const Material& material);

}  // namespace ringlet
