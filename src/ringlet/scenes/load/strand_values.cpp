// Implements scenes/load/strand_values.h.
#include "ringlet/scenes/load/strand_values.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "ringlet/base/nearest_name.h"
#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"

namespace ringlet {
namespace {

constexpr const char* kPrimvars = "primvars:";
constexpr std::uint32_t kMostPixelsOfSide = 16384;

const GroomValue* valueNamed(const GroomPrim& prim, const std::string& name) {
  const auto found = std::ranges::find_if(prim.values, [&](const GroomValue& value) {
    return value.name == name || value.name == kPrimvars + name;
  });
  return found == prim.values.end() ? nullptr : &*found;
}

Error missing(const GroomPrim& prim, const std::string& name) {
  std::vector<std::string> names;
  for (const GroomValue& value : prim.values)
    names.push_back(value.name.starts_with(kPrimvars) ? value.name.substr(9) : value.name);
  const std::size_t nearest = nearestName(name, names);
  return Error{fmt::format("{} has no primvar {}{}", prim.path, ringlet::quoted(name),
                           nearest < names.size() ? fmt::format("; did you mean {}?", names[nearest]) : "")};
}

// How many numbers an element of this type has: "color3f[]", "float2[]", "texCoord2f[]".
std::size_t widthOf(const std::string& type) {
  const std::string name = type.starts_with("int64") || type.starts_with("uint64") ? type.substr(6) : type;
  for (const char digit : name)
    if (digit >= '2' && digit <= '4') return static_cast<std::size_t>(digit - '0');
  return 1;
}

struct GreyImage {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  // the highest row first
  double at(std::size_t x, std::size_t y) const { return pixels[y * width + x] / 255.0; }
};

Result<GreyImage> readGrey(const std::filesystem::path& path) {
  const auto bytes = readWholeFile(path);
  if (!bytes) return bytes.error();
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  const auto failed = [&] {
    Error error{fmt::format("{}: cannot read it as a PNG file: {}", path.string(), header.message)};
    png_image_free(&header);
    return error;
  };
  if (!png_image_begin_read_from_memory(&header, bytes->data(), bytes->size())) return failed();
  if (header.width > kMostPixelsOfSide || header.height > kMostPixelsOfSide) {
    png_image_free(&header);
    return Error{fmt::format("{}: has {} x {} pixels; expected at most {} on a side", path.string(),
                             header.width, header.height, kMostPixelsOfSide)};
  }
  header.format = PNG_FORMAT_GRAY;
  GreyImage image{header.width, header.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(header))};
  if (!png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr)) return failed();
  return image;
}

double sampled(const GreyImage& image, double u, double v) {
  const auto place = [](double share, std::size_t count) {
    const double x = (share - std::floor(share)) * static_cast<double>(count) - 0.5, low = std::floor(x);
    const auto size = static_cast<long long>(count), first = static_cast<long long>(low);
    const auto wrapped = [&](long long i) { return static_cast<std::size_t>(((i % size) + size) % size); };
    return std::tuple(wrapped(first), wrapped(first + 1), x - low);
  };
  const auto [x0, x1, tx] = place(u, image.width);
  const auto [y0, y1, ty] = place(1 - v, image.height);
  return (1 - ty) * ((1 - tx) * image.at(x0, y0) + tx * image.at(x1, y0)) +
         ty * ((1 - tx) * image.at(x0, y1) + tx * image.at(x1, y1));
}

}  // namespace

Result<std::vector<double>> primvarOfStrands(const LoadedGroom& groom, const std::string& name,
                                             std::size_t& width) {
  if (groom.prims.empty())
    return Error{fmt::format(
        "the groom's file has no primvar {}; primvars are of USD and Alembic grooms, and displayColor of .hair "
        "files with colours",
        ringlet::quoted(name))};
  std::vector<double> numbers;
  width = 0;
  for (const GroomPrim& prim : groom.prims) {
    const GroomValue* value = valueNamed(prim, name);
    if (!value) return missing(prim, name);
    const GroomValue* indices = valueNamed(prim, value->name + ":indices");
    const std::size_t each = widthOf(value->type), count = value->numbers.size() / each;
    if (count == 0 || (width != 0 && each != width))
      return Error{fmt::format("the primvar {} of {} has no numbers, or others than the prim before",
                               ringlet::quoted(name), prim.path)};
    width = each;
    for (std::uint32_t s = 0; s < prim.strandCount; ++s) {
      const std::size_t strand = prim.firstStrand + s;
      const std::size_t root = groom.groom.firstPoint[strand] - groom.groom.firstPoint[prim.firstStrand];
      std::size_t element = value->interpolation == "uniform"   ? s
                            : value->interpolation == "vertex"  ? root
                            : value->interpolation == "varying" ? root
                                                                : 0;
      if (indices) {
        const std::size_t at = std::min(element, indices->numbers.size() - 1);
        const double index = indices->numbers.empty() ? -1 : indices->numbers[at];
        element = index >= 0 ? static_cast<std::size_t>(index) : count;
      }
      if (element >= count)
        return Error{fmt::format("the primvar {} of {} has {} elements, too few for strand {}",
                                 ringlet::quoted(name), prim.path, count, strand)};
      for (std::size_t k = 0; k < each; ++k) numbers.push_back(value->numbers[element * each + k]);
    }
  }
  return numbers;
}

Result<std::vector<double>> valuesOfPrimvar(const LoadedGroom& groom, const std::string& name) {
  std::size_t width = 0;
  const auto numbers = primvarOfStrands(groom, name, width);
  if (!numbers) return numbers.error();
  std::vector<double> values;
  for (std::size_t i = 0; i < numbers->size(); i += width) {
    double sum = 0;
    for (std::size_t k = 0; k < width; ++k) sum += (*numbers)[i + k];
    values.push_back(sum / static_cast<double>(width));
  }
  return values;
}

Result<std::vector<double>> valuesOfTexture(const LoadedGroom& groom, const std::filesystem::path& path,
                                            const std::string& uv) {
  std::size_t width = 0;
  const auto places = primvarOfStrands(groom, uv, width);
  if (!places) return places.error();
  if (width != 2)
    return Error{
        fmt::format("the primvar {} has {} numbers; expected two, u and v", ringlet::quoted(uv), width)};
  const auto image = readGrey(path);
  if (!image) return image.error();
  std::vector<double> values;
  for (std::size_t i = 0; i < places->size(); i += 2) {
    const double u = (*places)[i], v = (*places)[i + 1];
    if (!std::isfinite(u) || !std::isfinite(v))
      return Error{fmt::format("strand {} has UVs that are not finite", i / 2)};
    values.push_back(sampled(*image, u, v));
  }
  return values;
}

}  // namespace ringlet
