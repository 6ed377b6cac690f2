// OgawaFile: the container of Alembic files. A file is a tree of groups, whose children are groups and data.
// All numbers are little-endian:
//   file   "Ogawa", a byte 0xff (0 while the file is written), 00 01, u64 the place of the root group
//   group  u64 n, then n u64: places of the children; bit 63 set: of data
//   data   u64 size, bytes
// A place of 0 is the empty group, or empty data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "ringlet/base/result.h"

namespace ringlet {

/// A child as a group names it.
struct OgawaChild {
  std::uint64_t word = 0;

  bool isData() const { return word >> 63 != 0; }
  std::uint64_t place() const { return word & ~(std::uint64_t{1} << 63); }
  bool operator==(const OgawaChild&) const = default;
};

/// The children of a group: a view of the file.
class OgawaGroup {
 public:
  OgawaGroup() = default;
  explicit OgawaGroup(std::span<const std::byte> words) : words_(words) {}

  std::size_t size() const { return words_.size() / 8; }
  /// k is less than size().
  OgawaChild operator[](std::size_t k) const;

 private:
  std::span<const std::byte> words_{};
};

/// A view of a file's bytes, which outlive it. It holds nothing and reads what it is asked for.
class OgawaFile {
 public:
  /// `name` is for messages. Errors: another kind of file (Alembic's older kind, HDF5, by its name); a file
  /// that was not closed by its writer; another version.
  static Result<OgawaFile> of(std::span<const std::byte> bytes, std::string name);

  const std::string& name() const { return name_; }
  std::size_t byteCount() const { return bytes_.size(); }
  Result<OgawaGroup> root() const;
  /// Errors: the other kind of child; a place or a size beyond the file's end.
  Result<OgawaGroup> group(OgawaChild child) const;
  Result<std::span<const std::byte>> data(OgawaChild child) const;

  /// "NAME: at byte PLACE: found FOUND; expected EXPECTED".
  Error wrong(std::uint64_t place, const std::string& found, const std::string& expected) const;

 private:
  OgawaFile(std::span<const std::byte> bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  std::span<const std::byte> bytes_;
  std::string name_;
};

}  // namespace ringlet
