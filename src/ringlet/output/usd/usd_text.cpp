// Implements output/usd/usd_text.h.
#include "ringlet/output/usd/usd_text.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

constexpr std::size_t kElementsOfLine = 25;

// Only quotes, backslashes and line breaks end a string before its end.
std::string quotedText(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '\n' ? ' ' : c;
  }
  return quoted + '"';
}

void appendNumber(std::string& text, usdc::Kind kind, double number) {
  const bool isFloat = kind == usdc::Kind::f32 || kind == usdc::Kind::half;
  if (isFloat) {
    fmt::format_to(std::back_inserter(text), "{}", static_cast<float>(number));
  } else if (kind == usdc::Kind::f64) {
    fmt::format_to(std::back_inserter(text), "{}", number);
  } else {
    fmt::format_to(std::back_inserter(text), "{}", static_cast<std::int64_t>(number));
  }
}

// A number, a tuple, or of a matrix a tuple of its rows.
void appendElement(std::string& text, UsdStageType type, const double* numbers) {
  const bool isMatrix = usdc::kTypes[type.number].isMatrix;
  const std::size_t columns = isMatrix ? 4 : type.width();
  RINGLET_ASSERT(!isMatrix || type.width() == 16, "matrices of four rows");
  if (isMatrix) text += "( ";
  for (std::size_t row = 0; row < type.width() / columns; ++row) {
    if (row > 0) text += ", ";
    if (columns > 1) text += '(';
    for (std::size_t column = 0; column < columns; ++column) {
      if (column > 0) text += ", ";
      appendNumber(text, type.kind(), numbers[columns * row + column]);
    }
    if (columns > 1) text += ')';
  }
  if (isMatrix) text += " )";
}

void appendPrim(std::string& text, const UsdStagePrim& prim, std::size_t indent) {
  const std::string blanks(indent, ' ');
  const std::string schemas = usdTextOf(prim.apiSchemas, indent + 4);
  text += fmt::format("\n{}def {} \"{}\"{}\n{}{{\n", blanks, prim.type, prim.name,
                      schemas.empty() ? "" : fmt::format(" (\n{}{})", schemas, blanks), blanks);
  for (const UsdStageAttribute& attribute : prim.attributes) text += usdTextOf(attribute, indent + 4);
  for (const UsdStagePrim& child : prim.children) appendPrim(text, child, indent + 4);
  text += blanks + "}\n";
}

}  // namespace

std::string usdTextOf(const UsdStageAttribute& attribute, std::size_t indent) {
  const auto type = usdTypeOf(attribute.type);
  RINGLET_ASSERT(type, "a type that is written");
  const std::string blanks(indent, ' ');
  std::string text = fmt::format("{}{}{} {} = {}", blanks, attribute.isUniform ? "uniform " : "",
                                 attribute.type, attribute.name, type->isArray ? "[" : "");
  const bool isText = type->kind() == usdc::Kind::token || type->kind() == usdc::Kind::string;
  const std::size_t count = isText ? attribute.texts.size() : attribute.numbers.size() / type->width();
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += i % kElementsOfLine == 0 ? ",\n" + blanks + "    " : ", ";
    if (isText) {
      text += quotedText(attribute.texts[i]);
    } else {
      appendElement(text, *type, attribute.numbers.data() + i * type->width());
    }
  }
  if (type->isArray) text += ']';
  if (!attribute.interpolation.empty())
    text += fmt::format(" (\n{0}    interpolation = \"{1}\"\n{0})", blanks, attribute.interpolation);
  return text + '\n';
}

std::string usdTextOf(const std::vector<std::string>& apiSchemas, std::size_t indent) {
  if (apiSchemas.empty()) return "";
  std::string list;
  for (const std::string& schema : apiSchemas) list += (list.empty() ? "" : ", ") + quotedText(schema);
  return fmt::format("{}prepend apiSchemas = [{}]\n", std::string(indent, ' '), list);
}

std::string usdTextOf(const UsdStage& stage) {
  RINGLET_ASSERT(stage.frameCount == 0, "a stage of what rests");
  std::string text = fmt::format("#usda 1.0\n(\n    defaultPrim = \"{}\"\n    metersPerUnit = {}\n",
                                 stage.defaultPrim, stage.metresPerUnit);
  if (stage.up) text += fmt::format("    upAxis = \"{}\"\n", *stage.up == UpAxis::y ? 'Y' : 'Z');
  text += ")\n";
  for (const UsdStagePrim& prim : stage.prims) appendPrim(text, prim, 0);
  return text;
}

std::string usdTextOf(const UsdTransform& transform) {
  std::string text = "( ";
  for (const Vec3d row : transform.rows)
    fmt::format_to(std::back_inserter(text), "({}, {}, {}, 0), ", row.x, row.y, row.z);
  fmt::format_to(std::back_inserter(text), "({}, {}, {}, 1) )", transform.move.x, transform.move.y,
                 transform.move.z);
  return text;
}

}  // namespace ringlet
