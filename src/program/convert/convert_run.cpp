// Implements convert_run.h.
#include "program/convert/convert_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <system_error>

#include "program/cli/progress_bar.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/groom_writer.h"
#include "ringlet/output/sheet.h"
#include "ringlet/pictures/scene_bodies.h"

namespace ringlet::program {
namespace {

namespace fs = std::filesystem;

int frameCountOf(const ConvertPlan& plan) { return plan.lastFrame - plan.firstFrame + 1; }

// What is written: the animation's strands, or the hair that follows them.
const Groom& shownGroom(const AnimationReader& source, const ConvertPlan& plan) {
  return plan.hair ? plan.hair->groom() : source.groom();
}

// Calls visit(frame) once shownGroom() is in the pose of that frame of the animation.
Status forEachFrame(AnimationReader& source, const ConvertPlan& plan,
                    const std::function<Status(int)>& visit) {
  ProgressBar progress(0, frameCountOf(plan), plan.showProgress);
  for (int frame = plan.firstFrame; frame <= plan.lastFrame; ++frame) {
    progress.show(frame - plan.firstFrame);
    if (Status read = source.readFrame(frame); !read) return read;
    if (plan.hair) {
      Status checked = frame == plan.firstFrame ? plan.hair->checkPose(source.groom()) : Status();
      if (!checked) return checked;
      const FollowScene about =
          plan.scene ? followSceneAtFrame(*plan.scene, *plan.hair, frame) : FollowScene{};
      if (Status moved = plan.hair->follow(about.pose(source.groom().points)); !moved) return moved;
    }
    if (Status visited = visit(frame); !visited) return visited;
  }
  return {};
}

Status toAnimation(AnimationReader& source, const ConvertPlan& plan) {
  const CacheHeader& header = source.header();
  const auto made = animationFormatOf(plan.output)
                        ->resume(plan.output, shownGroom(source, plan),
                                 {.framesPerSecond = header.framesPerSecond,
                                  .metresPerUnit = header.metresPerUnit,
                                  .up = header.up,
                                  .diameter = header.diameter,
                                  .frameCount = frameCountOf(plan),
                                  .precision = plan.precision,
                                  .usd = plan.usd},
                                 0);
  if (!made) return made.error();
  AnimationWriter& writer = **made;
  const auto add = [&](int) { return writer.addFrame(shownGroom(source, plan).points); };
  if (Status added = forEachFrame(source, plan, add); !added) {
    const std::string partial = plan.output.string() + ".partial";
    const bool isSaid = added.error().message.find(partial) != std::string::npos;  // by the writer
    if (writer.frameCount() == 0 || isSaid) return added;
    return Error{fmt::format("{} (the {} frames before it are kept in {})", added.error().message,
                             writer.frameCount(), partial),
                 added.error().fault};
  }
  if (Status written = plan.cuts.from(plan.firstFrame).write(plan.output); !written) return written;
  return writer.finish();
}

Status toSheet(AnimationReader& source, const ConvertPlan& plan) {
  Sheet sheet(shownGroom(source, plan), frameCountOf(plan), source.header().up);
  const auto offer = [&](int frame) -> Status {
    const Groom& shown = shownGroom(source, plan);
    sheet.offer(frame - plan.firstFrame + 1, shown.points, {}, plan.cuts.cutBeyond(frame, shown.firstPoint));
    return {};
  };
  if (Status seen = forEachFrame(source, plan, offer); !seen) return seen;
  return sheet.write(plan.output);
}

Status toFrames(AnimationReader& source, const ConvertPlan& plan) {
  const bool isSequence = plan.to == ConvertTo::frameSequence;
  if (isSequence && !isFrameFile(plan.output)) {
    std::error_code code;
    fs::create_directories(plan.output, code);
    if (code)
      return Error{fmt::format("cannot create the folder {}: {}", plan.output.string(), code.message())};
  }
  return forEachFrame(source, plan, [&](int frame) {
    return writeGroom(isSequence ? framePath(plan.output, frame) : plan.output, shownGroom(source, plan));
  });
}

// Bytes of the files of an outcome.
std::uint64_t bytesOf(const ConvertPlan& plan) {
  std::uint64_t bytes = 0;
  std::error_code code;
  if (plan.to != ConvertTo::frameSequence) return fs::file_size(plan.output, code);
  for (int frame = plan.firstFrame; frame <= plan.lastFrame; ++frame)
    bytes += fs::file_size(framePath(plan.output, frame), code);
  return bytes;
}

// How far the source's frames may be from what was simulated.
double errorBoundOf(const AnimationReader& source, const ConvertPlan& plan) {
  double largest = 0;
  for (int frame = plan.firstFrame; frame <= plan.lastFrame; ++frame)
    largest = std::max(largest, source.errorBound(frame));
  return largest;
}

}  // namespace

bool isFrameFile(const fs::path& path) {
  return path.extension() == ".obj" || path.extension() == ".ply" || path.extension() == ".hair";
}

fs::path framePath(const fs::path& output, int frame) {
  if (!isFrameFile(output)) return output / fmt::format("hair.{:04}.obj", frame);
  return output.parent_path() /
         fmt::format("{}.{:04}{}", output.stem().string(), frame, output.extension().string());
}

Result<ConvertOutcome> convert(AnimationReader& source, const ConvertPlan& plan) {
  const Status done = plan.to == ConvertTo::animation ? toAnimation(source, plan)
                      : plan.to == ConvertTo::sheet   ? toSheet(source, plan)
                                                      : toFrames(source, plan);
  if (!done) return done.error();

  ConvertOutcome outcome;
  outcome.errorBound = errorBoundOf(source, plan);
  if (plan.to == ConvertTo::animation && animationFormatOf(plan.output)->hasPrecisions &&
      plan.precision == CachePrecision::bits16) {
    // What was lost before and what is lost now may add up.
    auto written = AnimationReader::open(plan.output);
    if (!written) return written.error();
    outcome.errorBound += written->errorBound();
  }
  if (plan.to == ConvertTo::frameSequence) {
    outcome.outputs = {framePath(plan.output, plan.firstFrame)};
    if (plan.lastFrame > plan.firstFrame) outcome.outputs.push_back(framePath(plan.output, plan.lastFrame));
    outcome.fileCount = frameCountOf(plan);
  } else {
    outcome.outputs = {plan.output};
    outcome.fileCount = 1;
  }
  outcome.byteCount = bytesOf(plan);
  return outcome;
}

}  // namespace ringlet::program
