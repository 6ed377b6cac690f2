// Implements the reading of motion/gltf_file.h. TinyGLTF, whose code is compiled here, takes the file apart;
// here and in gltf_accessor.h every index and size that it found is checked.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>  // TinyGLTF forgets it where it reads no files
#include <limits>
#include <new>

#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/motion/gltf_accessor.h"
#include "ringlet/motion/gltf_buffers.h"
#include "ringlet/motion/gltf_bytes.h"
#include "ringlet/motion/gltf_file.h"

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
#undef TINYGLTF_IMPLEMENTATION

namespace ringlet {
namespace {

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

Affine matrixOf(const double* m) {
  return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

Result<GltfNode> readNode(const gltf::Model& model, std::size_t n) {
  const gltf::Node& from = model.nodes[n];
  GltfNode node;
  node.name = from.name;
  node.weights = from.weights;
  const auto sized = [&](const std::vector<double>& numbers, std::size_t size) {
    return (numbers.empty() || numbers.size() == size) &&
           std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
  };
  if (!sized(from.translation, 3) || !sized(from.rotation, 4) || !sized(from.scale, 3) ||
      !sized(from.matrix, 16) || !sized(from.weights, from.weights.size()))
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
                                std::size_t node, GltfChannel::Path path, std::size_t width) {
  GltfChannel channel;
  channel.node = node;
  channel.path = path;
  channel.width = width;
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
  const bool isWeights = path == GltfChannel::Path::weights;  // which are numbers, one after the other
  auto values = readAccessor(model, sampler.output, isWeights ? 1 : width, "values");
  if (!values) return values.error();
  const std::size_t keys = seconds->count;
  const std::size_t parts =
      (channel.interpolation == Interpolation::cubicSpline ? 3 : 1) * (isWeights ? width : 1);
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

// The morph targets of the node's mesh; 0 where it has none.
std::size_t morphCount(const gltf::Model& model, const GltfNode& node) {
  std::size_t count = 0;
  if (!node.mesh || *node.mesh >= model.meshes.size()) return count;
  for (const gltf::Primitive& primitive : model.meshes[*node.mesh].primitives)
    count = std::max(count, primitive.targets.size());
  return count;
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
                      : word == "weights"   ? std::optional(Path::weights)
                                            : std::nullopt;
    if (!path) continue;  // what extensions animate
    const auto node = indexOf(from.channels[c].target_node, file.nodes.size());
    const auto sampler = indexOf(from.channels[c].sampler, from.samplers.size());
    if (!node || !sampler) {
      return Error{fmt::format("channel {} is of node {} of {} and sampler {} of {}", c,
                               from.channels[c].target_node, file.nodes.size(), from.channels[c].sampler,
                               from.samplers.size())};
    }
    const bool isWeights = path == Path::weights;
    const std::size_t targets = isWeights ? morphCount(model, file.nodes[*node]) : 0;
    if (isWeights && targets == 0) continue;
    if (file.nodes[*node].matrix && !isWeights)
      return Error{fmt::format("channel {} animates node {}, which has a matrix", c, *node)};
    const std::size_t width = isWeights ? targets : path == Path::rotation ? 4 : 3;
    auto channel = readChannel(model, from.samplers[*sampler], *node, *path, width);
    if (!channel) return Error{fmt::format("channel {}: {}", c, channel.error().message)};
    if (isWeights) {
      animation.weights.push_back(std::move(*channel));
      continue;
    }
    first = std::min(first, channel->seconds.front());
    last = std::max(last, channel->seconds.back());
    animation.ofNode[*node][static_cast<std::size_t>(*path)] = animation.channels.size();
    animation.channels.push_back(std::move(*channel));
  }
  if (animation.channels.empty()) {
    for (const GltfChannel& weights : animation.weights) {
      first = std::min(first, weights.seconds.front());
      last = std::max(last, weights.seconds.back());
    }
  }
  if (first <= last) animation.firstSeconds = first, animation.lastSeconds = last;
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

// The shifts of points `first` and on in each morph target; one without POSITION has none.
Status readMorphs(const gltf::Model& model, const gltf::Primitive& from, std::size_t first, std::size_t count,
                  GltfMesh& mesh) {
  mesh.morphs.resize(std::max(mesh.morphs.size(), from.targets.size()));
  for (std::size_t m = 0; m < from.targets.size(); ++m) {
    const auto position = from.targets[m].find("POSITION");
    if (position == from.targets[m].end()) continue;
    const auto shifts = readAccessor(model, position->second, 3, "POSITION of a morph target");
    if (!shifts) return shifts.error();
    if (shifts->count != count)
      return Error{fmt::format("morph target {} has {} points, not {}", m, shifts->count, count)};
    for (std::size_t p = 0; p < count; ++p)
      if (shifts->vec3(p) != Vec3d{})
        mesh.morphs[m].push_back({static_cast<std::uint32_t>(first + p), shifts->vec3(p)});
  }
  return {};
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
  return readMorphs(model, from, first, points->count, mesh);
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
  mesh.weights = from.weights;
  if (!std::ranges::all_of(mesh.weights, [](double x) { return std::isfinite(x); }))
    mesh.problem = Error{"its weights of morph targets are not finite"};
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
