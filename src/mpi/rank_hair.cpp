// Implements rank_hair.h.
#include "mpi/rank_hair.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mpi/ranks.h"
#include "mpi/remote_hair.h"
#include "ringlet/base/archive.h"
#include "ringlet/rest/whole_rest.h"
#include "ringlet/run/divided_hair.h"
#include "ringlet/run/split_hair.h"
#include "ringlet/run/strand_parts.h"

namespace ringlet::mpi {
namespace {

// The parts that rank 0 chooses, on every rank: another METIS might choose others.
Result<StrandParts> dividedByFirst(const SceneHairInput& input, const Result<WholeRest>& rest,
                                   std::size_t count) {
  const Groom& groom = input.scene.groom;
  Archive written = Archive::writing();
  if (ranks().own == 0) {
    const auto parts = rest ? divideStrands(groom, input.settings(), *rest, count) : rest.error();
    std::string why = parts ? std::string() : parts.error().message;
    std::vector<std::uint32_t> partOf(parts ? groom.strandCount() : 0);
    for (std::uint32_t part = 0; parts && part < parts->size(); ++part)
      for (const std::uint32_t strand : (*parts)[part]) partOf[strand] = part;
    written.text(why);
    written.values(std::span(partOf));
  }
  const std::vector<std::byte> bytes = fromFirst(written.take());
  if (isToldToLeave()) return Error{"rank 0 has ended"};
  Archive read = Archive::reading(bytes);
  std::string why;
  read.text(why);
  if (!why.empty()) return Error{why};
  std::vector<std::uint32_t> partOf(groom.strandCount());
  read.values(std::span(partOf));
  if (!read.isWhole()) return Error{"rank 0 has another groom than this rank"};
  StrandParts parts(count);
  for (std::uint32_t strand = 0; strand < partOf.size(); ++strand) parts[partOf[strand]].push_back(strand);
  return parts;
}

// This rank's.
struct OwnPart {
  StrandParts all;
  PartLinks links{};
  Result<std::unique_ptr<SceneHair>> hair;
};

Result<OwnPart> makeOwnPart(const SceneHairInput& input, const PartMaker& makePart) {
  const auto [own, count] = ranks();
  const auto rank = static_cast<std::size_t>(own), rankCount = static_cast<std::size_t>(count);
  const std::size_t strandCount = input.scene.groom.strandCount();
  if (rankCount > strandCount)
    return Error{fmt::format("{} ranks are more than the groom's {} strands", rankCount, strandCount)};
  const auto rest = wholeRestOf(input);
  auto parts = dividedByFirst(input, rest, rankCount);
  if (!parts) return parts.error();
  if (!rest) return rest.error();
  OwnPart made{.all = std::move(*parts), .hair = Error{}};
  if (input.settings().contacts.on) made.links.push_back(linkRanks(made.all));
  SceneHairInput withRest = input;
  withRest.rest = &*rest;
  made.hair = makePart(withRest, rank, made.all[rank], made.links.empty() ? nullptr : made.links[0].get());
  return made;
}

}  // namespace

Result<std::unique_ptr<SceneHair>> makeRankHair(const SceneHairInput& input, const PartMaker& makePart) {
  auto own = makeOwnPart(input, makePart);
  if (!own) return own.error();
  auto hair = std::move(own->hair);
  std::vector<HairPart> parts;
  if (hair) parts.push_back({std::move(*hair), own->all[0]});
  for (int other = 1; other < ranks().count; ++other) {
    const std::vector<std::uint32_t>& its = own->all[static_cast<std::size_t>(other)];
    auto made = makeRemoteHair(other, input.scene.groom, its);
    if (!made && hair) hair = made.error();
    if (made) parts.push_back({std::move(*made), its});
  }
  if (!hair) return hair.error();
  return joinParts(std::move(own->links), std::move(parts), input.scene.groom);
}

void serveRanks(const SceneHairInput& input, const PartMaker& makePart) {
  auto own = makeOwnPart(input, makePart);
  if (own) {
    const auto& strands = own->all[static_cast<std::size_t>(ranks().own)];
    serve(std::move(own->hair), input.frames, input.scene.groom, strands);
  } else {
    serve(own.error(), input.frames, input.scene.groom, {});
  }
}

}  // namespace ringlet::mpi
