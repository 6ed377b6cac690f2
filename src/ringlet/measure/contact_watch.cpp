// Implements measure/contact_watch.h.
#include "ringlet/measure/contact_watch.h"

#include <algorithm>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/measure/crossings.h"

namespace ringlet {

Result<ContactWatch> ContactWatch::make(const Groom& groom, const Material& material,
                                        const Settings& settings) {
  auto ruler = ContactRuler::make(groom, material, settings);
  if (!ruler) return ruler.error();
  return ContactWatch(std::move(*ruler), groom.firstPoint, settings.contacts);
}

ContactWatch::ContactWatch(ContactRuler ruler, std::span<const std::uint32_t> firstPoint,
                           const ContactSettings& settings)
    : ruler_(std::move(ruler)),
      firstPoint_(firstPoint.begin(), firstPoint.end()),
      bundles_(bundlesOf(settings, firstPoint.size() - 1)) {}

void ContactWatch::addStep(std::span<const Vec3f> positions) {
  if (!positions_.empty()) numbers_.crossings += countCrossings(firstPoint_, positions_, positions, bundles_);
  positions_.assign(positions.begin(), positions.end());
}

bool ContactWatch::endFrame() {
  RINGLET_ASSERT(!positions_.empty(), "a frame ends with a step");
  const ContactQuality now = ruler_.measure(positions_);
  numbers_.deepestOverlap = std::max(numbers_.deepestOverlap, now.deepestOverlap);
  if (now.overlapBeyondRestSum < numbers_.worst.overlapBeyondRestSum) return false;
  numbers_.worst = now;
  return true;
}

}  // namespace ringlet
