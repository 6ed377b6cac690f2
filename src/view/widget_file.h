// The file that tells scripts where the window's widgets are, and what it shows: JSON, written anew every
// frame.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "view/panel.h"

namespace ringlet::view {

struct WindowState {
  std::size_t shownFrames = 0;
  int pictureWidth = 0, pictureHeight = 0;  // the picture is at the window's top left
  bool isPlaying = true;
  Vec3d eye, head;  // [m]
  std::string dragged, message;
  std::vector<Vec3d> solids;  // where the middle of each is in the picture; x, y [pixels], distance [m]
};

Status writeWidgets(const std::filesystem::path& path, const WindowState& state, const WidgetPlaces& widgets);

}  // namespace ringlet::view
