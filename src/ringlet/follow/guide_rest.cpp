// Implements follow/guide_rest.h.
#include "ringlet/follow/guide_rest.h"

#include "ringlet/groom/curl_shape.h"

namespace ringlet {

GuideRest restOfGuide(std::span<const Vec3d> strand) {
  GuideRest rest;
  rest.arcs = arcPositions(strand);
  rest.window = coreWindow(measureCurl(strand), rest.arcs.back());
  rest.root = strand.front();
  rest.frame = rootFrameOf(smoothCore(strand, rest.arcs, rest.window));
  return rest;
}

}  // namespace ringlet
