// Implements solver/contacts/sampled_contacts.h.
#include "ringlet/solver/contacts/sampled_contacts.h"

#include <algorithm>

namespace ringlet {

SampledContacts sampledContacts(const RestContacts& contacts, std::size_t hereCount, std::uint32_t stride) {
  std::vector<std::vector<std::uint32_t>> byRemainder(stride);
  for (std::uint32_t c = 0; c < contacts.inWhole.size(); ++c)
    if (contacts.particles.strands[c] < hereCount) byRemainder[contacts.inWhole[c] % stride].push_back(c);
  SampledContacts sampled;
  std::uint32_t end = stride + 1;
  sampled.list.push_back(end);
  for (const std::vector<std::uint32_t>& some : byRemainder) {
    const auto count = static_cast<std::uint32_t>(some.size());
    sampled.list.push_back(end += count);
    sampled.most = std::max(sampled.most, count);
  }
  for (const std::vector<std::uint32_t>& some : byRemainder)
    sampled.list.insert(sampled.list.end(), some.begin(), some.end());
  return sampled;
}

}  // namespace ringlet
