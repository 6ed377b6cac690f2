// Implements output/exr_file.h. "OpenEXR File Layout", version 2, single part, scan lines; in blocks of 16
// lines, compressed by zlib after their bytes were parted and made differences (ZIP_COMPRESSION).
//
//     magic, version | attributes, 0 | offset of each block | { first line, bytes, data } of each block
//
// In a block, line by line, all of blue, then green, then red: channels are in the order of their names.
#include "ringlet/output/exr_file.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "ringlet/base/assert.h"
#include "ringlet/base/half.h"
#include "ringlet/base/whole_file.h"

namespace ringlet {
namespace {

constexpr std::int32_t kExrMagic = 20000630, kExrVersion = 2, kHalf = 1;
constexpr std::uint8_t kZip = 3;
constexpr int kBlockLines = 16, kChannels = 3;

// Little-endian.
class ExrBytes {
 public:
  void add(std::integral auto value) {
    for (std::size_t i = 0; i < sizeof value; ++i) all.push_back(static_cast<std::byte>(value >> (8 * i)));
  }
  void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }
  void addText(std::string_view text) {
    for (const char c : text) all.push_back(static_cast<std::byte>(c));
    all.push_back(std::byte{0});
  }
  template <class... T>
  void addAttribute(std::string_view name, std::string_view type, T... values) {
    addText(name);
    addText(type);
    add(static_cast<std::int32_t>((sizeof(T) + ...)));
    (add(values), ...);
  }

  std::vector<std::byte> all;
};

void addHeader(ExrBytes& file, std::int32_t width, std::int32_t height) {
  file.add(kExrMagic);
  file.add(kExrVersion);
  ExrBytes channels;
  for (const char* name : {"B", "G", "R"}) {
    channels.addText(name);
    for (const std::int32_t number : {kHalf, 0, 1, 1})
      channels.add(number);  // perceived linearly; every pixel
  }
  channels.add(std::uint8_t{0});
  file.addText("channels");
  file.addText("chlist");
  file.add(static_cast<std::int32_t>(channels.all.size()));
  file.all.insert(file.all.end(), channels.all.begin(), channels.all.end());
  const std::int32_t none = 0, right = width - 1, bottom = height - 1;
  file.addAttribute("compression", "compression", kZip);
  file.addAttribute("dataWindow", "box2i", none, none, right, bottom);
  file.addAttribute("displayWindow", "box2i", none, none, right, bottom);
  file.addAttribute("lineOrder", "lineOrder", std::uint8_t{0});
  file.addAttribute("pixelAspectRatio", "float", 1.0f);
  file.addAttribute("screenWindowCenter", "v2f", 0.0f, 0.0f);
  file.addAttribute("screenWindowWidth", "float", 1.0f);
  file.add(std::uint8_t{0});
}

std::vector<std::byte> linesOf(std::span<const float> pixels, int width, int first, int count) {
  ExrBytes lines;
  for (int y = first; y < first + count; ++y)
    for (int channel = kChannels - 1; channel >= 0; --channel)
      for (int x = 0; x < width; ++x)
        lines.add(halfBits(pixels[(static_cast<std::size_t>(y) * width + x) * kChannels + channel]));
  return std::move(lines.all);
}

// As the format has it: even bytes before odd ones, each as its difference from the one before. As they are
// where that is no longer.
std::vector<std::byte> compressed(const std::vector<std::byte>& raw) {
  std::vector<Bytef> parted;
  for (const std::size_t odd : {0, 1})
    for (std::size_t i = odd; i < raw.size(); i += 2) parted.push_back(std::to_integer<Bytef>(raw[i]));
  for (std::size_t i = parted.size() - 1; i > 0; --i)
    parted[i] = static_cast<Bytef>(parted[i] - parted[i - 1] + 128);
  uLongf size = compressBound(parted.size());
  std::vector<std::byte> packed(size);
  const int code = compress(reinterpret_cast<Bytef*>(packed.data()), &size, parted.data(), parted.size());
  if (code != Z_OK || size >= raw.size()) return raw;
  packed.resize(size);
  return packed;
}

}  // namespace

Status writeExr(const std::filesystem::path& path, int width, int height, std::span<const float> pixels) {
  RINGLET_ASSERT(
      width > 0 && height > 0 && pixels.size() == static_cast<std::size_t>(width) * height * kChannels,
      "three numbers a pixel");
  ExrBytes file;
  addHeader(file, width, height);
  const int blocks = (height + kBlockLines - 1) / kBlockLines;
  const std::size_t table = file.all.size();
  file.all.resize(table + 8 * static_cast<std::size_t>(blocks));
  ExrBytes offsets;
  for (int block = 0; block < blocks; ++block) {
    offsets.add(std::uint64_t{file.all.size()});
    const int first = block * kBlockLines;
    const auto data = compressed(linesOf(pixels, width, first, std::min(kBlockLines, height - first)));
    file.add(static_cast<std::int32_t>(first));
    file.add(static_cast<std::int32_t>(data.size()));
    file.all.insert(file.all.end(), data.begin(), data.end());
  }
  std::ranges::copy(offsets.all, file.all.begin() + static_cast<std::ptrdiff_t>(table));
  return writeWholeFile(path, file.all);
}

}  // namespace ringlet
