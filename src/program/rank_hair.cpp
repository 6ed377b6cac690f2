// Implements rank_hair.h.
#include "program/rank_hair.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "program/exit_codes.h"
#include "program/hair_maker.h"
#include "program/interruption.h"
#include "program/ranks.h"
#include "program/remote_hair.h"
#include "ringlet/base/archive.h"
#include "ringlet/run/split_hair.h"
#include "ringlet/run/strand_parts.h"

namespace ringlet::program {
namespace {

// The parts that rank 0 chooses, on every rank: another METIS might choose others.
Result<StrandParts> dividedByFirst(const SceneHairInput& input, std::size_t count) {
  const Groom& groom = input.scene.groom;
  Archive written = Archive::writing();
  if (ranks().own == 0) {
    const auto parts = divideStrands(groom, input.scene.material, input.settings(), count);
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

Result<OwnPart> makeOwnPart(const SceneHairInput& input, const SimulateOptions& options) {
  const auto [own, count] = ranks();
  const auto rank = static_cast<std::size_t>(own), rankCount = static_cast<std::size_t>(count);
  const std::size_t strandCount = input.scene.groom.strandCount();
  if (rankCount > strandCount)
    return Error{fmt::format("{} ranks are more than the groom's {} strands", rankCount, strandCount)};
  auto parts = dividedByFirst(input, rankCount);
  if (!parts) return parts.error();
  OwnPart made{.all = std::move(*parts), .hair = Error{}};
  if (input.settings().contacts.on) made.links.push_back(linkRanks(made.all));
  const std::string& device =
      options.devices.empty() ? options.device : options.devices[rank % options.devices.size()];
  const auto gpu = GpuChoice::make(input, options, device);
  made.hair = gpu ? makeHairPart(input, (*gpu)->choice(), made.all[rank],
                                 made.links.empty() ? nullptr : made.links[0].get())
                  : gpu.error();
  return made;
}

}  // namespace

Result<std::unique_ptr<SceneHair>> makeRankHair(const SceneHairInput& input, const SimulateOptions& options) {
  auto own = makeOwnPart(input, options);
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

int serveRanks(const LoadedScene& scene, const SimulateOptions& options) {
  catchInterruption();  // rank 0 says when this one ends
  const SceneFrames frames(scene);
  auto own = makeOwnPart(hairInputOf(scene, frames, options), options);
  if (own) {
    const auto& strands = own->all[static_cast<std::size_t>(ranks().own)];
    serve(std::move(own->hair), frames, scene.groom, strands);
  } else {
    serve(own.error(), frames, scene.groom, {});
  }
  return kExitFine;
}

}  // namespace ringlet::program
