// Implements view/viewer.h.
#include "view/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <memory>
#include <thread>
#include <utility>

#include "ringlet/gpu/recorder.h"
#include "ringlet/output/picture.h"
#include "ringlet/solver/diagnostics.h"
#include "view/canvas.h"
#include "view/mouse_control.h"
#include "view/overlays.h"
#include "view/pane_row.h"
#include "view/panel.h"
#include "view/stage_times.h"
#include "view/widget_file.h"
#include "view/window.h"

namespace ringlet::view {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double cpuNow() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }  // of all threads

constexpr double kIdleWait = 0.1;  // for something to happen, while nothing moves [s]
constexpr int kIdleFrames = 4;     // that are drawn after the last event: widgets settle

class Viewer {
 public:
  explicit Viewer(const ViewPlan& plan) : plan_(plan), history_(editsOf(*plan.file)) {}

  Status run();
  ViewOutcome outcome();

 private:
  Status open();
  Status preparePanes();
  Status showFrame();
  Status drawUi();
  void moveByMouse();
  Status answer();
  Status applyEdits();
  Status step();
  Status drawPanes();
  Status writePicture();
  Status tellWidgets() const;
  void waitForTime(double start) const;
  Facts facts() const;
  bool isOver() const;
  std::vector<SolidPlace> places() const;
  PixelSize picture() const;  // all of it, of A and B
  int paneWidth() const { return picture().width / static_cast<int>(session_->hairs().size()); }

  const ViewPlan& plan_;
  std::unique_ptr<Window> window_;
  std::optional<ComputeDevice> device_;
  std::optional<Session> session_;
  std::optional<OrbitCamera> camera_;
  std::unique_ptr<Canvas> canvas_;
  PaneRow panes_;
  std::optional<gpu::Recorder> recorder_;  // the last to be made, the first to end

  Panel panel_;
  Shown shown_;
  Asked asked_;
  MouseControl mouse_;
  EditHistory<Edits> history_;
  std::size_t appliedVersion_ = 0;  // of the history
  bool isRefused_ = false;          // hair could not be made of these numbers
  StageTimes times_;
  std::string message_;
  std::vector<std::optional<std::size_t>> bodyOf_;
  ViewOutcome outcome_;
  double firstEnd_ = 0, firstCpu_ = 0, lastEnd_ = 0, framesPerSecond_ = 0;
  int quietFrames_ = 0;
};

Status Viewer::open() {
  const PixelSize size{plan_.look.size.width + kPanelWidth, plan_.look.size.height};
  auto window = Window::open(size, "ringlet view");
  if (!window) return window.error();
  window_ = std::move(*window);
  auto device = gpu::Device::open(plan_.device, window_->deviceOptions(), plan_.cacheFolder);
  if (!device) return device.error();
  if (Status attached = window_->attach(*device); !attached) return attached;
  device_ = ComputeDevice::over(*device);
  auto session = Session::create(*device_, *plan_.file, *plan_.scene);
  if (!session) return session.error();
  session_.emplace(std::move(*session));
  session_->isPlaying = !plan_.startsPaused;
  std::vector<Vec3d> points;
  const Groom& groom = plan_.scene->groom;
  for (const Vec3f& p : groom.points)
    points.push_back(session_->head().position +
                     rotate(session_->head().rotation, Vec3d(p) * groom.metresPerUnit));
  camera_.emplace(points, plan_.up, static_cast<double>(plan_.look.size.width) / plan_.look.size.height);
  for (const ViewSolid& solid : plan_.solids) bodyOf_.push_back(solid.body);
  auto canvas = Canvas::create(*device, *window_);
  if (!canvas) return canvas.error();
  canvas_ = std::move(*canvas);
  auto recorder = gpu::Recorder::create(device_->gpu(), "picture of the view");
  if (!recorder) return recorder.error();
  recorder_.emplace(std::move(*recorder));
  return preparePanes();
}

PixelSize Viewer::picture() const {
  const PixelSize all = window_->size();
  return {std::max(all.width - (panel_.isOpen ? kPanelWidth : 0), 8), std::max(all.height, 8)};
}

Status Viewer::preparePanes() {
  return panes_.prepare(device_->gpu(), *session_, plan_.look, picture(), shown_);
}

std::vector<SolidPlace> Viewer::places() const {
  std::vector<SolidPlace> places;
  if (!shown_.bodies) return places;
  const HeadPose& head = session_->head();
  const std::vector<std::vector<Vec3d>>& points = session_->bodyPoints();
  for (std::size_t s = 0; s < plan_.solids.size(); ++s) {
    const ViewSolid& solid = plan_.solids[s];
    if (solid.body) {
      const BodyPose& pose = session_->bodies()[*solid.body];
      places.push_back({pose.position, pose.rotation});
      const auto& moving = plan_.scene->moving;
      const auto m = std::ranges::find(moving, *solid.body, &MovingBody::body) - moving.begin();
      if (static_cast<std::size_t>(m) < points.size())
        places.back().bent = std::make_shared<const SolidMesh>(
            bent(plan_.look.solids[s], points[static_cast<std::size_t>(m)]));
    } else {
      places.push_back({head.position + rotate(head.rotation, solid.onHead.position),
                        head.rotation * solid.onHead.rotation});
    }
  }
  return places;
}

Facts Viewer::facts() const {
  const Groom& groom = plan_.scene->groom;
  Facts facts{.framesPerSecond = framesPerSecond_,
              .frame = session_->frame(),
              .seconds = session_->seconds(),
              .isPlaying = session_->isPlaying,
              .canShowGuides = plan_.look.follow != nullptr,
              .hair = fmt::format("{} strands, {} particles", groom.strandCount(), groom.points.size()),
              .message = message_,
              .stages = times_.smoothed()};
  if (const auto& follow = plan_.look.follow) facts.hair += fmt::format(", {} hairs", follow->hairs().size());
  return facts;
}

Status Viewer::drawUi() {
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  for (const auto& [key, modifiers] : window_->takeKeys())
    panel_.readKey(key, modifiers, history_, shown_, asked_);
  panel_.draw(window_->size().width, window_->size().height, facts(), history_, shown_, asked_);
  moveByMouse();
  Status drawn;
  for (std::size_t k = 0; k < session_->hairs().size() && drawn; ++k) {
    drawn = drawOverlays(shown_, *camera_, *session_, session_->hairs()[k].simulation(),
                         {static_cast<int>(k) * paneWidth(), paneWidth(), picture().height});
  }
  if (session_->hairs().size() == 2) {
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const auto middle = static_cast<float>(paneWidth());
    list->AddLine({middle, 0}, {middle, static_cast<float>(picture().height)}, IM_COL32(255, 255, 255, 90));
    list->AddText({8, 6}, IM_COL32_WHITE, "A");
    list->AddText({middle + 8, 6}, IM_COL32_WHITE, "B");
  }
  ImGui::Render();
  return drawn;
}

void Viewer::moveByMouse() {
  const ImGuiIO& io = ImGui::GetIO();
  const Mouse mouse{.x = io.MousePos.x,
                    .y = io.MousePos.y,
                    .movedRight = io.MouseDelta.x,
                    .movedDown = io.MouseDelta.y,
                    .wheel = io.MouseWheel,
                    .left = io.MouseDown[0],
                    .middle = io.MouseDown[2],
                    .right = io.MouseDown[1],
                    .isOverPicture = !io.WantCaptureMouse && io.MousePos.x >= 0 &&
                                     io.MousePos.x < static_cast<float>(picture().width),
                    .control = io.KeyCtrl};
  const int pane =
      std::clamp(static_cast<int>(mouse.x) / paneWidth(), 0, static_cast<int>(session_->hairs().size()) - 1);
  const std::span<const SolidMesh> solids =
      shown_.bodies ? std::span<const SolidMesh>(plan_.look.solids) : std::span<const SolidMesh>();
  mouse_.update(mouse, {static_cast<double>(pane * paneWidth()), paneWidth(), picture().height},
                {.solids = solids, .places = places(), .bodyOf = bodyOf_}, *camera_, *session_);
}

// What was asked for, but for pictures, which come last.
Status Viewer::answer() {
  if (asked_.play) session_->isPlaying = !session_->isPlaying;
  if (asked_.undo) history_.undo();
  if (asked_.redo) history_.redo();
  if (asked_.home) camera_->home();
  if (asked_.quit) glfwSetWindowShouldClose(window_->handle(), 1);
  if (asked_.save) {
    const Status saved = saveScene(*plan_.file, history_.now(), panel_.material, plan_.saveTo);
    message_ = saved ? fmt::format("saved {}", plan_.saveTo.string()) : saved.error().message;
    if (saved) outcome_.outputs.push_back(plan_.saveTo);
  }
  if (asked_.reset) {
    if (Status reset = session_->reset(); !reset) return reset;
    return panes_.attach(device_->gpu(), *session_);
  }
  return {};
}

Status Viewer::applyEdits() {
  if (panel_.isHeld()) return {};
  if (history_.version() == appliedVersion_) return {};
  appliedVersion_ = history_.version();
  const auto changed = session_->setEdits(history_.now());
  if (!changed) {  // hair goes on as it was
    message_ = changed.error().message;
    isRefused_ = true;
    return {};
  }
  if (isRefused_) message_.clear();
  isRefused_ = false;
  return *changed ? panes_.attach(device_->gpu(), *session_) : Status{};
}

Status Viewer::step() {
  if (!session_->isPlaying && !asked_.step) return {};
  const Status submitted = session_->submitFrame();
  return submitted ? panes_.takeCuts(device_->gpu(), *session_) : submitted;
}

Status Viewer::drawPanes() {
  std::vector<Vec3d> roots;  // of hairs on a scalp
  if (plan_.look.follow) roots = plan_.look.follow->rootsAt(session_->seconds(), session_->head());
  const std::vector<Vec3d> strandRoots = session_->strandRoots();
  const Status set = panes_.setFrame(camera_->camera(), session_->head(), places(),
                                     {.bodies = session_->bodies(),
                                      .bodyPoints = session_->bodyPoints(),
                                      .roots = roots,
                                      .strandRoots = strandRoots});
  if (!set) return set;
  if (Status begun = recorder_->begin(); !begun) return begun;
  panes_.record(*recorder_, session_->head().rotation);
  return recorder_->submit();
}

Status Viewer::writePicture() {
  const PixelSize size = canvas_->size();
  const std::vector<std::uint32_t> pixels = canvas_->pixels();
  Picture image(size.width, size.height, {});
  for (std::size_t i = 0; i < pixels.size(); ++i)
    image.pixels[i] = {static_cast<std::uint8_t>(pixels[i]), static_cast<std::uint8_t>(pixels[i] >> 8),
                       static_cast<std::uint8_t>(pixels[i] >> 16)};
  std::error_code code;  // where it fails, writing does
  if (!plan_.pictures.empty()) std::filesystem::create_directories(plan_.pictures, code);
  std::filesystem::path path;
  for (int number = 1; path.empty() || std::filesystem::exists(path, code); ++number)
    path = plan_.pictures / fmt::format("window.{:04}.png", number);
  const Status written = image.writePng(path);
  message_ = written ? fmt::format("wrote {}", path.string()) : written.error().message;
  if (written) outcome_.outputs.push_back(path);
  return {};
}

Status Viewer::tellWidgets() const {
  if (plan_.widgets.empty()) return {};
  std::vector<Vec3d> solids;
  for (const SolidPlace& place : places())
    solids.push_back(camera_->project(place.position, paneWidth(), picture().height).value_or(Vec3d{}));
  return writeWidgets(plan_.widgets,
                      {.shownFrames = outcome_.frameCount,
                       .pictureWidth = picture().width,
                       .pictureHeight = picture().height,
                       .isPlaying = session_->isPlaying,
                       .eye = camera_->camera().eye,
                       .head = session_->head().position,
                       .dragged = mouse_.dragged(),
                       .message = message_,
                       .solids = std::move(solids)},
                      panel_.places());
}

Status Viewer::showFrame() {
  times_.begin();
  asked_ = {};
  const bool isLast =
      plan_.frameCount > 0 && outcome_.frameCount + 1 == static_cast<std::size_t>(plan_.frameCount);
  asked_.picture = isLast && !plan_.pictures.empty();
  const double uiStart = now();
  if (Status drawn = drawUi(); !drawn) return drawn;
  times_.add("panel", 1000 * (now() - uiStart));
  if (Status answered = answer(); !answered) return answered;
  if (Status applied = applyEdits(); !applied) return applied;
  if (Status prepared = preparePanes(); !prepared) return prepared;
  if (Status stepped = step(); !stepped) return stepped;
  const bool isStepped = session_->isPlaying || asked_.step;
  if (Status drawn = drawPanes(); !drawn) return drawn;
  if (isStepped) {
    if (Status waited = session_->waitFrame(); !waited) return waited;
  }
  if (Status waited = recorder_->wait(); !waited) return waited;
  times_.addSolver(session_->hairs());
  for (const auto& [stage, milliseconds] : recorder_->stageMilliseconds()) times_.add(stage, milliseconds);
  panes_.finish();
  const double showStart = now();
  if (Status shown = canvas_->show(panes_.pictures(), asked_.picture); !shown) return shown;
  times_.add("window", 1000 * (now() - showStart));
  if (asked_.picture) {
    if (Status written = writePicture(); !written) return written;
  }
  ++outcome_.frameCount;
  times_.end(outcome_.frameCount > 1);
  return tellWidgets();
}

bool Viewer::isOver() const {
  return window_->isClosed() || (plan_.wasInterrupted && plan_.wasInterrupted()) ||
         (plan_.frameCount > 0 && outcome_.frameCount >= static_cast<std::size_t>(plan_.frameCount));
}

// Hair moves no faster than its frames; where nothing moves, nothing is drawn until something happens.
void Viewer::waitForTime(double start) const {
  if (plan_.frameCount > 0) return;
  if (!session_->isPlaying) {
    if (quietFrames_ > kIdleFrames) glfwWaitEventsTimeout(kIdleWait);
    return;
  }
  const double left = start + 1 / session_->framesPerSecond() - now();
  if (left > 0) std::this_thread::sleep_for(std::chrono::duration<double>(left));
}

Status Viewer::run() {
  if (Status opened = open(); !opened) return opened;
  while (!isOver()) {
    const double start = now();
    glfwPollEvents();
    if (Status shown = showFrame(); !shown) return shown;
    quietFrames_ = session_->isPlaying ? 0 : quietFrames_ + 1;
    waitForTime(start);
    lastEnd_ = now();
    if (outcome_.frameCount == 1) firstEnd_ = lastEnd_, firstCpu_ = cpuNow();
    const double rate = 1 / (lastEnd_ - start);
    framesPerSecond_ = framesPerSecond_ > 0 ? framesPerSecond_ + 0.1 * (rate - framesPerSecond_) : rate;
  }
  return {};
}

ViewOutcome Viewer::outcome() {
  outcome_.seconds = lastEnd_ - firstEnd_;
  outcome_.cpuSeconds = cpuNow() - firstCpu_;
  outcome_.stages = times_.means();
  outcome_.sceneFrames = session_->frame();
  for (const LiveHair& hair : session_->hairs()) {
    outcome_.deviceBytes += Diagnostics(hair.simulation()).memory().total();
    const auto& warnings = hair.simulation().warnings();
    outcome_.warnings.insert(outcome_.warnings.end(), warnings.begin(), warnings.end());
  }
  outcome_.device = device_->name();
  outcome_.driver = device_->driver();
  outcome_.validationMessages = device_->validationMessages();
  return std::move(outcome_);
}

}  // namespace

Result<ViewOutcome> runView(const ViewPlan& plan) {
  Viewer viewer(plan);
  if (Status ran = viewer.run(); !ran) return ran.error();
  return viewer.outcome();
}

}  // namespace ringlet::view
