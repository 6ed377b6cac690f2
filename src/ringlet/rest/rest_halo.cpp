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
  strands.erase(std::unique(strands.begin(), strands.end()), strands.end());
}

}  // namespace

RestHalo haloOf(const RestContacts& contacts, std::span<const std::size_t> partOf, std::size_t own) {
  RestHalo halo;
  std::map<std::size_t, Shared> shared;
  for (std::uint32_t s = 0; s < partOf.size(); ++s) {
    if (partOf[s] != own) continue;
    halo.here.push_back(s);
    contacts.eachPartner(s, [&](std::uint32_t other, std::uint32_t) {
      if (partOf[other] == own) return;
      Shared& with = shared[partOf[other]];
      if (with.out.empty() || with.out.back() != s) with.out.push_back(s);
      with.in.push_back(other);
    });
  }
  std::vector<bool> isBorder(partOf.size());
  for (auto& [part, with] : shared) {
    for (const std::uint32_t s : with.out) isBorder[s] = true;
    sortOut(with.in);
    halo.around.insert(halo.around.end(), with.in.begin(), with.in.end());
    halo.peers.push_back({part, std::move(with.out), std::move(with.in)});
  }
  std::ranges::sort(halo.around);
  const auto inner =
      std::stable_partition(halo.here.begin(), halo.here.end(), [&](std::uint32_t s) { return isBorder[s]; });
  halo.borderCount = static_cast<std::size_t>(inner - halo.here.begin());
  if (halo.here.empty() && halo.around.empty() && !partOf.empty()) halo.around.push_back(0);
  return halo;
}

}  // namespace ringlet
