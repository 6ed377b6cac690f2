// PaneRow: the pictures of hair in the window, one a material, side by side.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/render/camera.h"
#include "view/canvas.h"
#include "view/hair_pane.h"
#include "view/panel.h"
#include "view/session.h"

namespace ringlet::view {

class PaneRow {
 public:
  /// `look`: of each, but for its size. Makes them anew where there are others to be shown than there are;
  /// nothing may be under way. Errors: HairPane's.
  Status prepare(gpu::Device& device, const Session& session, const PaneLook& look, PixelSize size,
                 const Shown& shown);
  /// Takes the session's hair again, whose buffers are others.
  Status attach(gpu::Device& device, const Session& session);
  /// The same where hair was cut since then.
  Status takeCuts(gpu::Device& device, const Session& session) {
    return session.cutCount() == cutCount_ ? Status{} : attach(device, session);
  }

  Status setFrame(const Camera& camera, const HeadPose& head, std::span<const SolidPlace> solids,
                  const HairSurroundings& about);
  void record(gpu::CommandList& list, Quatd head) const;
  void finish();  // when what was recorded is done
  std::vector<PlacedPicture> pictures() const;

 private:
  std::vector<std::unique_ptr<HairPane>> panes_;
  PixelSize size_;            // of all
  std::size_t cutCount_ = 0;  // that are drawn
  Shown shown_;
};

}  // namespace ringlet::view
