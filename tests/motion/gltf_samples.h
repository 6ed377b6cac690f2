// Writes small glTF files for tests: a JSON tree, and a buffer that accessors are put into one by one.
#pragma once

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet::test {

class GltfBuilder {
 public:
  nlohmann::json root = {{"asset", {{"version", "2.0"}}}, {"nodes", nlohmann::json::array()}};

  /// Each returns the index of what it adds.
  int node(nlohmann::json node) { return add(root["nodes"], std::move(node)); }

  /// `type` as SCALAR, VEC3; T as componentType says.
  template <class T>
  int accessor(const std::vector<T>& numbers, const char* type, int componentType,
               bool isNormalized = false) {
    while (bytes_.size() % 4 != 0) bytes_.push_back('\0');
    const std::string kind = type;
    const std::size_t width = kind == "MAT4"     ? 16
                              : kind == "SCALAR" ? 1
                                                 : static_cast<std::size_t>(kind[3] - '0');
    const std::size_t size = numbers.size() * sizeof(T);
    const int view =
        add(root["bufferViews"], {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}});
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), size);
    nlohmann::json accessor = {{"bufferView", view},
                               {"componentType", componentType},
                               {"count", numbers.size() / width},
                               {"type", type}};
    if (isNormalized) accessor["normalized"] = true;
    return add(root["accessors"], std::move(accessor));
  }
  int floats(const std::vector<double>& numbers, const char* type) {
    return accessor(std::vector<float>(numbers.begin(), numbers.end()), type, 5126);
  }

  /// Of animation `a`, which may be the next one.
  void channel(std::size_t a, int node, const char* path, const char* interpolation,
               const std::vector<double>& seconds, const std::vector<double>& values) {
    auto& animation = root["animations"][a];
    if (animation.is_null()) animation = {{"name", "take" + std::to_string(a)}};
    const int sampler =
        add(animation["samplers"], {{"input", floats(seconds, "SCALAR")},
                                    {"output", floats(values, std::string(path) == "rotation"  ? "VEC4"
                                                              : std::string(path) == "weights" ? "SCALAR"
                                                                                               : "VEC3")},
                                    {"interpolation", interpolation}});
    add(animation["channels"], {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
  }

  const std::string& bytes() const { return bytes_; }

  /// With the buffer inside.
  std::string text() const {
    nlohmann::json tree = root;
    if (!bytes_.empty())
      tree["buffers"] = {
          {{"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes_)}}};
    return tree.dump();
  }
  /// With the buffer in a file beside.
  std::string textBeside(const std::string& file) const {
    nlohmann::json tree = root;
    tree["buffers"] = {{{"byteLength", bytes_.size()}, {"uri", file}}};
    return tree.dump();
  }
  std::string glb() const {
    nlohmann::json tree = root;
    tree["buffers"] = {{{"byteLength", bytes_.size()}}};
    std::string text = tree.dump(), binary = bytes_;
    while (text.size() % 4 != 0) text += ' ';
    while (binary.size() % 4 != 0) binary += '\0';
    const std::size_t whole = 12 + 8 + text.size() + 8 + binary.size();
    return "glTF" + number(2) + number(whole) + number(text.size()) + "JSON" + text + number(binary.size()) +
           std::string("BIN\0", 4) + binary;
  }

 private:
  static int add(nlohmann::json& list, nlohmann::json what) {
    if (list.is_null()) list = nlohmann::json::array();
    list.push_back(std::move(what));
    return static_cast<int>(list.size()) - 1;
  }
  static std::string number(std::size_t value) {
    std::string four;
    for (int k = 0; k < 4; ++k) four += static_cast<char>(value >> (8 * k) & 0xff);
    return four;
  }
  static std::string base64(const std::string& bytes) {
    const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
      std::uint32_t three = 0;
      for (std::size_t j = 0; j < 3; ++j)
        three = three << 8 | (k + j < bytes.size() ? static_cast<unsigned char>(bytes[k + j]) : 0u);
      for (std::size_t j = 0; j < 4; ++j)
        out += k + j > bytes.size() ? '=' : letters[three >> (18 - 6 * j) & 63];
    }
    return out;
  }

  std::string bytes_;
};

inline std::span<const std::byte> bytesOf(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// A strip along X from 0 to 2, 0.2 wide along Z, of `pieces` pieces, on two bones: one at the origin, one at
/// X = 1 that turns about Z by a quarter in a second. A point at x follows the second by x / 2.
/// `jointType` 5121 or 5123, `weightType` 5121, 5123 or 5126; `sum`: of a point's weights, as the file has
/// them.
inline GltfBuilder bendingStrip(int pieces, int jointType, int weightType, double sum = 1) {
  GltfBuilder file;
  const int first = file.node({{"name", "bone0"}, {"children", {1}}});
  const int second = file.node({{"name", "bone1"}, {"translation", {1, 0, 0}}});
  std::vector<double> points, weights;
  std::vector<std::uint16_t> indices;
  std::vector<int> joints;
  for (int k = 0; k <= pieces; ++k) {
    for (double z : {-0.1, 0.1}) {
      const double x = 2.0 * k / pieces;
      points.insert(points.end(), {x, 0, z});
      weights.insert(weights.end(), {sum * x / 2, sum * (1 - x / 2), 0, 0});
      joints.insert(joints.end(), {1, 0, 0, 0});
    }
    const auto p = static_cast<std::uint16_t>(2 * k);
    const auto next = [p](int by) { return static_cast<std::uint16_t>(p + by); };
    if (k < pieces) indices.insert(indices.end(), {p, next(1), next(2), next(2), next(1), next(3)});
  }
  const auto scaled = [&](double most) {
    std::vector<double> numbers;
    for (double w : weights) numbers.push_back(std::round(w * most));
    return numbers;
  };
  const auto as8 = [](const auto& v) { return std::vector<std::uint8_t>(v.begin(), v.end()); };
  const auto as16 = [](const auto& v) { return std::vector<std::uint16_t>(v.begin(), v.end()); };
  const int weightNumbers = weightType == 5126   ? file.floats(weights, "VEC4")
                            : weightType == 5121 ? file.accessor(as8(scaled(255)), "VEC4", 5121, true)
                                                 : file.accessor(as16(scaled(65535)), "VEC4", 5123, true);
  file.root["meshes"] = {{{"name", "strip"},
                          {"primitives",
                           {{{"attributes",
                              {{"POSITION", file.floats(points, "VEC3")},
                               {"WEIGHTS_0", weightNumbers},
                               {"JOINTS_0", jointType == 5121 ? file.accessor(as8(joints), "VEC4", 5121)
                                                              : file.accessor(as16(joints), "VEC4", 5123)}}},
                             {"indices", file.accessor(indices, "SCALAR", 5123)}}}}}};
  std::vector<double> binds(32, 0);
  for (std::size_t k : {0, 5, 10, 15}) binds[k] = binds[16 + k] = 1;
  binds[16 + 12] = -1;
  file.root["skins"] = {{{"joints", {first, second}}, {"inverseBindMatrices", file.floats(binds, "MAT4")}}};
  // Where it is does not matter: joints carry a skin.
  file.node({{"name", "strip"}, {"mesh", 0}, {"skin", 0}, {"translation", {50, 60, 70}}});
  const double half = std::sqrt(0.5);
  file.channel(0, second, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, half, half});
  return file;
}

/// The turn of the strip's second bone at t, and what becomes of a point of it.
inline Quatd stripTurn(double t) { return fromRotationVector(Vec3d{0, 0, t * std::numbers::pi / 2}); }
inline Vec3d bentPoint(Vec3d rest, double t) {
  const Vec3d bone{1, 0, 0};
  const double weight = rest.x / 2;
  return rest * (1 - weight) + (rotate(stripTurn(t), rest - bone) + bone) * weight;
}

}  // namespace ringlet::test
