// Lines and points over the picture: axes of head, bodies and strands, and particles in contact.
#pragma once

#include "ringlet/base/result.h"
#include "view/orbit_camera.h"
#include "view/panel.h"
#include "view/session.h"

namespace ringlet::view {

/// Where one of the pictures is in the window [pixels].
struct OverlayPicture {
  int left = 0, width = 1, height = 1;
};

/// Into ImGui's background, within an ImGui frame. Reads positions back where contacts or frames are shown;
/// nothing may be under way.
Status drawOverlays(const Shown& shown, const OrbitCamera& camera, const Session& session,
                    const Simulation& hair, const OverlayPicture& picture);

}  // namespace ringlet::view
