// Implements output/foreign/foreign_frames.h.
#include "ringlet/output/foreign/foreign_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "ringlet/base/file_ending.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/moving_groom.h"
#include "ringlet/motion/point_cache.h"
#include "ringlet/output/animation_writer.h"

namespace ringlet {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kUsdEndings{".usda", ".usdc", ".usd", ".usdz"};

bool isOfCurves(const fs::path& path) {
  const std::string ending = endingOf(path);
  return ending == ".abc" || std::ranges::find(kUsdEndings, ending) != kUsdEndings.end();
}

// --- Curves.

struct EvenTimes {
  double first = 0, step = 0;
  int count = 0;
  bool isExact = true;  // every time is one of them
};

// Of two times or more.
EvenTimes evenTimesOf(const std::vector<double>& seconds) {
  constexpr double kMostFrames = 1e6, kOnStep = 0.05;  // of a step
  const double range = seconds.back() - seconds.front();
  double smallest = range;
  for (std::size_t k = 1; k < seconds.size(); ++k) smallest = std::min(smallest, seconds[k] - seconds[k - 1]);
  EvenTimes even{.first = seconds.front()};
  const double steps = std::round(range / smallest);
  if (steps < kMostFrames) {
    even.step = range / steps;
    even.count = static_cast<int>(steps) + 1;
    const bool isExact = std::ranges::all_of(seconds, [&](double t) {
      const double at = (t - even.first) / even.step;
      return std::abs(at - std::round(at)) <= kOnStep;
    });
    if (isExact) return even;
  }
  even.count = static_cast<int>(std::min<std::size_t>(seconds.size(), static_cast<std::size_t>(kMostFrames)));
  even.step = range / (even.count - 1);
  even.isExact = false;
  return even;
}

// 24 of 23.9999999.
double niceRate(double rate) {
  const double whole = std::round(rate);
  return std::abs(rate / whole - 1) < 1e-4 ? whole : rate;
}

// Times from the first on at which there is hair: some programs write curves without points until it is
// there.
Result<std::vector<double>> timesWithHair(const MovingGroom& groom) {
  const std::vector<double>& all = groom.seconds();
  if (all.size() < 2 || groom.at(all.front(), {})) return all;
  const auto last = groom.at(all.back(), {});
  if (!last) return last.error();
  const auto first = std::ranges::partition_point(all, [&](double t) { return !groom.at(t, {}); });
  return std::vector<double>(first, all.end());
}

class CurveFrames final : public ForeignFrames {
 public:
  static Result<std::unique_ptr<ForeignFrames>> open(const fs::path& path) {
    auto groom = MovingGroom::open(path);
    if (!groom) return groom.error();
    const auto times = timesWithHair(*groom);
    if (!times) return times.error();
    if (times->size() < 2)
      return Error{fmt::format("{}: none of its curves move: it is a groom and no animation", path.string())};
    auto self = std::make_unique<CurveFrames>(path, std::move(*groom), *times);
    constexpr double kSlowest = 1e-6, kFastest = 1e6;  // frames a second
    if (!(self->framesPerSecond() >= kSlowest && self->framesPerSecond() <= kFastest))
      return Error{fmt::format("{}: its samples make {} frames a second; expected {} to {}", path.string(),
                               self->framesPerSecond(), kSlowest, kFastest)};
    return std::unique_ptr<ForeignFrames>(std::move(self));
  }

  CurveFrames(const fs::path& path, MovingGroom groom, const std::vector<double>& times)
      : groom_(std::move(groom)), even_(evenTimesOf(times)) {
    const std::string ending = endingOf(path);
    frameCount_ = even_.count;
    framesPerSecond_ = niceRate(1 / even_.step);
    formatName_ = ending == ".abc" ? "Alembic" : "USD";
    formatKey_ = ending.substr(1);
    if (times.size() < groom_.seconds().size())
      warnings_.push_back(
          fmt::format("{}: it has no hair before {} s, where it begins", path.string(), times.front()));
    if (!even_.isExact)
      warnings_.push_back(fmt::format(
          "{}: its {} samples are not at even times; it is played in {} even steps, straight between samples",
          path.string(), times.size(), even_.count));
  }

  Result<LoadedGroom> frame(int frame, const GroomReading& reading) override {
    return groom_.at(frame == even_.count ? groom_.seconds().back() : even_.first + (frame - 1) * even_.step,
                     reading);
  }

 private:
  MovingGroom groom_;
  EvenTimes even_;
};

// --- A file a frame.

// "hair." and ".obj" of "hair.####.obj".
struct SequenceName {
  std::string before{}, after{};
  std::size_t digits = 0;
};

std::optional<SequenceName> sequenceNameOf(const fs::path& path) {
  const std::string name = path.filename().string();
  const std::size_t begin = name.find('#');
  if (begin == name.npos) return std::nullopt;
  const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
  if (name.find('#', end) != name.npos) return std::nullopt;
  return SequenceName{name.substr(0, begin), name.substr(end), end - begin};
}

// The number of a file of the sequence.
std::optional<std::uint64_t> numberIn(const SequenceName& sequence, std::string_view name) {
  if (!name.starts_with(sequence.before) || !name.ends_with(sequence.after) ||
      name.size() < sequence.before.size() + sequence.after.size() + sequence.digits)
    return std::nullopt;
  name.remove_prefix(sequence.before.size());
  name.remove_suffix(sequence.after.size());
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool isWhole = error == std::errc() && end == name.data() + name.size();
  return isWhole ? std::optional(number) : std::nullopt;
}

class SequenceFrames final : public ForeignFrames {
 public:
  static Result<std::unique_ptr<ForeignFrames>> open(const fs::path& path, const ForeignReading& reading) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const SequenceName name = *sequenceNameOf(path);
    std::map<std::uint64_t, fs::path> files;
    std::error_code code;
    for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code))
      if (const auto number = numberIn(name, entry->path().filename().string()))
        files[*number] = entry->path();
    if (code)
      return Error{fmt::format("{}: cannot list its folder: {}", path.string(), code.message()),
                   Fault::input};
    if (files.empty())
      return Error{fmt::format("{}: there is no such file with a number of {} digits or more in place of #",
                               path.string(), name.digits),
                   Fault::input};
    auto self = std::make_unique<SequenceFrames>();
    for (auto& [number, file] : files) {
      if (!self->files_.empty() && number != files.begin()->first + self->files_.size())
        return Error{fmt::format("{}: number {} is missing between {} and {}", path.string(),
                                 files.begin()->first + self->files_.size(), files.begin()->first,
                                 files.rbegin()->first)};
      self->files_.push_back(std::move(file));
    }
    self->frameCount_ = static_cast<int>(self->files_.size());
    self->framesPerSecond_ = reading.framesPerSecond;
    self->formatName_ = fmt::format("sequence of {} files", endingOf(path));
    self->formatKey_ = "sequence";
    return std::unique_ptr<ForeignFrames>(std::move(self));
  }

  Result<LoadedGroom> frame(int frame, const GroomReading& reading) override {
    return readGroom(files_[static_cast<std::size_t>(frame - 1)], reading);
  }

 private:
  std::vector<fs::path> files_{};
};

// --- A point cache.

class CachedFrames final : public ForeignFrames {
 public:
  static Result<std::unique_ptr<ForeignFrames>> open(const fs::path& path, const ForeignReading& reading) {
    auto samples = readPointCache(path, reading.framesPerSecond);
    if (!samples) return samples.error();
    fs::path groom = reading.groom;
    std::error_code code;
    if (groom.empty()) groom = fs::path(path).replace_extension(".obj");
    if (reading.groom.empty() && !fs::exists(groom, code))
      return Error{fmt::format(
          "{}: holds points without strands; expected the groom whose points they are, {} or another that is named",
          path.string(), groom.string())};
    auto self = std::make_unique<CachedFrames>();
    self->path_ = path;
    self->groom_ = std::move(groom);
    self->frameCount_ = static_cast<int>(samples->seconds.size());
    const std::vector<double>& seconds = samples->seconds;
    self->framesPerSecond_ =
        seconds.size() > 1 ? niceRate(static_cast<double>(seconds.size() - 1) / (seconds.back() - seconds[0]))
                           : reading.framesPerSecond;
    self->samples_ = std::move(*samples);
    self->formatKey_ = endingOf(path).substr(1);
    self->formatName_ = self->formatKey_ == "pc2" ? "PC2" : "MDD";
    return std::unique_ptr<ForeignFrames>(std::move(self));
  }

  Result<LoadedGroom> frame(int frame, const GroomReading& reading) override {
    if (!rest_) {
      auto rest = readGroom(groom_, reading);
      if (!rest) return rest.error();
      if (rest->groom.points.size() != samples_.pointCount)
        return Error{fmt::format("{}: has {} points, and the groom {} has {}; expected as many",
                                 path_.string(), samples_.pointCount, groom_.string(),
                                 rest->groom.points.size())};
      rest_ = std::move(*rest);
    }
    LoadedGroom posed = *rest_;
    const auto from =
        samples_.points.begin() +
        static_cast<std::ptrdiff_t>((frame - 1) * static_cast<std::int64_t>(samples_.pointCount));
    posed.groom.points.assign(from, from + static_cast<std::ptrdiff_t>(samples_.pointCount));
    return posed;
  }

 private:
  fs::path path_, groom_;
  PointSamples samples_{};
  std::optional<LoadedGroom> rest_{};
};

}  // namespace

bool isSequence(const fs::path& path) { return sequenceNameOf(path).has_value() && isGroomFile(path); }

bool holdsForeignFrames(const fs::path& path) {
  if (isSequence(path) || isPointCache(path)) return true;
  std::error_code code;
  if (!isOfCurves(path) || !fs::is_regular_file(path, code)) return false;
  try {
    const auto groom = MovingGroom::open(path);
    return groom && groom->seconds().size() > 1;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

Result<std::unique_ptr<ForeignFrames>> openForeignFrames(const fs::path& path,
                                                         const ForeignReading& reading) {
  if (isSequence(path)) return SequenceFrames::open(path, reading);
  if (isPointCache(path)) return CachedFrames::open(path, reading);
  if (isOfCurves(path)) return CurveFrames::open(path);
  return Error{fmt::format(
      "{}: cannot read an animation: its name must end in {}, or in one of these and .partial; another program's "
      "in .usda, .usdc, .usd, .usdz, .abc, .pc2 or .mdd, or have # in place of a frame's digits",
      path.string(), animationEndings(&AnimationFormat::isRead, "or"))};
}

}  // namespace ringlet
