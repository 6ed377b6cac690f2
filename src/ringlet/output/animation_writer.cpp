// Implements output/animation_writer.h: the table of formats.
#include "ringlet/output/animation_writer.h"

#include "ringlet/output/cache_writer.h"
#include "ringlet/output/usd_writer.h"

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

constexpr AnimationFormat kFormats[] = {{".usda", false, resumeUsd}, {".rgc", true, resumeCache}};

}  // namespace

std::span<const AnimationFormat> animationFormats() { return kFormats; }

const AnimationFormat* animationFormatOf(const std::filesystem::path& path) {
  for (const AnimationFormat& format : kFormats)
    if (path.extension() == format.extension) return &format;
  return nullptr;
}

}  // namespace ringlet
