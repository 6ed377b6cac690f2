// Implements measure/contact_watch.h.
#include "ringlet/measure/contact_watch.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/measure/crossings.h"

namespace ringlet {

Result<ContactWatch> ContactWatch::make(const Groom& groom, const Material& material,
                                        const Settings& settings) {
  auto rest = buildRestState(groom, material, settings);
  if (!rest) return rest.error();
  RestContacts contacts = buildRestContacts(*rest, settings.contacts);
  if (settings.contacts.on) std::ranges::copy(contacts.warnings(), std::back_inserter(rest->warnings));
  return ContactWatch(std::move(*rest), std::move(contacts), groom.firstPoint);
}

ContactWatch::ContactWatch(RestState rest, RestContacts contacts, std::span<const std::uint32_t> firstPoint)
    : rest_(std::move(rest)),
      contacts_(std::move(contacts)),
      firstPoint_(firstPoint.begin(), firstPoint.end()) {}

void ContactWatch::addStep(std::span<const Vec3f> positions) {
  if (!positions_.empty()) numbers_.crossings += countCrossings(firstPoint_, positions_, positions);
  positions_.assign(positions.begin(), positions.end());
}

bool ContactWatch::endFrame() {
  RINGLET_ASSERT(!positions_.empty(), "a frame ends with a step");
  const ContactQuality now = measureContacts(rest_, contacts_, positions_);
  numbers_.deepestOverlap = std::max(numbers_.deepestOverlap, now.deepestOverlap);
  if (now.overlapBeyondRestSum < numbers_.worst.overlapBeyondRestSum) return false;
  numbers_.worst = now;
  return true;
}

}  // namespace ringlet
