// RestShape: a strand at rest as the hairs that follow it see it: its core, and its curl along the core's
// frames.
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/follow/guide_rest.h"
#include "ringlet/measure/core.h"

namespace ringlet {

struct RestShape {
  std::vector<Vec3d> points, core, curl;  // one a particle [m]; the curl along `frames`
  std::vector<MeasuringFrame> frames;
  std::vector<double> arcs;  // where its particles stand, from 0 at the root [m]
  double coreLength = 0;     // [m]
};

/// `points`: what `rest` is of [m]. Cost: n log n.
RestShape restShapeOf(std::vector<Vec3d> points, const GuideRest& rest);

/// A vector along a frame's normal, binormal and tangent; and back.
inline Vec3d inFrame(const MeasuringFrame& frame, Vec3d v) {
  return {dot(v, frame.normal), dot(v, frame.binormal), dot(v, frame.tangent)};
}
inline Vec3d outOfFrame(const MeasuringFrame& frame, Vec3d v) {
  return frame.normal * v.x + frame.binormal * v.y + frame.tangent * v.z;
}

}  // namespace ringlet
