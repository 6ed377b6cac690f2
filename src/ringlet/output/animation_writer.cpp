// Implements output/animation_writer.h: the table of formats.
#include "ringlet/output/animation_writer.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "ringlet/output/alembic/abc_writer.h"
#include "ringlet/output/cache_writer.h"
#include "ringlet/output/pc2_writer.h"
#include "ringlet/output/usd/usd_clips_writer.h"
#include "ringlet/output/usd/usd_writer.h"
#include "ringlet/output/usd/usdc_writer.h"

namespace ringlet {
namespace {

using Writer = std::unique_ptr<AnimationWriter>;

template <class T>
Result<Writer> owned(Result<T> writer) {
  if (!writer) return writer.error();
  return Writer(std::make_unique<T>(std::move(*writer)));
}

Result<Writer> resumeUsd(const std::filesystem::path& path, const Groom& topology, const AnimationOptions& o,
                         int frameCount) {
  if (o.usd.clipFrames > 0) return owned(UsdClipsWriter::resume(path, topology, o, frameCount));
  return owned(UsdWriter::resume(path, topology, o, frameCount));
}

Result<Writer> resumeCache(const std::filesystem::path& path, const Groom& topology,
                           const AnimationOptions& o, int frameCount) {
  return owned(CacheWriter::resume(path, topology,
                                   {.precision = o.precision,
                                    .up = o.up,
                                    .diameter = o.diameter,
                                    .framesPerSecond = o.framesPerSecond,
                                    .metresPerUnit = o.metresPerUnit},
                                   frameCount));
}

Result<Writer> resumeUsdc(const std::filesystem::path& path, const Groom& topology, const AnimationOptions& o,
                          int frameCount) {
  return owned(UsdcWriter::resume(path, topology, o, frameCount));
}

Result<Writer> resumeAbc(const std::filesystem::path& path, const Groom& topology, const AnimationOptions& o,
                         int frameCount) {
  return owned(AbcWriter::resume(path, topology, o, frameCount));
}

Result<Writer> resumePc2(const std::filesystem::path& path, const Groom& topology, const AnimationOptions& o,
                         int frameCount) {
  return owned(Pc2Writer::resume(path, topology, o, frameCount));
}

constexpr AnimationFormat kFormats[] = {
    {.extension = ".usda", .isRead = true, .hasValues = true, .resume = resumeUsd},
    {.extension = ".usdc", .isRead = true, .hasValues = true, .resume = resumeUsdc},
    {.extension = ".abc", .isRead = true, .hasValues = true, .resume = resumeAbc},
    {.extension = ".rgc", .hasPrecisions = true, .isRead = true, .resume = resumeCache},
    {.extension = ".pc2", .note = "with an .obj beside it", .resume = resumePc2}};

}  // namespace

std::span<const AnimationFormat> animationFormats() { return kFormats; }

std::string animationEndings(bool AnimationFormat::*property, const char* last) {
  std::vector<std::string> endings;
  for (const AnimationFormat& format : kFormats)
    if (format.*property) endings.emplace_back(format.extension);
  std::string text = endings.front();
  for (std::size_t i = 1; i < endings.size(); ++i)
    text += (i + 1 < endings.size() ? ", " : " " + std::string(last) + " ") + endings[i];
  return text;
}

const AnimationFormat* animationFormatOf(const std::filesystem::path& path) {
  for (const AnimationFormat& format : kFormats)
    if (path.extension() == format.extension) return &format;
  return nullptr;
}

Result<Writer> createAnimation(const std::filesystem::path& path, const Groom& topology,
                               const AnimationOptions& options) {
  if (const AnimationFormat* format = animationFormatOf(path))
    return format->resume(path, topology, options, 0);
  std::string known;
  for (const AnimationFormat& each : kFormats)
    known += (known.empty() ? "" : ", ") + std::string(each.extension);
  return Error{fmt::format("cannot write {}: an animation ends in one of {}", path.string(), known),
               Fault::output};
}

}  // namespace ringlet
