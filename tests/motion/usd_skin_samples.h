// A USD scene of prims and their properties, written as text and as a crate; and in it an arm: a mesh that
// three joints and two blend shapes deform, with where its points are by formulas of their own.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/base/vec3.h"
#include "tests/groom/crate_bytes.h"

namespace ringlet::test {

struct UsdSceneProperty {
  std::string type, name;  // "rel": texts are paths
  std::vector<double> numbers{};
  std::vector<std::string> texts{};
  std::vector<std::pair<double, std::vector<double>>> samples{};
  std::string interpolation{};
  bool isPrepended = false;  // of "rel"
};
struct UsdScenePrim {
  std::string path, type;
  std::vector<UsdSceneProperty> properties{};
};

class UsdScene {
 public:
  double metresPerUnit = 0.01, timeCodesPerSecond = 10;
  std::string up = "Z";
  std::vector<UsdScenePrim> prims;  // depth first

  UsdScenePrim& prim(const std::string& path) { return *std::ranges::find(prims, path, &UsdScenePrim::path); }
  /// A new one where there is none.
  UsdSceneProperty& at(const std::string& path, const std::string& name, const std::string& type = "") {
    auto& properties = prim(path).properties;
    const auto found = std::ranges::find(properties, name, &UsdSceneProperty::name);
    if (found != properties.end()) return *found;
    return properties.emplace_back(UsdSceneProperty{type, name});
  }
  void remove(const std::string& path, const std::string& name) {
    std::erase_if(prim(path).properties, [&](const auto& property) { return property.name == name; });
  }

  std::string text() const {
    std::string out =
        fmt::format("#usda 1.0\n(\n  metersPerUnit = {}\n  upAxis = \"{}\"\n  timeCodesPerSecond = {}\n)\n",
                    metresPerUnit, up, timeCodesPerSecond);
    std::vector<std::string> open;
    const auto closeTo = [&](const std::string& path) {
      while (!open.empty() && !path.starts_with(open.back() + "/")) {
        out += "}\n";
        open.pop_back();
      }
    };
    for (const UsdScenePrim& prim : prims) {
      closeTo(prim.path);
      open.push_back(prim.path);
      out += fmt::format("def {} \"{}\"\n{{\n", prim.type, prim.path.substr(prim.path.rfind('/') + 1));
      for (const UsdSceneProperty& property : prim.properties) out += textOf(property);
    }
    closeTo("");
    return out;
  }

  std::string crate() const {
    CrateBytes crate;
    for (const UsdScenePrim& prim : prims) {
      crate.name(prim.path.substr(prim.path.rfind('/') + 1));
      for (const UsdSceneProperty& property : prim.properties) crate.name(property.name);
    }
    crate.addRoot(childrenOf(""), {{"metersPerUnit", crate.scalar<double>(9, {metresPerUnit})},
                                   {"timeCodesPerSecond", crate.scalar<double>(9, {timeCodesPerSecond})},
                                   {"upAxis", crate.token(up)}});
    for (const UsdScenePrim& prim : prims) crate.addPrim(prim.path, prim.type, childrenOf(prim.path));
    for (const UsdScenePrim& prim : prims)
      for (const UsdSceneProperty& property : prim.properties) addTo(crate, prim.path, property);
    return crate.bytes();
  }

 private:
  static bool isArray(const UsdSceneProperty& property) { return property.type.ends_with("[]"); }
  static std::size_t widthOf(const std::string& type) {
    if (type.starts_with("matrix4d")) return 16;
    if (type.starts_with("quat")) return 4;
    return type.find('3') == type.npos ? 1 : 3;
  }

  std::vector<std::string> childrenOf(const std::string& path) const {
    std::vector<std::string> children;
    for (const UsdScenePrim& prim : prims)
      if (prim.path.substr(0, prim.path.rfind('/')) == path)
        children.push_back(prim.path.substr(prim.path.rfind('/') + 1));
    return children;
  }

  static std::string numbersText(const UsdSceneProperty& property, const std::vector<double>& numbers) {
    std::vector<std::string> elements;
    const std::size_t width = widthOf(property.type);
    const auto joined = [&](std::size_t first, std::size_t count) {
      std::vector<std::string> parts;
      for (std::size_t k = first; k < first + count; ++k) parts.push_back(fmt::format("{:.17g}", numbers[k]));
      return fmt::format("{}", fmt::join(parts, ", "));
    };
    for (std::size_t at = 0; at + width <= numbers.size(); at += width) {
      if (width == 16) {
        elements.push_back(fmt::format("(({}), ({}), ({}), ({}))", joined(at, 4), joined(at + 4, 4),
                                       joined(at + 8, 4), joined(at + 12, 4)));
      } else {
        elements.push_back(width == 1 ? joined(at, 1) : "(" + joined(at, width) + ")");
      }
    }
    const std::string all = fmt::format("{}", fmt::join(elements, ", "));
    return isArray(property) ? "[" + all + "]" : all;
  }
  static std::string textOf(const UsdSceneProperty& property) {
    std::string line = (property.isPrepended ? "prepend " : "") + property.type + " " + property.name;
    if (!property.samples.empty()) {
      line += ".timeSamples = {";
      for (const auto& [time, numbers] : property.samples)
        line += fmt::format(" {}: {},", time, numbersText(property, numbers));
      line += " }";
    } else if (property.type == "rel" || !property.texts.empty()) {
      std::vector<std::string> texts;
      for (const std::string& text : property.texts)
        texts.push_back(property.type == "rel" ? "<" + text + ">" : "\"" + text + "\"");
      const std::string all = fmt::format("{}", fmt::join(texts, ", "));
      line += texts.size() == 1 && !isArray(property) ? " = " + all : " = [" + all + "]";
    } else {
      line += " = " + numbersText(property, property.numbers);
    }
    if (!property.interpolation.empty())
      line += fmt::format(" ( elementSize = 2\n interpolation = \"{}\" )", property.interpolation);
    return line + "\n";
  }

  // Of numbers that a half holds.
  static std::uint16_t halfOf(double number) {
    if (number == 0) return 0;
    int exponent = 0;
    const double digits = std::frexp(std::abs(number), &exponent);
    return static_cast<std::uint16_t>((number < 0 ? 0x8000 : 0) + ((exponent + 14) << 10) +
                                      static_cast<int>((2 * digits - 1) * 1024));
  }
  template <class Number>
  static CrateBytes::Rep numbersOf(CrateBytes& crate, std::uint32_t type, const UsdSceneProperty& property,
                                   const std::vector<double>& numbers) {
    std::vector<Number> converted;
    for (const double number : numbers) converted.push_back(static_cast<Number>(number));
    return isArray(property) ? crate.array(type, converted, widthOf(property.type))
                             : crate.scalar(type, converted);
  }
  static CrateBytes::Rep valueOf(CrateBytes& crate, const UsdSceneProperty& property,
                                 std::vector<double> numbers) {
    const std::string& type = property.type;
    if (type.starts_with("quat"))  // a crate has the real part last
      for (std::size_t at = 0; at < numbers.size(); at += 4)
        std::rotate(numbers.begin() + static_cast<std::ptrdiff_t>(at),
                    numbers.begin() + static_cast<std::ptrdiff_t>(at + 1),
                    numbers.begin() + static_cast<std::ptrdiff_t>(at + 4));
    if (type.starts_with("half3")) {
      std::vector<std::uint16_t> halves;
      for (const double number : numbers) halves.push_back(halfOf(number));
      return crate.array(25, halves, 3);
    }
    if (type == "asset") return CrateBytes::inlined(12, 0);  // which is not read
    if (type == "float") return crate.real(static_cast<float>(numbers.front()));
    if (type.starts_with("int")) return numbersOf<std::int32_t>(crate, 3, property, numbers);
    if (type.starts_with("matrix4d")) return numbersOf<double>(crate, 15, property, numbers);
    if (type.starts_with("double3")) return numbersOf<double>(crate, 23, property, numbers);
    if (type.starts_with("quat")) return numbersOf<float>(crate, 17, property, numbers);
    return numbersOf<float>(crate, type.starts_with("float[]") ? 8 : 24, property, numbers);
  }
  static void addTo(CrateBytes& crate, const std::string& prim, const UsdSceneProperty& property) {
    const std::string path = prim + "." + property.name;
    if (property.type == "rel") {
      crate.add(path, CrateBytes::kRelationship,
                {{"targetPaths", crate.pathList(property.texts, property.isPrepended)}});
      return;
    }
    CrateBytes::Fields fields;
    if (!property.samples.empty()) {
      std::vector<double> times;
      std::vector<CrateBytes::Rep> values;
      for (const auto& [time, numbers] : property.samples) {
        times.push_back(time);
        values.push_back(valueOf(crate, property, numbers));
      }
      fields.push_back({"timeSamples", crate.samples(times, values)});
    } else if (!property.texts.empty()) {
      fields.push_back({"default", isArray(property) ? crate.tokens(property.texts)
                                                     : crate.token(property.texts.front())});
    } else {
      fields.push_back({"default", valueOf(crate, property, property.numbers)});
    }
    if (!property.interpolation.empty())
      fields.push_back({"interpolation", crate.token(property.interpolation)});
    crate.add(path, CrateBytes::kAttribute, fields);
  }
};

// --- Maps of points, one after the other, and undone the other way round.

struct TestMove {
  char kind;  // 'm': by v; 'x', 'y', 'z': about this axis by v.x degrees; 's': scaled by v
  Vec3d v;
};
using TestMoves = std::vector<TestMove>;

inline Vec3d moved(Vec3d p, const TestMoves& moves) {
  for (const auto& [kind, v] : moves) {
    const double a = v.x * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
    if (kind == 'm') p = {p.x + v.x, p.y + v.y, p.z + v.z};
    if (kind == 's') p = {p.x * v.x, p.y * v.y, p.z * v.z};
    if (kind == 'x') p = {p.x, p.y * c - p.z * s, p.y * s + p.z * c};
    if (kind == 'y') p = {p.x * c + p.z * s, p.y, p.z * c - p.x * s};
    if (kind == 'z') p = {p.x * c - p.y * s, p.x * s + p.y * c, p.z};
  }
  return p;
}
inline Vec3d movedBack(Vec3d p, const TestMoves& moves) {
  for (std::size_t k = moves.size(); k-- > 0;) {
    const auto& [kind, v] = moves[k];
    p = moved(p, {{kind, kind == 's' ? Vec3d{1 / v.x, 1 / v.y, 1 / v.z} : -v}});
  }
  return p;
}
/// Four rows of what multiplies rows.
inline std::vector<double> matrixOf(const TestMoves& moves) {
  const Vec3d origin = moved({}, moves);
  std::vector<double> numbers;
  for (const Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    const Vec3d row = moved(axis, moves) - origin;
    numbers.insert(numbers.end(), {row.x, row.y, row.z, 0});
  }
  numbers.insert(numbers.end(), {origin.x, origin.y, origin.z, 1});
  return numbers;
}
inline std::vector<double> matricesOf(const std::vector<TestMoves>& all) {
  std::vector<double> numbers;
  for (const TestMoves& moves : all) {
    const auto matrix = matrixOf(moves);
    numbers.insert(numbers.end(), matrix.begin(), matrix.end());
  }
  return numbers;
}
/// Real part first, about x, y or z.
inline std::vector<double> turnNumbers(char axis, double degrees) {
  const double half = degrees * std::numbers::pi / 360, s = std::sin(half);
  return {std::cos(half), axis == 'x' ? s : 0, axis == 'y' ? s : 0, axis == 'z' ? s : 0};
}
inline std::vector<double> joinedNumbers(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
inline std::vector<double> numbersOfPoints(const std::vector<Vec3d>& points) {
  std::vector<double> numbers;
  for (const Vec3d& p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
  return numbers;
}

// --- The arm. Joints of the skeleton: Upper, Upper/Lower, Upper/Lower/Hand; the hand is not animated. The
// animation has them in another order, and so has the mesh.

namespace arm {

inline const std::vector<Vec3d> kPoints{
    {0, 0, 0}, {0.5, 0.25, 0}, {1.25, -0.25, 0.5}, {1.75, 0.125, -0.25}, {2.5, 0, 0.25}};
inline const std::vector<Vec3d> kBulge{{0, 0.25, 0}, {0, 0, 0.5}};  // of points 3 and 1
inline const std::vector<Vec3d> kDent{{0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {-0.5, 0, 0}, {0, -0.5, 0}};
inline const TestMoves kBindUpper{{'y', {15, 0, 0}}, {'m', {0, 0, 0.125}}};
inline const TestMoves kBindLower{{'z', {40, 0, 0}}, {'m', {1, 0, 0}}};
inline const TestMoves kBindHand{{'s', {2, 1, 0.5}}, {'x', {70, 0, 0}}, {'m', {2, 0, 0}}};
inline const TestMoves kRestUpper{{'z', {10, 0, 0}}, {'m', {0, 0.25, 0}}};
inline const TestMoves kRestLower{{'x', {-20, 0, 0}}, {'m', {1, 0, 0}}};
inline const TestMoves kRestHand{{'x', {30, 0, 0}}, {'m', {0.875, 0, 0}}};
inline const TestMoves kGeomBind{{'s', {1, 1, 1.5}}, {'z', {-25, 0, 0}}, {'m', {0.25, 0.5, 0}}};
inline const TestMoves kSkeleton{{'x', {90, 0, 0}}, {'m', {5, 6, 7}}};

/// Weights of upper arm, lower arm and hand, of each point; their sums are not 1.
inline constexpr double kWeights[5][3] = {{2, 0, 0}, {1, 3, 0}, {0, 0.5, 0}, {0, 1, 1}, {0, 0, 0.25}};

inline TestMoves upperAt(double s) {
  return {{'s', {1 + 0.5 * s, 1, 1}}, {'z', {20 + 60 * s, 0, 0}}, {'m', {0, 0.5 * s, 0}}};
}
inline TestMoves lowerAt(double s) {
  return {{'s', {1, 1, 1 + s}}, {'x', {-50 * s, 0, 0}}, {'m', {1 + 0.25 * s, 0, 0}}};
}
inline double share(double seconds, double first, double last) {
  return std::clamp((seconds - first) / (last - first), 0.0, 1.0);
}

/// Point p of the mesh with its blend shapes, before the joints.
inline Vec3d shaped(std::size_t p, double seconds) {
  const double s = share(seconds, 1.2, 1.8), bulge = s, dent = 0.5 - s;
  return kPoints[p] + kDent[p] * dent + (p == 3 ? kBulge[0] * bulge : p == 1 ? kBulge[1] * bulge : Vec3d{});
}
/// A point of the mesh as the joints carry it, in the skeleton's space.
inline Vec3d skinned(Vec3d point, const double (&weights)[3], const TestMoves& upper,
                     const TestMoves& lower) {
  const Vec3d q = moved(point, kGeomBind);
  const Vec3d places[3] = {moved(movedBack(q, kBindUpper), upper),
                           moved(moved(movedBack(q, kBindLower), lower), upper),
                           moved(moved(moved(movedBack(q, kBindHand), kRestHand), lower), upper)};
  const double sum = weights[0] + weights[1] + weights[2];
  return (places[0] * weights[0] + places[1] * weights[1] + places[2] * weights[2]) / sum;
}
/// From the skeleton's space, in centimetres with Z up, to metres with Y up.
inline Vec3d inWorld(Vec3d p) {
  const Vec3d q = moved(p, kSkeleton) * 0.01;
  return {q.x, q.z, -q.y};
}
inline Vec3d pointAt(std::size_t p, double seconds) {
  const double s = share(seconds, 1, 2);
  return inWorld(skinned(shaped(p, seconds), kWeights[p], upperAt(s), lowerAt(s)));
}

inline void addSkeleton(UsdScene& scene) {
  scene.prims.push_back({"/Root/Bones", "Skeleton", {}});
  const auto add = [&](UsdSceneProperty property) {
    scene.prims.back().properties.push_back(std::move(property));
  };
  add({.type = "token[]", .name = "joints", .texts = {"Upper", "Upper/Lower", "Upper/Lower/Hand"}});
  add({"matrix4d[]", "bindTransforms", matricesOf({kBindUpper, kBindLower, kBindHand})});
  add({"matrix4d[]", "restTransforms", matricesOf({kRestUpper, kRestLower, kRestHand})});
  add({.type = "rel", .name = "skel:animationSource", .texts = {"/Root/Bones/Wave"}});
  add({"double3", "xformOp:translate", {5, 6, 7}});
  add({"float", "xformOp:rotateX", {90}});
  add({.type = "token[]", .name = "xformOpOrder", .texts = {"xformOp:translate", "xformOp:rotateX"}});

  // The second quaternions say the same turns from the far side.
  scene.prims.push_back({"/Root/Bones/Wave", "SkelAnimation", {}});
  const auto far = [](std::vector<double> turn) {
    for (double& number : turn) number = -number;
    return turn;
  };
  add({.type = "token[]", .name = "joints", .texts = {"Upper/Lower", "Upper"}});
  add({.type = "float3[]",
       .name = "translations",
       .samples = {{10, {1, 0, 0, 0, 0, 0}}, {20, {1.25, 0, 0, 0, 0.5, 0}}}});
  add({.type = "quatf[]",
       .name = "rotations",
       .samples = {{10, joinedNumbers(turnNumbers('x', 0), turnNumbers('z', 20))},
                   {20, joinedNumbers(far(turnNumbers('x', -50)), far(turnNumbers('z', 80)))}}});
  add({.type = "half3[]",
       .name = "scales",
       .samples = {{10, {1, 1, 1, 1, 1, 1}}, {20, {1, 1, 2, 1.5, 1, 1}}}});
  add({.type = "token[]", .name = "blendShapes", .texts = {"Dent", "Other", "Bulge"}});
  add({.type = "float[]", .name = "blendShapeWeights", .samples = {{12, {0.5, 9, 0}}, {18, {-0.5, 9, 1}}}});
}

inline void addMesh(UsdScene& scene) {
  scene.prims.push_back({"/Root/Arm", "Mesh", {}});
  const auto add = [&](UsdSceneProperty property) {
    scene.prims.back().properties.push_back(std::move(property));
  };
  // Two influences a point: the first two weights that are not 0, of joints in the mesh's order.
  std::vector<double> joints, weights;
  for (const auto& of : kWeights) {
    std::vector<std::pair<double, double>> some;
    for (std::size_t j = 0; j < 3; ++j)
      if (of[j] != 0) some.push_back({j == 0 ? 1 : j == 1 ? 2 : 0, of[j]});
    some.resize(2);
    for (const auto& [joint, weight] : some) {
      joints.push_back(joint);
      weights.push_back(weight);
    }
  }
  add({"point3f[]", "points", numbersOfPoints(kPoints)});
  add({"int[]", "faceVertexCounts", {3, 3, 3}});
  add({"int[]", "faceVertexIndices", {0, 1, 2, 1, 2, 3, 2, 3, 4}});
  add({.type = "token", .name = "subdivisionScheme", .texts = {"none"}});
  add({.type = "token[]", .name = "skel:joints", .texts = {"Upper/Lower/Hand", "Upper", "Upper/Lower"}});
  add({.type = "int[]", .name = "primvars:skel:jointIndices", .numbers = joints, .interpolation = "vertex"});
  add({.type = "float[]",
       .name = "primvars:skel:jointWeights",
       .numbers = weights,
       .interpolation = "vertex"});
  add({"matrix4d", "primvars:skel:geomBindTransform", matrixOf(kGeomBind)});
  add({"double3", "xformOp:translate", {100, 0, 0}});  // which joints do not follow
  add({.type = "token[]", .name = "xformOpOrder", .texts = {"xformOp:translate"}});
  add({.type = "token[]", .name = "skel:blendShapes", .texts = {"Bulge", "Dent"}});
  add({.type = "rel",
       .name = "skel:blendShapeTargets",
       .texts = {"/Root/Arm/BulgeShape", "/Root/Arm/DentShape"}});
  scene.prims.push_back({"/Root/Arm/BulgeShape", "BlendShape", {}});
  add({"vector3f[]", "offsets", numbersOfPoints(kBulge)});
  add({"int[]", "pointIndices", {3, 1}});
  scene.prims.push_back({"/Root/Arm/DentShape", "BlendShape", {}});
  add({"vector3f[]", "offsets", numbersOfPoints(kDent)});
}

/// The skeleton is bound above the mesh.
inline UsdScene scene() {
  UsdScene made;
  made.prims.push_back(
      {"/Root", "SkelRoot", {{.type = "rel", .name = "skel:skeleton", .texts = {"/Root/Bones"}}}});
  addSkeleton(made);
  addMesh(made);
  return made;
}

}  // namespace arm

}  // namespace ringlet::test
