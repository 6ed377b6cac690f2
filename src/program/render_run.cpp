// Implements render_run.h.
#include "program/render_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <utility>

#include "program/follow_plan.h"
#include "program/interruption.h"
#include "program/picture_solids.h"
#include "program/progress_bar.h"
#include "ringlet/follow/follow_stage.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/measure/head_fit.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/picture.h"
#include "ringlet/render/strand_points.h"

namespace ringlet::program {
namespace {

constexpr std::size_t kFewestGuides = 100, kMostGuides = 10000;  // of a head of hair
constexpr int kUsualHairs = 30000;                               // of a head
constexpr int kLockHairs = 300;                                  // of a strand among few
constexpr double kLockRadius = 0.0025;                           // likewise, at the root [m]
constexpr std::size_t kLockPoints = 2000000;                     // at most, of all locks
constexpr double kShutter = 0.5;                                 // share of a frame that is seen in it
constexpr double kTravels = 2;  // hair that needs so much more room than a frame of it: the camera goes along
constexpr double kFollowMargin = 0.02;  // of hairs beside the strands they follow [m]

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double cpuNow() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }  // of all threads

Bounds emptyBounds() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
}
void include(Bounds& bounds, Vec3d p) {
  bounds.low = {std::min(bounds.low.x, p.x), std::min(bounds.low.y, p.y), std::min(bounds.low.z, p.z)};
  bounds.high = {std::max(bounds.high.x, p.x), std::max(bounds.high.y, p.y), std::max(bounds.high.z, p.z)};
}
double radiusOf(const Bounds& bounds) { return length(bounds.high - bounds.low) / 2; }

// What is shown unasked. No hairs: the strands themselves.
struct UsualHairs {
  FollowOptions options;
  double width;  // at the root [m]
};
UsualHairs usualHairs(std::size_t strands, std::size_t particles) {
  if (strands >= kMostGuides) return {{.hairCount = 0}, widthOfHairs(static_cast<double>(strands))};
  if (strands >= kFewestGuides) return {{.hairCount = kUsualHairs}, widthOfHairs(kUsualHairs)};
  const auto ofEach = static_cast<int>(std::clamp<std::size_t>(kLockPoints / particles, 1, kLockHairs));
  return {{.hairCount = ofEach * static_cast<int>(strands), .reach = kLockRadius}, widthOfHairs(kUsualHairs)};
}

// A frame of the strands, in their file's unit.
using Points = std::vector<Vec3f>;

class Rendering {
 public:
  Rendering(const Groom& strands, double metresPerUnit, UpAxis up, const ComputeDevice& device,
            const RenderPlan& plan)
      : strands_(strands),
        metresPerUnit_(metresPerUnit),
        up_(up == UpAxis::z ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0}),
        device_(device),
        plan_(plan) {}

  /// `first`: frame 1, which hairs follow as if it were at rest, unless the plan has the strands at rest.
  Status prepare(const Groom& first);
  Status drawFrame(int frame, const Points& before, const Points& points);
  /// Of each frame that the camera must show, before prepare.
  void see(const Groom& pose);
  RenderOutcome finish();

 private:
  Status makeHair(const Groom& rest);
  Status makeSolids(const Groom& rest);
  Status drawMoment(int frame, double share, const Points& before, const Points& points, bool isFirst);
  Status write(int frame, std::span<const std::uint32_t> pixels);
  Camera cameraOf(double frame, const Bounds& here) const;
  Bounds boundsOf(const Points& points) const;
  std::vector<Vec3d> rootsOf(const Points& points) const;

  const Groom& strands_;
  double metresPerUnit_;
  Vec3d up_;
  const ComputeDevice& device_;
  const RenderPlan& plan_;
  std::optional<FollowPlan> follow_;
  std::optional<FollowStage> hairs_;
  std::optional<StrandPoints> lines_;
  std::optional<PictureSolids> solids_;
  std::optional<HairRenderer> renderer_;
  std::optional<gpu::Recorder> recorder_;  // the last to be made, the first to end
  std::vector<Vec3d> restRoots_;
  Bounds all_ = emptyBounds();  // of every frame
  Outline outline_;             // likewise
  double largest_ = 0;          // radius of a frame's
  RenderOutcome outcome_;
  double seconds_ = 0, cpuSeconds_ = 0;
  int measured_ = 0;
};

Bounds Rendering::boundsOf(const Points& points) const {
  Bounds bounds = emptyBounds();
  for (const Vec3f& p : points) include(bounds, Vec3d(p) * metresPerUnit_);
  const Vec3d margin = Vec3d{1, 1, 1} * (follow_ ? kFollowMargin : 0.001);
  return {bounds.low - margin, bounds.high + margin};
}

std::vector<Vec3d> Rendering::rootsOf(const Points& points) const {
  std::vector<Vec3d> roots;
  for (std::size_t s = 0; s < strands_.strandCount(); ++s)
    roots.push_back(Vec3d(points[strands_.firstPoint[s]]) * metresPerUnit_);
  return roots;
}

void Rendering::see(const Groom& pose) {
  const Bounds here = boundsOf(pose.points);
  include(all_, here.low);
  include(all_, here.high);
  for (const Vec3f& p : pose.points) outline_.add(Vec3d(p) * metresPerUnit_);
  largest_ = std::max(largest_, radiusOf(here));
}

Status Rendering::makeHair(const Groom& rest) {
  const UsualHairs usual = usualHairs(strands_.strandCount(), strands_.firstPoint.back());
  const FollowOptions options = plan_.hairs ? FollowOptions{.hairCount = *plan_.hairs} : usual.options;
  outcome_.strandCount = strands_.strandCount();
  outcome_.hairCount =
      options.hairCount > 0 ? static_cast<std::size_t>(options.hairCount) : strands_.strandCount();
  outcome_.width =
      plan_.width.value_or(plan_.hairs ? widthOfHairs(static_cast<double>(outcome_.hairCount)) : usual.width);
  if (options.hairCount == 0) {
    auto lines = StrandPoints::create(device_.gpu(), strands_.firstPoint);
    if (!lines) return lines.error();
    lines_.emplace(std::move(*lines));
    outcome_.pointCount = strands_.firstPoint.back();
    return {};
  }
  auto follow = FollowPlan::make(rest, metresPerUnit_, options);
  if (!follow) return follow.error();
  follow_.emplace(std::move(*follow));
  auto stage = FollowStage::create(device_.gpu(), follow_->guides(), follow_->hairs());
  if (!stage) return stage.error();
  hairs_.emplace(std::move(*stage));
  outcome_.pointCount = hairs_->pointCount();
  return {};
}

Status Rendering::makeSolids(const Groom& rest) {
  restRoots_ = rootsOf(rest.points);
  if (!plan_.showsSolids) return {};
  if (plan_.scene && !plan_.scene->bodies.empty()) {
    solids_ = PictureSolids::ofScene(*plan_.scene, 2 * largest_);
    return {};
  }
  solids_ = PictureSolids::ofRoots(restRoots_, up_);
  outcome_.showsHead = !solids_->meshes().empty();
  return {};
}

Status Rendering::prepare(const Groom& first) {
  if (Status made = makeHair(plan_.rest ? *plan_.rest : first); !made) return made;
  if (follow_) {
    if (Status belongs = follow_->checkPose(first); !belongs) return belongs;
  }
  if (Status made = makeSolids(follow_ && plan_.rest ? *plan_.rest : first); !made) return made;
  const DrawnHairs drawn{hairs_ ? hairs_->points() : lines_->points(),
                         hairs_ ? hairs_->firstPoint() : lines_->firstPoint(), outcome_.width};
  auto renderer = HairRenderer::create(
      device_.gpu(), drawn, solids_ ? solids_->meshes() : std::vector<SolidMesh>{}, plan_.size, plan_.look);
  if (!renderer) return renderer.error();
  renderer_.emplace(std::move(*renderer));
  auto recorder = gpu::Recorder::create(device_.gpu(), "picture");
  if (!recorder) return recorder.error();
  recorder_.emplace(std::move(*recorder));
  outcome_.deviceBytes = renderer_->byteCount() + (hairs_ ? hairs_->byteCount() : lines_->points().bytes());
  return {};
}

Camera Rendering::cameraOf(double frame, const Bounds& here) const {
  std::vector<Vec3d> shown = outline_.points();
  if (radiusOf(all_) > kTravels * largest_) {  // the camera goes along
    const Vec3d middle = (here.low + here.high) / 2.0, half = Vec3d{1, 1, 1} * (largest_ / std::sqrt(3.0));
    shown = {middle - half, middle + half};
  }
  CameraPlace place = plan_.camera;
  const int span = plan_.lastFrame - plan_.firstFrame;
  if (span > 0) place.azimuth += plan_.orbit * (frame - plan_.firstFrame) / span;
  return cameraAround(shown, up_, static_cast<double>(plan_.size.width) / plan_.size.height, place);
}

// `share`: of the way from the frame before.
Status Rendering::drawMoment(int frame, double share, const Points& before, const Points& points,
                             bool isFirst) {
  Points pose = points;
  if (share < 1)
    for (std::size_t i = 0; i < pose.size(); ++i)
      pose[i] = before[i] + (points[i] - before[i]) * static_cast<float>(share);
  const Quatd head = follow_ ? follow_->headOf(pose) : fitHeadRotation(restRoots_, rootsOf(pose));
  if (hairs_) {
    std::vector<Vec3d> metres;
    for (const Vec3f& p : pose) metres.push_back(Vec3d(p) * metresPerUnit_);
    if (Status set = hairs_->setPose(metres); !set) return set;
  } else if (Status set = lines_->setPose(pose, metresPerUnit_); !set) {
    return set;
  }
  const Bounds here = boundsOf(pose);
  const double at = frame - 1 + share;
  std::vector<SolidPlace> places;
  if (solids_) places = solids_->placesAt(at, rootsOf(pose), head);
  if (Status set = renderer_->setFrame(cameraOf(at, here), here, places); !set) return set;

  if (Status begun = recorder_->begin(); !begun) return begun;
  if (hairs_) {
    recorder_->beginStage("follow");
    hairs_->record(*recorder_, head);
    recorder_->endStage();
  }
  renderer_->record(*recorder_, isFirst);
  return recorder_->submitAndWait();
}

Status Rendering::drawFrame(int frame, const Points& before, const Points& points) {
  const double start = now(), cpuStart = cpuNow();
  std::map<std::string, double> stages;
  const int moments = before.empty() ? 1 : plan_.moments;
  for (int k = 0; k < moments; ++k) {
    const double share = moments == 1 ? 1 : 1 - kShutter * (k + 0.5) / moments;
    if (Status drawn = drawMoment(frame, share, before, points, k == 0); !drawn) return drawn;
    for (const auto& [stage, milliseconds] : recorder_->stageMilliseconds()) stages[stage] += milliseconds;
  }
  auto picture = renderer_->picture();
  if (!picture) return picture.error();
  // The first frame compiles kernels.
  if (outcome_.frameCount <= 1) seconds_ = cpuSeconds_ = measured_ = 0, outcome_.stages.clear();
  seconds_ += now() - start;
  cpuSeconds_ += cpuNow() - cpuStart;
  ++measured_;
  for (const auto& [stage, milliseconds] : stages) outcome_.stages[stage] += milliseconds;

  return write(frame, *picture);
}

Status Rendering::write(int frame, std::span<const std::uint32_t> pixels) {
  Picture image(plan_.size.width, plan_.size.height, {});
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    image.pixels[i] = {static_cast<std::uint8_t>(pixels[i]), static_cast<std::uint8_t>(pixels[i] >> 8),
                       static_cast<std::uint8_t>(pixels[i] >> 16)};
  }
  const bool isOne = plan_.output.extension() == ".png";
  const auto path = isOne ? plan_.output : plan_.output / fmt::format("frame.{:04}.png", frame);
  if (Status written = image.writePng(path); !written) return written;
  if (outcome_.outputs.size() > 1) outcome_.outputs.pop_back();
  outcome_.outputs.push_back(path);
  ++outcome_.frameCount;
  return {};
}

RenderOutcome Rendering::finish() {
  const double count = std::max(measured_, 1);
  outcome_.secondsPerFrame = seconds_ / count;
  outcome_.cpuSecondsPerFrame = cpuSeconds_ / count;
  for (auto& [stage, milliseconds] : outcome_.stages) milliseconds /= count;
  return std::move(outcome_);
}

Status makeFolder(const std::filesystem::path& output) {
  const std::filesystem::path folder = output.extension() == ".png" ? output.parent_path() : output;
  if (folder.empty()) return {};
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code)
    return Error{fmt::format("cannot make the folder {}: {}", folder.string(), code.message()),
                 Fault::output};
  return {};
}

}  // namespace

Result<RenderOutcome> renderAnimation(const std::filesystem::path& animation, const ComputeDevice& device,
                                      const RenderPlan& asked) {
  const double start = now();
  // Once for what the camera must show, and once for the pictures.
  auto seen = AnimationReader::open(animation), drawn = AnimationReader::open(animation);
  if (!seen) return seen.error();
  if (!drawn) return drawn.error();
  RenderPlan plan = asked;
  if (plan.lastFrame == 0) plan.lastFrame = seen->frameCount();
  if (plan.firstFrame > plan.lastFrame || plan.lastFrame > seen->frameCount())
    return Error{fmt::format("{} has {} frames; there is none of {} to {}", animation.string(),
                             seen->frameCount(), plan.firstFrame, plan.lastFrame)};
  if (Status made = makeFolder(plan.output); !made) return made.error();

  if (Status read = seen->readFrame(1); !read) return read.error();
  const Groom first = seen->groom();
  Rendering rendering(drawn->groom(), seen->header().metresPerUnit, seen->header().up, device, plan);
  for (int frame = plan.firstFrame; frame <= plan.lastFrame; ++frame) {
    if (frame > 1) {
      if (Status read = seen->readFrame(frame); !read) return read.error();
    }
    rendering.see(seen->groom());
  }
  if (Status ready = rendering.prepare(first); !ready) return ready.error();
  const double ready = now();

  Points before;
  const auto read = [&](int frame) { return drawn->readFrame(frame); };
  if (plan.moments > 1 && plan.firstFrame > 1) {
    if (Status done = read(plan.firstFrame - 1); !done) return done.error();
    before = drawn->groom().points;
  }
  const int count = plan.lastFrame - plan.firstFrame + 1;
  ProgressBar progress(0, count, plan.showProgress);
  int finished = 0;
  for (; finished < count && !wasInterrupted(); ++finished) {
    const int frame = plan.firstFrame + finished;
    if (Status done = read(frame); !done) return done.error();
    if (Status done = rendering.drawFrame(frame, before, drawn->groom().points); !done) return done.error();
    if (plan.moments > 1) before = drawn->groom().points;
    progress.show(finished + 1);
  }
  progress.clear();
  RenderOutcome outcome = rendering.finish();
  outcome.startSeconds = ready - start;
  outcome.interrupted = finished < count;
  outcome.warnings = seen->warnings();
  return outcome;
}

Result<RenderOutcome> renderGroom(const Groom& groom, UpAxis up, const ComputeDevice& device,
                                  const RenderPlan& plan) {
  const double start = now();
  if (Status made = makeFolder(plan.output); !made) return made.error();
  Rendering rendering(groom, groom.metresPerUnit, up, device, plan);
  rendering.see(groom);
  if (Status ready = rendering.prepare(groom); !ready) return ready.error();
  const double ready = now();
  if (Status drawn = rendering.drawFrame(1, {}, groom.points); !drawn) return drawn.error();
  RenderOutcome outcome = rendering.finish();
  outcome.startSeconds = ready - start;
  return outcome;
}

}  // namespace ringlet::program
