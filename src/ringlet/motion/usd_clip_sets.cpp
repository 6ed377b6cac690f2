// Implements motion/usd_clip_sets.h.
#include "ringlet/motion/usd_clip_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "ringlet/base/quoted.h"

namespace ringlet {
namespace {

constexpr double kMostTemplateTimes = 100'000;
constexpr double kMostTime = 1e9;  // of a template's numbers, which become integers
constexpr double kParts = 10'000;  // of a time code, in which a template counts, so that tenths stay tenths

// The numbers of a template: "sim.###.###.usd" is "sim.", 3 digits, 3 more of what follows the point, ".usd".
struct Template {
  std::string before, after;
  std::size_t digits = 0, decimals = 0;

  static std::optional<Template> of(const std::string& path);
  std::string nameAt(double time) const;
};

bool isAllHashes(std::string_view part) { return !part.empty() && part.find_first_not_of('#') == part.npos; }

// Parts between the points of the name, one or two of which are of '#' alone, beside each other.
std::optional<Template> Template::of(const std::string& path) {
  const std::size_t name = path.rfind('/') == path.npos ? 0 : path.rfind('/') + 1;
  Template made;
  std::size_t groups = 0, end = name;
  for (std::size_t at = name; at <= path.size();) {
    const std::size_t stop = std::min(path.find('.', at), path.size());
    const std::string_view part = std::string_view(path).substr(at, stop - at);
    if (isAllHashes(part)) {
      if (++groups == 1) {
        made.before = path.substr(0, at);
        made.digits = part.size();
      } else if (groups == 2 && at == end + 1) {
        made.decimals = part.size();
      } else {
        return std::nullopt;
      }
      end = stop;
    }
    at = stop + 1;
  }
  if (groups == 0) return std::nullopt;
  made.after = path.substr(end);
  return made;
}

std::string Template::nameAt(double time) const {
  const std::string whole = fmt::format("{:0{}d}", static_cast<std::int64_t>(time), digits);
  if (decimals == 0) return before + whole + after;
  const std::string rounded = fmt::format("{:.{}f}", time, decimals);
  return before + whole + rounded.substr(rounded.find('.')) + after;
}

class ScheduleMaker {
 public:
  ScheduleMaker(const UsdPrims& prims, std::uint32_t prim, const UsdClipSet& set, const UsdClipFiles& files)
      : prims_(prims), prim_(prim), set_(set), files_(files) {}

  Result<UsdClipSchedule> make() {
    if (!set_.isDictionary) return wrong("found no dictionary of it; expected one");
    made_.prim = prim_;
    made_.name = set_.name;
    Status read = readPrimPath();
    if (read) read = readGaps();
    // What is stated counts before a template.
    if (read) read = entryOf("assetPaths") ? readStated() : readTemplate();
    if (!read) return read.error();
    return std::move(made_);
  }

 private:
  Error wrong(const std::string& sentence) const {
    return prims_.wrong(prim_, fmt::format("clip set {}: {}", ringlet::quoted(set_.name), sentence));
  }

  const UsdEntry* entryOf(std::string_view key) const {
    const auto found = std::ranges::find(set_.entries, key, &UsdEntry::key);
    const bool isThere = found != set_.entries.end() && !found->value.isBlocked;
    return isThere ? &*found : nullptr;
  }
  static std::string foundIn(const UsdEntry* entry) {
    if (!entry) return "none";
    if (entry->isDictionary) return "a dictionary";
    if (!entry->value.texts.empty()) return fmt::format("{} texts", entry->value.texts.size());
    const std::size_t count = entry->value.numbers.size() / entry->value.width;
    return entry->value.width == 1 ? fmt::format("{} numbers", count)
                                   : fmt::format("{} times {} numbers", count, entry->value.width);
  }

  Result<std::string> textOf(std::string_view key, const char* expected) const {
    const UsdEntry* entry = entryOf(key);
    if (!entry || entry->value.texts.size() != 1)
      return wrong(fmt::format("found {} as {}; expected {}", foundIn(entry), key, expected));
    return std::string(entry->value.texts.front());
  }
  Result<double> numberOf(std::string_view key) const {
    const UsdEntry* entry = entryOf(key);
    if (!entry || entry->value.numbers.size() != 1)
      return wrong(fmt::format("found {} as {}; expected a number", foundIn(entry), key));
    if (!(std::abs(entry->value.numbers.front()) <= kMostTime))
      return wrong(fmt::format("found {} as {}; expected at most {} either way", entry->value.numbers.front(),
                               key, kMostTime));
    return entry->value.numbers.front();
  }
  // Pairs, whose first numbers are times of the stage.
  Result<std::vector<UsdClipKey>> pairsOf(std::string_view key) const {
    const UsdEntry* entry = entryOf(key);
    if (!entry || !entry->value.texts.empty() || entry->isDictionary ||
        (entry->value.width != 2 && !entry->value.numbers.empty()))
      return wrong(fmt::format("found {} as {}; expected pairs of numbers", foundIn(entry), key));
    std::vector<UsdClipKey> pairs;
    for (std::size_t at = 0; at + 2 <= entry->value.numbers.size(); at += 2) {
      pairs.push_back({entry->value.numbers[at], entry->value.numbers[at + 1]});
      if (!std::isfinite(pairs.back().stage) || !std::isfinite(pairs.back().clip))
        return wrong(fmt::format("pair {} of {} is not finite", pairs.size(), key));
    }
    return pairs;
  }

  Status readPrimPath() {
    auto path = textOf("primPath", "the path of a prim in the clips, as in \"/Model\"");
    if (!path) return path.error();
    if (!path->starts_with('/') || path->size() == 1 || path->find_first_of(".{[<") != path->npos)
      return wrong(
          fmt::format("found {} as primPath; expected the path of a prim in the clips, as in \"/Model\"",
                      ringlet::quoted(*path)));
    made_.primPath = std::move(*path);
    return {};
  }

  Status readGaps() {
    if (!entryOf("interpolateMissingClipValues")) return {};
    const auto number = numberOf("interpolateMissingClipValues");
    if (!number) return number.error();
    made_.fillsGaps = *number != 0;
    return {};
  }

  Status readStated() {
    const UsdEntry* paths = entryOf("assetPaths");
    if (paths->value.texts.empty())
      return wrong(fmt::format("found {} as assetPaths; expected files", foundIn(paths)));
    made_.files.assign(paths->value.texts.begin(), paths->value.texts.end());
    for (const std::string& file : made_.files)
      if (Status allowed = files_.check(file); !allowed) return wrong(allowed.error().message);
    if (Status read = readActive(); !read) return read;
    return entryOf("times") ? readTimes() : Status{};
  }

  Status readActive() {
    const auto active = pairsOf("active");
    if (!active) return active.error();
    if (active->empty()) return wrong("found no pairs as active; expected one or more");
    for (const UsdClipKey& pair : *active) {
      const auto count = static_cast<double>(made_.files.size());
      if (!(pair.clip >= 0 && pair.clip < count) || pair.clip != std::floor(pair.clip))
        return wrong(fmt::format("active has clip {} at time {}; expected 0 to {}, of its {} assetPaths",
                                 pair.clip, pair.stage, count - 1, count));
      if (!made_.ranges.empty() && !(pair.stage > made_.ranges.back().from))
        return wrong(fmt::format("active has time {} after {}; expected times that rise", pair.stage,
                                 made_.ranges.back().from));
      made_.ranges.push_back({pair.stage, static_cast<std::size_t>(pair.clip)});
    }
    return {};
  }

  Status readTimes() {
    auto times = pairsOf("times");
    if (!times) return times.error();
    for (std::size_t k = 1; k < times->size(); ++k) {
      const double before = (*times)[k - 1].stage, now = (*times)[k].stage;
      if (now < before)
        return wrong(fmt::format("times has time {} after {}; expected times that rise", now, before));
      if (k > 1 && now == (*times)[k - 2].stage)
        return wrong(
            fmt::format("times has time {} three times; expected it once, or twice for a jump", now));
    }
    made_.knots = std::move(*times);
    return {};
  }

  Status readTemplate() {
    const auto path = textOf("templateAssetPath", "it, or assetPaths");
    if (!path) return path.error();
    if (Status allowed = files_.check(*path); !allowed) return wrong(allowed.error().message);
    const auto form = Template::of(*path);
    if (!form)
      return wrong(
          fmt::format("found {} as templateAssetPath; expected one group of '#' between points in the "
                      "file's name, or two beside each other, as in clip.###.usd",
                      ringlet::quoted(*path)));
    const auto start = numberOf("templateStartTime"), end = numberOf("templateEndTime"),
               stride = numberOf("templateStride");
    for (const auto* number : {&start, &end, &stride})
      if (!*number) return number->error();
    if (!(*stride > 0 && *start <= *end))
      return wrong(
          fmt::format("its template goes from {} to {} by {}; expected an end that is no earlier, and "
                      "steps above 0",
                      *start, *end, *stride));
    if ((*end - *start) / *stride > kMostTemplateTimes)
      return wrong(fmt::format("its template has {:.0f} times; expected at most {}",
                               (*end - *start) / *stride, kMostTemplateTimes));
    const auto offset = offsetOf(*stride);
    if (!offset) return offset.error();
    addTemplateFiles(*form, *start, *end, *stride, *offset);
    if (made_.files.empty())
      return wrong(fmt::format("found no file of {}, from {} to {} by {}", files_.pathOf(*path), *start, *end,
                               *stride));
    return {};
  }

  Result<std::optional<double>> offsetOf(double stride) const {
    if (!entryOf("templateActiveOffset")) return std::optional<double>{};
    const auto offset = numberOf("templateActiveOffset");
    if (!offset) return offset.error();
    if (std::abs(*offset) > stride)
      return wrong(fmt::format("found {} as templateActiveOffset; expected at most {} either way, its stride",
                               *offset, stride));
    return std::optional(*offset);
  }

  // A file of time t holds from t on, or from the offset after it, and has the stage's time. With an offset
  // times go on by as much before the first and after the last.
  void addTemplateFiles(const Template& form, double start, double end, double stride,
                        std::optional<double> offset) {
    const double margin = std::abs(offset.value_or(0)) * kParts;
    const auto addKnot = [&](double time) {
      if (made_.knots.empty() || time > made_.knots.back().stage) made_.knots.push_back({time, time});
    };
    if (offset) addKnot((start * kParts - margin) / kParts);
    for (double part = start * kParts; part <= end * kParts; part += stride * kParts) {
      const double time = part / kParts;
      std::string name = form.nameAt(time);
      if (!files_.has(name)) continue;
      made_.ranges.push_back({(part + offset.value_or(0) * kParts) / kParts, made_.files.size()});
      made_.files.push_back(std::move(name));
      addKnot(time);
    }
    if (offset) addKnot((end * kParts + margin) / kParts);
  }

  const UsdPrims& prims_;
  std::uint32_t prim_;
  const UsdClipSet& set_;
  const UsdClipFiles& files_;
  UsdClipSchedule made_{};
};

// Names of sets, the first of which counts most: by the alphabet, and then as `clipSets` change that.
std::vector<std::string_view> orderedSets(const UsdPrim& prim) {
  std::set<std::string_view> all;
  for (const UsdClipSet& set : prim.clips) all.insert(set.name);
  std::vector<std::string_view> order(all.begin(), all.end());
  for (const UsdNameEdit& edit : prim.clipSets) {
    std::vector<std::string_view> names;
    for (const std::string_view name : edit.names)
      if (all.contains(name) && std::ranges::find(names, name) == names.end()) names.push_back(name);
    if (edit.edit == "add")  // what is there stays where it is
      std::erase_if(names, [&](auto name) { return std::ranges::find(order, name) != order.end(); });
    std::erase_if(
        order, [&](auto name) { return edit.edit.empty() || std::ranges::find(names, name) != names.end(); });
    if (edit.edit == "delete") continue;
    const bool isFirst = edit.edit == "prepend" || edit.edit == "reorder";
    order.insert(isFirst ? order.begin() : order.end(), names.begin(), names.end());
  }
  return order;
}

}  // namespace

Result<std::vector<UsdClipSchedule>> clipSchedulesOf(const UsdPrims& prims, std::uint32_t prim,
                                                     const UsdClipFiles& files) {
  std::vector<UsdClipSchedule> schedules;
  for (const std::string_view name : orderedSets(prims[prim])) {
    const auto set = std::ranges::find(prims[prim].clips, name, &UsdClipSet::name);
    auto schedule = ScheduleMaker(prims, prim, *set, files).make();
    if (!schedule) return schedule.error();
    schedules.push_back(std::move(*schedule));
  }
  return schedules;
}

}  // namespace ringlet
