// Implements follow/rest_shape.h.
#include "ringlet/follow/rest_shape.h"

#include <utility>

namespace ringlet {

RestShape restShapeOf(std::vector<Vec3d> points, const GuideRest& rest) {
  RestShape shape{.points = std::move(points), .core = {}, .curl = {}, .frames = {}, .arcs = rest.arcs};
  shape.core = smoothCore(shape.points, rest.arcs, rest.window);
  shape.frames = framesAlong(shape.core, rest.frame);
  for (std::size_t i = 1; i < shape.core.size(); ++i)
    shape.coreLength += length(shape.core[i] - shape.core[i - 1]);
  for (std::size_t i = 0; i < shape.points.size(); ++i)
    shape.curl.push_back(inFrame(shape.frames[i], shape.points[i] - shape.core[i]));
  return shape;
}

}  // namespace ringlet
