// CrateStructure: the sections of a crate (.usdc), checked: names, paths and which values each has. What the
// values are is usdc_values.h's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/usd/usdc_format.h"

namespace ringlet::usdc {

/// A path, and whether something is there.
struct Path {
  std::uint32_t parent = kNone, token = 0;
  std::uint32_t firstField = kNone;  // into the field sets
  std::uint8_t spec = 0;             // 0: none
  bool isFound = false, isProperty = false;
};

struct NamedField {
  std::uint32_t token;
  Rep rep;
};

class CrateStructure {
 public:
  /// Bytes and name must live as long; `name` is the file's, for messages.
  CrateStructure(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  /// Reads all sections. What the file packs may not become more than its own size allows. Errors: byte,
  /// what was found and what was expected.
  Status read();

  std::span<const std::byte> bytes() const { return bytes_; }
  unsigned minorVersion() const { return minor_; }
  const std::string& name() const { return name_; }
  const std::vector<std::string_view>& tokens() const { return tokens_; }
  const std::vector<Path>& paths() const { return paths_; }
  std::uint32_t root() const { return root_; }  // kNone: there is none
  /// What the tokens are views into; they are good as long as this lives, wherever it is moved.
  std::vector<char> takeText() { return std::move(text_); }

  /// Calls visit(field) for each of a path's, until one fails.
  template <class Visit>
  Status forEachField(std::uint32_t path, Visit visit) const {
    constexpr std::size_t kMostFieldsOfSpec = 256;
    std::size_t visited = 0;
    for (std::size_t i = paths_[path].firstField; fieldSets_[i] != kNone; ++i) {
      if (++visited > kMostFieldsOfSpec) return tooManyFields(path, kMostFieldsOfSpec);
      if (Status seen = visit(fields_[fieldSets_[i]]); !seen) return seen;
    }
    return {};
  }
  /// The text of a token or string.
  Result<std::string_view> textOf(Kind kind, std::uint32_t index) const;

  // For messages.
  std::string describe(std::uint32_t path) const;
  Error wrong(std::uint64_t at, const std::string& found, const std::string& expected) const;
  Error ended(std::uint64_t at, const std::string& what) const;

  /// Whether the file has so many bytes there.
  bool has(std::uint64_t at, std::uint64_t count) const;
  /// So many of each byte of the file, and some that are free.
  std::size_t mostOf(std::size_t perByte, std::size_t free) const;

  /// Reads on within a section.
  struct Cursor {
    std::uint64_t at = 0, end = 0;
    std::uint64_t left() const { return end - at; }
  };
  Result<std::vector<std::int32_t>> takeIntegers(Cursor& cursor, std::size_t count) const;

 private:
  Result<Cursor> section(std::size_t index) const;
  Result<std::uint64_t> takeU64(Cursor& cursor) const;
  Result<std::size_t> takeCount(Cursor& cursor, const char* what, std::uint64_t most) const;
  Result<std::span<const std::byte>> takePacked(Cursor& cursor) const;
  Result<std::vector<std::byte>> takeBytes(Cursor& cursor, std::size_t count) const;

  Status readHeader();
  Status readTokens();
  Status readStrings();
  Status readFields();
  Status readFieldSets();
  Status readPaths();
  Status readSpecs();
  Error noToken(std::uint64_t at, std::uint64_t token) const;
  Error tooManyFields(std::uint32_t path, std::size_t most) const;

  std::span<const std::byte> bytes_;
  const std::string& name_;
  unsigned minor_ = 0;
  std::array<std::optional<Cursor>, kSections.size()> sections_;
  std::vector<char> text_;
  std::vector<std::string_view> tokens_;
  std::vector<std::uint32_t> strings_, fieldSets_;
  std::vector<NamedField> fields_;
  std::vector<Path> paths_;
  std::uint32_t root_ = kNone;
};

}  // namespace ringlet::usdc
