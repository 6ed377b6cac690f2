// Implements groom/alembic/ogawa_file.h.
#include "ringlet/groom/alembic/ogawa_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "ringlet/base/little_endian.h"
#include "ringlet/base/quoted.h"
#include "ringlet/base/text_of.h"

namespace ringlet {
namespace {

constexpr std::string_view kOgawaMagic = "Ogawa", kHdf5Magic = "\x89HDF\r\n\x1a\n";
constexpr std::size_t kClosedByte = 5, kOgawaVersionByte = 6, kRootPlace = 8, kOgawaHeaderSize = 16;
constexpr unsigned kOgawaVersion = 1;
constexpr std::uint64_t kWordSize = 8;

}  // namespace

OgawaChild OgawaGroup::operator[](std::size_t k) const { return {readU64(words_, 8 * k)}; }

Error OgawaFile::wrong(std::uint64_t place, const std::string& found, const std::string& expected) const {
  return Error{fmt::format("{}: at byte {}: found {}; expected {}", name_, place, found, expected)};
}

Result<OgawaFile> OgawaFile::of(std::span<const std::byte> bytes, std::string name) {
  const OgawaFile file(bytes, std::move(name));
  const std::string_view text = textOf(bytes);
  if (text.starts_with(kHdf5Magic))
    return Error{
        fmt::format("{}: is an Alembic file of the older kind, HDF5, which is not read; programs that write "
                    "Alembic write Ogawa too, and `abcconvert -toOgawa` of the Alembic library makes it",
                    file.name_)};
  if (!text.starts_with(kOgawaMagic))
    return file.wrong(0, quoted(text.substr(0, 8)), "'Ogawa', with which an Alembic file begins");
  if (bytes.size() < kOgawaHeaderSize)
    return file.wrong(0, fmt::format("{} bytes", bytes.size()),
                      fmt::format("a header of {}", kOgawaHeaderSize));
  if (bytes[kClosedByte] != std::byte{0xff})
    return Error{fmt::format(
        "{}: was not closed by the program that wrote it: it is still written, or the program ended early",
        file.name_)};
  const unsigned version = std::to_integer<unsigned>(bytes[kOgawaVersionByte]) << 8 |
                           std::to_integer<unsigned>(bytes[kOgawaVersionByte + 1]);
  if (version != kOgawaVersion)
    return file.wrong(kOgawaVersionByte, fmt::format("version {} of Ogawa", version),
                      fmt::format("version {}", kOgawaVersion));
  return file;
}

Result<OgawaGroup> OgawaFile::root() const { return group({readU64(bytes_, kRootPlace)}); }

Result<OgawaGroup> OgawaFile::group(OgawaChild child) const {
  if (child.isData()) return wrong(child.place(), "data", "a group");
  if (child.place() == 0) return OgawaGroup();
  if (bytes_.size() < kWordSize || child.place() > bytes_.size() - kWordSize)
    return wrong(child.place(), "the place of a group", fmt::format("one within {} bytes", bytes_.size()));
  const std::uint64_t count = readU64(bytes_, child.place());
  const std::uint64_t left = bytes_.size() - kWordSize - child.place();
  if (count > left / kWordSize)
    return wrong(child.place(), fmt::format("a group of {} children", count),
                 fmt::format("at most {}, for which there is room", left / kWordSize));
  return OgawaGroup(bytes_.subspan(child.place() + kWordSize, count * kWordSize));
}

Result<std::span<const std::byte>> OgawaFile::data(OgawaChild child) const {
  if (!child.isData()) return wrong(child.place(), "a group", "data");
  if (child.place() == 0) return std::span<const std::byte>();
  if (bytes_.size() < kWordSize || child.place() > bytes_.size() - kWordSize)
    return wrong(child.place(), "the place of data", fmt::format("one within {} bytes", bytes_.size()));
  const std::uint64_t size = readU64(bytes_, child.place());
  const std::uint64_t left = bytes_.size() - kWordSize - child.place();
  if (size > left)
    return wrong(child.place(), fmt::format("data of {} bytes", size),
                 fmt::format("at most {}, where the file ends", left));
  return bytes_.subspan(child.place() + kWordSize, size);
}

}  // namespace ringlet
