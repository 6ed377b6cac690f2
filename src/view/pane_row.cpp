// Implements view/pane_row.h.
#include "view/pane_row.h"

#include <algorithm>
#include <utility>

namespace ringlet::view {
namespace {

constexpr int kLeastWidth = 4;  // of a picture [pixels]

bool isDrawnAlike(const Shown& a, const Shown& b) {
  return a.bodies == b.bodies && a.guides == b.guides && a.stretch == b.stretch;
}

}  // namespace

Status PaneRow::prepare(gpu::Device& device, const Session& session, const PaneLook& look, PixelSize size,
                        const Shown& shown) {
  const std::size_t count = session.hairs().size();
  if (panes_.size() == count && size_ == size && isDrawnAlike(shown_, shown)) return {};
  panes_.clear();
  size_ = size;
  shown_ = shown;
  PaneLook each = look;
  each.size.width = std::max(size.width / static_cast<int>(count), kLeastWidth);
  each.size.height = size.height;
  each.showsStretch = shown.stretch;
  const Groom& groom = session.scene().groom;
  if (shown.guides && each.follow) {
    each.follow.reset();
    each.width = std::min(widthOfHairs(static_cast<double>(groom.strandCount())), kMostStrandWidth);
  }
  if (!shown.bodies) each.solids.clear();
  for (std::size_t k = 0; k < count; ++k) {
    auto pane = HairPane::create(device, groom, each);
    if (!pane) return pane.error();
    panes_.push_back(std::make_unique<HairPane>(std::move(*pane)));
  }
  return attach(device, session);
}

Status PaneRow::attach(gpu::Device& device, const Session& session) {
  cutCount_ = session.cutCount();
  const std::vector<std::uint32_t> cutBeyond = session.cutBeyond();
  for (std::size_t k = 0; k < panes_.size() && k < session.hairs().size(); ++k) {
    Status attached = panes_[k]->attach(device, session.hairs()[k].simulation(), cutBeyond);
    if (!attached) return attached;
  }
  return {};
}

Status PaneRow::setFrame(const Camera& camera, const HeadPose& head, std::span<const SolidPlace> solids,
                         const HairSurroundings& about) {
  for (auto& pane : panes_) {
    if (Status set = pane->setFrame(camera, head, solids, about); !set) return set;
  }
  return {};
}

void PaneRow::record(gpu::CommandList& list, Quatd head) const {
  for (const auto& pane : panes_) pane->record(list, head);
}

void PaneRow::finish() {
  for (auto& pane : panes_) pane->finish();
}

std::vector<PlacedPicture> PaneRow::pictures() const {
  std::vector<PlacedPicture> pictures;
  for (const auto& pane : panes_) {
    const int width = pane->size().width;
    pictures.push_back(
        {&pane->shown(), static_cast<int>(pictures.size()) * width, width, pane->size().height});
  }
  return pictures;
}

}  // namespace ringlet::view
