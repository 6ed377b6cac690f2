// Implements rest/rest_halo.h.
#include "ringlet/rest/rest_halo.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace ringlet {
namespace {

struct Shared {
  std::vector<std::uint32_t> out, in;
};

void sortOut(std::vector<std::uint32_t>& strands) {
  std::ranges::sort(strands);
  const auto rest = std::ranges::unique(strands);
  strands.erase(rest.begin(), rest.end());
}

}  // namespace

RestHalo haloOf(const RestContacts& contacts, std::span<const std::size_t> partOf, std::size_t own) {
  RestHalo halo;
  for (const std::size_t part : partOf) halo.isHere.push_back(part == own);
  halo.isKnown = halo.isHere;
  std::map<std::size_t, Shared> shared;
  for (std::uint32_t s = 0; s < partOf.size(); ++s) {
    if (!halo.isHere[s]) continue;
    contacts.eachPartner(s, [&](std::uint32_t other, std::uint32_t) {
      if (halo.isHere[other]) return;
      halo.isKnown[other] = true;
      Shared& with = shared[partOf[other]];
      if (with.out.empty() || with.out.back() != s) with.out.push_back(s);
      with.in.push_back(other);
    });
  }
  for (auto& [part, with] : shared) {
    sortOut(with.in);
    halo.peers.push_back({part, std::move(with.out), std::move(with.in)});
  }
  if (std::ranges::find(halo.isKnown, true) == halo.isKnown.end() && !halo.isKnown.empty())
    halo.isKnown[0] = true;
  return halo;
}

}  // namespace ringlet
