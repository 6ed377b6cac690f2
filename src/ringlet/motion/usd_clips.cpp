// Implements motion/usd_clips.h.
#include "ringlet/motion/usd_clips.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

#include "ringlet/base/quoted.h"
#include "ringlet/groom/usd/usd_file.h"
#include "ringlet/groom/usd/usd_value_at.h"
#include "ringlet/motion/usd_clip_schedule.h"
#include "ringlet/motion/usd_clip_sets.h"

namespace ringlet {
namespace {

// Bounds on what times make of clips, of the size of all files read: a loop has a clip's samples many times.
constexpr std::size_t kNumbersPerByte = 16, kFreeNumbers = 1 << 16;
constexpr std::size_t kNumbersOfKey = 8;  // what a sample costs beside its numbers
constexpr std::size_t kMostSets = 16;     // for one mesh; each may read the same file

constexpr std::string_view kFaces[] = {"faceVertexCounts", "faceVertexIndices"};
constexpr std::string_view kStill[] = {"faceVertexCounts", "faceVertexIndices", "orientation",
                                       "subdivisionScheme", "xformOpOrder"};

bool isStill(std::string_view name) { return std::ranges::find(kStill, name) != std::end(kStill); }

bool hasValue(const UsdAttribute* attribute) {
  return attribute &&
         (!attribute->value.numbers.empty() || !attribute->value.texts.empty() ||
          attribute->value.isBlocked || !attribute->samples.empty() || !attribute->drivenBy.empty());
}

std::vector<double> timesOf(const UsdAttribute& attribute) {
  std::vector<double> times;
  for (const UsdSample& sample : attribute.samples) times.push_back(sample.time);
  return times;
}

// What the clips of one set say of one attribute.
struct Given {
  std::vector<UsdSample> samples{};                       // of all but points
  std::vector<std::pair<double, std::uint32_t>> poses{};  // of points: time of the stage, which pose
  std::size_t ranges = 0;                                 // in which clips have samples of it
  std::string missingFrom{};                              // the first clip that has none
  bool lacksPrim = false;                                 // and not even the prim
};

// A clip file, while it is read.
struct Clip {
  std::string path;
  std::vector<std::byte> bytes;
  UsdLayer layer{};
};

class ClipReader {
 public:
  ClipReader(UsdLayer& layer, const UsdPrims& prims, std::uint32_t mesh, const UsdClipFiles* files)
      : layer_(layer), prims_(prims), mesh_(mesh), files_(files) {
    allow(layer.byteCount);
  }

  Result<UsdClipped> read() {
    findTargets();
    std::size_t setCount = 0;
    for (const std::uint32_t prim : clippedPrims()) {
      if (!files_)
        return prims_.wrong(
            prim,
            "has value clips, which are files of their own, and only the layer itself is here; "
            "read it from its folder, and from no package");
      const auto schedules = clipSchedulesOf(prims_, prim, *files_);
      if (!schedules) return schedules.error();
      if ((setCount += schedules->size()) > kMostSets)
        return prims_.wrong(prim, fmt::format("{} clip sets hold for {}; expected at most {}", setCount,
                                              prims_.pathOf(mesh_), kMostSets));
      for (const UsdClipSchedule& schedule : *schedules)
        if (Status done = readSet(schedule); !done) return done.error();
    }
    if (!clipped_.points && !hasValue(usdAttributeOf(layer_.prims[mesh_], "points")) && !pointless_.empty())
      return prims_.wrong(mesh_, fmt::format("has no points, and neither has its clip {}", pointless_));
    return std::move(clipped_);
  }

 private:
  // --- What is asked for.

  // The mesh, its skeleton and animation, and all above them.
  void findTargets() {
    std::vector<std::uint32_t> wanted{mesh_};
    const auto follow = [&](std::uint32_t from, std::string_view relationship, std::string_view type) {
      const auto binding = prims_.nearest(from, relationship);
      if (!binding) return;
      if (const auto target = prims_.onlyTargetOf(*binding, type)) wanted.push_back(*target);
    };
    follow(mesh_, "skel:skeleton", "Skeleton");
    follow(wanted.back(), "skel:animationSource", "SkelAnimation");
    isTarget_.resize(layer_.prims.size());
    for (std::uint32_t p : wanted)
      for (; p != kNoUsdPrim && !isTarget_[p]; p = layer_.prims[p].parent) isTarget_[p] = true;
  }

  // Of the targets those with clips, deepest first: parents stand first in a layer.
  std::vector<std::uint32_t> clippedPrims() const {
    std::vector<std::uint32_t> clipped;
    for (auto p = static_cast<std::uint32_t>(layer_.prims.size()); p-- > 0;)
      if (isTarget_[p] && !layer_.prims[p].clips.empty()) clipped.push_back(p);
    return clipped;
  }

  // Its path in the clips of a set; none where the set is not of it or of one above it.
  std::optional<std::string> clipPathOf(const UsdClipSchedule& schedule, std::uint32_t prim) const {
    std::string below;
    for (; prim != schedule.prim; prim = layer_.prims[prim].parent) {
      if (prim == kNoUsdPrim) return std::nullopt;
      below = "/" + std::string(layer_.prims[prim].name) + below;
    }
    return schedule.primPath + below;
  }

  // --- Clips.

  struct Target {
    std::uint32_t prim = 0;
    std::string path{};  // in clips
  };

  Status readSet(const UsdClipSchedule& schedule) {
    std::vector<Target> targets;
    for (std::uint32_t p = 0; p < layer_.prims.size(); ++p) {
      if (!isTarget_[p]) continue;
      if (auto path = clipPathOf(schedule, p)) targets.push_back({p, std::move(*path)});
    }
    given_.clear();
    poses_.clear();
    for (const auto& ranges : rangesByFile(schedule))
      if (Status done = readClip(schedule, ranges, targets); !done) return done;
    return takeSet(schedule);
  }

  // The ranges of each file, in the order in which files are first used.
  std::vector<std::vector<std::size_t>> rangesByFile(const UsdClipSchedule& schedule) const {
    std::map<std::string, std::size_t> placeOf;
    std::vector<std::vector<std::size_t>> ranges;
    for (std::size_t r = 0; r < schedule.ranges.size(); ++r) {
      const std::string path = files_->pathOf(schedule.files[schedule.ranges[r].file]);
      const auto [found, isNew] = placeOf.insert({path, ranges.size()});
      if (isNew) ranges.emplace_back();
      ranges[found->second].push_back(r);
    }
    return ranges;
  }

  Status readClip(const UsdClipSchedule& schedule, const std::vector<std::size_t>& ranges,
                  const std::vector<Target>& targets) {
    const std::string& name = schedule.files[schedule.ranges[ranges.front()].file];
    Clip clip{files_->pathOf(name), {}};
    auto bytes = files_->read(name);
    if (!bytes) return Error{ofSet(schedule, bytes.error().message), bytes.error().fault};
    clip.bytes = std::move(*bytes);
    auto layer = readUsdLayer(clip.bytes, clip.path, UsdContent::meshes);
    if (!layer) return Error{ofSet(schedule, layer.error().message), layer.error().fault};
    clip.layer = std::move(*layer);
    allow(clip.bytes.size());
    const UsdPrims prims(clip.layer, clip.path);
    for (const Target& target : targets) {
      const auto found = prims.primAt(target.path, kNoUsdPrim);
      Status done = found ? readTarget(schedule, ranges, clip, target, *found) : Status{};
      if (done && target.prim == mesh_ && !(found && hasSamples(clip, *found, "points")))
        noteMissing(clip, !found);
      if (!done) return done;
    }
    return {};
  }

  static bool hasSamples(const Clip& clip, std::uint32_t prim, std::string_view name) {
    const UsdAttribute* attribute = usdAttributeOf(clip.layer.prims[prim], name);
    return attribute && !attribute->samples.empty();
  }

  void noteMissing(const Clip& clip, bool lacksPrim) {
    if (pointless_.empty()) pointless_ = clip.path;
    Given& points = given_[{mesh_, "points"}];
    if (!points.missingFrom.empty()) return;
    points.missingFrom = clip.path;
    points.lacksPrim = lacksPrim;
  }

  Status readTarget(const UsdClipSchedule& schedule, const std::vector<std::size_t>& ranges, const Clip& clip,
                    const Target& target, std::uint32_t prim) {
    for (const UsdAttribute& attribute : clip.layer.prims[prim].attributes) {
      const bool isPoints = attribute.name == "points";
      if (isStill(attribute.name)) {
        if (Status done = takeStill(clip, target, attribute); !done) return done;
      } else if (attribute.samples.empty() || (isPoints && target.prim != mesh_) ||
                 isSettled(target.prim, attribute)) {
        continue;
      } else if (Status done = readSamples(schedule, ranges, clip, target, attribute); !done) {
        return done;
      }
    }
    return {};
  }

  // Whether the layer, or a set that counts more, says it already.
  bool isSettled(std::uint32_t prim, const UsdAttribute& attribute) {
    if (prim == mesh_ && attribute.name == "points" && clipped_.points) return true;
    if (!hasValue(usdAttributeOf(layer_.prims[prim], attribute.name))) return false;
    if (prim == mesh_ && attribute.name == "points" && clipped_.warnings.empty())
      clipped_.warnings.push_back(fmt::format(
          "{}: its points stand in the file itself, which counts more than its clips; these do not move it",
          prims_.pathOf(mesh_)));
    return true;
  }

  // --- What does not move.

  // The layer's own where it has some; else of the first clip, with which all others agree.
  Status takeStill(const Clip& clip, const Target& target, const UsdAttribute& attribute) {
    if (!hasValue(&attribute)) return {};
    const bool isFace = target.prim == mesh_ && std::ranges::find(kFaces, attribute.name) != std::end(kFaces);
    const UsdAttribute* own = usdAttributeOf(layer_.prims[target.prim], attribute.name);
    if (!hasValue(own)) {
      UsdAttribute& taken = attributeOf(target.prim, attribute.name);
      taken.value = kept(attribute.value);
      if (isFace) facesOf_ = clip.path;
      own = &taken;
    }
    if (!isFace || !own->samples.empty()) return {};
    if (Status same = checkFaces(clip, target, attribute.name, attribute.value, own->value); !same)
      return same;
    for (const UsdSample& sample : attribute.samples)
      if (Status same = checkFaces(clip, target, attribute.name, sample.value, own->value); !same)
        return same;
    return {};
  }

  Status checkFaces(const Clip& clip, const Target& target, std::string_view name, const UsdValue& found,
                    const UsdValue& expected) const {
    if (found.numbers == expected.numbers) return {};
    const std::string of = facesOf_.empty() ? "the file that names the clip" : facesOf_;
    const std::string faces = "; the faces of a mesh that moves stay the same";
    if (found.numbers.size() != expected.numbers.size())
      return Error{fmt::format("{}: {}: found {} {}; expected {}, as in {}{}", clip.path, target.path,
                               found.numbers.size(), name, expected.numbers.size(), of, faces)};
    const auto [a, b] = std::ranges::mismatch(found.numbers, expected.numbers);
    return Error{fmt::format("{}: {}: found {} as number {} of {}; expected {}, as in {}{}", clip.path,
                             target.path, *a, a - found.numbers.begin(), name, *b, of, faces)};
  }

  // --- What moves.

  Status readSamples(const UsdClipSchedule& schedule, const std::vector<std::size_t>& ranges,
                     const Clip& clip, const Target& target, const UsdAttribute& attribute) {
    Given& given = given_[{target.prim, std::string(attribute.name)}];
    const std::vector<double> times = timesOf(attribute);
    const bool isPoints = attribute.name == "points";
    if (isPoints)
      if (Status same = checkPoints(clip, target, attribute); !same) return same;
    std::map<double, std::uint32_t> poses;  // by the clip's time
    for (const std::size_t range : ranges) {
      const auto keys = schedule.keysOf(range, times, left_ / kNumbersOfKey);
      if (!keys) return prims_.wrong(schedule.prim, keys.error().message);
      for (const UsdClipKey& key : *keys) {
        // Beyond its ends a clip holds still.
        const double at = std::clamp(key.clip, times.front(), times.back());
        const auto known = poses.find(at);
        if (known != poses.end()) {
          if (!take(kNumbersOfKey)) return tooMuch(schedule);
          given.poses.push_back({key.stage, known->second});
          continue;
        }
        UsdValue value = usdValueAt(attribute.samples, at);
        if (!take(kNumbersOfKey + value.numbers.size())) return tooMuch(schedule);
        if (isPoints) {
          poses.insert({at, addPose(value)});
          given.poses.push_back({key.stage, poses.at(at)});
        } else {
          given.samples.push_back({key.stage, std::move(value)});
        }
      }
    }
    given.ranges += ranges.size();
    return {};
  }

  Status checkPoints(const Clip& clip, const Target& target, const UsdAttribute& points) {
    if (pointCount_ == 0) {
      pointCount_ = points.value.numbers.size() / 3;
      pointsOf_ = clip.path;
    }
    for (const UsdSample& sample : points.samples) {
      const std::size_t count = sample.value.numbers.size();
      if (count == 0 || sample.value.width != 3 || count != 3 * pointCount_)
        return Error{fmt::format(
            "{}: {}: found {} points at its time {}; expected {}, as in {}: points and faces of a "
            "mesh that moves stay the same",
            clip.path, target.path, count / 3, sample.time, pointCount_, pointsOf_)};
    }
    return {};
  }

  std::uint32_t addPose(const UsdValue& value) {
    const auto pose = static_cast<std::uint32_t>(poses_.size() / pointCount_);
    const std::vector<double>& xyz = value.numbers;
    for (std::size_t at = 0; at < xyz.size(); at += 3)
      poses_.push_back(static_cast<Vec3f>(Vec3d{xyz[at], xyz[at + 1], xyz[at + 2]}));
    return pose;
  }

  // --- A set, once all its clips are read.

  Status takeSet(const UsdClipSchedule& schedule) {
    for (auto& [of, given] : given_) {
      const auto& [prim, name] = of;
      if (given.ranges == 0) continue;
      if (given.ranges < schedule.ranges.size() && !schedule.fillsGaps)
        return missing(schedule, prim, name, given);
      if (prim == mesh_ && name == "points") {
        takePoints(given);
      } else {
        UsdAttribute& attribute = attributeOf(prim, name);
        std::ranges::stable_sort(given.samples, {}, &UsdSample::time);
        attribute.samples = std::move(given.samples);
        attribute.value = attribute.samples.front().value;
        attribute.isSampled = attribute.samples.size() > 1;
      }
    }
    return {};
  }

  void takePoints(Given& given) {
    std::ranges::stable_sort(given.poses, {}, &std::pair<double, std::uint32_t>::first);
    PointSamples points{.pointCount = pointCount_, .seconds = {}, .points = std::move(poses_)};
    for (const auto& [time, pose] : given.poses) {
      points.seconds.push_back(time);
      points.poses.push_back(pose);
    }
    clipped_.points = std::move(points);
  }

  Error missing(const UsdClipSchedule& schedule, std::uint32_t prim, const std::string& name,
                const Given& given) const {
    const std::string path = clipPathOf(schedule, prim).value_or("");
    const char* advice = "; expected it as in other clips, or interpolateMissingClipValues = true";
    if (given.lacksPrim)
      return Error{
          ofSet(schedule, fmt::format("{}: there is no prim {}{}", given.missingFrom, path, advice))};
    if (!given.missingFrom.empty())
      return Error{ofSet(
          schedule, fmt::format("{}: {} has no samples of {}{}", given.missingFrom, path, name, advice))};
    return Error{
        ofSet(schedule, fmt::format("some of its clips have no samples of {} of {}{}", name, path, advice))};
  }

  // --- Helpers.

  std::string ofSet(const UsdClipSchedule& schedule, const std::string& sentence) const {
    return prims_
        .wrong(schedule.prim, fmt::format("clip set {}: {}", ringlet::quoted(schedule.name), sentence))
        .message;
  }
  Error tooMuch(const UsdClipSchedule& schedule) const {
    return Error{ofSet(schedule, "its times come to more samples than files of this size may")};
  }
  void allow(std::size_t byteCount) { left_ += kNumbersPerByte * byteCount; }
  bool take(std::size_t numbers) {
    if (numbers > left_) return false;
    left_ -= numbers;
    return true;
  }

  // Of the layer's; a new one where it has none of this name.
  UsdAttribute& attributeOf(std::uint32_t prim, std::string_view name) {
    std::vector<UsdAttribute>& attributes = layer_.prims[prim].attributes;
    const auto found = std::ranges::find(attributes, name, &UsdAttribute::name);
    if (found != attributes.end()) return *found;
    return attributes.emplace_back(UsdAttribute{.name = keptText(name)});
  }
  // Texts of a clip's are gone with it.
  std::string_view keptText(std::string_view text) { return layer_.targets.emplace_back(text); }
  UsdValue kept(UsdValue value) {
    for (std::string_view& text : value.texts) text = keptText(text);
    return value;
  }

  UsdLayer& layer_;
  const UsdPrims& prims_;
  std::uint32_t mesh_;
  const UsdClipFiles* files_;
  std::vector<bool> isTarget_{};  // of each prim
  UsdClipped clipped_{};

  std::map<std::pair<std::uint32_t, std::string>, Given> given_{};  // of the set that is read
  std::vector<Vec3f> poses_{};
  std::size_t pointCount_ = 0, left_ = kFreeNumbers;
  std::string facesOf_{}, pointsOf_{}, pointless_{};  // clips, for messages
};

}  // namespace

Result<UsdClipped> readUsdClips(UsdLayer& layer, const UsdPrims& prims, std::uint32_t mesh,
                                const UsdClipFiles* files) {
  return ClipReader(layer, prims, mesh, files).read();
}

}  // namespace ringlet
