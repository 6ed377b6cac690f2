// Implements cuts of solver/simulation.h. What is cut off keeps its particles: contacts and all that reads
// positions know no difference. Kernels of its own step it (kernels/strand_step.comp, kFalls), from records
// of its own.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "layout/strands.h"
#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/rest/rest_curve.h"
#include "ringlet/solver/simulation_implementation.h"

namespace ringlet {
namespace {

Vec3d vectorOf(const layout::vec3& v) { return {v.x, v.y, v.z}; }

// The rest state of a piece, which begins with its first edge: its frames and smoothed curves begin there,
// turned as the head was when it was cut, and shape and springs stay. `points`, `particles`: of the strand.
void beginWith(const FallenPiece& piece, std::span<const Vec3f> points, layout::StrandRest& strand,
               std::span<layout::ParticleRest> particles) {
  std::vector<Vec3d> whole, rest;
  for (std::size_t i = 0; i + 1 < piece.end; ++i)
    whole.push_back(static_cast<Vec3d>(points[i + 1]) - static_cast<Vec3d>(points[i]));
  for (std::size_t i = piece.begin; i < whole.size(); ++i) rest.push_back(rotate(piece.restTurn, whole[i]));
  if (rest.empty()) return;  // a single particle
  const auto before = framesBeforeEdges(smoothEdges(whole, strand.bendBeta), whole[0]);
  const auto frames = framesBeforeEdges(smoothEdges(rest, strand.bendBeta), rest[0]);
  const auto coreEdges = smoothEdges(rest, strand.coreBeta);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    layout::ParticleRest& particle = particles[piece.begin + i];
    const Vec3d target = rotate(piece.restTurn * before[piece.begin + i], vectorOf(particle.target));
    particle.target = packed3(rotate(frames[i].conjugate(), target));
    particle.coreEdgeLength = static_cast<float>(length(coreEdges[i]));
  }
  strand.firstEdge = packed3(rest[0]);
}

// Of the particles [begin, end) of a strand.
float restCoreLength(std::span<const layout::ParticleRest> particles, std::uint32_t begin,
                     std::uint32_t end) {
  double length = 0;
  for (std::uint32_t i = begin; i + 1 < end; ++i) length += particles[i].coreEdgeLength;
  return static_cast<float>(std::max(length, 1e-12));
}

Result<std::vector<layout::ParticleRest>> particlesOf(std::span<const ConstantChunk> chunks) {
  std::vector<layout::ParticleRest> all;
  for (const ConstantChunk& chunk : chunks) {
    const auto some = downloadAll<layout::ParticleRest>(*chunk.particles, chunk.part.particleCount());
    if (!some) return some.error();
    all.insert(all.end(), some->begin(), some->end());
  }
  return all;
}

}  // namespace

Status Simulation::Implementation::checkCuts(std::span<const StrandCut> cuts) const {
  if (settings.integrator != Integrator::jacobi)
    return Error{"hair is cut with the integrator jacobi only; this run has another"};
  if (!rest.elsewhere.empty() || divided)
    return Error{"hair that is divided among devices is not cut; use one device"};
  std::vector<std::uint32_t> stay(rest.groomStrandCount, 0);  // 0: rigid
  for (std::size_t s = 0; s < rest.strands.size(); ++s) stay[rest.strandInGroom[s]] = keptOf(s);
  const auto least = static_cast<std::uint32_t>(std::max(settings.rootCount, 2));
  for (const StrandCut& cut : cuts) {
    if (cut.strand >= stay.size())
      return Error{fmt::format("a cut names strand {}; the groom has {}, numbered from 0", cut.strand,
                               rest.groomStrandCount)};
    std::uint32_t& now = stay[cut.strand];
    if (now == 0) continue;
    if (cut.keep < least || cut.keep >= now)
      return Error{fmt::format("strand {} has {} particles, of which a cut is to keep {}; expected {} to {}",
                               cut.strand, now, cut.keep, least, now - 1)};
    now = cut.keep;
  }
  return {};
}

Status Simulation::Implementation::cut(std::span<const StrandCut> cuts) {
  const auto reports = fallenReports();
  if (!reports) return reports.error();
  for (std::size_t k = 0; k < pieces.size(); ++k) pieces[k].report = (*reports)[k];
  if (kept.empty())
    for (const layout::StrandRest& strand : rest.strands) kept.push_back(strand.particleCount);
  std::vector<std::uint32_t> onDevice(rest.groomStrandCount, ~0u);  // rigid strands are not there
  for (std::uint32_t s = 0; s < rest.strands.size(); ++s) onDevice[rest.strandInGroom[s]] = s;
  for (const StrandCut& cut : cuts) {
    const std::uint32_t s = onDevice[cut.strand];
    if (s == ~0u) continue;
    pieces.push_back({.strand = s, .begin = cut.keep, .end = kept[s], .restTurn = head.now.rotation});
    kept[s] = cut.keep;
  }
  std::ranges::sort(pieces, {}, [](const FallenPiece& p) { return std::pair(p.strand, p.begin); });
  if (Status status = makeFallen(); !status) return status;
  if (volume) {
    if (Status status = volume->release(fallenParticles()); !status) return status;
  }
  return renewConstants();
}

// Buffers, ranges and kernels. A piece has the shape of the strand that it was.
Status Simulation::Implementation::makeFallen() {
  fallenChunks.clear();
  fallenRanges.clear();
  std::size_t done = 0;
  for (std::uint32_t c = 0; c < buffers.chunks.size(); ++c) {
    const GroomChunk& part = buffers.chunks[c].part;
    const std::size_t first = done;
    for (const StrandRange& range : ranges) {
      if (range.chunk != c) continue;
      const std::size_t begin = done;
      while (done < pieces.size() && pieces[done].strand < part.strandBegin + range.end) ++done;
      if (done > begin)
        fallenRanges.push_back({range.shape, static_cast<std::uint32_t>(begin - first),
                                static_cast<std::uint32_t>(done - first), range.longest, c});
    }
    std::vector<layout::StrandReport> reports;
    for (std::size_t k = first; k < done; ++k) reports.push_back(pieces[k].report);
    auto records = createZero(device.gpu(), reports.size() * sizeof(layout::StrandRest), "fallen strands");
    if (!records) return records.error();
    auto ofPieces = createFilled(device.gpu(), reports, "reports of fallen strands");
    if (!ofPieces) return ofPieces.error();
    fallenChunks.push_back({std::move(*records), std::move(*ofPieces)});
  }
  RINGLET_ASSERT(done == pieces.size(), "every piece is of a strand of some range");
  return create(fallenKernels, fallenOptions());
}

// The constants, of the present material and of what was cut.
Status Simulation::Implementation::renewConstants() {
  std::vector<layout::StrandRest> own = strands.empty() ? rest.strands : strands;
  std::vector<std::string> sentences;
  auto particles =
      liveMaterial ? liveMaterial->with(material, own, sentences) : particlesOf(asset->constants);
  if (!particles) return particles.error();
  const std::vector<layout::StrandRest> fallen = restrict(own, *particles);
  if (Status status = buffers.setConstants(device.gpu(), own, *particles, rest.edgeFactors); !status)
    return status;
  if (Status status = uploadFallen(fallen); !status) return status;
  if (Status status = bindKernels(); !status) return status;
  if (liveMaterial) {
    warnings = std::move(sentences);
    warnings.insert(warnings.end(),
                    rest.warnings.begin() + static_cast<std::ptrdiff_t>(rest.materialWarningCount),
                    rest.warnings.end());
  }
  stillness.wake();
  forgetRecordings();
  return {};
}

// Of whole strands what each keeps, and the records of the pieces.
std::vector<layout::StrandRest> Simulation::Implementation::restrict(
    std::span<layout::StrandRest> of, std::span<layout::ParticleRest> particles) const {
  std::vector<layout::StrandRest> fallen;
  for (const FallenPiece& piece : pieces) {
    layout::StrandRest strand = of[piece.strand];
    const layout::StrandRest& whole = rest.strands[piece.strand];
    const auto own = particles.subspan(whole.firstParticle, whole.particleCount);
    beginWith(piece, std::span(rest.points).subspan(whole.firstParticle, whole.particleCount), strand, own);
    strand.firstParticle = whole.firstParticle + piece.begin - 1;
    strand.particleCount = piece.count() + 1;
    strand.restCoreLength = restCoreLength(own, piece.begin, piece.end);
    fallen.push_back(strand);
  }
  for (std::size_t s = 0; s < kept.size(); ++s) {
    const layout::StrandRest& whole = rest.strands[s];
    if (kept[s] == whole.particleCount) continue;
    of[s].particleCount = kept[s];
    of[s].restCoreLength =
        restCoreLength(particles.subspan(whole.firstParticle, whole.particleCount), 0, kept[s]);
  }
  return fallen;
}

// `fallen`: of the pieces.
Status Simulation::Implementation::uploadFallen(std::span<const layout::StrandRest> fallen) {
  std::size_t done = 0;
  for (std::size_t c = 0; c < fallenChunks.size(); ++c) {
    const GroomChunk& part = buffers.chunks[c].part;
    std::vector<layout::StrandRest> ofChunk;
    for (; done < pieces.size() && pieces[done].strand < part.strandEnd; ++done) {
      ofChunk.push_back(fallen[done]);
      ofChunk.back().firstParticle -= part.particleBegin;
    }
    if (Status status = fallenChunks[c].strands.upload(std::as_bytes(std::span(ofChunk))); !status)
      return status;
  }
  return {};
}

// Device order.
std::vector<std::uint32_t> Simulation::Implementation::fallenParticles() const {
  std::vector<std::uint32_t> particles;
  for (const FallenPiece& piece : pieces)
    for (std::uint32_t i = piece.begin; i < piece.end; ++i)
      particles.push_back(rest.strands[piece.strand].firstParticle + i);
  return particles;
}

// By piece.
Result<std::vector<layout::StrandReport>> Simulation::Implementation::fallenReports() const {
  std::vector<layout::StrandReport> all;
  for (const FallenChunk& chunk : fallenChunks) {
    const std::size_t count = chunk.reports.bytes() / sizeof(layout::StrandReport);
    const auto some = downloadAll<layout::StrandReport>(chunk.reports, count);
    if (!some) return some.error();
    all.insert(all.end(), some->begin(), some->end());
  }
  return all;
}

Status Simulation::cut(std::span<const StrandCut> cuts) {
  Implementation& self = *self_;
  RINGLET_ASSERT(self.lostFrame || self.waited == self.submitted, "cut while frames are in flight");
  if (self.lostFrame) return *self.lostFrame;
  if (Status status = self.checkCuts(cuts); !status) return status;
  Status status = self.cut(cuts);
  if (!status) self.lostFrame = status.error();
  return status;
}

}  // namespace ringlet
