// Implements rest/whole_rest.h.
#include "ringlet/rest/whole_rest.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "ringlet/rest/strand_order.h"

namespace ringlet {

Result<WholeRest> buildWholeRest(const Groom& groom, const Material& material, const Settings& settings,
                                 std::span<const StrandGeometry> geometry) {
  std::vector<std::uint32_t> order;
  if (settings.contacts.on) order = orderAlongCurve(groom);
  auto state = buildRestState(groom, material, settings, order, geometry);
  if (!state) return state.error();
  WholeRest rest{std::move(*state)};
  if (!settings.contacts.on || rest.state.strands.empty()) return rest;
  rest.contacts = buildRestContacts(rest.state, settings.contacts);
  std::ranges::copy(rest.contacts->warnings(), std::back_inserter(rest.state.warnings));
  if (rest.contacts->kinds.volume) rest.volume = buildRestVolume(rest.state, *rest.contacts);
  return rest;
}

}  // namespace ringlet
