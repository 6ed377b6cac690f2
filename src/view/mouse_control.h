// MouseControl: what the mouse does in the picture: it takes the camera around, and drags the head and
// bodies.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "view/orbit_camera.h"
#include "view/session.h"

namespace ringlet::view {

/// The mouse in a frame. Places are from the picture's top left [pixels].
struct Mouse {
  double x = 0, y = 0, movedRight = 0, movedDown = 0;
  double wheel = 0;  // turned away from the person
  bool left = false, middle = false, right = false;
  bool isOverPicture = false;  // and no widget wants it
  bool control = false;
};

/// The picture under the mouse, or one of two.
struct MousePicture {
  double left = 0;
  int width = 1, height = 1;
};

/// What may be dragged.
struct MouseSolids {
  std::span<const SolidMesh> solids;
  std::span<const SolidPlace> places;
  std::span<const std::optional<std::size_t>> bodyOf;  // the body of the scene that each is; none: the head's
};

class MouseControl {
 public:
  void update(const Mouse& mouse, const MousePicture& picture, const MouseSolids& solids, OrbitCamera& camera,
              Session& session);

  /// What is dragged now, for people: "head", "body 2"; empty: nothing.
  std::string dragged() const;

 private:
  enum class Action { none, orbit, pan, move, turn };
  void begin(const Mouse& mouse, const MousePicture& picture, const MouseSolids& solids,
             const OrbitCamera& camera, const Session& session);

  Action action_ = Action::none;
  std::optional<std::size_t> body_;  // that is dragged; none: the head
  Vec3d grip_;                       // where it was taken hold of
};

}  // namespace ringlet::view
