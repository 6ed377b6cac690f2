// Implements sweep_plan.h.
#include "program/sweep/sweep_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "ringlet/scenes/load/scene_paths.h"

namespace ringlet::program {
namespace {

namespace fs = std::filesystem;

// Splits at separators outside of brackets and quotes.
std::vector<std::string> partsOf(std::string_view text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == separator && depth == 0) {
      parts.emplace_back();
      continue;
    }
    parts.back() += c;
  }
  return parts;
}

template <class Number>
std::optional<Number> numberOf(const std::string& text) {
  Number number{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// The n values of "a:b:n"; none if the text is no such range.
std::optional<std::vector<std::string>> rangeOf(std::string_view text) {
  const std::vector<std::string> parts = partsOf(text, ':');
  if (parts.size() != 3) return std::nullopt;
  const auto low = numberOf<double>(parts[0]), high = numberOf<double>(parts[1]);
  const auto count = numberOf<std::size_t>(parts[2]);
  if (!low || !high || !std::isfinite(*low) || !std::isfinite(*high) || !count) return std::nullopt;
  std::vector<std::string> values;
  for (std::size_t i = 0; i < *count && i <= kMostRuns; ++i) {
    const double share = *count > 1 ? static_cast<double>(i) / static_cast<double>(*count - 1) : 0;
    const double value = i + 1 == *count && *count > 1 ? *high : *low + (*high - *low) * share;
    values.push_back(fmt::format("{:.12g}", value));
  }
  return values;
}

std::string changesText(std::span<const SceneChange> changes) {
  std::vector<std::string> texts;
  for (const SceneChange& change : changes) texts.push_back(fmt::format("{} = {}", change.key, change.value));
  return fmt::format("{}", fmt::join(texts, ", "));
}

Status checkAxes(std::span<const SweepAxis> axes) {
  double count = 1;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    count *= static_cast<double>(axes[i].values.size());
    if (axes[i].key == "output.folder")
      return Error{"a sweep gives each run a folder of its own; leave out output.folder"};
    for (std::size_t k = 0; k < i; ++k) {
      if (axes[k].key == axes[i].key)
        return Error{fmt::format("{} is varied twice; give all its values at once", axes[i].key)};
    }
  }
  if (count > kMostRuns)
    return Error{fmt::format("these are {:.0f} runs; a sweep has {} at most", count, kMostRuns)};
  return {};
}

}  // namespace

Result<SweepAxis> parseAxis(std::string_view typed) {
  const std::size_t equals = typed.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    return Error{fmt::format(
        "'{}' is no key with its values; expected KEY=a:b:n or KEY=v1,v2, as material.dials.hold=0.5:2:5",
        typed)};
  }
  SweepAxis axis{std::string(typed.substr(0, equals)), {}};
  const std::string_view values = typed.substr(equals + 1);
  if (auto range = rangeOf(values)) {
    axis.values = std::move(*range);
  } else {
    axis.values = partsOf(values, ',');
  }
  if (axis.values.empty() || std::ranges::any_of(axis.values, &std::string::empty))
    return Error{fmt::format("'{}' lacks a value; expected KEY=a:b:n or KEY=v1,v2", typed)};
  return axis;
}

Result<std::vector<SweepRun>> planRuns(const fs::path& scene, std::span<const SweepAxis> axes,
                                       SceneReach reach) {
  if (Status checked = checkAxes(axes); !checked) return checked.error();
  std::vector<SweepRun> runs;
  std::vector<std::size_t> at(axes.size(), 0);  // index into the values of each axis
  for (bool isDone = false; !isDone;) {
    SweepRun run{static_cast<int>(runs.size()) + 1, {}, {}};
    for (std::size_t i = 0; i < axes.size(); ++i) run.changes.push_back({axes[i].key, axes[i].values[at[i]]});
    auto read = readScene(scene, run.changes, reach);
    if (!read) {
      return Error{fmt::format("{} (with {})", read.error().message, changesText(run.changes)),
                   read.error().fault};
    }
    run.scene = std::move(*read);
    run.scene.output.folder.clear();
    makePathsAbsolute(run.scene);
    runs.push_back(std::move(run));
    // Counts up with the last axis fastest.
    isDone = true;
    for (std::size_t i = axes.size(); i-- > 0 && isDone;) {
      at[i] = (at[i] + 1) % axes[i].values.size();
      isDone = at[i] == 0;
    }
  }
  return runs;
}

std::string shortName(const SweepAxis& axis, std::span<const SweepAxis> axes) {
  const auto lastWord = [](const std::string& key) { return key.substr(key.rfind('.') + 1); };
  const std::string name = lastWord(axis.key);
  const auto count =
      std::ranges::count_if(axes, [&](const SweepAxis& other) { return lastWord(other.key) == name; });
  return count > 1 ? axis.key : name;
}

std::string valuesText(const SweepRun& run, std::span<const SweepAxis> axes) {
  const bool someVary =
      std::ranges::any_of(axes, [](const SweepAxis& axis) { return axis.values.size() > 1; });
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].values.size() > 1 || !someVary)
      texts.push_back(fmt::format("{} = {}", shortName(axes[i], axes), run.changes[i].value));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace ringlet::program
