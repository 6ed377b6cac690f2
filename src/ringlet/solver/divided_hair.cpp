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

// Each strand's part.
Result<std::vector<std::size_t>> partOfEach(const RestState& rest,
                                            const std::vector<std::vector<std::uint32_t>>& parts) {
  std::vector<std::size_t> partOf(rest.strands.size());
  std::vector<int> counts(rest.strands.size());
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const auto isIn = strandsHere(rest, parts[part]);
    if (!isIn) return isIn.error();
    for (std::size_t s = 0; s < partOf.size(); ++s) {
      if ((*isIn)[s]) partOf[s] = part, ++counts[s];
    }
  }
  for (std::size_t s = 0; s < counts.size(); ++s) {
    if (counts[s] != 1)
      return Error{fmt::format("strand {} is in {} parts of the hair; every strand is in one",
                               rest.strandInGroom[s], counts[s])};
  }
  return partOf;
}

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

Result<DividedHair> DividedHair::create(gpu::Device& device, const RestState& rest, PartLink& link,
                                        const Fields& ofHair, const std::optional<RestVolume>& volume,
                                        const Fields& ofVolume) {
  const auto partOf = partOfEach(rest, link.parts());
  if (!partOf) return partOf.error();
  const auto add = [](std::vector<Run>& runs, std::size_t first, std::size_t count) {
    if (runs.empty() || runs.back().end != first) runs.push_back({first, first});
    runs.back().end += count;
  };
  std::vector<std::vector<Run>> hair(link.parts().size()), inVolume(link.parts().size());
  for (std::size_t s = 0; s < rest.strands.size(); ++s)
    add(hair[(*partOf)[s]], rest.strands[s].firstParticle, rest.strands[s].particleCount);
  if (volume) {
    for (std::size_t i = 0; i < volume->strands.size(); ++i)
      add(inVolume[(*partOf)[volume->strands[i]]], i, 1);
  }
  DividedHair self(link);
  for (std::size_t part = 0; part < hair.size(); ++part)
    self.step_.addPart(hair[part], ofHair.step, inVolume[part], ofVolume.step);
  self.solve_.begin = self.step_.bytes();
  for (std::size_t part = 0; part < hair.size(); ++part)
    self.solve_.addPart(hair[part], ofHair.solve, inVolume[part], ofVolume.solve);
  auto crossing = gpu::Buffer::create(device, self.step_.bytes() + self.solve_.bytes(),
                                      gpu::BufferKind::stream, "rows between parts of hair");
  if (!crossing) return crossing.error();
  self.crossing_.emplace(std::move(*crossing));
  return self;
}

void DividedHair::Crossing::addPart(std::span<const Run> hair, std::span<const Field> ofHair,
                                    std::span<const Run> volume, std::span<const Field> ofVolume) {
  std::size_t end = ends.empty() ? 0 : ends.back();
  std::vector<Piece>& own = pieces.emplace_back();
  const auto addFields = [&](std::span<const Field> fields, std::span<const Run> runs) {
    for (const Field& field : fields) {
      for (const Run& run : runs) {
        const std::size_t bytes = (run.end - run.first) * kRow;
        own.push_back({field.buffer, (field.firstRow + run.first) * kRow, begin + end, bytes});
        end += bytes;
      }
    }
  };
  addFields(ofHair, hair);
  addFields(ofVolume, volume);
  ends.push_back(end);
}

void DividedHair::recordOut(gpu::CommandList& list, Rows rows) const {
  for (const Piece& piece : of(rows).pieces[link_->own()])
    list.copyBuffer(*piece.buffer, *crossing_, piece.bytes, piece.inBuffer, piece.inCrossing);
}

void DividedHair::recordIn(gpu::CommandList& list, Rows rows) const {
  const Crossing& crossing = of(rows);
  for (std::size_t part = 0; part < crossing.pieces.size(); ++part) {
    if (part == link_->own()) continue;
    for (const Piece& piece : crossing.pieces[part])
      list.copyBuffer(*crossing_, *piece.buffer, piece.bytes, piece.inCrossing, piece.inBuffer);
  }
}

Status DividedHair::exchange(Rows rows) {
  const Crossing& crossing = of(rows);
  return link_->exchange(crossing_->mapped().subspan(crossing.begin, crossing.bytes()), crossing.ends);
}

Result<ContactStage::Sample> DividedHair::sum(const ContactStage::Sample& own) {
  std::vector<ContactStage::Sample> all(link_->parts().size());
  all[link_->own()] = own;
  std::vector<std::size_t> ends;
  for (std::size_t part = 1; part <= all.size(); ++part) ends.push_back(part * sizeof(own));
  if (Status done = link_->exchange(std::as_writable_bytes(std::span(all)), ends); !done) return done.error();
  ContactStage::Sample sum;
  for (const ContactStage::Sample& part : all) sum.sampled += part.sampled, sum.missed += part.missed;
  return sum;
}

}  // namespace ringlet
