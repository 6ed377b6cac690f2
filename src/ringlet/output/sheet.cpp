// Implements output/sheet.h.
//
// Each panel is drawn kSuper times too large with a depth buffer and then averaged, which gives smooth lines
// whatever the order of strands. A strand is a tube: bright along its middle, dark at its edges, so that
// crossing strands part.
#include "ringlet/output/sheet.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "ringlet/base/bounds.h"
#include "ringlet/base/in_parallel.h"

namespace ringlet {
namespace {

constexpr int kSuper = 3;                 // samples per pixel, each way: nine shades of coverage
constexpr double kMargin = 0.07;          // share of a panel left free on each side
constexpr double kYaw = 35, kPitch = 12;  // where the camera stands: degrees to the side, degrees up
constexpr double kDistance = 5;  // of the camera, in sizes of what it sees: a long lens, little distortion
constexpr double kFollowBelow =
    0.5;  // the camera goes along if hair would else be drawn below this share of its size
constexpr double kFarLight = 0.38;   // brightness of the farthest strand, the nearest being 1
constexpr double kFullDepth = 0.6;   // depth, in sizes of the hair, over which it falls that far
constexpr float kExposure = 1.55f;   // so that the brightest strands are just below white
constexpr double kNearSolid = 0.25;  // in sizes of the hair: what of a solid is so near is in the picture
constexpr Colour kBackground{33, 36, 42}, kDivider{62, 66, 74}, kLabel{150, 156, 166};

// The camera's axes: where right, up and towards the viewer are in the groom's axes.
struct Axes {
  Vec3d right, up, back;
  Vec3d toCamera(Vec3d p) const { return {dot(right, p), dot(up, p), dot(back, p)}; }
};

Axes cameraAxes(UpAxis upAxis) {
  // Y up is seen from +Z, Z up from -Y; X points right in both.
  const Vec3d side{1, 0, 0};
  const Vec3d up = upAxis == UpAxis::y ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
  const Vec3d front = cross(side, up);
  const double yaw = kYaw * std::numbers::pi / 180, pitch = kPitch * std::numbers::pi / 180;
  const Vec3d level = front * std::cos(yaw) + side * std::sin(yaw);
  const Vec3d back = level * std::cos(pitch) + up * std::sin(pitch);
  const Vec3d right = cross(up, level);
  return {right, cross(back, right), back};
}

double sizeOf(const Bounds& box) {
  const Vec3d size = box.high - box.low;
  return std::max({size.x, size.y, size.z, 1e-12});
}

// A box of camera coordinates drawn into a panel: pixel = middle + scale (p - centre) / (1 - depth /
// distance).
struct View {
  double width = 0, height = 0;  // of the panel [sample]
  Vec3d centre;
  double distance = 1, scale = 1;

  Vec3d project(Vec3d camera) const {
    Vec3d p = camera - centre;
    double nearness = 1 / std::max(0.1, 1 - p.z / distance);
    return {0.5 * width + scale * p.x * nearness, 0.5 * height - scale * p.y * nearness, p.z};
  }
};

// The view in which all of the points, given in camera coordinates, fill a panel of the grid.
View fit(std::span<const std::vector<Vec3d>> frames, const PanelGrid& grid) {
  Bounds box = Bounds::none();
  for (const auto& points : frames) {
    for (Vec3d p : points) box.add(p);
  }
  View view{static_cast<double>(grid.width) * kSuper, static_cast<double>(grid.height - grid.footer) * kSuper,
            box.middle(), kDistance * sizeOf(box), std::numeric_limits<double>::infinity()};
  const double halfWidth = (0.5 - kMargin) * view.width, halfHeight = (0.5 - kMargin) * view.height;
  for (const auto& points : frames) {
    for (Vec3d q : points) {
      Vec3d p = q - view.centre;
      double nearness = 1 / std::max(0.1, 1 - p.z / view.distance);
      view.scale = std::min({view.scale, halfWidth / std::max(1e-12, std::abs(p.x) * nearness),
                             halfHeight / std::max(1e-12, std::abs(p.y) * nearness)});
    }
  }
  return view;
}

struct Shade {
  float red = 0, green = 0, blue = 0;  // 0..1
  Shade operator*(float s) const { return {red * s, green * s, blue * s}; }
  Shade operator+(Shade o) const { return {red + o.red, green + o.green, blue + o.blue}; }
};

// A strand's own colour, from copper to straw, so that neighbours can be told apart.
Shade strandColour(std::size_t strand) {
  // A hash (the finaliser of splitmix64), because strands often come in an order that any regular sequence
  // would show.
  std::uint64_t mixed = (static_cast<std::uint64_t>(strand) + 1) * 0x9e3779b97f4a7c15;
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111eb;
  const float hue = static_cast<float>(mixed >> 40) / 0x1p24f;
  const float value = static_cast<float>((mixed >> 16) & 0xffffff) / 0x1p24f;
  const Shade copper{0.90f, 0.44f, 0.21f}, straw{0.97f, 0.76f, 0.45f};
  return (copper * (1 - hue) + straw * hue) * (0.72f + 0.28f * value);
}

// Light on a thin fibre (Kajiya and Kay 1989): it depends on the tangent only. Light comes from above left,
// behind the viewer.
Shade fibreLight(Shade colour, Vec3d tangent) {
  const Vec3d light = normalizedOr(Vec3d{-0.45, 0.75, 0.5}, {});
  const Vec3d halfway = normalizedOr(light + Vec3d{0, 0, 1}, {});
  const double alongLight = dot(tangent, light), alongHalf = dot(tangent, halfway);
  const double diffuse = std::sqrt(std::max(0.0, 1 - alongLight * alongLight));
  const double gloss = std::pow(std::max(0.0, 1 - alongHalf * alongHalf), 24);
  return colour * static_cast<float>(0.30 + 0.62 * diffuse) +
         Shade{1, 0.93f, 0.82f} * static_cast<float>(0.22 * gloss);
}

// Light on skin, from where it falls on fibres; dull, so that hair stands out before it.
Shade skinLight(Vec3d normal) {
  const Vec3d light = normalizedOr(Vec3d{-0.45, 0.75, 0.5}, {});
  const double diffuse = 0.5 + 0.5 * dot(normal, light);
  return Shade{0.40f, 0.42f, 0.46f} * static_cast<float>(0.25 + 0.75 * diffuse * diffuse);
}

// One panel at kSuper times its size.
class Canvas {
 public:
  Canvas(int width, int height)
      : width_(width * kSuper),
        height_(height * kSuper),
        depth_(static_cast<std::size_t>(width_) * height_),
        shade_(depth_.size()) {}

  void clear() { std::fill(depth_.begin(), depth_.end(), -std::numeric_limits<float>::infinity()); }

  struct End {
    Vec3d at;  // x, y [sample], z depth, larger is nearer
    Shade shade;
  };

  // A tube of the given radius [sample] from a to b, walked along its longer side.
  void drawEdge(End a, End b, double radius) {
    const bool steep = std::abs(b.at.y - a.at.y) > std::abs(b.at.x - a.at.x);
    auto major = [steep](Vec3d p) { return steep ? p.y : p.x; };
    auto minor = [steep](Vec3d p) { return steep ? p.x : p.y; };
    if (major(a.at) > major(b.at)) std::swap(a, b);
    const double runMajor = major(b.at) - major(a.at), runMinor = minor(b.at) - minor(a.at);
    const double squaredLength = runMajor * runMajor + runMinor * runMinor;
    const double slope = runMajor > 0 ? runMinor / runMajor : 0;
    const double reach = radius * std::sqrt(1 + slope * slope);
    const int majorEnd = steep ? height_ : width_, minorEnd = steep ? width_ : height_;
    const std::size_t majorStride = steep ? width_ : 1, minorStride = steep ? 1 : width_;
    const auto fMajor = static_cast<float>(runMajor), fMinor = static_cast<float>(runMinor);
    const auto perMajor = static_cast<float>(squaredLength > 0 ? runMajor / squaredLength : 0);
    const auto perMinor = static_cast<float>(squaredLength > 0 ? runMinor / squaredLength : 0);
    const auto perSquaredRadius = static_cast<float>(1 / (radius * radius)),
               minorStart = static_cast<float>(0.5 - minor(a.at));
    const auto aDepth = static_cast<float>(a.at.z), runDepth = static_cast<float>(b.at.z - a.at.z);

    const int first = clampedCeil(major(a.at) - radius - 0.5, majorEnd),
              last = clampedFloor(major(b.at) + radius - 0.5, majorEnd);
    for (int i = first; i <= last; ++i) {
      const double middle =
          minor(a.at) + slope * (std::clamp(i + 0.5, major(a.at), major(b.at)) - major(a.at));
      const int low = clampedCeil(middle - reach - 0.5, minorEnd),
                high = clampedFloor(middle + reach - 0.5, minorEnd);
      // The nearest place t on the edge to each sample of this row or column, and how far it is; in float,
      // this is the hot loop.
      const auto pMajor = static_cast<float>(i + 0.5 - major(a.at));
      for (int j = low; j <= high; ++j) {
        const float pMinor = static_cast<float>(j) + minorStart;
        const float t = std::clamp(pMajor * perMajor + pMinor * perMinor, 0.0f, 1.0f);
        const float depth = aDepth + t * runDepth;
        float& held = depth_[i * majorStride + j * minorStride];
        if (depth <= held) continue;
        const float dMajor = pMajor - t * fMajor, dMinor = pMinor - t * fMinor;
        const float off = (dMajor * dMajor + dMinor * dMinor) * perSquaredRadius;
        if (off > 1) continue;
        held = depth;
        shade_[i * majorStride + j * minorStride] = (a.shade * (1 - t) + b.shade * t) * (1 - 0.55f * off);
      }
    }
  }

  // A triangle seen from outside, x right and y down; others are left out.
  void drawTriangle(const End& a, const End& b, const End& c) {
    const double area = (b.at.x - a.at.x) * (c.at.y - a.at.y) - (b.at.y - a.at.y) * (c.at.x - a.at.x);
    if (!(area < 0)) return;
    const int left = clampedCeil(std::min({a.at.x, b.at.x, c.at.x}) - 0.5, width_),
              right = clampedFloor(std::max({a.at.x, b.at.x, c.at.x}) - 0.5, width_),
              top = clampedCeil(std::min({a.at.y, b.at.y, c.at.y}) - 0.5, height_),
              bottom = clampedFloor(std::max({a.at.y, b.at.y, c.at.y}) - 0.5, height_);
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const double px = x + 0.5 - a.at.x, py = y + 0.5 - a.at.y;
        const double v = (px * (c.at.y - a.at.y) - py * (c.at.x - a.at.x)) / area;
        const double w = (py * (b.at.x - a.at.x) - px * (b.at.y - a.at.y)) / area;
        if (v < 0 || w < 0 || v + w > 1) continue;
        const auto depth = static_cast<float>(a.at.z * (1 - v - w) + b.at.z * v + c.at.z * w);
        const std::size_t sample = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
        if (depth <= depth_[sample]) continue;
        depth_[sample] = depth;
        shade_[sample] = a.shade * static_cast<float>(1 - v - w) + b.shade * static_cast<float>(v) +
                         c.shade * static_cast<float>(w);
      }
    }
  }

  // Averages the samples of every pixel into the picture, its top left corner at (left, top).
  void copyTo(Picture& picture, int left, int top) const {
    for (int y = 0; y < height_ / kSuper; ++y) {
      for (int x = 0; x < width_ / kSuper; ++x) {
        Shade sum;
        int covered = 0;
        for (int dy = 0; dy < kSuper; ++dy) {
          for (int dx = 0; dx < kSuper; ++dx) {
            const std::size_t sample = static_cast<std::size_t>(y * kSuper + dy) * width_ + (x * kSuper + dx);
            if (depth_[sample] == -std::numeric_limits<float>::infinity()) continue;
            sum = sum + shade_[sample];
            ++covered;
          }
        }
        if (covered == 0) continue;
        const float open = static_cast<float>(kSuper * kSuper - covered);
        auto mix = [open](float lit, std::uint8_t behind) {
          float value = (255 * lit + open * static_cast<float>(behind)) / (kSuper * kSuper);
          return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f);
        };
        Colour& pixel = picture.at(left + x, top + y);
        pixel = {mix(sum.red, pixel.red), mix(sum.green, pixel.green), mix(sum.blue, pixel.blue)};
      }
    }
  }

 private:
  // Rounded to a sample and kept within [0, end), so that points far outside cost nothing and overflow
  // nothing.
  static int clampedCeil(double value, int end) {
    return static_cast<int>(std::ceil(std::clamp(value, 0.0, end + 1.0)));
  }
  static int clampedFloor(double value, int end) {
    return static_cast<int>(std::floor(std::clamp(value, -1.0, end - 1.0)));
  }

  int width_, height_;  // [sample]
  std::vector<float> depth_;
  std::vector<Shade> shade_;
};

// Panels as the camera sees them, and the view of each: one for all, or, where hair would else be tiny, each
// its own of the same scale.
struct PanelViews {
  std::vector<std::vector<Vec3d>> points;
  std::vector<View> views;
};

// Of a panel's solid: its points as the camera sees them.
std::vector<Vec3d> solidPoints(const Panel& panel, std::size_t s, const Axes& axes) {
  std::vector<Vec3d> points;
  const SheetPlace& place = panel.places[s];
  for (Vec3d p : panel.solids[s].points) {
    const Vec3d world = place.position + rotate(place.rotation, p);
    points.push_back(axes.toCamera(world / panel.metresPerUnit));
  }
  return points;
}

// The hair's points, and what of solids is in their box, grown by a share of its size.
std::vector<Vec3d> shownPoints(const Panel& panel, const std::vector<Vec3d>& hair, const Axes& axes) {
  std::vector<Vec3d> shown = hair;
  Bounds box = Bounds::none();
  for (Vec3d p : hair) box.add(p);
  const Vec3d room = Vec3d{1, 1, 1} * (kNearSolid * sizeOf(box));
  const Vec3d low = box.low - room, high = box.high + room;
  for (std::size_t s = 0; s < panel.solids.size(); ++s) {
    for (Vec3d p : solidPoints(panel, s, axes)) {
      const bool isNear =
          p.x > low.x && p.y > low.y && p.z > low.z && p.x < high.x && p.y < high.y && p.z < high.z;
      if (isNear) shown.push_back(p);
    }
  }
  return shown;
}

PanelViews viewsOf(std::span<const Panel> panels, const PanelGrid& grid) {
  PanelViews seen;
  std::vector<std::vector<Vec3d>> shown;
  const Axes axes = cameraAxes(grid.up);
  for (const Panel& panel : panels) {
    auto& points = seen.points.emplace_back();
    points.reserve(panel.points.size());
    for (Vec3f p : panel.points) points.push_back(axes.toCamera(Vec3d(p)));
    shown.push_back(shownPoints(panel, points, axes));
  }
  const View fixed = fit(shown, grid);
  double followScale = std::numeric_limits<double>::infinity(), followDistance = 0;
  for (const auto& points : shown) {
    seen.views.push_back(points.empty() ? fixed : fit(std::span(&points, 1), grid));
    if (points.empty()) continue;
    followScale = std::min(followScale, seen.views.back().scale);
    followDistance = std::max(followDistance, seen.views.back().distance);
  }
  const bool follow = fixed.scale < kFollowBelow * followScale;
  for (View& view : seen.views)
    view = follow ? View{fixed.width, fixed.height, view.centre, followDistance, followScale} : fixed;
  return seen;
}

// Few strands are drawn thicker than many; the exponent was chosen by eye over 1 to 10,000 strands.
double radiusOf(std::size_t strandCount) {
  return 0.5 * kSuper * std::clamp(3.4 * std::pow(static_cast<double>(strandCount), -0.14), 0.9, 3.0);
}

// Of each point: the mean of its triangles' normals, weighted by their areas.
std::vector<Vec3d> normalsOf(std::span<const Vec3d> points, const SheetSolid& solid) {
  std::vector<Vec3d> normals(points.size());
  for (const auto& [a, b, c] : solid.triangles) {
    const Vec3d area = cross(points[b] - points[a], points[c] - points[a]);
    for (const std::uint32_t p : {a, b, c}) normals[p] += area;
  }
  for (Vec3d& normal : normals) normal = normalizedOr(normal, {0, 1, 0});
  return normals;
}

void drawSolids(const Panel& panel, const View& view, const Axes& axes, Canvas& canvas) {
  // Behind by a strand's radius, so that hair that lies on a solid is before it.
  const double behind = radiusOf(panel.firstPoint.size() - 1) / view.scale;
  for (std::size_t s = 0; s < panel.solids.size(); ++s) {
    const std::vector<Vec3d> points = solidPoints(panel, s, axes);
    const std::vector<Vec3d> normals = normalsOf(points, panel.solids[s]);
    std::vector<Canvas::End> ends;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Vec3d at = view.project(points[p]);
      ends.push_back({{at.x, at.y, at.z - behind}, skinLight(normals[p])});
    }
    for (const auto& [a, b, c] : panel.solids[s].triangles) canvas.drawTriangle(ends[a], ends[b], ends[c]);
  }
}

void drawStrands(const Panel& panel, std::span<const Vec3d> points, const View& view, Canvas& canvas) {
  const auto firstPoint = panel.firstPoint;
  Bounds box = Bounds::none();
  for (Vec3d p : points) box.add(p - view.centre);
  const double depth = std::max(box.high.z - box.low.z, kFullDepth * sizeOf(box));
  const double radius = radiusOf(firstPoint.size() - 1);
  for (std::size_t strand = 0; strand + 1 < firstPoint.size(); ++strand) {
    const Shade colour = strandColour(strand);
    const std::size_t root = firstPoint[strand], end = firstPoint[strand + 1];
    std::optional<Canvas::End> before;
    for (std::size_t i = root; i < end; ++i) {
      // Dark at the root, light at the tip; darker when farther away.
      const bool goesOn =
          i + 1 < end && !std::ranges::binary_search(panel.cutBeyond, static_cast<std::uint32_t>(i));
      const Vec3d tangent = normalizedOr(points[goesOn ? i + 1 : i] - points[before ? i - 1 : i], {0, 1, 0});
      const double alongStrand =
          static_cast<double>(i - root) / static_cast<double>(std::max<std::size_t>(end - root - 1, 1));
      const Vec3d at = view.project(points[i]);
      const double depthLight = 1 - (1 - kFarLight) * (box.high.z - at.z) / depth;
      const auto light = static_cast<float>((0.6 + 0.4 * alongStrand) * depthLight);
      const Canvas::End now{at, fibreLight(colour, tangent) * (kExposure * light)};
      if (before) canvas.drawEdge(*before, now, radius);
      before = goesOn ? std::optional(now) : std::nullopt;
    }
  }
}

void drawLabels(Picture& picture, const Panel& panel, int left, int bottom, int dot) {
  const int margin = 14 * dot / 3, line = 10 * dot;
  int top = bottom - margin + 3 * dot - line * static_cast<int>(panel.labels.size());
  for (const std::string& label : panel.labels) {
    picture.drawText(label, left + margin, top, dot, kLabel);
    top += line;
  }
}

// A thin line between panels.
void drawDividers(Picture& picture, const PanelGrid& grid) {
  for (int column = 1; column < grid.columns; ++column) {
    for (int y = 0; y < picture.height; ++y) picture.at(column * grid.width, y) = kDivider;
  }
  for (int row = 1; row < grid.rows; ++row) {
    for (int x = 0; x < picture.width; ++x) picture.at(x, row * grid.height) = kDivider;
  }
}

}  // namespace

Picture drawPanels(std::span<const Panel> panels, const PanelGrid& grid) {
  RINGLET_ASSERT(panels.size() <= static_cast<std::size_t>(grid.columns) * grid.rows,
                 "a place for each panel");
  RINGLET_ASSERT(std::ranges::any_of(panels, [](const Panel& panel) { return !panel.points.empty(); }),
                 "there is something to draw");
  Picture picture(grid.columns * grid.width, grid.rows * grid.height, kBackground);
  const PanelViews seen = viewsOf(panels, grid);

  // Panels are parts of the picture of their own, so each processor can draw one at a time.
  std::atomic<std::size_t> nextPanel = 0;
  auto drawSome = [&] {
    Canvas canvas(grid.width, grid.height);
    for (std::size_t i; (i = nextPanel++) < panels.size();) {
      const int left = static_cast<int>(i) % grid.columns * grid.width,
                top = static_cast<int>(i) / grid.columns * grid.height;
      if (!panels[i].points.empty()) {
        canvas.clear();
        drawSolids(panels[i], seen.views[i], cameraAxes(grid.up), canvas);
        drawStrands(panels[i], seen.points[i], seen.views[i], canvas);
        canvas.copyTo(picture, left, top);
      }
      drawLabels(picture, panels[i], left, top + grid.height, grid.labelDot);
    }
  };
  const unsigned processors = std::max(1u, std::thread::hardware_concurrency());
  inParallel(std::min(processors, static_cast<unsigned>(panels.size())), drawSome);
  drawDividers(picture, grid);
  return picture;
}

std::vector<int> sheetFrames(int frameCount) {
  std::vector<int> frames;
  for (int i = 0; i < kSheetPanels; ++i) {
    // Rounded in 64 bits: 1 + i (n - 1) / 5.
    const auto frame =
        static_cast<int>(1 + (2LL * i * (frameCount - 1) + kSheetPanels - 1) / (2 * (kSheetPanels - 1)));
    if (frames.empty() || frame > frames.back()) frames.push_back(frame);
  }
  return frames;
}

Sheet::Sheet(const Groom& topology, int frameCount, UpAxis up, std::vector<SheetSolid> solids)
    : firstPoint_(topology.firstPoint),
      metresPerUnit_(topology.metresPerUnit),
      solids_(std::move(solids)),
      wanted_(sheetFrames(frameCount)),
      up_(up) {
  RINGLET_ASSERT(frameCount >= 1, "a run has at least one frame");
}

void Sheet::offer(int frame, std::span<const Vec3f> points, std::span<const SheetPlace> places,
                  std::span<const std::uint32_t> cutBeyond) {
  RINGLET_ASSERT(places.size() == solids_.size(), "every solid has a place");
  RINGLET_ASSERT(points.size() == firstPoint_.back(), "one point per particle of the groom");
  // The latest frame makes way for the next unless it is one of those chosen.
  auto wanted = [this](int number) {
    return std::find(wanted_.begin(), wanted_.end(), number) != wanted_.end();
  };
  if (frames_.empty() || wanted(frames_.back().number)) frames_.emplace_back();
  frames_.back().number = frame;
  frames_.back().points.assign(points.begin(), points.end());
  frames_.back().places.assign(places.begin(), places.end());
  frames_.back().cutBeyond.assign(cutBeyond.begin(), cutBeyond.end());
}

void Sheet::archive(Archive& archive) {
  std::uint64_t count = frames_.size();
  archive.value(count);
  if (archive.isReading()) frames_.assign(std::min<std::uint64_t>(count, kSheetPanels + 1), {});
  for (Frame& frame : frames_) {
    archive.value(frame.number);
    archive.list(frame.points);
    archive.list(frame.places);
    archive.list(frame.cutBeyond);
  }
}

Picture Sheet::draw() const {
  RINGLET_ASSERT(!frames_.empty(), "a sheet shows at least one frame");
  std::vector<Panel> panels;
  for (const Frame& frame : frames_)
    panels.push_back({firstPoint_,
                      frame.points,
                      {std::to_string(frame.number)},
                      solids_,
                      frame.places,
                      metresPerUnit_,
                      frame.cutBeyond});
  return drawPanels(panels, {.up = up_});
}

}  // namespace ringlet
