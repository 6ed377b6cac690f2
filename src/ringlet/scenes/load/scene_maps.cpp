// Implements scenes/load/scene_maps.h.
#include "ringlet/scenes/load/scene_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <memory>
#include <optional>

#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/scenes/load/scene_parts.h"
#include "ringlet/scenes/load/strand_values.h"

namespace ringlet {
namespace {

constexpr std::string_view kBlank = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

template <class Number>
std::optional<Number> numberOf(std::string_view text) {
  text = trimmed(text);
  Number number{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<std::uint32_t> strandOf(std::string_view text) {
  const auto strand = numberOf<std::uint32_t>(text);
  return strand && *strand <= kMostMappedStrand ? strand : std::nullopt;
}

// What stands before a mark, and all after it.
std::pair<std::string_view, std::string_view> splitAt(std::string_view text, char mark) {
  const std::size_t at = std::min(text.find(mark), text.size());
  return {text.substr(0, at), text.substr(std::min(at + 1, text.size()))};
}

using Runs = std::vector<StrandRun>;

// Sorted, unless a strand is in two of them.
Result<Runs> sorted(Runs runs) {
  std::ranges::sort(runs, {}, &StrandRun::first);
  for (std::size_t i = 1; i < runs.size(); ++i) {
    if (runs[i].first <= runs[i - 1].last)
      return Error{fmt::format("strand {} is there twice", runs[i].first)};
  }
  return runs;
}

Result<Runs> runsOfFile(const std::filesystem::path& path) {
  const auto bytes = readWholeFile(path);
  if (!bytes) return bytes.error();
  auto runs = parseStrandFactors({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (!runs) return Error{fmt::format("{}: {}", path.string(), runs.error().message)};
  return runs;
}

// A groom that is read once, when a map asks for what its file says of curves.
class GroomValues {
 public:
  explicit GroomValues(const SceneGroom& scene) : scene_(&scene) {}

  Result<Runs> runsOf(const SceneMap& map) {
    if (!groom_) {
      if (scene_->file.empty())
        return Error{"primvars and UVs are of USD and Alembic grooms; this one is generated"};
      auto read = readGroom(scene_->file, readingOf(*scene_, true));
      if (!read) return read.error();
      groom_.emplace(std::move(*read));
    }
    const auto values = map.texture.empty() ? valuesOfPrimvar(*groom_, map.primvar)
                                            : valuesOfTexture(*groom_, map.texture, map.uv);
    if (!values) return values.error();
    Runs runs;
    for (std::size_t s = 0; s < values->size(); ++s) {
      const double factor = map.low + (map.high - map.low) * (*values)[s];
      if (!(factor <= kMostStrandFactor))
        return Error{fmt::format("strand {} has the factor {}; expected one of at most {}", s, factor,
                                 kMostStrandFactor)};
      const auto strand = static_cast<std::uint32_t>(s);
      const auto bounded = static_cast<float>(std::max(factor, kLeastStrandFactor));
      if (!runs.empty() && runs.back().factor == bounded) {
        runs.back().last = strand;
      } else {
        runs.push_back({strand, strand, bounded});
      }
    }
    return runs;
  }

 private:
  const SceneGroom* scene_;
  std::optional<LoadedGroom> groom_;
};

// The numbers that a map is of, each with its factor.
Result<std::vector<std::pair<double Material::*, double>>> numbersOf(const SceneMap& map,
                                                                     const Material& base) {
  std::vector<std::pair<double Material::*, double>> numbers;
  const std::optional<Material> preset = materialPreset(map.preset);
  for (const Parameter<Material>& parameter : mappedParameters()) {
    const auto member = std::get<double Material::*>(parameter.member);
    if (parameter.key == map.number) numbers.emplace_back(member, map.factor);
    if (!preset || (*preset).*member == base.*member) continue;
    if (base.*member == 0)
      return Error{
          fmt::format("a map cannot make {} of a material whose {} is 0", map.preset, parameter.key)};
    numbers.emplace_back(member, (*preset).*member / (base.*member));
  }
  return numbers;
}

// factor: where the map names strands.
Result<Runs> runsOf(const SceneMap& map, double factor, const SceneFile& scene, GroomValues& groom) {
  if (!map.file.empty()) return runsOfFile(map.file);
  return map.strands.empty() ? groom.runsOf(map) : parseStrands(map.strands, factor, scene.groups);
}

}  // namespace

std::span<const Parameter<Material>> mappedParameters() {
  static const std::vector<Parameter<Material>> all = [] {
    std::vector<Parameter<Material>> own;
    for (const Parameter<Material>& parameter : materialParameters()) {
      for (const char* key : {"line_density", "stretch_stiffness", "stretch_damping_time", "bend_stiffness",
                              "bend_damping_ratio", "core_stiffness", "core_damping_ratio"})
        if (parameter.key == std::string_view(key)) own.push_back(parameter);
    }
    return own;
  }();
  return all;
}

Result<std::vector<StrandRun>> parseStrands(std::string_view text, double factor,
                                            std::span<const SceneGroup> groups) {
  Runs runs;
  while (!text.empty()) {
    const auto [word, rest] = splitAt(text, ',');
    text = rest;
    const auto group = std::ranges::find(groups, trimmed(word), &SceneGroup::name);
    if (group != groups.end()) {
      const auto before = groups.first(static_cast<std::size_t>(group - groups.begin()));
      const auto named = parseStrands(group->strands, factor, before);
      if (!named) return named.error();
      runs.insert(runs.end(), named->begin(), named->end());
      continue;
    }
    const auto [low, high] = splitAt(word, ':');
    const bool isRange = word.find(':') != std::string_view::npos;
    const auto first = strandOf(low), last = isRange ? strandOf(high) : first;
    if (!first || !last || *last < *first)
      return Error{fmt::format("found {}; expected strands from 0 to {}, as 0:99, 120{}",
                               ringlet::quoted(std::string(trimmed(word))), kMostMappedStrand,
                               groups.empty() ? "" : ", or the name of a group")};
    runs.push_back({*first, *last, static_cast<float>(factor)});
  }
  return sorted(std::move(runs));
}

Result<std::vector<StrandRun>> parseStrandFactors(std::string_view text) {
  Runs runs;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const auto [whole, rest] = splitAt(text, '\n');
    text = rest;
    const std::string_view words = trimmed(splitAt(whole, '#').first);
    const bool isWord = !words.empty() && std::isalpha(static_cast<unsigned char>(words.front())) != 0;
    if (words.empty() || (line == 1 && isWord)) continue;  // the columns' names
    const auto [name, value] = splitAt(words, ',');
    const auto strand = strandOf(name);
    const auto factor = numberOf<double>(value);
    if (!strand || !factor || !(*factor >= kLeastStrandFactor && *factor <= kMostStrandFactor))
      return Error{fmt::format(
          "line {}: found {}; expected a strand from 0 to {} and a factor from {} to {}, as 12,0.5", line,
          ringlet::quoted(std::string(words)), kMostMappedStrand, kLeastStrandFactor, kMostStrandFactor)};
    runs.push_back({*strand, *strand, static_cast<float>(*factor)});
  }
  return sorted(std::move(runs));
}

Status checkStrands(const SceneMap& map, const SceneFile& scene) {
  GroomValues groom(scene.groom);
  const auto runs = runsOf(map, map.factor, scene, groom);
  return runs ? Status{} : Status(runs.error());
}

Result<std::vector<float>> factorsOf(std::string_view number, const SceneFile& scene,
                                     std::size_t strandCount) {
  std::vector<float> factors;
  GroomValues groom(scene.groom);
  for (const SceneMap& map : scene.maps) {
    if (map.number != number) continue;
    const auto runs = runsOf(map, map.factor, scene, groom);
    if (!runs) return runs.error();
    factors.resize(strandCount, 1);
    for (const StrandRun& run : *runs) {
      if (run.last >= strandCount)
        return Error{fmt::format("a map of {} names strand {}; the groom has {}, numbered from 0", number,
                                 run.last, strandCount)};
      for (std::uint32_t s = run.first; s <= run.last; ++s) factors[s] *= run.factor;
    }
  }
  return factors;
}

Status applyMaps(std::span<const SceneMap> maps, const SceneFile& scene, Material& material) {
  material.factors.clear();
  GroomValues groom(scene.groom);
  for (const SceneMap& map : maps) {
    const auto numbers = numbersOf(map, material);
    if (!numbers) return numbers.error();
    for (const auto& [member, factor] : *numbers) {
      auto runs = runsOf(map, factor, scene, groom);
      if (!runs) return runs.error();
      if (!runs->empty())
        material.factors.push_back({member, std::make_shared<const Runs>(std::move(*runs))});
    }
  }
  return {};
}

}  // namespace ringlet
