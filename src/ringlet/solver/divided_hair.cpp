// Implements solver/divided_hair.h.
#include "ringlet/solver/divided_hair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include "ringlet/rest/rest_part.h"

namespace ringlet {
namespace {

constexpr std::size_t kRow = sizeof(layout::vec4);

std::size_t fieldCount(DividedHair::Rows rows) { return rows == DividedHair::Rows::step ? 3 : 1; }

}  // namespace

Result<std::vector<bool>> strandsHere(const RestState& rest, std::span<const std::uint32_t> part) {
  const auto isIn = membersOf(part, rest.groomStrandCount);
  if (!isIn) return isIn.error();
  std::vector<bool> isHere;
  for (const std::uint32_t strand : rest.strandInGroom) isHere.push_back((*isIn)[strand]);
  return isHere;
}

std::vector<StrandRange> rangesHere(std::span<const StrandRange> ranges, const RestState& rest,
                                    const std::vector<bool>& isHere) {
  std::vector<StrandRange> runs;
  for (const StrandRange& range : ranges) {
    for (std::uint32_t s = range.begin; s < range.end; ++s) {
      if (!isHere[s]) continue;
      if (s == range.begin || !isHere[s - 1]) runs.push_back({range.shape, s, s, 0, range.chunk});
      runs.back().end = s + 1;
      runs.back().longest = rest.strands[s].particleCount;  // they rise
    }
  }
  return runs;
}

Result<DividedHair> DividedHair::create(gpu::Device& device, const RestState& rest, PartLink& link) {
  const std::size_t fields = fieldCount(Rows::step) + fieldCount(Rows::solve);
  auto crossing = gpu::Buffer::create(device, rest.points.size() * fields * kRow, gpu::BufferKind::stream,
                                      "rows between parts of hair");
  if (!crossing) return crossing.error();
  DividedHair self(link, std::move(*crossing));
  std::vector<int> parts(rest.strands.size());  // that a strand is in
  self.countBefore_.push_back(0);
  for (const std::vector<std::uint32_t>& part : link.parts()) {
    const auto isIn = strandsHere(rest, part);
    if (!isIn) return isIn.error();
    std::vector<Run> runs;
    std::size_t count = 0;
    for (std::size_t s = 0; s < rest.strands.size(); ++s) {
      if (!(*isIn)[s]) continue;
      ++parts[s];
      const layout::StrandRest& strand = rest.strands[s];
      const bool goesOn =
          !runs.empty() && runs.back().firstParticle + runs.back().count == strand.firstParticle;
      if (!goesOn) runs.push_back({strand.firstParticle, 0});
      runs.back().count += strand.particleCount;
      count += strand.particleCount;
    }
    self.runs_.push_back(std::move(runs));
    self.countBefore_.push_back(self.countBefore_.back() + count);
  }
  for (std::size_t s = 0; s < parts.size(); ++s) {
    if (parts[s] != 1)
      return Error{fmt::format("strand {} is in {} parts of the hair; every strand is in one",
                               rest.strandInGroom[s], parts[s])};
  }
  return self;
}

// Rows of the step stay as they came until its lists have room.
std::size_t DividedHair::beginOf(Rows rows) const {
  return rows == Rows::step ? 0 : countBefore_.back() * fieldCount(Rows::step) * kRow;
}

// copy(field's buffer, first byte there, first byte in crossing_, bytes) of each run of a part's.
template <class Copy>
void DividedHair::eachRun(std::size_t part, const DeviceChunk& hair, Rows rows, const Copy& copy) const {
  std::size_t at = beginOf(rows) + countBefore_[part] * fieldCount(rows) * kRow;
  const auto each = [&](const gpu::Buffer& field) {
    for (const Run& run : runs_[part]) {
      copy(field, run.firstParticle * kRow, at, run.count * kRow);
      at += run.count * kRow;
    }
  };
  if (rows == Rows::step) each(hair.positions), each(hair.velocities);
  each(hair.solved);
}

void DividedHair::recordOut(gpu::CommandList& list, const DeviceChunk& hair, Rows rows) const {
  eachRun(link_->own(), hair, rows,
          [&](const gpu::Buffer& field, std::size_t inField, std::size_t at, std::size_t bytes) {
            list.copyBuffer(field, crossing_, bytes, inField, at);
          });
}

void DividedHair::recordIn(gpu::CommandList& list, const DeviceChunk& hair, Rows rows) const {
  for (std::size_t part = 0; part < runs_.size(); ++part) {
    if (part == link_->own()) continue;
    eachRun(part, hair, rows,
            [&](const gpu::Buffer& field, std::size_t inField, std::size_t at, std::size_t bytes) {
              list.copyBuffer(crossing_, field, bytes, at, inField);
            });
  }
}

Status DividedHair::exchange(Rows rows) {
  std::vector<std::size_t> ends;
  for (std::size_t part = 0; part < runs_.size(); ++part)
    ends.push_back(countBefore_[part + 1] * fieldCount(rows) * kRow);
  return link_->exchange(crossing_.mapped().subspan(beginOf(rows), ends.back()), ends);
}

Result<ContactStage::Sample> DividedHair::sum(const ContactStage::Sample& own) {
  std::vector<ContactStage::Sample> all(runs_.size());
  all[link_->own()] = own;
  std::vector<std::size_t> ends;
  for (std::size_t part = 1; part <= all.size(); ++part) ends.push_back(part * sizeof(own));
  if (Status done = link_->exchange(std::as_writable_bytes(std::span(all)), ends); !done) return done.error();
  ContactStage::Sample sum;
  for (const ContactStage::Sample& part : all) sum.sampled += part.sampled, sum.missed += part.missed;
  return sum;
}

}  // namespace ringlet
