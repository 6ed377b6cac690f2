// Implements the reading of motion/gltf_file.h. TinyGLTF takes the file apart; here every index and size it
// found is checked and every number becomes a double. The one file that knows TinyGLTF, and holds its code.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>  // TinyGLTF forgets it where it reads no files
#include <limits>
#include <new>
#include <numbers>
#include <type_traits>

#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/motion/gltf_buffers.h"
#include "ringlet/motion/gltf_bytes.h"
#include "ringlet/motion/gltf_file.h"

// Under a name of our own: a program that uses Ringlet may hold a TinyGLTF too.
#define tinygltf ringlet_tinygltf
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

namespace ringlet {
namespace {

namespace gltf = ringlet_tinygltf;

constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr const char* kDraco = "KHR_draco_mesh_compression";

// In a message: what TinyGLTF says has many lines, and pieces of the file.
std::string oneLine(std::string_view text) {
  constexpr std::size_t kLongest = 300;
  std::string line;
  for (char c : text.substr(0, kLongest)) {
    if (c == '\n') {
      line += line.empty() || line.back() == ' ' ? "" : " ";
    } else {
      line += c >= 0x20 && c < 0x7f ? c : '?';
    }
  }
  while (line.ends_with(' ') || line.ends_with('.')) line.pop_back();
  return line;
}

std::optional<std::size_t> indexOf(int index, std::size_t count) {
  if (index < 0 || static_cast<std::size_t>(index) >= count) return std::nullopt;
  return static_cast<std::size_t>(index);
}

// The numbers of an accessor, element after element.
struct Numbers {
  std::size_t width = 0, count = 0;
  std::vector<double> values;

  Vec3d vec3(std::size_t i) const { return {values[3 * i], values[3 * i + 1], values[3 * i + 2]}; }
};

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

Result<Numbers> readAccessor(const gltf::Model& model, int accessor, std::size_t width,
                             std::string_view what) {
  const auto a = indexOf(accessor, model.accessors.size());
  if (!a) return Error{fmt::format("{}: there is no accessor {}", what, accessor)};
  auto numbers = readNumbers(model, model.accessors[*a], width);
  if (!numbers) return Error{fmt::format("{}: accessor {}: {}", what, accessor, numbers.error().message)};
  return numbers;
}

// Column by column, as glTF stores them. The last row is taken to be 0 0 0 1.
Affine matrixOf(const double* m) {
  return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

Result<GltfNode> readNode(const gltf::Model& model, std::size_t n) {
  const gltf::Node& from = model.nodes[n];
  GltfNode node;
  node.name = from.name;
  const auto sized = [&](const std::vector<double>& numbers, std::size_t size) {
    return (numbers.empty() || numbers.size() == size) &&
           std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
  };
  if (!sized(from.translation, 3) || !sized(from.rotation, 4) || !sized(from.scale, 3) ||
      !sized(from.matrix, 16))
    return Error{fmt::format("node {}: its place is not 3, 4 and 3 or 16 numbers", n)};
  if (!from.matrix.empty()) node.matrix = matrixOf(from.matrix.data());
  if (!from.translation.empty())
    node.translation = {from.translation[0], from.translation[1], from.translation[2]};
  if (!from.scale.empty()) node.scale = {from.scale[0], from.scale[1], from.scale[2]};
  if (!from.rotation.empty()) {
    const Quatd q{from.rotation[0], from.rotation[1], from.rotation[2], from.rotation[3]};
    const double square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    if (!(square > 1e-12 && square < 1e12))
      return Error{fmt::format("node {}: its rotation ({}, {}, {}, {}) is none", n, q.x, q.y, q.z, q.w)};
    node.rotation = normalized(q);
  }
  if (from.mesh >= 0) {
    node.mesh = indexOf(from.mesh, model.meshes.size());
    if (!node.mesh) return Error{fmt::format("node {} has mesh {} of {}", n, from.mesh, model.meshes.size())};
  }
  if (from.skin >= 0) {
    node.skin = indexOf(from.skin, model.skins.size());
    if (!node.skin) return Error{fmt::format("node {} has skin {} of {}", n, from.skin, model.skins.size())};
  }
  if (from.camera >= 0) {
    node.camera = indexOf(from.camera, model.cameras.size());
    if (!node.camera)
      return Error{fmt::format("node {} has camera {} of {}", n, from.camera, model.cameras.size())};
  }
  return node;
}

// Who is whose parent, and an order in which parents come first; a ring of nodes has none.
Status readTree(const gltf::Model& model, GltfFile& file) {
  for (std::size_t n = 0; n < file.nodes.size(); ++n) {
    for (int child : model.nodes[n].children) {
      const auto c = indexOf(child, file.nodes.size());
      if (!c) return Error{fmt::format("node {} has child {} of {} nodes", n, child, file.nodes.size())};
      if (file.nodes[*c].parent)
        return Error{
            fmt::format("node {} is a child of both node {} and node {}", *c, *file.nodes[*c].parent, n)};
      file.nodes[*c].parent = n;
    }
  }
  for (std::size_t n = 0; n < file.nodes.size(); ++n) {
    if (!file.nodes[n].parent) file.parentsFirst.push_back(n);
  }
  for (std::size_t k = 0; k < file.parentsFirst.size(); ++k) {
    for (int child : model.nodes[file.parentsFirst[k]].children)
      file.parentsFirst.push_back(static_cast<std::size_t>(child));
  }
  if (file.parentsFirst.size() < file.nodes.size()) {
    return Error{fmt::format("{} of {} nodes are their own parents' parents",
                             file.nodes.size() - file.parentsFirst.size(), file.nodes.size())};
  }
  return {};
}

Result<GltfChannel> readChannel(const gltf::Model& model, const gltf::AnimationSampler& sampler,
                                std::size_t node, GltfChannel::Path path) {
  GltfChannel channel;
  channel.node = node;
  channel.path = path;
  using Interpolation = GltfChannel::Interpolation;
  if (sampler.interpolation == "STEP") {
    channel.interpolation = Interpolation::step;
  } else if (sampler.interpolation == "CUBICSPLINE") {
    channel.interpolation = Interpolation::cubicSpline;
  } else if (sampler.interpolation != "LINEAR" && !sampler.interpolation.empty()) {
    return Error{fmt::format("interpolation {} is not glTF's", ringlet::quoted(sampler.interpolation))};
  }
  auto seconds = readAccessor(model, sampler.input, 1, "times");
  if (!seconds) return seconds.error();
  auto values = readAccessor(model, sampler.output, channel.width(), "values");
  if (!values) return values.error();
  const std::size_t keys = seconds->count;
  const std::size_t parts = channel.interpolation == Interpolation::cubicSpline ? 3 : 1;
  if (values->count / parts < keys)
    return Error{fmt::format("{} keys have {} values, not {}", keys, values->count, keys * parts)};
  for (std::size_t k = 0; k + 1 < keys; ++k) {
    if (seconds->values[k + 1] < seconds->values[k])
      return Error{fmt::format("key {} is at {} s, the one before it at {} s", k + 1, seconds->values[k + 1],
                               seconds->values[k])};
  }
  channel.seconds = std::move(seconds->values);
  channel.values = std::move(values->values);
  return channel;
}

Result<GltfAnimation> readAnimation(const gltf::Model& model, const GltfFile& file,
                                    const gltf::Animation& from) {
  GltfAnimation animation;
  animation.name = from.name;
  animation.ofNode.resize(file.nodes.size());
  double first = INFINITY, last = -INFINITY;
  for (std::size_t c = 0; c < from.channels.size(); ++c) {
    using Path = GltfChannel::Path;
    const std::string& word = from.channels[c].target_path;
    const auto path = word == "translation" ? std::optional(Path::translation)
                      : word == "rotation"  ? std::optional(Path::rotation)
                      : word == "scale"     ? std::optional(Path::scale)
                                            : std::nullopt;
    if (!path) continue;  // morph weights, and what extensions animate
    const auto node = indexOf(from.channels[c].target_node, file.nodes.size());
    const auto sampler = indexOf(from.channels[c].sampler, from.samplers.size());
    if (!node || !sampler) {
      return Error{fmt::format("channel {} is of node {} of {} and sampler {} of {}", c,
                               from.channels[c].target_node, file.nodes.size(), from.channels[c].sampler,
                               from.samplers.size())};
    }
    if (file.nodes[*node].matrix)
      return Error{fmt::format("channel {} animates node {}, which has a matrix", c, *node)};
    auto channel = readChannel(model, from.samplers[*sampler], *node, *path);
    if (!channel) return Error{fmt::format("channel {}: {}", c, channel.error().message)};
    first = std::min(first, channel->seconds.front());
    last = std::max(last, channel->seconds.back());
    animation.ofNode[*node][static_cast<std::size_t>(*path)] = animation.channels.size();
    animation.channels.push_back(std::move(*channel));
  }
  if (!animation.channels.empty()) animation.firstSeconds = first, animation.lastSeconds = last;
  return animation;
}

Result<GltfSkin> readSkin(const gltf::Model& model, const gltf::Skin& from) {
  GltfSkin skin;
  for (int joint : from.joints) {
    const auto j = indexOf(joint, model.nodes.size());
    if (!j) return Error{fmt::format("joint {} of {} nodes", joint, model.nodes.size())};
    skin.joints.push_back(*j);
  }
  skin.inverseBinds.resize(skin.joints.size());  // where there are none, frames are the mesh's
  if (from.inverseBindMatrices < 0) return skin;
  const auto matrices = readAccessor(model, from.inverseBindMatrices, 16, "inverse bind matrices");
  if (!matrices) return matrices.error();
  if (matrices->count < skin.joints.size())
    return Error{fmt::format("{} joints have {} inverse bind matrices", skin.joints.size(), matrices->count)};
  for (std::size_t j = 0; j < skin.joints.size(); ++j)
    skin.inverseBinds[j] = matrixOf(matrices->values.data() + 16 * j);
  return skin;
}

// Appends the influences of a primitive's points: all its sets of four.
Status readInfluences(const gltf::Model& model, const gltf::Primitive& from, std::size_t pointCount,
                      GltfMesh& mesh, std::size_t& weightless) {
  std::vector<Numbers> joints, weights;
  for (int set = 0;; ++set) {
    const auto j = from.attributes.find(fmt::format("JOINTS_{}", set));
    const auto w = from.attributes.find(fmt::format("WEIGHTS_{}", set));
    if (j == from.attributes.end() || w == from.attributes.end()) break;
    auto jointNumbers = readAccessor(model, j->second, 4, j->first);
    if (!jointNumbers) return jointNumbers.error();
    auto weightNumbers = readAccessor(model, w->second, 4, w->first);
    if (!weightNumbers) return weightNumbers.error();
    if (jointNumbers->count != pointCount || weightNumbers->count != pointCount) {
      return Error{fmt::format("{} points have {} joints and {} weights", pointCount, jointNumbers->count,
                               weightNumbers->count)};
    }
    joints.push_back(std::move(*jointNumbers));
    weights.push_back(std::move(*weightNumbers));
  }
  for (std::size_t p = 0; p < pointCount; ++p) {
    const std::size_t before = mesh.influences.size();
    double sum = 0;
    for (std::size_t k = 0; k < 4 * joints.size(); ++k) {
      const double joint = joints[k / 4].values[4 * p + k % 4], weight = weights[k / 4].values[4 * p + k % 4];
      if (!(weight > 0)) continue;
      if (!(joint >= 0 && joint < 65536 && joint == std::floor(joint)))
        return Error{fmt::format("point {} follows joint {}", p, joint)};
      mesh.influences.push_back({static_cast<std::uint32_t>(joint), weight});
      mesh.jointCount = std::max(mesh.jointCount, static_cast<std::uint32_t>(joint) + 1);
      sum += weight;
    }
    for (std::size_t k = before; k < mesh.influences.size(); ++k) mesh.influences[k].weight /= sum;
    if (!joints.empty() && mesh.influences.size() == before) ++weightless;
    mesh.influencesBefore.push_back(static_cast<std::uint32_t>(mesh.influences.size()));
  }
  return {};
}

Error dracoProblem() {
  return Error{fmt::format("it is compressed by {}, which is not read; write it without", kDraco)};
}

Status readPrimitive(const gltf::Model& model, const gltf::Primitive& from, GltfMesh& mesh) {
  if (from.extensions.contains(kDraco)) return dracoProblem();
  const auto position = from.attributes.find("POSITION");
  if (position == from.attributes.end()) return Error{"it has no POSITION"};
  const auto points = readAccessor(model, position->second, 3, "POSITION");
  if (!points) return points.error();
  constexpr std::size_t kMostPoints = 0x7fffffff;
  const std::size_t first = mesh.points.size();
  if (points->count > kMostPoints - first) return Error{"it has too many points"};
  for (std::size_t p = 0; p < points->count; ++p) mesh.points.push_back(points->vec3(p));

  Numbers indices{1, points->count, {}};  // where there are none: one corner after the other
  if (from.indices >= 0) {
    auto found = readAccessor(model, from.indices, 1, "indices");
    if (!found) return found.error();
    indices = std::move(*found);
  }
  if (indices.count % 3 != 0) return Error{fmt::format("its {} corners are no triangles", indices.count)};
  for (std::size_t k = 0; k < indices.count; k += 3) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const double index = from.indices >= 0 ? indices.values[k + corner] : static_cast<double>(k + corner);
      if (!(index >= 0 && index < static_cast<double>(points->count) && index == std::floor(index)))
        return Error{fmt::format("triangle {} has point {} of {}", k / 3, index, points->count)};
      triangle[corner] = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(index);
    }
    mesh.triangles.push_back(triangle);
  }

  std::size_t weightless = 0;
  if (Status status = readInfluences(model, from, points->count, mesh, weightless); !status) return status;
  if (weightless > 0)
    mesh.warnings.push_back(fmt::format("{} points follow no joint; their node carries them", weightless));
  if (!from.targets.empty()) mesh.warnings.push_back("its morph targets are left out");
  return {};
}

GltfMesh readMesh(const gltf::Model& model, const gltf::Mesh& from) {
  GltfMesh mesh;
  mesh.influencesBefore = {0};
  for (std::size_t k = 0; k < from.primitives.size(); ++k) {
    if (from.primitives[k].mode != TINYGLTF_MODE_TRIANGLES) {
      mesh.warnings.push_back(fmt::format("primitive {} is of mode {}, no plain triangles; it is left out", k,
                                          from.primitives[k].mode));
      continue;
    }
    if (Status status = readPrimitive(model, from.primitives[k], mesh); !status) {
      mesh = {};
      mesh.influencesBefore = {0};
      mesh.problem = Error{fmt::format("primitive {}: {}", k, status.error().message)};
      break;
    }
  }
  mesh.name = from.name;
  return mesh;
}

GltfCamera readCamera(const gltf::Camera& from) {
  const double angle = from.perspective.yfov;
  const bool isFine = from.type == "perspective" && angle > 0 && angle < std::numbers::pi;
  return {isFine ? std::optional(angle) : std::nullopt};
}

// TinyGLTF's way to the files beside: those that were looked at, and no others.
bool isAnywhere(const std::string&, void*) { return true; }
std::string asItIs(const std::string& path, void*) { return path; }
bool readBeside(std::vector<unsigned char>* out, std::string* error, const std::string& path, void* user) {
  const auto& known = *static_cast<const std::vector<GltfBuffer>*>(user);
  if (std::ranges::find(known, path, [](const GltfBuffer& b) { return b.file.string(); }) == known.end()) {
    *error += "it is no buffer of this file";
    return false;
  }
  auto bytes = readWholeFile(path);
  if (!bytes) {
    *error += bytes.error().message;
    return false;
  }
  out->resize(bytes->size());
  if (!bytes->empty()) std::memcpy(out->data(), bytes->data(), bytes->size());
  return true;
}
bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}
bool passPicture(gltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
                 void*) {
  return true;
}

// A file as TinyGLTF sees it, or why not. `required`: the extensions it cannot be read without.
struct Parsed {
  gltf::Model model;
  std::optional<Error> problem;
  std::vector<std::string> required;
};

Parsed parse(std::span<const std::byte> bytes, const std::filesystem::path& folder, bool hidesMeshes) {
  Parsed parsed;
  std::vector<std::byte> guarded(bytes.begin(), bytes.end());
  const auto form = guardGltf(guarded, hidesMeshes);
  if (!form) {
    parsed.problem = form.error();
    return parsed;
  }
  auto buffers = gltfBuffersOf(gltfText(guarded, *form), folder);
  if (const Status checked = buffers ? checkGltfBuffers(*buffers) : Status(buffers.error()); !checked) {
    parsed.problem = checked.error();
    return parsed;
  }
  gltf::TinyGLTF reader;
  reader.SetFsCallbacks({isAnywhere, asItIs, readBeside, writeNothing, &*buffers});
  reader.SetImageLoader(passPicture, nullptr);
  std::string error, warning;
  const auto size = static_cast<unsigned>(guarded.size());
  const bool isRead =
      *form == GltfForm::binary
          ? reader.LoadBinaryFromMemory(&parsed.model, &error, &warning,
                                        reinterpret_cast<const unsigned char*>(guarded.data()), size,
                                        folder.string())
          : reader.LoadASCIIFromString(&parsed.model, &error, &warning,
                                       reinterpret_cast<const char*>(guarded.data()), size, folder.string());
  for (const std::string& extension : parsed.model.extensionsRequired)
    parsed.required.push_back(oneLine(extension));
  const std::string& version = parsed.model.asset.version;
  if (!isRead) {
    parsed.problem = Error{error.empty() ? "its text is not glTF's" : oneLine(error)};
    if (!parsed.required.empty())
      parsed.problem->message += fmt::format(" (it requires {})", fmt::join(parsed.required, ", "));
  } else if (!version.starts_with("2.")) {
    parsed.problem =
        Error{fmt::format("it is of version {}; version 2 can be read", ringlet::quoted(version))};
  }
  return parsed;
}

Result<GltfFile> fileOf(const gltf::Model& model) {
  GltfFile file;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    auto node = readNode(model, n);
    if (!node) return node.error();
    file.nodes.push_back(std::move(*node));
  }
  if (Status status = readTree(model, file); !status) return status.error();
  for (std::size_t a = 0; a < model.animations.size(); ++a) {
    auto animation = readAnimation(model, file, model.animations[a]);
    if (!animation) return Error{fmt::format("animation {}: {}", a, animation.error().message)};
    file.animations.push_back(std::move(*animation));
  }
  for (std::size_t s = 0; s < model.skins.size(); ++s) {
    auto skin = readSkin(model, model.skins[s]);
    if (!skin) return Error{fmt::format("skin {}: {}", s, skin.error().message)};
    file.skins.push_back(std::move(*skin));
  }
  for (const gltf::Mesh& mesh : model.meshes) file.meshes.push_back(readMesh(model, mesh));
  for (const gltf::Camera& camera : model.cameras) file.cameras.push_back(readCamera(camera));
  return file;
}

}  // namespace

Result<GltfFile> parseGltf(std::span<const std::byte> bytes, const std::filesystem::path& folder) try {
  Parsed parsed = parse(bytes, folder, false);
  const bool hidesMeshes =
      parsed.problem && std::ranges::find(parsed.required, kDraco) != parsed.required.end();
  // TinyGLTF refuses indices that are in no buffer, as Draco's are. Skeletons move without them.
  if (hidesMeshes) parsed = parse(bytes, folder, true);
  if (parsed.problem) return *parsed.problem;
  if (hidesMeshes) {
    for (gltf::Node& node : parsed.model.nodes) node.mesh = std::min(node.mesh, 0);
    parsed.model.meshes.resize(1);
  }
  auto file = fileOf(parsed.model);
  if (file && hidesMeshes) file->meshes.front().problem = dracoProblem();
  return file;
} catch (const std::bad_alloc&) {
  return Error{"there is not enough memory for it"};
} catch (const std::exception& problem) {
  return Error{fmt::format("its text is not glTF's: {}", oneLine(problem.what()))};
}

Result<GltfFile> readGltf(const std::filesystem::path& path) try {
  const auto bytes = readWholeFile(path);
  if (!bytes) return bytes.error();
  auto file = parseGltf(*bytes, path.parent_path());
  if (!file) {
    const Error& error = file.error();
    const char* what = error.fault == Fault::input ? "cannot be read" : "is no glTF";
    return Error{fmt::format("{} {}: {}", path.string(), what, error.message), error.fault};
  }
  return file;
} catch (const std::bad_alloc&) {
  return Error{fmt::format("{}: there is not enough memory for it", path.string())};
}

}  // namespace ringlet
