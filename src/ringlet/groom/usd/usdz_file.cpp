// Implements groom/usd/usdz_file.h.
//
//   a file     u32 "PK34", u16 version, flags, method, time, date, u32 CRC-32, size packed, size, u16 length
//   of
//              its name and of what else is said of it; these; its bytes
//   directory  for each file u32 "PK12", u16 version, then as above from the version on, u16 length of a
//   comment,
//              disk, attributes, u32 attributes, where the file begins; name, what else, comment
//   end        u32 "PK56", u16 disks (2), files here, files, u32 size of the directory, where it begins, u16
//              length of a comment, which is all that follows
#include "ringlet/groom/usd/usdz_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "ringlet/base/little_endian.h"
#include "ringlet/base/quoted.h"

namespace ringlet {
namespace {

constexpr std::uint32_t kFileMark = 0x04034b50, kEntryMark = 0x02014b50, kEndMark = 0x06054b50;
constexpr std::size_t kFileHead = 30, kEntryHead = 46, kEndHead = 22, kLongestComment = 65535;

// What a file's head and its entry in the directory both say; `at` is where that begins.
struct ZipFile {
  std::uint32_t flags, method, crc, packedSize, size, nameLength, extraLength;
  std::string_view name;
};
ZipFile zipFileAt(std::span<const std::byte> bytes, std::size_t at) {
  return {readU16(bytes, at),      readU16(bytes, at + 2),  readU32(bytes, at + 8),  readU32(bytes, at + 12),
          readU32(bytes, at + 16), readU16(bytes, at + 20), readU16(bytes, at + 22), {}};
}

// Where the record of the end stands.
std::optional<std::size_t> endOf(std::span<const std::byte> bytes) {
  if (bytes.size() < kEndHead) return std::nullopt;
  const std::size_t last = bytes.size() - kEndHead;
  for (std::size_t back = 0; back <= std::min(last, kLongestComment); ++back) {
    const std::size_t at = last - back;
    if (readU32(bytes, at) == kEndMark && readU16(bytes, at + 20) == back) return at;
  }
  return std::nullopt;
}

bool endsAsLayer(std::string_view name) {
  return name.ends_with(".usda") || name.ends_with(".usdc") || name.ends_with(".usd");
}

std::string_view textAt(std::span<const std::byte> bytes, std::size_t at, std::size_t length) {
  return {reinterpret_cast<const char*>(bytes.data()) + at, length};
}

}  // namespace

bool isUsdz(std::span<const std::byte> bytes) { return bytes.size() >= 4 && readU32(bytes, 0) == kFileMark; }

Result<std::span<const std::byte>> firstOfUsdz(std::span<const std::byte> bytes, const std::string& name) {
  const auto wrong = [&](std::size_t at, const std::string& found, const char* expected) {
    return Error{fmt::format("{}: at byte {}: found {}; expected {}", name, at, found, expected)};
  };
  const auto end = endOf(bytes);
  if (!isUsdz(bytes) || !end) return wrong(bytes.size(), "no end of a zip file", "a whole .usdz package");
  const std::size_t directory = readU32(bytes, *end + 16);
  if (directory > *end || *end - directory < kEntryHead || readU32(bytes, directory) != kEntryMark)
    return wrong(*end, "no directory", "that of a zip file");
  ZipFile entry = zipFileAt(bytes, directory + 8);
  if (entry.nameLength > *end - directory - kEntryHead)
    return wrong(directory, "a name without its end", "a name");
  entry.name = textAt(bytes, directory + kEntryHead, entry.nameLength);
  if (const std::uint32_t begin = readU32(bytes, directory + 42); begin != 0)
    return wrong(directory, fmt::format("{} at byte {} first", quoted(entry.name), begin),
                 "the file at byte 0");

  // The directory is at 0 at least a head behind it.
  if (directory < kFileHead) return wrong(0, "a directory within the first file", "it behind all files");
  ZipFile file = zipFileAt(bytes, 6);
  const std::size_t begin = kFileHead + file.nameLength + file.extraLength;
  if (begin > directory || file.size > directory - begin)
    return wrong(0, fmt::format("a file of {} bytes, beyond the directory at {}", file.size, directory),
                 "it before the directory");
  file.name = textAt(bytes, kFileHead, file.nameLength);
  if (file.name != entry.name || file.size != entry.size || file.packedSize != entry.packedSize ||
      file.method != entry.method)
    return wrong(directory, fmt::format("{} there and {} at byte 0", quoted(entry.name), quoted(file.name)),
                 "both to say the same");
  if (file.method != 0 || file.packedSize != file.size)
    return wrong(8, fmt::format("{} packed", quoted(file.name)),
                 "a stored file, as .usdz asks; `usdzip` makes such");
  if ((file.flags & 9) != 0) return wrong(6, "an encrypted file, or one without its size", "a plain one");
  if (!endsAsLayer(file.name))
    return wrong(kFileHead, quoted(file.name), "a layer first, .usda, .usdc or .usd");
  return bytes.subspan(begin, file.size);
}

}  // namespace ringlet
