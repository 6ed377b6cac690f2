// Value clips of a mesh "M": the layer that names them and the clips, as text and as crates.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/motion/mesh_motion_samples.h"

namespace ringlet::test {

using NumberPairs = std::vector<std::pair<double, double>>;

struct SampleTemplate {
  std::string path;
  double start = 0, end = 0, stride = 1;
  std::optional<double> offset{};
};

struct SampleClipSet {
  std::vector<std::string> files{};
  NumberPairs active{}, times{};
  std::optional<SampleTemplate> form{};  // in place of these
  std::string primPath = "/M";
  bool fillsGaps = false;
  std::string name = "default";
  std::string more{};  // lines of text
};

inline std::string pairsText(const NumberPairs& pairs) {
  std::vector<std::string> parts;
  for (const auto& [a, b] : pairs) parts.push_back(fmt::format("({}, {})", a, b));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

/// The entry of one set in `clips`.
inline std::string clipSetText(const SampleClipSet& set) {
  std::string text =
      fmt::format("    dictionary {} = {{\n      string primPath = \"{}\"\n", set.name, set.primPath);
  if (!set.files.empty())
    text += fmt::format("      asset[] assetPaths = [@{}@]\n", fmt::join(set.files, "@, @"));
  if (!set.active.empty()) text += "      double2[] active = " + pairsText(set.active) + "\n";
  if (!set.times.empty()) text += "      double2[] times = " + pairsText(set.times) + "\n";
  if (set.form) {
    text += fmt::format(
        "      string templateAssetPath = \"{}\"\n      double templateStartTime = {}\n"
        "      double templateEndTime = {}\n      double templateStride = {}\n",
        set.form->path, set.form->start, set.form->end, set.form->stride);
    if (set.form->offset) text += fmt::format("      double templateActiveOffset = {}\n", *set.form->offset);
  }
  if (set.fillsGaps) text += "      bool interpolateMissingClipValues = true\n";
  return text + set.more + "    }\n";
}

/// The metadata of a prim.
inline std::string clipsText(const std::vector<SampleClipSet>& sets, const std::string& more = "") {
  std::string text = "(\n  clips = {\n";
  for (const SampleClipSet& set : sets) text += clipSetText(set);
  return text + "  }\n" + more + ")\n";
}

inline CrateBytes::Rep pairsRep(CrateBytes& crate, const NumberPairs& pairs) {
  std::vector<double> numbers;
  for (const auto& [a, b] : pairs) numbers.insert(numbers.end(), {a, b});
  return crate.array(19, numbers, 2);
}
inline CrateBytes::Rep clipsRep(CrateBytes& crate, const std::vector<SampleClipSet>& sets) {
  CrateBytes::Fields all;
  for (const SampleClipSet& set : sets) {
    CrateBytes::Fields entries{{"primPath", crate.string(set.primPath)}};
    if (!set.files.empty()) entries.push_back({"assetPaths", crate.assets(set.files)});
    if (!set.active.empty()) entries.push_back({"active", pairsRep(crate, set.active)});
    if (!set.times.empty()) entries.push_back({"times", pairsRep(crate, set.times)});
    if (set.form) {
      const auto number = [&](const char* name, double value) {
        entries.push_back({name, crate.scalar<double>(9, {value})});
      };
      entries.push_back({"templateAssetPath", crate.string(set.form->path)});
      number("templateStartTime", set.form->start);
      number("templateEndTime", set.form->end);
      number("templateStride", set.form->stride);
      if (set.form->offset) number("templateActiveOffset", *set.form->offset);
    }
    if (set.fillsGaps) entries.push_back({"interpolateMissingClipValues", crate.flag(true)});
    all.push_back({set.name, crate.dictionary(entries)});
  }
  return crate.dictionary(all);
}

inline std::string facesText(const Triangles& triangles) {
  std::vector<std::string> corners;
  for (const auto& [a, b, c] : triangles) corners.push_back(fmt::format("{}, {}, {}", a, b, c));
  return fmt::format("  int[] faceVertexCounts = [{}]\n  int[] faceVertexIndices = [{}]\n",
                     fmt::join(std::vector<int>(triangles.size(), 3), ", "), fmt::join(corners, ", "));
}

/// The layer, of metres with Y up: faces and clips; `more`: lines of the prim.
inline std::string clippedText(const Triangles& triangles, double framesPerSecond,
                               const std::string& metadata, const std::string& more = "") {
  return fmt::format(
      "#usda 1.0\n(\n  metersPerUnit = 1\n  upAxis = \"Y\"\n  timeCodesPerSecond = {}\n)\n"
      "def Mesh \"M\" {}{{\n{}  point3f[] points\n  uniform token subdivisionScheme = \"none\"\n{}}}\n",
      framesPerSecond, metadata, facesText(triangles), more);
}
inline std::string clippedCrate(const Triangles& triangles, double framesPerSecond,
                                const std::vector<SampleClipSet>& sets) {
  CrateBytes crate;
  for (const char* name : {"M", "faceVertexCounts", "faceVertexIndices", "subdivisionScheme"})
    crate.name(name);
  std::vector<std::int32_t> corners;
  for (const auto& triangle : triangles)
    for (const std::uint32_t corner : triangle) corners.push_back(static_cast<std::int32_t>(corner));
  crate.addRoot({"M"}, {{"metersPerUnit", crate.scalar<double>(9, {1})},
                        {"timeCodesPerSecond", crate.scalar<double>(9, {framesPerSecond})},
                        {"upAxis", crate.token("Y")}});
  crate.addPrim("/M", "Mesh", {}, {{"clips", clipsRep(crate, sets)}});
  crate.addAttribute("/M.faceVertexCounts", crate.integers(std::vector<std::int32_t>(triangles.size(), 3)));
  crate.addAttribute("/M.faceVertexIndices", crate.integers(corners));
  crate.addAttribute("/M.subdivisionScheme", crate.token("none"));
  return crate.bytes();
}

/// A clip: samples of its points at times; `lines` of the prim; a prim without a type has "over" before it.
inline std::string clipText(const std::vector<double>& times, const std::vector<std::vector<Vec3d>>& samples,
                            const std::string& lines = "", const std::string& prim = "over \"M\"") {
  std::string points;
  for (std::size_t k = 0; k < times.size(); ++k)
    points += fmt::format("    {}: {},\n", times[k], usdTuples(samples[k]));
  return fmt::format("#usda 1.0\n{}\n{{\n  point3f[] points.timeSamples = {{\n{}  }}\n{}}}\n", prim, points,
                     lines);
}
inline std::string clipCrate(const std::vector<double>& times,
                             const std::vector<std::vector<Vec3d>>& samples) {
  CrateBytes crate;
  for (const char* name : {"M", "points"}) crate.name(name);
  std::vector<CrateBytes::Rep> values;
  for (const auto& points : samples) {
    std::vector<Vec3f> floats;
    for (const Vec3d& p : points) floats.push_back(static_cast<Vec3f>(p));
    values.push_back(crate.points(floats));
  }
  crate.addRoot({"M"});
  crate.addPrim("/M", "Mesh");
  crate.add("/M.points", CrateBytes::kAttribute, {{"timeSamples", crate.samples(times, values)}});
  return crate.bytes();
}

}  // namespace ringlet::test
