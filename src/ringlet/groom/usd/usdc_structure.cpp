// Implements groom/usd/usdc_structure.h.
#include "ringlet/groom/usd/usdc_structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "ringlet/base/little_endian.h"
#include "ringlet/groom/usd/usdc_codec.h"

namespace ringlet::usdc {
namespace {

constexpr std::size_t kMostSections = 64;

// Bounds on what a file unpacks to, of its size. Of people's files structure takes a few bytes a path; what
// is equal is stored once.
constexpr std::size_t kTextPerByte = 32, kFreeText = 1 << 20, kFreeCount = 4096;

}  // namespace

Status CrateStructure::read() {
  for (const auto part :
       {&CrateStructure::readHeader, &CrateStructure::readTokens, &CrateStructure::readStrings,
        &CrateStructure::readFields, &CrateStructure::readFieldSets, &CrateStructure::readPaths,
        &CrateStructure::readSpecs}) {
    if (Status read = (this->*part)(); !read) return read;
  }
  return {};
}

Error CrateStructure::wrong(std::uint64_t at, const std::string& found, const std::string& expected) const {
  return Error{fmt::format("{}: at byte {}: found {}; expected {}", name_, at, found, expected)};
}
Error CrateStructure::ended(std::uint64_t at, const std::string& what) const {
  return wrong(at, fmt::format("{} that the {} bytes of the file do not hold", what, bytes_.size()),
               "a whole file");
}
bool CrateStructure::has(std::uint64_t at, std::uint64_t count) const {
  return at <= bytes_.size() && count <= bytes_.size() - at;
}
std::size_t CrateStructure::mostOf(std::size_t perByte, std::size_t free) const {
  return perByte * bytes_.size() + free;
}

Result<CrateStructure::Cursor> CrateStructure::section(std::size_t index) const {
  if (!sections_[index]) return Error{fmt::format("{}: has no section {}", name_, kSections[index])};
  return *sections_[index];
}
Result<std::uint64_t> CrateStructure::takeU64(Cursor& cursor) const {
  if (cursor.left() < 8) return ended(cursor.at, "a number");
  cursor.at += 8;
  return readU64(bytes_, cursor.at - 8);
}
// A count, which may be no more than `most`.
Result<std::size_t> CrateStructure::takeCount(Cursor& cursor, const char* what, std::uint64_t most) const {
  const std::uint64_t at = cursor.at;
  const auto count = takeU64(cursor);
  if (!count) return count.error();
  if (*count > most)
    return wrong(at, fmt::format("{} {}", *count, what), fmt::format("at most {} in so small a file", most));
  return static_cast<std::size_t>(*count);
}
Result<std::span<const std::byte>> CrateStructure::takePacked(Cursor& cursor) const {
  const auto size = takeU64(cursor);
  if (!size) return size.error();
  if (*size > cursor.left()) return ended(cursor.at, fmt::format("{} packed bytes", *size));
  cursor.at += *size;
  return bytes_.subspan(cursor.at - *size, *size);
}
Result<std::vector<std::byte>> CrateStructure::takeBytes(Cursor& cursor, std::size_t count) const {
  const std::uint64_t at = cursor.at;
  const auto packed = takePacked(cursor);
  if (!packed) return packed.error();
  if (count == 0) return std::vector<std::byte>{};
  auto bytes = unpackUsdc(*packed, count);
  if (!bytes || bytes->size() != count)
    return wrong(at, "bytes that do not unpack", fmt::format("{} bytes, packed by LZ4", count));
  return std::move(*bytes);
}
Result<std::vector<std::int32_t>> CrateStructure::takeIntegers(Cursor& cursor, std::size_t count) const {
  const std::uint64_t at = cursor.at;
  const auto packed = takePacked(cursor);
  if (!packed) return packed.error();
  auto values = unpackUsdcIntegers(*packed, count);
  if (!values) return wrong(at, "bytes that do not unpack", fmt::format("{} packed integers", count));
  return std::move(*values);
}

Status CrateStructure::readHeader() {
  if (bytes_.size() < kHeaderSize || std::memcmp(bytes_.data(), kMagic.data(), kMagic.size()) != 0)
    return wrong(0, fmt::format("{} bytes", bytes_.size()),
                 fmt::format("a crate's header of {}", kHeaderSize));
  const auto version = [&](std::size_t part) {
    return std::to_integer<unsigned>(bytes_[kVersionOffset + part]);
  };
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

Status CrateStructure::readTokens() {
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
  return {};
}

Status CrateStructure::readStrings() {
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
Error CrateStructure::noToken(std::uint64_t at, std::uint64_t token) const {
  return wrong(at, fmt::format("name {}", token), fmt::format("one of {}", tokens_.size()));
}

Status CrateStructure::readFields() {
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
    fields_.push_back({token, {readU64(*values, 8 * i)}});
  }
  return {};
}

Status CrateStructure::readFieldSets() {
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
      return wrong(at, fmt::format("field {}", fieldSets_.back()), fmt::format("one of {}", fields_.size()));
  }
  if (!fieldSets_.empty() && fieldSets_.back() != kNone) return wrong(at, "an open field set", "its end");
  return {};
}

Status CrateStructure::readPaths() {
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
      if (i >= *stored || ++visited > *stored) return wrong(at, "paths that lead nowhere", "a tree of paths");
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

Status CrateStructure::readSpecs() {
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

std::string CrateStructure::describe(std::uint32_t path) const {
  std::string text(tokens_[std::min<std::size_t>(paths_[path].token, tokens_.size() - 1)].substr(0, 64));
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
  }
  return fmt::format("'{}'", text);
}

Error CrateStructure::tooManyFields(std::uint32_t path, std::size_t most) const {
  return Error{fmt::format("{}: {} has more than {} fields", name_, describe(path), most)};
}

Result<std::string_view> CrateStructure::textOf(Kind kind, std::uint32_t index) const {
  if (kind == Kind::string) {
    if (index >= strings_.size())
      return Error{fmt::format("{}: found string {}; expected one of {}", name_, index, strings_.size())};
    index = strings_[index];
  }
  if (index >= tokens_.size())
    return Error{fmt::format("{}: found name {}; expected one of {}", name_, index, tokens_.size())};
  return tokens_[index];
}

}  // namespace ringlet::usdc
