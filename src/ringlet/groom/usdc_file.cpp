// Implements groom/usdc_file.h.
//
//   byte   0  "PXR-USDC"
//          8  u8 major, minor, patch version
//         16  u64 where the table of contents begins
//             u64 count, and for each section char name[16], u64 begin, u64 size
//
//   TOKENS     u64 count, u64 size, packed: texts that end with NUL
//   STRINGS    u64 count, u32 token[count]
//   FIELDS     u64 count, packed integers: its name's token; packed: u64 value[count]
//   FIELDSETS  u64 count, packed integers: fields, each set ended by -1
//   PATHS      u64 count, u64 of these stored, three times packed integers: path, token (negative: of a
//              property), jump to the next sibling (-2 leaf, -1 child only, 0 sibling only): depth first
//   SPECS      u64 count, three times packed integers: path, first entry of its field set, what it is
//
//   Packed is u64 size and so many bytes (usdc_codec.h). A value is 64 bits: from the top array, inline,
//   packed, five that are 0, 8 of type, 48 of payload: the value itself, or where it begins.
#include "ringlet/groom/usdc_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "ringlet/base/little_endian.h"
#include "ringlet/groom/usdc_codec.h"

namespace ringlet {
namespace {

constexpr std::string_view kMagic = "PXR-USDC";
constexpr std::size_t kHeaderSize = 88, kTableOffset = 16, kSectionSize = 32, kNameSize = 16;
constexpr std::uint32_t kNone = 0xffffffff;
constexpr unsigned kOldestMinor = 4, kNewestMinor = 13;
constexpr std::size_t kMostSections = 64, kMostFieldsOfSpec = 256;
constexpr std::size_t kFewestPacked = 16;  // elements of an array that is packed

// Bounds on what a file unpacks to, of its size. Of people's files structure takes a few bytes a path and the
// points all others; what is equal is stored once, so that a file may have more numbers than bytes.
constexpr std::size_t kTextPerByte = 32, kNumbersPerByte = 16, kFreeText = 1 << 20, kFreeNumbers = 1 << 16,
                      kFreeCount = 4096;

enum class SpecType : std::uint32_t { attribute = 1, prim = 6, root = 7, last = 11 };
constexpr std::uint32_t kSpecifierType = 42, kTokenVectorType = 41, kSamplesType = 46, kDoubleVectorType = 48,
                        kBlockType = 51, kDictionaryType = 31, kDoubleType = 9, kHalf2Type = 21;

// The fields we look at.
enum class Field : std::uint8_t {
  other,
  specifier,
  typeName,
  active,
  children,
  upAxis,
  metresPerUnit,
  standard,
  samples,
  connection,
  spline,
  composing
};
constexpr std::pair<std::string_view, Field> kFields[] = {{"specifier", Field::specifier},
                                                          {"typeName", Field::typeName},
                                                          {"active", Field::active},
                                                          {"primChildren", Field::children},
                                                          {"upAxis", Field::upAxis},
                                                          {"metersPerUnit", Field::metresPerUnit},
                                                          {"default", Field::standard},
                                                          {"timeSamples", Field::samples},
                                                          {"connectionPaths", Field::connection},
                                                          {"spline", Field::spline},
                                                          {"subLayers", Field::composing},
                                                          {"layerRelocates", Field::composing},
                                                          {"relocates", Field::composing},
                                                          {"references", Field::composing},
                                                          {"payload", Field::composing},
                                                          {"inheritPaths", Field::composing},
                                                          {"specializes", Field::composing},
                                                          {"variantSetNames", Field::composing},
                                                          {"variantSelection", Field::composing},
                                                          {"clips", Field::composing}};

// A type of values: numbers of one kind, so many an element; or texts.
enum class Kind : std::uint8_t { none, boolean, u8, i32, u32, i64, u64, half, f32, f64, token, string };
struct Type {
  Kind kind = Kind::none;
  std::uint8_t width = 1;
  bool isQuaternion = false, isMatrix = false;
};
constexpr std::array<Type, 31> kTypes = {{{},
                                          {Kind::boolean},
                                          {Kind::u8},
                                          {Kind::i32},
                                          {Kind::u32},
                                          {Kind::i64},
                                          {Kind::u64},
                                          {Kind::half},
                                          {Kind::f32},
                                          {Kind::f64},
                                          {Kind::string},
                                          {Kind::token},
                                          {},
                                          {Kind::f64, 4, false, true},
                                          {Kind::f64, 9, false, true},
                                          {Kind::f64, 16, false, true},
                                          {Kind::f64, 4, true},
                                          {Kind::f32, 4, true},
                                          {Kind::half, 4, true},
                                          {Kind::f64, 2},
                                          {Kind::f32, 2},
                                          {Kind::half, 2},
                                          {Kind::i32, 2},
                                          {Kind::f64, 3},
                                          {Kind::f32, 3},
                                          {Kind::half, 3},
                                          {Kind::i32, 3},
                                          {Kind::f64, 4},
                                          {Kind::f32, 4},
                                          {Kind::half, 4},
                                          {Kind::i32, 4}}};

std::size_t sizeOf(Kind kind) {
  switch (kind) {
    case Kind::boolean:
    case Kind::u8:
      return 1;
    case Kind::half:
      return 2;
    case Kind::i64:
    case Kind::u64:
    case Kind::f64:
      return 8;
    default:
      return 4;
  }
}

double fromHalf(std::uint32_t bits) {
  const std::uint32_t exponent = bits >> 10 & 31, digits = bits & 1023;
  const double size = exponent == 31  ? (digits ? std::nan("") : HUGE_VAL)
                      : exponent == 0 ? std::ldexp(digits, -24)
                                      : std::ldexp(1024 + digits, static_cast<int>(exponent) - 25);
  return bits >> 15 & 1 ? -size : size;
}

// The 64 bits of a value.
struct Rep {
  std::uint64_t bits = 0;

  bool isArray() const { return bits >> 63 & 1; }
  bool isInline() const { return bits >> 62 & 1; }
  bool isPacked() const { return bits >> 61 & 1; }
  bool isKnown() const { return (bits >> 56 & 31) == 0; }
  std::uint32_t type() const { return static_cast<std::uint32_t>(bits >> 48 & 255); }
  std::uint64_t payload() const { return bits & 0xffffffffffff; }
  std::uint32_t low() const { return static_cast<std::uint32_t>(bits); }
};

// A path, and whether something is there.
struct Path {
  std::uint32_t parent = kNone, token = 0;
  std::uint32_t firstField = kNone;  // into the field sets
  std::uint8_t spec = 0;             // 0: none
  bool isFound = false, isProperty = false, isVisited = false;
};

struct Child {
  std::uint32_t parent, token, path;
  bool isProperty;
  auto key() const { return std::tuple(parent, isProperty, token); }
};

class CrateReader {
 public:
  CrateReader(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  Result<UsdLayer> read() {
    for (const auto part : {&CrateReader::readHeader, &CrateReader::readTokens, &CrateReader::readStrings,
                            &CrateReader::readFields, &CrateReader::readFieldSets, &CrateReader::readPaths,
                            &CrateReader::readSpecs, &CrateReader::readPrims}) {
      if (Status read = (this->*part)(); !read) return read.error();
    }
    layer_.text = std::move(text_);
    return std::move(layer_);
  }

 private:
  // --- Bytes.

  Error wrong(std::uint64_t at, const std::string& found, const std::string& expected) const {
    return Error{fmt::format("{}: at byte {}: found {}; expected {}", name_, at, found, expected)};
  }
  Error ended(std::uint64_t at, const std::string& what) const {
    return wrong(at, fmt::format("{} that the {} bytes of the file do not hold", what, bytes_.size()),
                 "a whole file");
  }
  bool has(std::uint64_t at, std::uint64_t count) const {
    return at <= bytes_.size() && count <= bytes_.size() - at;
  }
  std::size_t mostOf(std::size_t perByte, std::size_t free) const { return perByte * bytes_.size() + free; }

  // Reads on within a section.
  struct Cursor {
    std::uint64_t at = 0, end = 0;
    std::uint64_t left() const { return end - at; }
  };

  Result<Cursor> section(std::size_t index) const {
    if (!sections_[index]) return Error{fmt::format("{}: has no section {}", name_, kSections[index])};
    return *sections_[index];
  }
  Result<std::uint64_t> takeU64(Cursor& cursor) const {
    if (cursor.left() < 8) return ended(cursor.at, "a number");
    cursor.at += 8;
    return readU64(bytes_, cursor.at - 8);
  }
  // A count, which may be no more than `most`.
  Result<std::size_t> takeCount(Cursor& cursor, const char* what, std::uint64_t most) const {
    const std::uint64_t at = cursor.at;
    const auto count = takeU64(cursor);
    if (!count) return count.error();
    if (*count > most)
      return wrong(at, fmt::format("{} {}", *count, what),
                   fmt::format("at most {} in so small a file", most));
    return static_cast<std::size_t>(*count);
  }
  Result<std::span<const std::byte>> takePacked(Cursor& cursor) const {
    const auto size = takeU64(cursor);
    if (!size) return size.error();
    if (*size > cursor.left()) return ended(cursor.at, fmt::format("{} packed bytes", *size));
    cursor.at += *size;
    return bytes_.subspan(cursor.at - *size, *size);
  }
  Result<std::vector<std::byte>> takeBytes(Cursor& cursor, std::size_t count) const {
    const std::uint64_t at = cursor.at;
    const auto packed = takePacked(cursor);
    if (!packed) return packed.error();
    if (count == 0) return std::vector<std::byte>{};
    auto bytes = unpackUsdc(*packed, count);
    if (!bytes || bytes->size() != count)
      return wrong(at, "bytes that do not unpack", fmt::format("{} bytes, packed by LZ4", count));
    return std::move(*bytes);
  }
  Result<std::vector<std::int32_t>> takeIntegers(Cursor& cursor, std::size_t count) const {
    const std::uint64_t at = cursor.at;
    const auto packed = takePacked(cursor);
    if (!packed) return packed.error();
    auto values = unpackUsdcIntegers(*packed, count);
    if (!values) return wrong(at, "bytes that do not unpack", fmt::format("{} packed integers", count));
    return std::move(*values);
  }

  // --- The sections.

  static constexpr std::array<std::string_view, 6> kSections{"TOKENS",    "STRINGS", "FIELDS",
                                                             "FIELDSETS", "PATHS",   "SPECS"};

  Status readHeader() {
    if (!isUsdc(bytes_) || bytes_.size() < kHeaderSize)
      return wrong(0, fmt::format("{} bytes", bytes_.size()),
                   fmt::format("a crate's header of {}", kHeaderSize));
    const auto version = [&](std::size_t part) { return std::to_integer<unsigned>(bytes_[8 + part]); };
    minor_ = version(1);
    if (version(0) != 0 || minor_ < kOldestMinor || minor_ > kNewestMinor) {
      return wrong(
          8, fmt::format("version {}.{}.{}", version(0), minor_, version(2)),
          fmt::format("0.{}.0 to 0.{}.0; `usdcat` of another version of USD can write it as text, .usda",
                      kOldestMinor, kNewestMinor));
    }
    const std::uint64_t table = readU64(bytes_, kTableOffset);
    if (table < kHeaderSize || !has(table, 8))
      return ended(kTableOffset, fmt::format("a table at byte {}", table));
    const std::uint64_t count = readU64(bytes_, table);
    if (count > kMostSections || !has(table + 8, kSectionSize * count))
      return ended(table, fmt::format("{} sections", count));
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t at = table + 8 + kSectionSize * i;
      std::string_view name(reinterpret_cast<const char*>(bytes_.data()) + at, kNameSize);
      name = name.substr(0, std::min(name.find('\0'), name.size()));
      const auto known = std::ranges::find(kSections, name);
      if (known == kSections.end()) continue;
      const std::uint64_t begin = readU64(bytes_, at + kNameSize), size = readU64(bytes_, at + kNameSize + 8);
      if (!has(begin, size)) return ended(at, fmt::format("a section {}", name));
      auto& section = sections_[static_cast<std::size_t>(known - kSections.begin())];
      if (section) return wrong(at, fmt::format("a second section {}", name), "one");
      section = Cursor{begin, begin + size};
    }
    return {};
  }

  Status readTokens() {
    auto cursor = section(0);
    if (!cursor) return cursor.error();
    const auto count = takeCount(*cursor, "names", mostOf(1, kFreeCount));
    if (!count) return count.error();
    const auto size = takeCount(*cursor, "bytes of names", mostOf(kTextPerByte, kFreeText));
    if (!size) return size.error();
    const std::uint64_t at = cursor->at;
    const auto bytes = takeBytes(*cursor, *size);
    if (!bytes) return bytes.error();
    text_.assign(reinterpret_cast<const char*>(bytes->data()),
                 reinterpret_cast<const char*>(bytes->data()) + bytes->size());
    for (std::size_t begin = 0; begin < text_.size();) {
      const auto end = std::find(text_.begin() + static_cast<std::ptrdiff_t>(begin), text_.end(), '\0');
      if (end == text_.end() || tokens_.size() == *count)
        return wrong(at, "another number of names", fmt::format("{}, each ended by a NUL", *count));
      const auto length = static_cast<std::size_t>(end - text_.begin()) - begin;
      tokens_.push_back(std::string_view(text_.data() + begin, length));
      begin += length + 1;
    }
    if (tokens_.size() != *count)
      return wrong(at, fmt::format("{} names", tokens_.size()), fmt::format("{}", *count));
    for (const std::string_view token : tokens_) {
      const auto* known = std::ranges::find(kFields, token, &std::pair<std::string_view, Field>::first);
      meaning_.push_back(known == std::end(kFields) ? Field::other : known->second);
    }
    return {};
  }

  Status readStrings() {
    auto cursor = section(1);
    if (!cursor) return cursor.error();
    const auto count = takeCount(*cursor, "strings", cursor->left() / 4);
    if (!count) return count.error();
    if (*count * 4 > cursor->left()) return ended(cursor->at, fmt::format("{} strings", *count));
    for (std::size_t i = 0; i < *count; ++i) {
      const std::uint64_t at = cursor->at + 4 * i;
      strings_.push_back(readU32(bytes_, at));
      if (strings_.back() >= tokens_.size()) return noToken(at, strings_.back());
    }
    return {};
  }
  Error noToken(std::uint64_t at, std::uint64_t token) const {
    return wrong(at, fmt::format("name {}", token), fmt::format("one of {}", tokens_.size()));
  }

  Status readFields() {
    auto cursor = section(2);
    if (!cursor) return cursor.error();
    const auto count = takeCount(*cursor, "fields", mostOf(1, kFreeCount));
    if (!count) return count.error();
    const std::uint64_t at = cursor->at;
    const auto names = takeIntegers(*cursor, *count);
    if (!names) return names.error();
    const auto values = takeBytes(*cursor, 8 * *count);
    if (!values) return values.error();
    for (std::size_t i = 0; i < *count; ++i) {
      const auto token = static_cast<std::uint32_t>((*names)[i]);
      if (token >= tokens_.size()) return noToken(at, token);
      fields_.push_back({meaning_[token], token, {readU64(*values, 8 * i)}});
    }
    return {};
  }

  Status readFieldSets() {
    auto cursor = section(3);
    if (!cursor) return cursor.error();
    const auto count = takeCount(*cursor, "entries of field sets", mostOf(1, kFreeCount));
    if (!count) return count.error();
    const std::uint64_t at = cursor->at;
    auto sets = takeIntegers(*cursor, *count);
    if (!sets) return sets.error();
    for (const std::int32_t entry : *sets) {
      fieldSets_.push_back(static_cast<std::uint32_t>(entry));
      if (fieldSets_.back() != kNone && fieldSets_.back() >= fields_.size())
        return wrong(at, fmt::format("field {}", fieldSets_.back()),
                     fmt::format("one of {}", fields_.size()));
    }
    if (!fieldSets_.empty() && fieldSets_.back() != kNone) return wrong(at, "an open field set", "its end");
    return {};
  }

  Status readPaths() {
    auto cursor = section(4);
    if (!cursor) return cursor.error();
    const auto count = takeCount(*cursor, "paths", mostOf(1, kFreeCount));
    if (!count) return count.error();
    const auto stored = takeCount(*cursor, "stored paths", *count);
    if (!stored) return stored.error();
    const std::uint64_t at = cursor->at;
    const auto indices = takeIntegers(*cursor, *stored), tokens = takeIntegers(*cursor, *stored),
               jumps = takeIntegers(*cursor, *stored);
    for (const auto* list : {&indices, &tokens, &jumps}) {
      if (!*list) return list->error();
    }
    paths_.resize(*count);

    // Depth first; what is left to be visited waits with its parent.
    std::vector<std::pair<std::size_t, std::uint32_t>> waiting;
    if (*stored > 0) waiting.push_back({0, kNone});
    std::size_t visited = 0;
    while (!waiting.empty()) {
      auto [i, parent] = waiting.back();
      waiting.pop_back();
      for (bool goesOn = true; goesOn; ++i) {
        if (i >= *stored || ++visited > *stored)
          return wrong(at, "paths that lead nowhere", "a tree of paths");
        const auto index = static_cast<std::uint32_t>((*indices)[i]);
        if (index >= *count || paths_[index].isFound)
          return wrong(at, fmt::format("path {} twice or beyond the end", index), "each once");
        const std::int64_t token = (*tokens)[i];
        Path& path = paths_[index];
        path = {.parent = parent,
                .token = static_cast<std::uint32_t>(std::abs(token)),
                .isFound = true,
                .isProperty = token < 0};
        if (path.token >= tokens_.size() && parent != kNone) return noToken(at, path.token);
        if (parent == kNone && root_ != kNone) return wrong(at, "a path beside the root", "all below it");
        if (parent == kNone) root_ = index;

        const std::int32_t jump = (*jumps)[i];
        if (jump < -2) return wrong(at, fmt::format("jump {}", jump), "-2, -1, 0 or further");
        if (jump > 0) {
          if (static_cast<std::size_t>(jump) >= *stored - i)
            return wrong(at, fmt::format("jump {} of path {}", jump, i), "one within the tree");
          waiting.push_back({i + static_cast<std::size_t>(jump), parent});
        }
        goesOn = jump != -2;
        if (jump > 0 || jump == -1) parent = index;
        if (parent == kNone && goesOn) return wrong(at, "a path beside the root", "all below it");
      }
    }
    return {};
  }

  Status readSpecs() {
    auto cursor = section(5);
    if (!cursor) return cursor.error();
    const auto count = takeCount(*cursor, "specs", paths_.size());
    if (!count) return count.error();
    const std::uint64_t at = cursor->at;
    const auto indices = takeIntegers(*cursor, *count), sets = takeIntegers(*cursor, *count),
               types = takeIntegers(*cursor, *count);
    for (const auto* list : {&indices, &sets, &types}) {
      if (!*list) return list->error();
    }
    for (std::size_t i = 0; i < *count; ++i) {
      const auto index = static_cast<std::uint32_t>((*indices)[i]),
                 set = static_cast<std::uint32_t>((*sets)[i]), type = static_cast<std::uint32_t>((*types)[i]);
      if (index >= paths_.size() || !paths_[index].isFound || paths_[index].spec != 0)
        return wrong(at, fmt::format("path {} of spec {}", index, i), "a path, each once");
      if (set >= fieldSets_.size() || (set > 0 && fieldSets_[set - 1] != kNone))
        return wrong(at, fmt::format("field set {} of spec {}", set, i), "where a set begins");
      if (type == 0 || type > static_cast<std::uint32_t>(SpecType::last))
        return wrong(at, fmt::format("type {} of spec {}", type, i), "1 to 11");
      paths_[index].firstField = set;
      paths_[index].spec = static_cast<std::uint8_t>(type);
    }
    return {};
  }

  // --- Values.

  struct NamedField {
    Field meaning;
    std::uint32_t token;
    Rep rep;
  };

  // Calls visit(field) for each of a path's.
  template <class Visit>
  Status forEachField(std::uint32_t path, Visit visit) {
    std::size_t visited = 0;
    for (std::size_t i = paths_[path].firstField; fieldSets_[i] != kNone; ++i) {
      if (++visited > kMostFieldsOfSpec)
        return Error{fmt::format("{}: {} has more than {} fields", name_, describe(path), kMostFieldsOfSpec)};
      if (Status seen = visit(fields_[fieldSets_[i]]); !seen) return seen;
    }
    return {};
  }
  std::string describe(std::uint32_t path) const {
    std::string text(tokens_[std::min<std::size_t>(paths_[path].token, tokens_.size() - 1)].substr(0, 64));
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
    }
    return fmt::format("'{}'", text);
  }

  Result<std::string_view> textOf(Kind kind, std::uint32_t index) const {
    if (kind == Kind::string) {
      if (index >= strings_.size())
        return Error{fmt::format("{}: found string {}; expected one of {}", name_, index, strings_.size())};
      index = strings_[index];
    }
    if (index >= tokens_.size())
      return Error{fmt::format("{}: found name {}; expected one of {}", name_, index, tokens_.size())};
    return tokens_[index];
  }

  double numberAt(Kind kind, std::uint64_t at) const {
    switch (kind) {
      case Kind::boolean:
        return std::to_integer<unsigned>(bytes_[at]) != 0;
      case Kind::u8:
        return std::to_integer<unsigned>(bytes_[at]);
      case Kind::i32:
        return static_cast<std::int32_t>(readU32(bytes_, at));
      case Kind::i64:
        return static_cast<double>(static_cast<std::int64_t>(readU64(bytes_, at)));
      case Kind::u64:
        return static_cast<double>(readU64(bytes_, at));
      case Kind::half:
        return fromHalf(readU16(bytes_, at));
      case Kind::f32:
        return readF32(bytes_, at);
      case Kind::f64:
        return readF64(bytes_, at);
      default:
        return readU32(bytes_, at);
    }
  }

  Result<Type> typeOf(Rep rep) const {
    const std::uint32_t number = rep.type();
    const Type type = number < kTypes.size() ? kTypes[number] : Type{};
    if (!rep.isKnown())
      return Error{fmt::format("{}: found a value that edits an array, of a newer USD", name_)};
    if (type.kind == Kind::none)
      return Error{fmt::format("{}: found a value of type {}; expected numbers or names", name_, number)};
    return type;
  }

  // Of `elements` at most.
  Result<UsdValue> valueOf(Rep rep, std::uint64_t mostElements = ~std::uint64_t{0}) {
    UsdValue value;
    if (rep.type() == kBlockType) {
      value.isBlocked = true;
      return value;
    }
    const auto type = typeOf(rep);
    if (!type) return type.error();
    value.width = type->width;
    const bool isText = type->kind == Kind::token || type->kind == Kind::string;
    const bool isAlwaysInline = (type->width == 1 && sizeOf(type->kind) <= 4) || rep.type() == kHalf2Type;
    Status read;
    if (rep.isArray()) {
      read = readArray(rep, *type, mostElements, value);
    } else if (isText) {
      auto text = textOf(type->kind, rep.low());
      if (!text) return text.error();
      value.texts.push_back(*text);
    } else if (rep.isInline() || isAlwaysInline) {
      read = readInline(rep, *type, value);
    } else {
      if (!has(rep.payload(), type->width * sizeOf(type->kind))) return ended(rep.payload(), "a value");
      readNumbers(*type, rep.payload(), 1, value);
    }
    if (!read) return read.error();
    // Stored i, j, k, r; as in text the real part comes first.
    if (type->isQuaternion) {
      for (std::size_t i = 0; i + 4 <= value.numbers.size(); i += 4)
        std::rotate(value.numbers.begin() + static_cast<std::ptrdiff_t>(i),
                    value.numbers.begin() + static_cast<std::ptrdiff_t>(i + 3),
                    value.numbers.begin() + static_cast<std::ptrdiff_t>(i + 4));
    }
    return value;
  }

  Status readInline(Rep rep, const Type& type, UsdValue& value) {
    const std::uint32_t bits = rep.low();
    const auto small = [&](std::size_t i) {
      return static_cast<double>(static_cast<std::int8_t>(bits >> 8 * i));
    };
    if (type.isMatrix) {
      const std::size_t side = type.width == 4 ? 2 : type.width == 9 ? 3 : 4;
      value.numbers.assign(type.width, 0);
      for (std::size_t i = 0; i < side; ++i) value.numbers[i * side + i] = small(i);
    } else if (rep.type() == kHalf2Type) {
      value.numbers = {fromHalf(bits & 0xffff), fromHalf(bits >> 16)};
    } else if (type.width > 1) {
      if (type.isQuaternion) return Error{fmt::format("{}: found a quaternion in a value's own bits", name_)};
      for (std::size_t i = 0; i < type.width; ++i) value.numbers.push_back(small(i));
    } else if (type.kind == Kind::half) {
      value.numbers = {fromHalf(bits & 0xffff)};
    } else if (type.kind == Kind::f32 || type.kind == Kind::f64) {
      value.numbers = {std::bit_cast<float>(bits)};
    } else if (type.kind == Kind::boolean || type.kind == Kind::u8) {
      value.numbers = {static_cast<double>(bits & 255)};
    } else if (type.kind == Kind::i32 || type.kind == Kind::i64) {
      value.numbers = {static_cast<double>(static_cast<std::int32_t>(bits))};
    } else {
      value.numbers = {static_cast<double>(bits)};
    }
    return {};
  }

  void readNumbers(const Type& type, std::uint64_t at, std::size_t count, UsdValue& value) const {
    value.numbers.reserve(count * type.width);
    for (std::size_t i = 0; i < count * type.width; ++i, at += sizeOf(type.kind))
      value.numbers.push_back(numberAt(type.kind, at));
  }

  Status readArray(Rep rep, const Type& type, std::uint64_t mostElements, UsdValue& value) {
    if (rep.payload() == 0) return {};
    Cursor cursor{rep.payload(), bytes_.size()};
    const bool isShortCount = minor_ < 7;
    if (minor_ < 5) cursor.at += 4;  // the rank, which is 1
    if (!has(cursor.at, isShortCount ? 4 : 8)) return ended(rep.payload(), "an array");
    const std::uint64_t count = isShortCount ? readU32(bytes_, cursor.at) : readU64(bytes_, cursor.at);
    cursor.at += isShortCount ? 4 : 8;
    if (count > mostElements)
      return wrong(rep.payload(), fmt::format("{} elements", count), fmt::format("at most {}", mostElements));

    const bool isPacked = rep.isPacked() && minor_ >= 5 && count >= kFewestPacked;
    const std::size_t size = type.width * sizeOf(type.kind);
    if (!isPacked && count > cursor.left() / size)
      return ended(rep.payload(), fmt::format("{} elements", count));
    const std::uint64_t most = mostOf(kNumbersPerByte, kFreeNumbers);
    if (count > most || count * type.width > most - numbersRead_) {
      return wrong(rep.payload(), fmt::format("{} more elements", count),
                   fmt::format("at most {} numbers in so small a file", most));
    }
    numbersRead_ += count * type.width;

    if (isPacked) {
      if (type.width != 1 || (type.kind != Kind::i32 && type.kind != Kind::u32)) {
        return wrong(rep.payload(), fmt::format("a packed array of type {}", rep.type()),
                     "integers, which alone can be packed here");
      }
      const auto integers = takeIntegers(cursor, static_cast<std::size_t>(count));
      if (!integers) return integers.error();
      value.numbers.assign(integers->begin(), integers->end());
      if (type.kind == Kind::u32) {
        for (double& number : value.numbers) number += number < 0 ? 4294967296.0 : 0;
      }
    } else if (type.kind == Kind::token || type.kind == Kind::string) {
      for (std::uint64_t i = 0; i < count; ++i) {
        const auto text = textOf(type.kind, readU32(bytes_, cursor.at + 4 * i));
        if (!text) return text.error();
        value.texts.push_back(*text);
      }
    } else {
      readNumbers(type, cursor.at, static_cast<std::size_t>(count), value);
    }
    return {};
  }

  // Where the value stands that the number at `at` leads to; it counts from itself, and never backwards.
  Result<std::uint64_t> placeAfter(std::uint64_t at) const {
    if (!has(at, 8)) return ended(at, "time samples");
    const std::uint64_t step = readU64(bytes_, at);
    if (step < 8 || step > bytes_.size() || !has(at + step, 8))
      return wrong(at, fmt::format("a value {} bytes on", step), "one in the file, behind this");
    return at + step;
  }

  // The first of an attribute's samples.
  Status readSamples(Rep rep, std::uint64_t mostElements, UsdAttribute& attribute) {
    const auto times = placeAfter(rep.payload());
    if (!times) return times.error();
    const Rep timesRep{readU64(bytes_, *times)};
    const bool isList =
        timesRep.type() == kDoubleVectorType || (timesRep.type() == kDoubleType && timesRep.isArray());
    if (!isList || !has(timesRep.payload(), 8)) return wrong(*times, "no list of times", "one");
    const std::uint64_t count = readU64(bytes_, timesRep.payload());
    if (count == 0) return {};
    if (count > (bytes_.size() - timesRep.payload() - 8) / 8)
      return ended(*times, fmt::format("{} times", count));
    const auto timeAt = [&](std::uint64_t i) { return readF64(bytes_, timesRep.payload() + 8 + 8 * i); };
    const double time = timeAt(0);
    if (!std::isfinite(time) || (count > 1 && !(timeAt(1) > time)))
      return wrong(timesRep.payload(), "times that do not rise", "finite ones, in order");

    const auto values = placeAfter(*times + 8);
    if (!values) return values.error();
    if (readU64(bytes_, *values) != count || !has(*values, 8 + 8 * count))
      return ended(*values, fmt::format("{} samples", count));
    auto value = valueOf({readU64(bytes_, *values + 8)}, mostElements);
    if (!value) return value.error();
    attribute.value = std::move(*value);
    attribute.time = time;
    attribute.isSampled = count > 1;
    return {};
  }

  // Whether a list of changes, a dictionary or a list of names holds something. What we do not know does.
  bool isFilled(Rep rep) const {
    const std::uint64_t at = rep.payload();
    const std::uint32_t type = rep.type();
    if (type == kDictionaryType && (rep.isInline() || !has(at, 8))) return false;
    if (type == kDictionaryType || type == 45 || type == 50) return has(at, 8) && readU64(bytes_, at) > 0;
    const bool isListEdit = (type >= 32 && type <= 39) || type == 55;
    if (!isListEdit) return type != kBlockType;
    if (!has(at, 1)) return true;
    // Bits of the lists that follow, each with its count: explicit 2, added 4, prepended 32, appended 64
    // bring in, deleted 8 and ordered 16 do not. The first that brings in stands first.
    const unsigned lists = std::to_integer<unsigned>(bytes_[at]);
    if ((lists & (2 | 4 | 32 | 64)) == 0) return false;
    return !has(at + 1, 8) || readU64(bytes_, at + 1) > 0 || std::popcount(lists & (2u | 4 | 32 | 64)) > 1;
  }

  // --- The layer.

  Result<double> numberOf(Rep rep) {
    const auto value = valueOf(rep);
    if (!value) return value.error();
    if (value->numbers.size() != 1)
      return Error{fmt::format("{}: found {} numbers; expected one", name_, value->numbers.size())};
    return value->numbers.front();
  }
  Result<std::string_view> nameOf(Rep rep) {
    const auto value = valueOf(rep);
    if (!value) return value.error();
    if (value->texts.size() != 1)
      return Error{fmt::format("{}: found {} names; expected one", name_, value->texts.size())};
    return value->texts.front();
  }

  Status readPrims() {
    if (root_ == kNone || paths_[root_].spec != static_cast<std::uint8_t>(SpecType::root))
      return Error{fmt::format("{}: has no root, which holds all prims", name_)};
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      if (paths_[i].isFound && paths_[i].parent != kNone && paths_[i].spec != 0)
        children_.push_back(
            {paths_[i].parent, paths_[i].token, static_cast<std::uint32_t>(i), paths_[i].isProperty});
    }
    std::ranges::sort(children_, {}, &Child::key);

    struct Waiting {
      std::uint32_t path, parent;
      std::size_t depth;
    };
    std::vector<Waiting> waiting;
    const auto addChildren = [&](std::uint32_t path, std::uint32_t prim, std::size_t depth) -> Status {
      std::vector<std::uint32_t> paths;
      if (Status listed = listChildren(path, paths); !listed) return listed;
      for (std::size_t i = paths.size(); i-- > 0;) waiting.push_back({paths[i], prim, depth});
      return {};
    };
    paths_[root_].isVisited = true;
    if (Status read = readLayerFields(); !read) return read;
    if (Status added = addChildren(root_, kNoUsdPrim, 1); !added) return added;
    while (!waiting.empty()) {
      const Waiting next = waiting.back();
      waiting.pop_back();
      if (next.depth > kDeepestUsdPrim)
        return Error{fmt::format("{}: found more than {} prims in each other", name_, kDeepestUsdPrim)};
      const auto prim = static_cast<std::uint32_t>(layer_.prims.size());
      layer_.prims.push_back({.name = tokens_[paths_[next.path].token],
                              .type = {},
                              .parent = next.parent,
                              .composedBy = {},
                              .attributes = {}});
      if (Status read = readPrim(next.path, layer_.prims.back()); !read) return read;
      if (Status added = addChildren(next.path, prim, next.depth + 1); !added) return added;
    }
    return {};
  }

  // The paths of a prim's children, in its own order.
  Status listChildren(std::uint32_t path, std::vector<std::uint32_t>& paths) {
    return forEachField(path, [&](const NamedField& field) -> Status {
      if (field.meaning != Field::children) return {};
      const std::uint64_t at = field.rep.payload();
      if (field.rep.type() != kTokenVectorType || !has(at, 8)) return wrong(at, "no list of prims", "one");
      const std::uint64_t count = readU64(bytes_, at);
      if (count > (bytes_.size() - at - 8) / 4) return ended(at, fmt::format("{} prims", count));
      for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint32_t token = readU32(bytes_, at + 8 + 4 * i);
        const auto found =
            std::ranges::lower_bound(children_, std::tuple(path, false, token), {}, &Child::key);
        const bool isThere = found != children_.end() && found->key() == std::tuple(path, false, token) &&
                             paths_[found->path].spec == static_cast<std::uint8_t>(SpecType::prim);
        if (!isThere || paths_[found->path].isVisited)
          return wrong(at + 8 + 4 * i, fmt::format("name {} of a prim", token), "one that is there, once");
        paths_[found->path].isVisited = true;
        paths.push_back(found->path);
      }
      return {};
    });
  }

  Status readLayerFields() {
    return forEachField(root_, [&](const NamedField& field) -> Status {
      if (field.meaning == Field::upAxis) {
        auto axis = nameOf(field.rep);
        if (!axis) return axis.error();
        layer_.upAxis = *axis;
      } else if (field.meaning == Field::metresPerUnit) {
        auto number = numberOf(field.rep);
        if (!number) return number.error();
        layer_.metresPerUnit = *number;
      } else if (field.meaning == Field::composing && isFilled(field.rep) && layer_.composedBy.empty()) {
        layer_.composedBy = tokens_[field.token];
      }
      return {};
    });
  }

  Status readPrim(std::uint32_t path, UsdPrim& prim) {
    const Status read = forEachField(path, [&](const NamedField& field) -> Status {
      if (field.meaning == Field::specifier) {
        const std::uint32_t number = field.rep.low();
        if (field.rep.type() != kSpecifierType || number > 2)
          return Error{
              fmt::format("{}: {}: found specifier {}; expected 0 to 2", name_, describe(path), number)};
        prim.specifier = static_cast<UsdSpecifier>(number);
      } else if (field.meaning == Field::typeName) {
        auto type = nameOf(field.rep);
        if (!type) return type.error();
        prim.type = *type;
      } else if (field.meaning == Field::active) {
        auto number = numberOf(field.rep);
        if (!number) return number.error();
        prim.isActive = *number != 0;
      } else if (field.meaning == Field::composing && isFilled(field.rep) && prim.composedBy.empty()) {
        prim.composedBy = tokens_[field.token];
      }
      return {};
    });
    if (!read) return read;

    // The counts last: there are no more of them than points, and packed ones could claim to be.
    std::uint64_t points = 0;
    for (const bool isCounts : {false, true}) {
      for (auto child = std::ranges::lower_bound(children_, std::tuple(path, true, 0u), {}, &Child::key);
           child != children_.end() && child->parent == path && child->isProperty; ++child) {
        const std::string_view name = tokens_[child->token];
        if (!isKeptUsdAttribute(prim.type, name) || isCounts != (name == "curveVertexCounts")) continue;
        if (paths_[child->path].spec != static_cast<std::uint8_t>(SpecType::attribute)) continue;
        if (prim.attributes.size() == kMostUsdAttributes)
          return Error{
              fmt::format("{}: {} has more than {} transforms", name_, describe(path), kMostUsdAttributes)};
        prim.attributes.push_back({.name = name});
        if (Status done =
                readAttribute(child->path, isCounts ? points : ~std::uint64_t{0}, prim.attributes.back());
            !done)
          return done;
        if (name == "points") points = prim.attributes.back().value.numbers.size();
      }
    }
    return {};
  }

  Status readAttribute(std::uint32_t path, std::uint64_t mostElements, UsdAttribute& attribute) {
    return forEachField(path, [&](const NamedField& field) -> Status {
      if (field.meaning == Field::samples) {
        if (field.rep.type() != kSamplesType || !field.rep.isKnown())
          return Error{
              fmt::format("{}: {}: found no time samples where they are named", name_, describe(path))};
        return readSamples(field.rep, mostElements, attribute);
      }
      if (field.meaning == Field::standard && !attribute.time) {
        auto value = valueOf(field.rep, mostElements);
        if (!value) return value.error();
        attribute.value = std::move(*value);
      } else if (field.meaning == Field::connection && isFilled(field.rep)) {
        attribute.drivenBy = "a connection";
      } else if (field.meaning == Field::spline) {
        attribute.drivenBy = "a spline";
      }
      return {};
    });
  }

  std::span<const std::byte> bytes_;
  const std::string& name_;
  unsigned minor_ = 0;
  std::array<std::optional<Cursor>, kSections.size()> sections_;
  std::vector<char> text_;
  std::vector<std::string_view> tokens_;
  std::vector<Field> meaning_;  // of each token
  std::vector<std::uint32_t> strings_, fieldSets_;
  std::vector<NamedField> fields_;
  std::vector<Path> paths_;
  std::uint32_t root_ = kNone;
  std::vector<Child> children_;
  std::uint64_t numbersRead_ = 0;
  UsdLayer layer_;
};

}  // namespace

bool isUsdc(std::span<const std::byte> bytes) {
  return bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

Result<UsdLayer> readUsdc(std::span<const std::byte> bytes, const std::string& name) {
  return CrateReader(bytes, name).read();
}

}  // namespace ringlet
