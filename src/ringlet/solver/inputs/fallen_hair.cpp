// Implements solver/inputs/fallen_hair.h.
#include "ringlet/solver/inputs/fallen_hair.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/rest/rest_curve.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/inputs/frame_inputs.h"

namespace ringlet {
namespace {

Vec3d vectorOf(const layout::vec3& v) { return {v.x, v.y, v.z}; }

// Sets the rest state of a piece, which begins with its first edge: its frames and smoothed curves begin
// there, turned as the head was when it was cut; shape and springs stay. `points`, `particles`: of the whole
// strand.
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

// The rest length of the core along particles [begin, end) of a strand.
float restCoreLength(std::span<const layout::ParticleRest> particles, std::uint32_t begin,
                     std::uint32_t end) {
  double length = 0;
  for (std::uint32_t i = begin; i + 1 < end; ++i) length += particles[i].coreEdgeLength;
  return static_cast<float>(std::max(length, 1e-12));
}

}  // namespace

Result<FallenHair> FallenHair::create(const InputSource& from) { return FallenHair(from.rest, from.chunks); }

Status FallenHair::check(std::span<const StrandCut> cuts, std::uint32_t least) const {
  std::vector<std::uint32_t> stay(rest_->groomStrandCount, 0);  // 0: rigid
  for (std::size_t s = 0; s < rest_->strands.size(); ++s) stay[rest_->strandInGroom[s]] = keptOf(s);
  for (const StrandCut& cut : cuts) {
    if (cut.strand >= stay.size())
      return Error{fmt::format("a cut names strand {}; the groom has {}, numbered from 0", cut.strand,
                               rest_->groomStrandCount)};
    std::uint32_t& now = stay[cut.strand];
    if (now == 0) continue;
    if (cut.keep < least || cut.keep >= now)
      return Error{fmt::format("strand {} has {} particles, of which a cut is to keep {}; expected {} to {}",
                               cut.strand, now, cut.keep, least, now - 1)};
    now = cut.keep;
  }
  return {};
}

Status FallenHair::cut(gpu::Device& device, std::span<const StrandCut> cuts, Quatd headRotation,
                       std::span<const StrandRange> ranges) {
  if (Status status = keepReports(); !status) return status;
  if (kept_.empty())
    for (const layout::StrandRest& strand : rest_->strands) kept_.push_back(strand.particleCount);
  std::vector<std::uint32_t> onDevice(rest_->groomStrandCount, ~0u);  // ~0: a rigid strand, which is not on
                                                                      // the device
  for (std::uint32_t s = 0; s < rest_->strands.size(); ++s) onDevice[rest_->strandInGroom[s]] = s;
  for (const StrandCut& cut : cuts) {
    const std::uint32_t s = onDevice[cut.strand];
    if (s == ~0u) continue;
    pieces_.push_back({.strand = s, .begin = cut.keep, .end = kept_[s], .restTurn = headRotation});
    kept_[s] = cut.keep;
  }
  std::ranges::sort(pieces_, {}, [](const FallenPiece& p) { return std::pair(p.strand, p.begin); });
  return makeRecords(device, ranges);
}

Status FallenHair::reshape(gpu::Device& device, std::span<const StrandRange> ranges) {
  if (pieces_.empty()) return {};
  if (Status status = keepReports(); !status) return status;
  return makeRecords(device, ranges);
}

// Saves the pieces' reports while the device's records are made anew.
Status FallenHair::keepReports() {
  const auto now = reports();
  if (!now) return now.error();
  for (std::size_t k = 0; k < pieces_.size(); ++k) pieces_[k].report = (*now)[k];
  return {};
}

// Makes buffers and ranges. A piece has the kernel shape of the strand that it was cut off.
Status FallenHair::makeRecords(gpu::Device& device, std::span<const StrandRange> ranges) {
  records_.clear();
  ranges_.clear();
  std::size_t done = 0;
  for (std::uint32_t c = 0; c < chunks_.size(); ++c) {
    const std::size_t first = done;
    for (const StrandRange& range : ranges) {
      if (range.chunk != c) continue;
      const std::size_t begin = done;
      while (done < pieces_.size() && pieces_[done].strand < chunks_[c].strandBegin + range.end) ++done;
      if (done > begin)
        ranges_.push_back({range.shape, static_cast<std::uint32_t>(begin - first),
                           static_cast<std::uint32_t>(done - first), range.longest, c});
    }
    std::vector<layout::StrandReport> ofChunk;
    for (std::size_t k = first; k < done; ++k) ofChunk.push_back(pieces_[k].report);
    auto strands = createZero(device, ofChunk.size() * sizeof(layout::StrandRest), "fallen strands");
    if (!strands) return strands.error();
    auto reports = createFilled(device, ofChunk, "reports of fallen strands");
    if (!reports) return reports.error();
    records_.push_back({std::move(*strands), std::move(*reports)});
  }
  RINGLET_ASSERT(done == pieces_.size(), "every piece is of a strand of some range");
  return {};
}

std::vector<layout::StrandRest> FallenHair::restrict(std::span<layout::StrandRest> of,
                                                     std::span<layout::ParticleRest> particles) const {
  std::vector<layout::StrandRest> fallen;
  for (const FallenPiece& piece : pieces_) {
    layout::StrandRest strand = of[piece.strand];
    const layout::StrandRest& whole = rest_->strands[piece.strand];
    const auto own = particles.subspan(whole.firstParticle, whole.particleCount);
    beginWith(piece, std::span(rest_->points).subspan(whole.firstParticle, whole.particleCount), strand, own);
    strand.firstParticle = whole.firstParticle + piece.begin - 1;
    strand.particleCount = piece.count() + 1;
    strand.restCoreLength = restCoreLength(own, piece.begin, piece.end);
    fallen.push_back(strand);
  }
  for (std::size_t s = 0; s < kept_.size(); ++s) {
    const layout::StrandRest& whole = rest_->strands[s];
    if (kept_[s] == whole.particleCount) continue;
    of[s].particleCount = kept_[s];
    of[s].restCoreLength =
        restCoreLength(particles.subspan(whole.firstParticle, whole.particleCount), 0, kept_[s]);
  }
  return fallen;
}

Status FallenHair::setRecords(std::span<const layout::StrandRest> ofPieces) {
  std::size_t done = 0;
  for (std::size_t c = 0; c < records_.size(); ++c) {
    std::vector<layout::StrandRest> ofChunk;
    for (; done < pieces_.size() && pieces_[done].strand < chunks_[c].strandEnd; ++done) {
      ofChunk.push_back(ofPieces[done]);
      ofChunk.back().firstParticle -= chunks_[c].particleBegin;
    }
    if (Status status = records_[c].strands.upload(std::as_bytes(std::span(ofChunk))); !status) return status;
  }
  return {};
}

std::vector<std::uint32_t> FallenHair::particles() const {
  std::vector<std::uint32_t> all;
  for (const FallenPiece& piece : pieces_)
    for (std::uint32_t i = piece.begin; i < piece.end; ++i)
      all.push_back(rest_->strands[piece.strand].firstParticle + i);
  return all;
}

Result<std::vector<layout::StrandReport>> FallenHair::reports() const {
  std::vector<layout::StrandReport> all;
  for (const Records& records : records_) {
    const std::size_t count = records.reports.bytes() / sizeof(layout::StrandReport);
    const auto some = downloadAll<layout::StrandReport>(records.reports, count);
    if (!some) return some.error();
    all.insert(all.end(), some->begin(), some->end());
  }
  return all;
}

Status FallenHair::archive(Archive& archive) {
  for (FallenPiece& piece : pieces_) archive.value(piece.restTurn);
  for (Records& records : records_) {
    if (Status status = archiveBuffer(archive, records.reports); !status) return status;
  }
  return {};
}

gpu::BufferTable FallenHair::pieceTable(std::size_t chunk) const {
  const auto& [strands, reports] = records_[chunk];
  return {
      {layout::kBindStrands, strands}, {layout::kBindStrandTexels, strands}, {layout::kBindReports, reports}};
}

std::uint64_t DeviceMemory::*FallenHair::kind() const { return &DeviceMemory::strands; }
std::uint64_t FallenHair::bytes() const {
  std::uint64_t bytes = 0;
  for (const Records& records : records_) bytes += records.strands.bytes() + records.reports.bytes();
  return bytes;
}

}  // namespace ringlet
