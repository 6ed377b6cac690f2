// Implements motion/gltf_accessor.h.
#include "ringlet/motion/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

namespace ringlet {
namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";

template <class T>
double numberOf(const unsigned char* bytes, bool isNormalized) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  const auto number = static_cast<double>(value);
  if constexpr (std::is_floating_point_v<T>) return number;
  return isNormalized ? std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0) : number;
}

struct Component {
  std::size_t size;
  double (*read)(const unsigned char*, bool);
};

std::optional<Component> componentOf(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return Component{1, numberOf<std::int8_t>};
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return Component{1, numberOf<std::uint8_t>};
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return Component{2, numberOf<std::int16_t>};
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return Component{2, numberOf<std::uint16_t>};
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return Component{4, numberOf<std::uint32_t>};
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return Component{4, numberOf<float>};
    default:
      return std::nullopt;
  }
}

// `count` elements of a buffer view, `step` bytes from one to the next (0: `size`). Nothing else looks into
// buffers.
Result<std::span<const unsigned char>> viewedBytes(const gltf::Model& model, int view, std::size_t offset,
                                                   std::size_t count, std::size_t size, std::size_t& step) {
  const auto v = indexOf(view, model.bufferViews.size());
  if (!v) return Error{fmt::format("there is no buffer view {}", view)};
  const gltf::BufferView& found = model.bufferViews[*v];
  if (found.extensions.contains(kMeshopt))
    return Error{fmt::format("buffer view {} is compressed by {}, which is not read; write it without", view,
                             kMeshopt)};
  const auto b = indexOf(found.buffer, model.buffers.size());
  if (!b) return Error{fmt::format("buffer view {} is of buffer {}, which is not there", view, found.buffer)};
  const std::vector<unsigned char>& data = model.buffers[*b].data;
  if (found.byteOffset > data.size() || found.byteLength > data.size() - found.byteOffset)
    return Error{fmt::format("buffer view {} ends beyond its buffer of {} bytes", view, data.size())};
  step = found.byteStride > 0 ? found.byteStride : size;
  if (step < size)
    return Error{fmt::format("buffer view {} steps {} bytes over elements of {}", view, step, size)};
  const std::size_t length = found.byteLength;
  if (offset > length || size > length - offset || (count - 1) > (length - offset - size) / step) {
    return Error{fmt::format("{} elements of {} bytes from byte {} on end beyond buffer view {} of {} bytes",
                             count, size, offset, view, length)};
  }
  return std::span(data).subspan(found.byteOffset + offset, (count - 1) * step + size);
}

Status readSparse(const gltf::Model& model, const gltf::Accessor& accessor, const Component& component,
                  Numbers& numbers) {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > numbers.count)
    return Error{fmt::format("{} of its {} elements are sparse", sparse.count, numbers.count)};
  const auto count = static_cast<std::size_t>(sparse.count);
  const auto index = componentOf(sparse.indices.componentType);
  if (!index || sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT)
    return Error{"its sparse indices are no whole numbers"};
  if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
    return Error{"its sparse elements begin before their buffer"};
  std::size_t indexStep = 0, valueStep = 0;
  const auto indices =
      viewedBytes(model, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                  count, index->size, indexStep);
  if (!indices) return indices.error();
  const auto values =
      viewedBytes(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
                  component.size * numbers.width, valueStep);
  if (!values) return values.error();
  for (std::size_t k = 0; k < count; ++k) {
    const double at = index->read(indices->data() + k * indexStep, false);
    if (!(at >= 0 && at < static_cast<double>(numbers.count)))
      return Error{fmt::format("its sparse element {} is number {} of {}", k, at, numbers.count)};
    for (std::size_t c = 0; c < numbers.width; ++c) {
      numbers.values[static_cast<std::size_t>(at) * numbers.width + c] =
          component.read(values->data() + k * valueStep + c * component.size, accessor.normalized);
    }
  }
  return {};
}

Result<Numbers> readNumbers(const gltf::Model& model, const gltf::Accessor& accessor, std::size_t width) {
  const int components = gltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  if (components != static_cast<int>(width))
    return Error{fmt::format("its elements have {} numbers, not {}", components, width)};
  const auto component = componentOf(accessor.componentType);
  if (!component) return Error{fmt::format("numbers of type {} are not glTF's", accessor.componentType)};
  // Of bytes, a matrix has gaps; nobody writes one.
  if (width == 16 && accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
    return Error{"its matrices are not of floats"};
  Numbers numbers{width, accessor.count, {}};
  if (numbers.count == 0) return Error{"it is empty"};
  if (accessor.bufferView < 0) {
    constexpr std::size_t kMostZeros = 1 << 20;  // all zero but for a few: nothing in the file bounds them
    if (!accessor.sparse.isSparse || numbers.count > kMostZeros) return Error{"it has no buffer view"};
    numbers.values.resize(numbers.count * width);
  } else {
    std::size_t step = 0;
    const auto bytes = viewedBytes(model, accessor.bufferView, accessor.byteOffset, numbers.count,
                                   component->size * width, step);
    if (!bytes) return bytes.error();
    numbers.values.reserve(numbers.count * width);
    for (std::size_t i = 0; i < numbers.count; ++i) {
      for (std::size_t c = 0; c < width; ++c)
        numbers.values.push_back(
            component->read(bytes->data() + i * step + c * component->size, accessor.normalized));
    }
  }
  if (accessor.sparse.isSparse) {
    if (Status status = readSparse(model, accessor, *component, numbers); !status) return status.error();
  }
  for (std::size_t k = 0; k < numbers.values.size(); ++k) {
    if (!std::isfinite(numbers.values[k])) return Error{fmt::format("number {} is not finite", k)};
  }
  return numbers;
}

}  // namespace

Result<Numbers> readAccessor(const gltf::Model& model, int accessor, std::size_t width,
                             std::string_view what) {
  const auto a = indexOf(accessor, model.accessors.size());
  if (!a) return Error{fmt::format("{}: there is no accessor {}", what, accessor)};
  auto numbers = readNumbers(model, model.accessors[*a], width);
  if (!numbers) return Error{fmt::format("{}: accessor {}: {}", what, accessor, numbers.error().message)};
  return numbers;
}

// Column by column, as glTF stores them. The last row is taken to be 0 0 0 1.

}  // namespace ringlet
