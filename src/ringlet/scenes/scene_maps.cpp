// Implements scenes/scene_maps.h.
#include "ringlet/scenes/scene_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <memory>
#include <optional>

#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/rest/material_presets.h"

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

using Factors = std::vector<float>;

void multiply(Factors& factors, std::uint32_t strand, double factor) {
  if (factors.size() <= strand) factors.resize(strand + 1, 1.0f);
  factors[strand] = static_cast<float>(factors[strand] * factor);
}

Result<Factors> factorsOfFile(const std::filesystem::path& path) {
  const auto bytes = readWholeFile(path);
  if (!bytes) return bytes.error();
  auto factors = parseStrandFactors({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (!factors) return Error{fmt::format("{}: {}", path.string(), factors.error().message)};
  return factors;
}

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

Result<std::vector<StrandRange>> parseStrands(std::string_view text) {
  std::vector<StrandRange> ranges;
  while (!text.empty()) {
    const auto [word, rest] = splitAt(text, ',');
    text = rest;
    const auto [low, high] = splitAt(word, ':');
    const bool isRange = word.find(':') != std::string_view::npos;
    const auto first = strandOf(low), last = isRange ? strandOf(high) : first;
    if (!first || !last || *last < *first)
      return Error{fmt::format("found {}; expected strands from 0 to {}, as 0:99, 120",
                               ringlet::quoted(std::string(trimmed(word))), kMostMappedStrand)};
    ranges.push_back({*first, *last});
  }
  return ranges;
}

Result<std::vector<float>> parseStrandFactors(std::string_view text) {
  Factors factors;
  std::vector<bool> isThere;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const auto [whole, rest] = splitAt(text, '\n');
    text = rest;
    const std::string_view words = trimmed(splitAt(whole, '#').first);
    if (words.empty()) continue;
    const auto [name, value] = splitAt(words, ',');
    const auto strand = strandOf(name);
    const auto factor = numberOf<double>(value);
    const bool isWord = std::isalpha(static_cast<unsigned char>(words.front())) != 0;
    if (line == 1 && isWord) continue;  // the columns' names
    if (!strand || !factor || !(*factor >= kLeastStrandFactor && *factor <= kMostStrandFactor))
      return Error{
          fmt::format("line {}: found {}; expected a strand from 0 to {} and a factor from {} to {}, as "
                      "12,0.5",
                      line, ringlet::quoted(std::string(words)), kMostMappedStrand, kLeastStrandFactor,
                      kMostStrandFactor)};
    if (isThere.size() <= *strand) isThere.resize(*strand + 1);
    if (isThere[*strand]) return Error{fmt::format("line {}: strand {} is there twice", line, *strand)};
    isThere[*strand] = true;
    multiply(factors, *strand, *factor);
  }
  return factors;
}

Status addMaps(std::span<const SceneMap> maps, Material& material) {
  std::vector<std::pair<double Material::*, Factors>> all;
  for (const SceneMap& map : maps) {
    const auto numbers = numbersOf(map, material);
    if (!numbers) return numbers.error();
    for (const auto& [member, factor] : *numbers) {
      auto of = std::ranges::find(all, member, &std::pair<double Material::*, Factors>::first);
      if (of == all.end()) of = all.insert(all.end(), {member, {}});
      if (map.file.empty()) {
        const auto ranges = parseStrands(map.strands);
        if (!ranges) return ranges.error();
        for (const StrandRange& range : *ranges)
          for (std::uint32_t s = range.first; s <= range.last; ++s) multiply(of->second, s, factor);
      } else {
        const auto factors = factorsOfFile(map.file);
        if (!factors) return factors.error();
        for (std::uint32_t s = 0; s < factors->size(); ++s) multiply(of->second, s, (*factors)[s]);
      }
    }
  }
  material.factors.clear();
  for (auto& [member, factors] : all)
    material.factors.push_back({member, std::make_shared<const Factors>(std::move(factors))});
  return {};
}

}  // namespace ringlet
