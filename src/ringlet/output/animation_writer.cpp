// Implements output/animation_writer.h: the table of formats.
#include "ringlet/output/animation_writer.h"

#include "ringlet/output/cache_writer.h"
#include "ringlet/output/pc2_writer.h"
#include "ringlet/output/usd_clips_writer.h"
#include "ringlet/output/usd_writer.h"
#include "ringlet/output/usdc_writer.h"

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

Result<Writer> resumePc2(const std::filesystem::path& path, const Groom& topology, const AnimationOptions& o,
                         int frameCount) {
  return owned(Pc2Writer::resume(path, topology, o, frameCount));
}

constexpr AnimationFormat kFormats[] = {{".usda", false, true, resumeUsd},
                                        {".usdc", false, true, resumeUsdc},
                                        {".rgc", true, true, resumeCache},
                                        {".pc2", false, false, resumePc2}};

}  // namespace

std::span<const AnimationFormat> animationFormats() { return kFormats; }

const AnimationFormat* animationFormatOf(const std::filesystem::path& path) {
  for (const AnimationFormat& format : kFormats)
    if (path.extension() == format.extension) return &format;
  return nullptr;
}

}  // namespace ringlet
