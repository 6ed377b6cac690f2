// Implements output/usd/usd_clips_writer.h.
#include "ringlet/output/usd/usd_clips_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>

#include "ringlet/base/assert.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/output/usd/usd_hair_stage.h"
#include "ringlet/output/usd/usd_text.h"
#include "ringlet/output/usd/usd_writer.h"

namespace ringlet {
namespace {

namespace fs = std::filesystem;

constexpr const char* kManifest = "manifest.usda";

fs::path folderOf(const fs::path& path) { return path.parent_path() / (path.stem().string() + "_clips"); }
fs::path partialOf(const fs::path& path) { return path.string() + ".partial"; }

Status writeText(const fs::path& path, const std::string& text) {
  return writeWholeFile(path, std::as_bytes(std::span(text)));
}

// "    point3f[] points": that it is there, and no value.
std::string declarations(const UsdStagePrim& prim) {
  std::string text;
  for (const UsdStageAttribute& attribute : prim.attributes) {
    if (attribute.elementsOfSample > 0) text += fmt::format("    {} {}\n", attribute.type, attribute.name);
  }
  return text;
}

}  // namespace

fs::path UsdClipsWriter::clipPath(const fs::path& path, int clip) {
  return folderOf(path) / fmt::format("{}.{:04}.usdc", path.stem().string(), clip);
}

Result<UsdClipsWriter> UsdClipsWriter::resume(const fs::path& path, const Groom& topology,
                                              const AnimationOptions& options, int frameCount) {
  RINGLET_ASSERT(options.usd.clipFrames > 0, "clips have frames");
  RINGLET_ASSERT(!options.usd.originPrims, "changes of other prims are written into one crate");
  UsdClipsWriter writer(path, topology, options);
  std::error_code code;
  fs::create_directories(folderOf(path), code);
  if (code) {
    return Error{fmt::format("cannot create the folder {}: {}", folderOf(path).string(), code.message()),
                 Fault::output};
  }
  writer.frameCount_ = frameCount;
  writer.wholeClips_ = frameCount / options.usd.clipFrames;
  if (Status written = writer.writeManifest(); !written) return written.error();
  if (Status written = writer.writeTop(partialOf(path)); !written) return written.error();
  writer.removeStale();
  if (const int begun = frameCount % options.usd.clipFrames; begun > 0) {
    if (Status opened = writer.openClip(begun); !opened) return opened.error();
  }
  return writer;
}

UsdClipsWriter::~UsdClipsWriter() {
  if (frameCount_ > 0 || topology_.points.empty()) return;
  std::error_code ignored;
  fs::remove(partialOf(path_), ignored);
  fs::remove(folderOf(path_) / kManifest, ignored);
  fs::remove(folderOf(path_), ignored);  // where it is empty
}

// Clips of a run before that are not gone on with.
void UsdClipsWriter::removeStale() const {
  const bool isBegun = frameCount_ % options_.usd.clipFrames > 0;
  std::error_code code;
  for (int clip = wholeClips_ + (isBegun ? 2 : 1);; ++clip) {
    const bool wasThere = fs::remove(clipPath(path_, clip), code);
    if (!fs::remove(partialOf(clipPath(path_, clip)), code) && !wasThere) return;
  }
}

// The next clip, of which so many frames are there.
Status UsdClipsWriter::openClip(int framesOfIt) {
  const int before = framesBefore(wholeClips_ + 1);
  AnimationOptions options = options_;
  options.usd.firstTimeCode = options_.usd.firstTimeCode + before;
  options.usd.clipFrames = 0;
  options.frameCount = std::min(options_.usd.clipFrames, options_.frameCount - before);
  auto opened = UsdcWriter::resume(clipPath(path_, wholeClips_ + 1), topology_, options, framesOfIt);
  if (!opened) return opened.error();
  clip_ = std::make_unique<UsdcWriter>(std::move(*opened));
  return {};
}

Status UsdClipsWriter::closeClip() {
  if (Status finished = clip_->finish(); !finished) return finished;
  clip_.reset();
  ++wholeClips_;
  return {};
}

Status UsdClipsWriter::addFrame(std::span<const Vec3f> points, const UsdTransform& head) {
  RINGLET_ASSERT(frameCount_ < options_.frameCount, "more frames than announced");
  if (!clip_) {
    if (Status opened = openClip(0); !opened) return opened;
  }
  if (Status added = clip_->addFrame(points, head); !added) return added;
  ++frameCount_;
  if (clip_->frameCount() < options_.usd.clipFrames) return {};
  if (Status closed = closeClip(); !closed) return closed;
  return writeTop(partialOf(path_));
}

Status UsdClipsWriter::sync() { return clip_ ? clip_->sync() : Status{}; }

Status UsdClipsWriter::finish() {
  RINGLET_ASSERT(frameCount_ > 0, "a file without frames is not finished but dropped");
  if (clip_) {
    if (Status closed = closeClip(); !closed) return closed;
  }
  if (Status written = writeTop(path_); !written) return written;
  std::error_code ignored;
  fs::remove(partialOf(path_), ignored);
  return {};
}

Status UsdClipsWriter::writeManifest() const {
  const HairStage made = hairStageOf(topology_, options_);
  return writeText(folderOf(path_) / kManifest, fmt::format("#usda 1.0\n\nover \"Hair\"\n{{\n{}}}\n",
                                                            declarations(made.stage.prims.front())));
}

// Of the clips that are whole.
Status UsdClipsWriter::writeTop(const fs::path& as) const {
  const HairStage made = hairStageOf(topology_, options_);
  const int first = options_.usd.firstTimeCode;
  const int last = first - 1 + std::min(frameCount_, framesBefore(wholeClips_ + 1));
  std::string paths, active;
  for (int clip = 1; clip <= wholeClips_; ++clip) {
    const char* comma = clip > 1 ? ", " : "";
    fmt::format_to(std::back_inserter(paths), "{}@./{}@", comma,
                   clipPath(path_, clip).lexically_relative(path_.parent_path()).string());
    fmt::format_to(std::back_inserter(active), "{}({}, {})", comma, first + framesBefore(clip), clip - 1);
  }
  std::string text = fmt::format(
      "{}{}\n    metersPerUnit = {}\n    startTimeCode = {}\n    timeCodesPerSecond = {}\n    upAxis = "
      "\"{}\"\n)\n\n",
      UsdWriter::kBegin, last, options_.metresPerUnit, first, options_.framesPerSecond,
      options_.up == UpAxis::y ? 'Y' : 'Z');
  const UsdStagePrim& prim = made.stage.prims.front();
  text += fmt::format(
      "def BasisCurves \"Hair\" (\n{}    clips = {{\n        dictionary default = {{\n"
      "            double2[] active = [{}]\n            asset[] assetPaths = [{}]\n"
      "            asset manifestAssetPath = @./{}@\n            string primPath = \"/Hair\"\n"
      "            double2[] times = [({}, {}), ({}, {})]\n        }}\n    }}\n)\n{{\n",
      usdTextOf(prim.apiSchemas, 4), active, paths,
      (folderOf(path_) / kManifest).lexically_relative(path_.parent_path()).string(), first, first,
      std::max(first, last), std::max(first, last));
  for (const UsdStageAttribute& attribute : prim.attributes) {
    if (attribute.elementsOfSample == 0) text += usdTextOf(attribute, 4);
  }
  return writeText(as, text + declarations(prim) + "}\n");
}

}  // namespace ringlet
