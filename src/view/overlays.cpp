// Implements view/overlays.h.
#include "view/overlays.h"
#include "ringlet/solver/diagnostics.h"

#include <imgui.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace ringlet::view {
namespace {

constexpr double kHeadAxis = 0.06, kStrandAxis = 0.012;  // [m]
constexpr std::size_t kMostContacts = 20000, kMostStrands = 400;

class Lines {
 public:
  Lines(const OrbitCamera& camera, const OverlayPicture& picture) : camera_(camera), picture_(picture) {
    list_->PushClipRect(
        {static_cast<float>(picture.left), 0},
        {static_cast<float>(picture.left + picture.width), static_cast<float>(picture.height)});
  }
  ~Lines() { list_->PopClipRect(); }
  Lines(const Lines&) = delete;

  void line(Vec3d from, Vec3d to, ImU32 colour) const {
    const auto a = camera_.project(from, picture_.width, picture_.height);
    const auto b = camera_.project(to, picture_.width, picture_.height);
    if (a && b) list_->AddLine(at(*a), at(*b), colour, 1.5f);
  }
  void point(Vec3d place, ImU32 colour) const {
    const auto p = camera_.project(place, picture_.width, picture_.height);
    if (p) list_->AddRectFilled(at(*p - Vec3d{1, 1, 0}), at(*p + Vec3d{1, 1, 0}), colour);
  }
  void axes(Vec3d origin, Vec3d x, Vec3d y, Vec3d z) const {
    line(origin, origin + x, IM_COL32(255, 80, 80, 255));
    line(origin, origin + y, IM_COL32(80, 230, 80, 255));
    line(origin, origin + z, IM_COL32(110, 140, 255, 255));
  }
  void axes(Vec3d origin, Quatd turn, double size) const {
    axes(origin, rotate(turn, Vec3d{size, 0, 0}), rotate(turn, Vec3d{0, size, 0}),
         rotate(turn, Vec3d{0, 0, size}));
  }

 private:
  ImVec2 at(Vec3d pixel) const {
    return {static_cast<float>(pixel.x) + static_cast<float>(picture_.left), static_cast<float>(pixel.y)};
  }

  const OrbitCamera& camera_;
  const OverlayPicture& picture_;
  ImDrawList* list_ = ImGui::GetBackgroundDrawList();
};

// At the root of each strand: along it, towards its bend, and across both.
void drawStrandFrames(const Lines& lines, const Groom& groom, const std::vector<Vec3f>& positions,
                      Vec3d head) {
  const std::size_t every = (groom.strandCount() + kMostStrands - 1) / kMostStrands;
  for (std::size_t s = 0; s < groom.strandCount(); s += every) {
    const std::uint32_t first = groom.firstPoint[s];
    if (groom.firstPoint[s + 1] < first + 3) continue;
    const Vec3d a(positions[first]), b(positions[first + 1]), c(positions[first + 2]);
    const Vec3d along = normalizedOr(b - a, Vec3d{0, -1, 0});
    const Vec3d across = normalizedOr(cross(along, c - b), anyNormal(along));
    lines.axes(head + a, along * kStrandAxis, cross(across, along) * kStrandAxis, across * kStrandAxis);
  }
}

Status drawContacts(const Lines& lines, const Simulation& hair, const std::vector<Vec3f>& positions,
                    Vec3d head) {
  const auto listed = Diagnostics(hair).listedContacts();
  if (!listed) return listed.error();
  std::size_t count = 0;
  for (const ListedContact& contact : *listed) {
    if (contact.stiffnessShare <= 0 && contact.dampingShare <= 0) continue;
    if (++count > kMostContacts) break;
    const Vec3d middle = Vec3d(positions[contact.a] + positions[contact.b]) / 2.0;
    lines.point(head + middle, IM_COL32(255, 220, 60, 255));
  }
  return {};
}

}  // namespace

Status drawOverlays(const Shown& shown, const OrbitCamera& camera, const Session& session,
                    const Simulation& hair, const OverlayPicture& picture) {
  if (!shown.frames && !shown.contacts) return {};
  const auto positions = hair.positions();
  if (!positions) return positions.error();
  const Vec3d head = session.head().position;
  const Lines lines(camera, picture);
  if (shown.frames) {
    lines.axes(head, session.head().rotation, kHeadAxis);
    for (const BodyPose& body : session.bodies()) lines.axes(body.position, body.rotation, kHeadAxis);
    drawStrandFrames(lines, session.scene().groom, *positions, head);
  }
  return shown.contacts ? drawContacts(lines, hair, *positions, head) : Status{};
}

}  // namespace ringlet::view
