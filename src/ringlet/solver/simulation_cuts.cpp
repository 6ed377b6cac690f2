// Implements cuts of solver/simulation.h (inputs/fallen_hair.h), and the constants that a head has of its
// own.
#include <algorithm>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/solver/simulation_implementation.h"

namespace ringlet {
Status Simulation::Implementation::checkCuts(std::span<const StrandCut> cuts) const {
  if (settings.integrator != Integrator::jacobi)
    return Error{"hair is cut with the integrator jacobi only; this run has another"};
  if (!rest().elsewhere.empty() || contacts.divided)
    return Error{"hair that is divided among devices is not cut; use one device"};
  if (contacts.crossings)
    return Error{"hair that is kept from going through hair is not cut yet; set no_crossings to false"};
  return fallen().check(cuts, static_cast<std::uint32_t>(std::max(settings.rootCount, 2)));
}

Status Simulation::Implementation::cut(std::span<const StrandCut> cuts) {
  FallenHair& fallen = inputs.get<FallenHair>();
  if (Status status = fallen.cut(device().gpu(), cuts, head().now.rotation, featurePlan->ranges); !status)
    return status;
  if (Status status = create(kernels.fallen, fallenOptions()); !status) return status;
  if (contacts.volume) {
    if (Status status = contacts.volume->release(fallen.particles()); !status) return status;
  }
  return renewConstants();
}

// Makes the constants anew, from the present material and the cuts.
Status Simulation::Implementation::renewConstants() {
  std::vector<layout::StrandRest> own = constants.strands.empty() ? rest().strands : constants.strands;
  std::vector<std::string> sentences;
  auto particles = constants.liveMaterial ? constants.liveMaterial->with(material, own, sentences)
                                          : particlesOf(asset->constants);
  if (!particles) return particles.error();
  const std::vector<layout::StrandRest> ofPieces = fallen().restrict(own, *particles);
  if (Status status = buffers.setConstants(device().gpu(), own, *particles, rest().edgeFactors); !status)
    return status;
  if (Status status = inputs.get<FallenHair>().setRecords(ofPieces); !status) return status;
  if (Status status = bindKernels(); !status) return status;
  if (constants.liveMaterial) {
    constants.warnings = std::move(sentences);
    constants.warnings.insert(
        constants.warnings.end(),
        rest().warnings.begin() + static_cast<std::ptrdiff_t>(rest().materialWarningCount),
        rest().warnings.end());
  }
  stillness.wake();
  frames.forgetRecordings();
  return {};
}

Status Simulation::cut(std::span<const StrandCut> cuts) {
  Implementation& self = *self_;
  RINGLET_ASSERT(self.frames.lost || self.frames.areAllWaitedFor(), "cut while frames are in flight");
  if (self.frames.lost) return *self.frames.lost;
  if (Status status = self.checkCuts(cuts); !status) return status;
  Status status = self.cut(cuts);
  if (!status) self.frames.lost = status.error();
  return status;
}

}  // namespace ringlet
