// Implements scenes/frames/velocity_file.h. The format is numpy.lib.format's: "\x93NUMPY", version, length of
// the header, the header as a Python dictionary, the numbers.
#include "ringlet/scenes/frames/velocity_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "ringlet/base/little_endian.h"
#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"

namespace ringlet {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

// What stands behind a key of the dictionary, up to its end.
std::string_view valueOf(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(fmt::format("'{}':", key));
  if (at == std::string_view::npos) return {};
  std::string_view rest = header.substr(at + key.size() + 3);
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  return rest;
}

// "(3, 4, 5, 3)": four lengths.
std::optional<std::array<std::uint64_t, 4>> shapeOf(std::string_view text) {
  std::array<std::uint64_t, 4> shape{};
  if (text.empty() || text.front() != '(') return std::nullopt;
  text.remove_prefix(1);
  for (std::size_t k = 0; k < 4; ++k) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), shape[k]);
    if (code != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (text.empty() || text.front() != (k < 3 ? ',' : ')')) return std::nullopt;
    text.remove_prefix(1);
  }
  return shape;
}

struct Header {
  std::array<std::uint64_t, 4> shape;
  std::size_t numberBytes, begin;
  bool isFortran;
};

Result<Header> readHeader(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!text.starts_with(kMagic) || bytes.size() < 12)
    return Error{"found no NumPy array; expected a file as numpy.save writes it"};
  const bool isLong = std::to_integer<int>(bytes[6]) >= 2;
  const std::size_t length = isLong ? readU32(bytes, 8) : readU16(bytes, 8), begin = isLong ? 12 : 10;
  if (length > bytes.size() - begin) return Error{"the file ends within its header"};
  const std::string_view header = text.substr(begin, length);
  const std::string_view type = valueOf(header, "descr").substr(0, 5);
  if (type != "'<f4'" && type != "'<f8'")
    return Error{fmt::format("found numbers of type {}; expected '<f4' or '<f8'", quoted(type))};
  const auto shape = shapeOf(valueOf(header, "shape"));
  if (!shape || (*shape)[3] != 3)
    return Error{"found an array of another shape; expected (x, y, z, 3): a velocity at each node"};
  for (std::size_t k = 0; k < 3; ++k) {
    if ((*shape)[k] < 2 || (*shape)[k] > 4096)
      return Error{fmt::format("found {} nodes on a side; expected 2 to 4096", (*shape)[k])};
  }
  return Header{*shape, type == "'<f4'" ? std::size_t(4) : 8, begin + length,
                valueOf(header, "fortran_order").starts_with("True")};
}

}  // namespace

Result<VelocityGrid> parseVelocities(std::span<const std::byte> bytes, double cell) {
  const auto header = readHeader(bytes);
  if (!header) return header.error();
  const auto [nx, ny, nz, components] = header->shape;
  const std::uint64_t count = nx * ny * nz;
  if ((bytes.size() - header->begin) / header->numberBytes < 3 * count)
    return Error{fmt::format("the file ends before its {} velocities do", count)};

  const auto numberAt = [&](std::uint64_t index) {
    const std::size_t at = header->begin + index * header->numberBytes;
    return header->numberBytes == 4 ? readF32(bytes, at) : static_cast<float>(readF64(bytes, at));
  };
  VelocityGrid grid{
      {static_cast<std::uint32_t>(nx), static_cast<std::uint32_t>(ny), static_cast<std::uint32_t>(nz)},
      cell,
      {}};
  grid.velocities.reserve(count);
  for (std::uint64_t z = 0; z < nz; ++z) {
    for (std::uint64_t y = 0; y < ny; ++y) {
      for (std::uint64_t x = 0; x < nx; ++x) {
        float v[3];
        for (std::uint64_t c = 0; c < 3; ++c) {
          v[c] = numberAt(header->isFortran ? x + nx * (y + ny * (z + nz * c))
                                            : ((x * ny + y) * nz + z) * 3 + c);
          if (!std::isfinite(v[c]))
            return Error{fmt::format("the velocity at ({}, {}, {}) is not finite", x, y, z)};
        }
        grid.velocities.push_back({v[0], v[1], v[2]});
      }
    }
  }
  return grid;
}

Result<VelocityGrid> readVelocities(const std::filesystem::path& path, double cell) {
  const auto bytes = readWholeFile(path);
  if (!bytes) return bytes.error();
  auto grid = parseVelocities(*bytes, cell);
  if (!grid) return Error{fmt::format("{}: {}", path.string(), grid.error().message)};
  return grid;
}

}  // namespace ringlet
