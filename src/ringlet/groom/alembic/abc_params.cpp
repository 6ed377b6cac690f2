// Implements groom/alembic/abc_params.h.
#include "ringlet/groom/alembic/abc_params.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>
#include <vector>

namespace ringlet {
namespace {

constexpr std::size_t kMostWidth = 4;
constexpr double kMostExact = 9007199254740992.0;  // 2^53, of integers as doubles
constexpr std::size_t kParamCost = 64;             // of a value without numbers
constexpr std::size_t kTextCost = 4;               // of a text's byte, whose string is larger than a number

// An array, and what it is indexed by.
struct AbcParamSource {
  AbcProperty values{}, indices{};
  bool isIndexed = false;
  std::string_view metadata{};  // that says the scope
};

// Nothing where it is no parameter, or moves.
std::optional<AbcParamSource> sourceOf(const AbcArchive& archive, const AbcProperty& property,
                                       AbcBudget& budget) {
  AbcParamSource source{.values = property, .metadata = property.metadata};
  if (property.kind == AbcKind::compound) {
    const auto parts = archive.propertiesOf(property);
    if (!parts) budget.fail(parts.error());
    if (!parts || !budget.take(parts->size())) return std::nullopt;
    const AbcProperty* values = abcPropertyNamed(*parts, ".vals");
    const AbcProperty* indices = abcPropertyNamed(*parts, ".indices");
    if (!values || !indices) return std::nullopt;
    source.values = *values;
    source.indices = *indices;
    source.isIndexed = true;
    if (indices->sampleCount == 0 || indices->isChanging() || indices->width != 1) return std::nullopt;
  }
  const bool isThere = source.values.kind != AbcKind::compound && source.values.sampleCount > 0;
  if (!isThere || source.values.isChanging()) return std::nullopt;
  return source;
}

std::string_view interpolationOfScope(std::string_view scope) {
  if (scope == "con") return "constant";
  if (scope == "uni") return "uniform";
  if (scope == "var") return "varying";
  return scope == "vtx" || scope == "fvr" ? "vertex" : "";
}

// "color", "vector", "": what three or four floats are.
std::string_view roleOf(std::string_view interpretation, unsigned width) {
  if (interpretation == (width == 3 ? "rgb" : "rgba")) return "color";
  for (const std::string_view role : {"vector", "normal", "point"})
    if (width == 3 && interpretation == role) return role;
  return "";
}

std::string typeOf(const AbcProperty& property, std::string_view interpretation, std::string_view name) {
  const unsigned width = property.width;
  const std::string count = width > 1 ? std::to_string(width) : "";
  switch (property.type) {
    case AbcType::boolean:
      return width > 1 ? "int" + count + "[]" : "bool[]";
    case AbcType::u32:
    case AbcType::u64:
    case AbcType::i64:
      return width > 1 ? "int" + count + "[]" : "int64[]";
    case AbcType::text:
      return "string[]";
    case AbcType::f16:
    case AbcType::f32:
    case AbcType::f64:
      break;
    default:
      return "int" + count + "[]";
  }
  const bool isHalf = property.type == AbcType::f16, isDouble = property.type == AbcType::f64;
  const char* letter = isHalf ? "h" : isDouble ? "d" : "f";
  if (name == "uv" && width == 2) return fmt::format("texCoord2{}[]", letter);
  const std::string_view role = roleOf(interpretation, width);
  if (!role.empty()) return fmt::format("{}{}{}[]", role, count, letter);
  return fmt::format("{}{}[]", isHalf ? "half" : isDouble ? "double" : "float", count);
}

// A name in USD: letters, digits and _, and no digit first.
std::string valueNameOf(std::string_view name) {
  if (name == "width") return "widths";
  if (name == "uv") return "primvars:st";
  if (name == ".velocities") name.remove_prefix(1);
  std::string own;
  for (const char c : name) {
    const bool isKept =
        static_cast<unsigned char>(c) < 128 && std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (own.empty() && c >= '0' && c <= '9') own += '_';
    own += isKept ? c : '_';
  }
  return "primvars:" + own;
}

// Elements by their places in the values; false: one of no value.
bool placesOf(const AbcArchive& archive, const AbcParamSource& source, std::size_t valueCount,
              std::vector<std::size_t>& places) {
  if (!source.isIndexed) {
    for (std::size_t k = 0; k < valueCount; ++k) places.push_back(k);
    return true;
  }
  const auto indices = archive.stored(source.indices, 0);
  if (!indices) return false;
  for (std::size_t k = 0; k < indices->numberCount(); ++k) {
    const double index = indices->number(k);
    if (!(index >= 0 && index < static_cast<double>(valueCount)) || index != std::floor(index)) return false;
    places.push_back(static_cast<std::size_t>(index));
  }
  return true;
}

// Of what the indices repeat.
std::size_t costOfIndices(const AbcArchive& archive, const AbcParamSource& source,
                          const std::vector<std::string_view>& texts) {
  if (!source.isIndexed) return 0;
  const auto indices = archive.stored(source.indices, 0);
  std::size_t most = source.values.width;
  for (const std::string_view text : texts) most = std::max(most, kTextCost * (text.size() + 1));
  return indices ? indices->numberCount() * most : 0;
}

// False: one that no double is.
bool appendNumbers(const AbcSample& sample, std::size_t place, std::size_t width, std::vector<double>& into) {
  const bool isWhole = sample.type() < AbcType::f16;
  for (std::size_t k = 0; k < width; ++k) {
    const double number = sample.number(place * width + k);
    if (isWhole && std::abs(number) > kMostExact) return false;
    into.push_back(number);
  }
  return true;
}

}  // namespace

AbcBudget::AbcBudget(const AbcArchive& archive) : archive_(archive), left_(archive.mostNumbers()) {}

bool AbcBudget::take(std::size_t count) {
  if (count > left_)
    fail(Error{fmt::format(
        "{}: its objects share more than is read of a file of {} bytes; expected at most {} numbers in all",
        archive_.name(), archive_.byteCount(), archive_.mostNumbers())});
  left_ -= std::min(count, left_);
  return static_cast<bool>(state_);
}

std::optional<AbcParam> readAbcParam(const AbcArchive& archive, const AbcProperty& property,
                                     AbcBudget& budget) {
  if (!budget.take(kParamCost)) return std::nullopt;
  const auto source = sourceOf(archive, property, budget);
  if (!source || source->values.width > kMostWidth) return std::nullopt;
  const auto sample = archive.stored(source->values, 0);
  const bool isText = source->values.type == AbcType::text;
  if (!sample || (isText && source->values.width > 1)) return std::nullopt;
  if (!budget.take(isText ? kTextCost * sample->bytes().size() : sample->numberCount())) return std::nullopt;
  const std::vector<std::string_view> texts = sample->texts();
  if (!budget.take(costOfIndices(archive, *source, texts))) return std::nullopt;
  std::vector<std::size_t> places;
  if (!placesOf(archive, *source, isText ? texts.size() : sample->elementCount(), places))
    return std::nullopt;

  AbcParam param{.width = source->values.width};
  std::string_view meaning = abcValueOf(source->metadata, "interpretation");
  if (meaning.empty()) meaning = abcValueOf(source->values.metadata, "interpretation");
  param.value.name = valueNameOf(property.name);
  param.value.type = typeOf(source->values, meaning, property.name);
  param.value.interpolation = interpolationOfScope(abcValueOf(source->metadata, "geoScope"));
  for (const std::size_t place : places) {
    if (isText) {
      param.value.texts.emplace_back(texts[place]);
    } else if (!appendNumbers(*sample, place, param.width, param.value.numbers)) {
      return std::nullopt;
    }
  }
  return param;
}

}  // namespace ringlet
