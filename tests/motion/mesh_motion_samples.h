// Files of a mesh whose points move, in every form that is read.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "ringlet/bodies/triangle_mesh.h"
#include "tests/groom/crate_bytes.h"
#include "tests/motion/abc_samples.h"

namespace ringlet::test {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

inline std::string objText(const std::vector<Vec3d>& points, const Triangles& triangles) {
  std::string text;
  for (const Vec3d& p : points) text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
}

inline void append(std::string& bytes, std::uint32_t value, bool isBig) {
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> 8 * (isBig ? 3 - k : k) & 0xff);
}
inline void append(std::string& bytes, float value, bool isBig) {
  append(bytes, std::bit_cast<std::uint32_t>(value), isBig);
}
inline void appendPoints(std::string& bytes, const std::vector<std::vector<Vec3d>>& samples, bool isBig) {
  for (const auto& points : samples)
    for (const Vec3d& p : points)
      for (const double number : {p.x, p.y, p.z}) append(bytes, static_cast<float>(number), isBig);
}

inline std::string pc2Bytes(const std::vector<std::vector<Vec3d>>& samples, float framesPerSample = 1) {
  std::string bytes("POINTCACHE2\0", 12);
  append(bytes, std::uint32_t{1}, false);
  append(bytes, static_cast<std::uint32_t>(samples[0].size()), false);
  append(bytes, 1.0f, false);
  append(bytes, framesPerSample, false);
  append(bytes, static_cast<std::uint32_t>(samples.size()), false);
  appendPoints(bytes, samples, false);
  return bytes;
}

inline std::string mddBytes(const std::vector<std::vector<Vec3d>>& samples, double secondsPerSample) {
  std::string bytes;
  append(bytes, static_cast<std::uint32_t>(samples.size()), true);
  append(bytes, static_cast<std::uint32_t>(samples[0].size()), true);
  for (std::size_t k = 0; k < samples.size(); ++k)
    append(bytes, static_cast<float>(static_cast<double>(k) * secondsPerSample), true);
  appendPoints(bytes, samples, true);
  return bytes;
}

inline std::string usdTuples(const std::vector<Vec3d>& points) {
  std::string text;
  for (const Vec3d& p : points)
    text += fmt::format("{}({:.9g}, {:.9g}, {:.9g})", text.empty() ? "" : ", ", p.x, p.y, p.z);
  return "[" + text + "]";
}

/// A Mesh "M" in a layer of metres with Y up; `more`: lines of the prim.
inline std::string usdaText(const Triangles& triangles, const std::vector<std::vector<Vec3d>>& samples,
                            double framesPerSecond, const std::string& more = "") {
  std::string corners, counts, points;
  for (const auto& [a, b, c] : triangles) {
    corners += fmt::format("{}{}, {}, {}", corners.empty() ? "" : ", ", a, b, c);
    counts += counts.empty() ? "3" : ", 3";
  }
  for (std::size_t k = 0; k < samples.size(); ++k)
    points += fmt::format("    {}: {},\n", k + 1, usdTuples(samples[k]));
  return fmt::format(
      "#usda 1.0\n(\n  metersPerUnit = 1\n  upAxis = \"Y\"\n  timeCodesPerSecond = {}\n)\n"
      "def Mesh \"M\"\n{{\n  int[] faceVertexCounts = [{}]\n  int[] faceVertexIndices = [{}]\n"
      "  point3f[] points.timeSamples = {{\n{}  }}\n  uniform token subdivisionScheme = \"none\"\n{}}}\n",
      framesPerSecond, counts, corners, points, more);
}

/// The same as a crate.
inline std::string usdcBytes(const Triangles& triangles, const std::vector<std::vector<Vec3d>>& samples,
                             double framesPerSecond) {
  CrateBytes crate;
  for (const char* name : {"M", "points", "faceVertexCounts", "faceVertexIndices", "subdivisionScheme"})
    crate.name(name);
  std::vector<std::int32_t> corners;
  for (const auto& triangle : triangles)
    for (const std::uint32_t corner : triangle) corners.push_back(static_cast<std::int32_t>(corner));
  std::vector<double> times;
  std::vector<CrateBytes::Rep> values;
  for (const auto& points : samples) {
    times.push_back(static_cast<double>(times.size() + 1));
    std::vector<Vec3f> floats;
    for (const Vec3d& p : points) floats.push_back(static_cast<Vec3f>(p));
    values.push_back(crate.points(floats));
  }
  constexpr std::uint32_t kDouble = 9;
  crate.addRoot({"M"}, {{"metersPerUnit", crate.scalar<double>(kDouble, {1})},
                        {"timeCodesPerSecond", crate.scalar<double>(kDouble, {framesPerSecond})},
                        {"upAxis", crate.token("Y")}});
  crate.addPrim("/M", "Mesh");
  crate.addAttribute("/M.faceVertexCounts", crate.integers(std::vector<std::int32_t>(triangles.size(), 3)));
  crate.addAttribute("/M.faceVertexIndices", crate.integers(corners));
  crate.add("/M.points", CrateBytes::kAttribute, {{"timeSamples", crate.samples(times, values)}});
  crate.addAttribute("/M.subdivisionScheme", crate.token("none"));
  return crate.bytes();
}

inline void writeBytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// NAME.obj with NAME.pc2 and NAME.mdd, NAME.usda, NAME.usdc and NAME.abc, and NAME.0007.obj and on: of one
/// mesh, all samples.
inline void writeMeshMotion(const std::filesystem::path& folder, const std::string& name,
                            const Triangles& triangles, const std::vector<std::vector<Vec3d>>& samples,
                            double framesPerSecond) {
  writeBytes(folder / (name + ".obj"), objText(samples[0], triangles));
  writeBytes(folder / (name + ".pc2"), pc2Bytes(samples));
  writeBytes(folder / (name + ".mdd"), mddBytes(samples, 1 / framesPerSecond));
  writeBytes(folder / (name + ".usdc"), usdcBytes(triangles, samples, framesPerSecond));
  writeBytes(folder / (name + ".abc"), abcMeshBytes(triangles, samples, framesPerSecond));
  writeBytes(folder / (name + ".usda"), usdaText(triangles, samples, framesPerSecond));
  for (std::size_t k = 0; k < samples.size(); ++k)
    writeBytes(folder / fmt::format("{}.{:04}.obj", name, k + 7), objText(samples[k], triangles));
}

}  // namespace ringlet::test
