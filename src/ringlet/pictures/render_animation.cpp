// Implements render_animation.h.
#include "ringlet/pictures/render_animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <utility>

#include "ringlet/gpu/recorder.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/sheet.h"
#include "ringlet/pictures/picture_solids.h"
#include "ringlet/pictures/scene_bodies.h"

namespace ringlet {
namespace {

constexpr double kShutter = 0.5;         // exposure time as a share of a frame
constexpr double kFollowMargin = 0.02;   // of following hairs around their strands [m]
constexpr double kStrandMargin = 0.001;  // of strands [m]
constexpr double kGroundShare = 25;      // radius of the ground relative to the hair's

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double cpuNow() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }  // CPU time of all threads

// The strands' points in a frame, in their file's unit.
using Points = std::vector<Vec3f>;

// What is drawn, and its coordinates.
struct Subject {
  const Groom& strands;
  double metresPerUnit;
  Vec3d up;
  double framesPerSecond;
};

Vec3d directionOf(UpAxis up) { return up == UpAxis::z ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0}; }

class Rendering {
 public:
  Rendering(const Subject& subject, const ComputeDevice& device, const RenderPlan& plan)
      : subject_(subject),
        device_(device),
        plan_(plan),
        camera_(plan.camera, subject.up, static_cast<double>(plan.size.width) / plan.size.height,
                plan.scene ? &plan.scene->motion : nullptr, subject.framesPerSecond) {}

  /// `first`: frame 1, which hairs take as the rest pose, unless the plan has the strands at rest. After
  /// start, call see for every frame and then prepare.
  Status start(const Groom& first, const CutList& cuts = {});
  void see(const Points& points);
  Status prepare(PictureFiles& files);
  Status drawFrame(int frame, const Points& before, const Points& points);
  RenderOutcome finish();

 private:
  void makeSolids();
  double groundHeight() const;
  Status drawMoment(int frame, double share, const Points& before, const Points& points, bool isFirst);
  Bounds boxOf(const Points& points) const;

  const Subject subject_;
  const ComputeDevice& device_;
  const RenderPlan& plan_;
  PictureCamera camera_;
  Groom rest_;
  std::optional<PictureHair> hair_;
  PictureSolids solids_;
  std::optional<HairRenderer> renderer_;
  std::optional<StrandColours> colours_;
  std::optional<gpu::Recorder> recorder_;  // made last and destroyed first
  PictureFiles* files_ = nullptr;
  std::vector<Vec3d> lowestRoots_;                               // in the frame in which they are lowest
  double lowest_ = std::numeric_limits<double>::infinity();      // of hair, along the up axis [m]
  double lowestRoot_ = std::numeric_limits<double>::infinity();  // of roots, on average
  RenderOutcome outcome_;
  double seconds_ = 0, cpuSeconds_ = 0;
  int measured_ = 0;
};

Bounds Rendering::boxOf(const Points& points) const {
  return boundsOf(points, subject_.metresPerUnit, hair_->follows() ? kFollowMargin : kStrandMargin);
}

Status Rendering::start(const Groom& first, const CutList& cuts) {
  rest_ = plan_.rest ? *plan_.rest : first;
  const auto ground = plan_.scene ? hairGroundOf(*plan_.scene, plan_.hair.look)
                                  : hairGroundOf(plan_.hair.look, subject_.metresPerUnit);
  if (!ground) return ground.error();
  const std::vector<Body> bodies = plan_.scene ? plan_.scene->bodies : std::vector<Body>();
  auto hair = PictureHair::create(device_, rest_, first, subject_.metresPerUnit, plan_.hair,
                                  {.bodies = bodies, .ground = *ground, .cuts = cuts});
  if (!hair) return hair.error();
  hair_.emplace(std::move(*hair));
  return {};
}

void Rendering::see(const Points& points) {
  camera_.see(points, subject_.metresPerUnit, boxOf(points));
  if (!plan_.ground) return;
  for (const Vec3f& p : points)
    lowest_ = std::min(lowest_, dot(Vec3d(p), subject_.up) * subject_.metresPerUnit);
  std::vector<Vec3d> roots = hair_->rootsOf(points);
  double height = 0;
  for (const Vec3d& root : roots) height += dot(root, subject_.up) / static_cast<double>(roots.size());
  if (height < lowestRoot_) lowestRoot_ = height, lowestRoots_ = std::move(roots);
}

void Rendering::makeSolids() {
  if (plan_.showsSolids && plan_.scene && !plan_.scene->bodies.empty()) {
    solids_ = PictureSolids::ofScene(*plan_.scene, 2 * camera_.largestRadius());
  } else if (plan_.showsSolids) {
    solids_ = PictureSolids::ofRoots(hair_->restRoots(), subject_.up);
    outcome_.showsHead = !solids_.meshes().empty();
  }
  if (!plan_.ground) return;
  const Bounds& all = camera_.all();
  outcome_.groundHeight = plan_.ground->height ? *plan_.ground->height : groundHeight();
  solids_.addGround(*outcome_.groundHeight,
                    kGroundShare * camera_.largestRadius() + length(all.high - all.low),
                    (all.low + all.high) / 2.0, subject_.up);
}

double Rendering::groundHeight() const {
  double low = lowest_;
  for (int frame = plan_.firstFrame; frame <= std::max(plan_.firstFrame, plan_.lastFrame); ++frame)
    low = std::min(low, solids_.lowest(solids_.placesAt(frame, lowestRoots_, Quatd{}), subject_.up));
  return low;
}

Status Rendering::prepare(PictureFiles& files) {
  files_ = &files;
  makeSolids();
  outcome_.strandCount = hair_->strandCount();
  outcome_.hairCount = hair_->hairCount();
  outcome_.pointCount = hair_->firstPoint().back();
  outcome_.width = hair_->width();
  Look look = plan_.look;
  if (plan_.colours) look.pigments = StrandColours::pigmentsOf(*plan_.colours->scale);
  std::vector<float> widths;
  if (plan_.scene && plan_.scene->widthFactors.size() == hair_->strandCount()) {
    for (const std::uint32_t strand : hair_->strandOf()) widths.push_back(plan_.scene->widthFactors[strand]);
  }
  auto renderer =
      HairRenderer::create(device_.gpu(), {hair_->points(), hair_->firstPoint(), hair_->width(), widths},
                           solids_.meshes(), plan_.size, look);
  if (!renderer) return renderer.error();
  renderer_.emplace(std::move(*renderer));
  if (plan_.colours) {
    auto colours = StrandColours::create(
        *plan_.colours, device_,
        {.rest = rest_, .metresPerUnit = subject_.metresPerUnit, .scene = plan_.scene}, *hair_, *renderer_);
    if (!colours) return colours.error();
    colours_.emplace(std::move(*colours));
  }
  auto recorder = gpu::Recorder::create(device_.gpu(), "picture");
  if (!recorder) return recorder.error();
  recorder_.emplace(std::move(*recorder));
  outcome_.deviceBytes = renderer_->byteCount() + hair_->byteCount();
  return {};
}

// `share`: of the way from the frame before to this one.
Status Rendering::drawMoment(int frame, double share, const Points& before, const Points& points,
                             bool isFirst) {
  Points pose = points;
  if (share < 1)
    for (std::size_t i = 0; i < pose.size(); ++i)
      pose[i] = before[i] + (points[i] - before[i]) * static_cast<float>(share);
  const double at = frame - 1 + share;
  const FollowScene about = plan_.scene ? followSceneAtFrame(*plan_.scene, *hair_, at) : FollowScene{};
  if (Status set = hair_->setPose(about.pose(pose), frame); !set) return set;
  const Quatd head = hair_->headOf(pose);
  const Bounds here = boxOf(pose);
  const int span = plan_.lastFrame - plan_.firstFrame;
  const Camera camera = camera_.at(at, span > 0 ? (at - plan_.firstFrame) / span : 0, here);
  if (Status set = renderer_->setFrame(camera, here, solids_.placesAt(at, hair_->rootsOf(pose), head)); !set)
    return set;

  if (Status begun = recorder_->begin(); !begun) return begun;
  hair_->record(*recorder_, head);
  if (colours_) colours_->record(*recorder_);
  renderer_->record(*recorder_, isFirst);
  return recorder_->submitAndWait();
}

Status Rendering::drawFrame(int frame, const Points& before, const Points& points) {
  const double start = now(), cpuStart = cpuNow();
  std::map<std::string, double> stages;
  if (colours_) {
    if (Status set = colours_->setFrame(*renderer_, frame, points); !set) return set;
  }
  const int moments = before.empty() ? 1 : plan_.moments;
  for (int k = 0; k < moments; ++k) {
    const double share = moments == 1 ? 1 : 1 - kShutter * (k + 0.5) / moments;
    if (Status drawn = drawMoment(frame, share, before, points, k == 0); !drawn) return drawn;
    for (const auto& [stage, milliseconds] : recorder_->stageMilliseconds()) stages[stage] += milliseconds;
  }
  // The first frame is not counted, since it compiles kernels.
  if (files_->count() <= 1) seconds_ = cpuSeconds_ = measured_ = 0, outcome_.stages.clear();
  seconds_ += now() - start;
  cpuSeconds_ += cpuNow() - cpuStart;
  ++measured_;
  for (const auto& [stage, milliseconds] : stages) outcome_.stages[stage] += milliseconds;
  return files_->write(frame, *renderer_);
}

RenderOutcome Rendering::finish() {
  const double count = std::max(measured_, 1);
  outcome_.secondsPerFrame = seconds_ / count;
  outcome_.cpuSecondsPerFrame = cpuSeconds_ / count;
  for (auto& [stage, milliseconds] : outcome_.stages) milliseconds /= count;
  outcome_.frameCount = files_->count();
  outcome_.outputs = files_->outputs();
  return std::move(outcome_);
}

std::vector<int> framesOf(const RenderPlan& plan) {
  const int count = plan.lastFrame - plan.firstFrame + 1;
  std::vector<int> frames;
  if (plan.isSheet) {
    for (const int frame : sheetFrames(count)) frames.push_back(plan.firstFrame + frame - 1);
  } else {
    for (int frame = plan.firstFrame; frame <= plan.lastFrame; ++frame) frames.push_back(frame);
  }
  return frames;
}

}  // namespace

Result<RenderOutcome> renderAnimation(const std::filesystem::path& animation, const ComputeDevice& device,
                                      const RenderPlan& asked) {
  const double start = now();
  // Read once to find what the camera must show, and once for the pictures.
  auto seen = AnimationReader::open(animation), drawn = AnimationReader::open(animation);
  if (!seen) return seen.error();
  if (!drawn) return drawn.error();
  RenderPlan plan = asked;
  if (plan.lastFrame == 0) plan.lastFrame = seen->frameCount();
  if (plan.firstFrame > plan.lastFrame || plan.lastFrame > seen->frameCount())
    return Error{fmt::format("{} has {} frames; there is none of {} to {}", animation.string(),
                             seen->frameCount(), plan.firstFrame, plan.lastFrame)};
  const CacheHeader& header = seen->header();
  plan.target.framesPerSecond = header.framesPerSecond;

  if (Status read = seen->readFrame(1); !read) return read.error();
  Rendering rendering({drawn->groom(), header.metresPerUnit, directionOf(header.up), header.framesPerSecond},
                      device, plan);
  const auto cuts = CutList::beside(animation);
  if (!cuts) return cuts.error();
  if (Status started = rendering.start(seen->groom(), *cuts); !started) return started.error();
  const std::vector<int> frames = framesOf(plan);
  if (plan.isSheet) plan.target.panels = static_cast<int>(frames.size());
  for (const int frame : frames) {
    if (frame > 1) {
      if (Status read = seen->readFrame(frame); !read) return read.error();
    }
    rendering.see(seen->groom().points);
  }
  auto files = PictureFiles::open(plan.target, plan.size);
  if (!files) return files.error();
  if (Status ready = rendering.prepare(*files); !ready) return ready.error();
  const double ready = now();

  Points before;
  const auto read = [&](int frame) { return drawn->readFrame(frame); };
  if (plan.moments > 1 && plan.firstFrame > 1) {
    if (Status done = read(plan.firstFrame - 1); !done) return done.error();
    before = drawn->groom().points;
  }
  const int count = static_cast<int>(frames.size());
  int finished = 0;
  const auto tell = [&] {
    if (plan.progress) plan.progress(finished, count);
  };
  for (; finished < count && !(plan.isStopped && plan.isStopped()); ++finished) {
    if (finished == 0) tell();
    const int frame = frames[static_cast<std::size_t>(finished)];
    if (Status done = read(frame); !done) return done.error();
    if (Status done = rendering.drawFrame(frame, before, drawn->groom().points); !done) return done.error();
    if (plan.moments > 1) before = drawn->groom().points;
    if (plan.progress) plan.progress(finished + 1, count);
  }
  if (Status done = files->finish(); !done) return done.error();
  RenderOutcome outcome = rendering.finish();
  outcome.startSeconds = ready - start;
  outcome.interrupted = finished < count;
  outcome.warnings = seen->warnings();
  return outcome;
}

Result<RenderOutcome> renderGroom(const Groom& groom, UpAxis up, const ComputeDevice& device,
                                  const RenderPlan& plan) {
  const double start = now();
  Rendering rendering({groom, groom.metresPerUnit, directionOf(up), plan.target.framesPerSecond}, device,
                      plan);
  if (Status started = rendering.start(groom); !started) return started.error();
  rendering.see(groom.points);
  auto files = PictureFiles::open(plan.target, plan.size);
  if (!files) return files.error();
  if (Status ready = rendering.prepare(*files); !ready) return ready.error();
  const double ready = now();
  if (Status drawn = rendering.drawFrame(1, {}, groom.points); !drawn) return drawn.error();
  RenderOutcome outcome = rendering.finish();
  outcome.startSeconds = ready - start;
  return outcome;
}

}  // namespace ringlet
