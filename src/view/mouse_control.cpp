// Implements view/mouse_control.h.
#include "view/mouse_control.h"

#include <fmt/format.h>

#include <cmath>

namespace ringlet::view {
namespace {

constexpr double kTurnEach = 0.008;  // [rad] a pixel
constexpr double kZoomEach = 0.88;   // of the distance, a notch of the wheel

}  // namespace

void MouseControl::begin(const Mouse& mouse, const MousePicture& picture, const MouseSolids& solids,
                         const OrbitCamera& camera, const Session& session) {
  action_ = mouse.control && mouse.left    ? Action::move
            : mouse.control && mouse.right ? Action::turn
            : mouse.left                   ? Action::orbit
                                           : Action::pan;
  if (action_ == Action::orbit || action_ == Action::pan) return;
  const double aspect = static_cast<double>(picture.width) / picture.height;
  const Ray ray =
      camera.rayThrough((mouse.x - picture.left) / picture.width, mouse.y / picture.height, aspect);
  const auto hit = hitBy(ray, solids.solids, solids.places);
  body_ = hit ? solids.bodyOf[hit->solid] : std::nullopt;
  grip_ = hit ? hit->place : session.head().position;
}

void MouseControl::update(const Mouse& mouse, const MousePicture& picture, const MouseSolids& solids,
                          OrbitCamera& camera, Session& session) {
  if (!mouse.left && !mouse.middle && !mouse.right) {
    action_ = Action::none;
  } else if (action_ == Action::none && mouse.isOverPicture) {
    begin(mouse, picture, solids, camera, session);
  }
  if (mouse.isOverPicture && mouse.wheel != 0) camera.zoom(std::pow(kZoomEach, mouse.wheel));
  if (mouse.movedRight == 0 && mouse.movedDown == 0) return;
  DraggedPose& dragged = body_ ? session.bodyDrags[*body_] : session.headDrag;
  if (action_ == Action::orbit) camera.orbit(-mouse.movedRight * kTurnEach, mouse.movedDown * kTurnEach);
  if (action_ == Action::pan) camera.pan(mouse.movedRight, mouse.movedDown, picture.height);
  if (action_ == Action::move) {
    const Vec3d move = camera.moveOf(grip_, mouse.movedRight, mouse.movedDown, picture.height);
    grip_ += move;
    dragged.move(move);
  }
  if (action_ == Action::turn) {
    const CameraAxes axes = axesOf(camera.camera());
    dragged.turn(fromRotationVector(camera.camera().up * (mouse.movedRight * kTurnEach)));
    dragged.turn(fromRotationVector(axes.right * (mouse.movedDown * kTurnEach)));
  }
}

std::string MouseControl::dragged() const {
  if (action_ != Action::move && action_ != Action::turn) return "";
  return body_ ? fmt::format("body {}", *body_ + 1) : "head";
}

}  // namespace ringlet::view
