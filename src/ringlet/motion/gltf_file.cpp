// Implements motion/gltf_file.h, less the reading: gltf_reader.cpp.
#include "ringlet/motion/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "ringlet/base/assert.h"
#include "ringlet/motion/joint_name.h"

namespace ringlet {
namespace {

constexpr double kFramesPerSecond = 23.5;  // keys as close as this are frames of a film, one by one
constexpr double kSampled = 120;           // between keys further apart [1/s]
constexpr double kMostSampled = 240;       // keys closer than that are passed over [1/s]
constexpr double kMostPoses = 1e6;

Quatd unit(const std::array<double, 4>& v) {
  const double size = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]);
  return size > 0 ? Quatd{v[0] / size, v[1] / size, v[2] / size, v[3] / size} : Quatd{};
}

// The time between keys that move a node [s]; 0 where there are no two. The mean of those about as short as
// the shortest: files hold times in single precision.
double secondsBetweenKeys(const GltfFile& file, std::size_t node, const GltfAnimation& animation) {
  double shortest = INFINITY, sum = 0, count = 0;
  const auto visit = [&](auto&& take) {
    for (std::optional<std::size_t> n = node; n; n = file.nodes[*n].parent) {
      for (const auto& channel : animation.ofNode[*n]) {
        if (!channel) continue;
        const std::vector<double>& seconds = animation.channels[*channel].seconds;
        for (std::size_t k = 1; k < seconds.size(); ++k) take(seconds[k] - seconds[k - 1]);
      }
    }
  };
  visit([&](double gap) {
    if (gap > 1e-5) shortest = std::min(shortest, gap);
  });
  visit([&](double gap) {
    if (gap > 1e-5 && gap < shortest * 1.1) sum += gap, ++count;
  });
  return count > 0 ? sum / count : 0;
}

double samplesFor(const GltfFile& file, std::size_t node, const GltfAnimation& animation) {
  const double gap = secondsBetweenKeys(file, node, animation);
  if (!(gap > 0)) return kSampled;
  const double keys = 1 / gap;
  const double rate = keys > kFramesPerSecond ? std::min(keys, kMostSampled)
                                              : keys * std::ceil(kSampled / keys - 0.01);  // meets every key
  // 24.0001 is 24 with times in single precision; 23.976 is not.
  return std::abs(rate - std::round(rate)) < 1e-4 * rate ? std::round(rate) : rate;
}

}  // namespace

Affine GltfPlacement::map() const {
  const Affine turn = turnUp(up, upIsZ);
  return {turn.x * metresPerUnit, turn.y * metresPerUnit, turn.z * metresPerUnit, {}};
}

template <class Values, class Linear>
Values GltfChannel::mixedAt(double t, const Values& zero, Linear linear) const {
  const bool isCubic = interpolation == Interpolation::cubicSpline;
  // Of key k; part 0 the tangent in, 1 the value, 2 the tangent out.
  const auto part = [&](std::size_t k, std::size_t which) {
    Values found = zero;
    const std::size_t at = isCubic ? (k * 3 + which) * width : k * width;
    for (std::size_t c = 0; c < width; ++c) found[c] = values[at + c];
    return found;
  };
  const auto after =
      static_cast<std::size_t>(std::upper_bound(seconds.begin(), seconds.end(), t) - seconds.begin());
  if (after == 0) return part(0, 1);
  if (after == seconds.size()) return part(after - 1, 1);
  const std::size_t k = after - 1;
  const double span = seconds[after] - seconds[k], s = (t - seconds[k]) / span;
  const Values a = part(k, 1), b = part(after, 1);
  // Times of keys are rounded to single precision: one that is all but there counts.
  if (interpolation == Interpolation::step) return s > 0.999 ? b : a;
  if (interpolation == Interpolation::linear) return linear(a, b, s);
  const Values out = part(k, 2), in = part(after, 0);
  const double s2 = s * s, s3 = s2 * s;
  Values mixed = zero;
  for (std::size_t c = 0; c < width; ++c) {
    mixed[c] = (2 * s3 - 3 * s2 + 1) * a[c] + span * (s3 - 2 * s2 + s) * out[c] + (3 * s2 - 2 * s3) * b[c] +
               span * (s3 - s2) * in[c];
  }
  return mixed;
}

namespace {

template <class Values>
Values between(const Values& a, const Values& b, double s) {
  Values mixed = a;
  for (std::size_t c = 0; c < mixed.size(); ++c) mixed[c] = a[c] + (b[c] - a[c]) * s;
  return mixed;
}

}  // namespace

std::array<double, 4> GltfChannel::valueAt(double t) const {
  using Values = std::array<double, 4>;
  if (path != Path::rotation) return mixedAt(t, Values{}, between<Values>);
  const auto asQuat = [](const Quatd& q) { return Values{q.x, q.y, q.z, q.w}; };
  const auto turned = [&](const Values& a, const Values& b, double s) {
    return asQuat(slerp(unit(a), unit(b), s));
  };
  return asQuat(unit(mixedAt(t, Values{}, turned)));
}

std::vector<double> GltfChannel::weightsAt(double t) const {
  using Values = std::vector<double>;
  return mixedAt(t, Values(width), between<Values>);
}

std::vector<std::string> GltfFile::names() const {
  std::vector<std::string> all;
  for (const GltfNode& node : nodes) all.push_back(node.name);
  return all;
}

std::optional<std::size_t> GltfFile::find(std::string_view name) const {
  for (const GltfSkin& skin : skins) {
    for (std::size_t joint : skin.joints) {
      if (!name.empty() && nodes[joint].name == name) return joint;
    }
  }
  return findJoint(names(), name);
}

Result<const GltfAnimation*> GltfFile::animationNamed(const std::string& word) const {
  if (word.empty()) return animations.empty() ? nullptr : &animations.front();
  std::vector<std::string> all;
  for (const GltfAnimation& animation : animations) {
    if (animation.name == word) return &animation;
    all.push_back(animation.name);
  }
  std::size_t number = 0;
  const auto [stopped, code] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (code == std::errc{} && stopped == word.data() + word.size() && number < animations.size())
    return &animations[number];
  if (animations.empty()) return Error{fmt::format("the file has no animation {}, nor any other", word)};
  return noSuchJoint(fmt::format("the file (of {} animations)", animations.size()), "animation", word, all);
}

Affine GltfFile::localAt(std::size_t n, const GltfAnimation* animation, double t) const {
  const GltfNode& node = nodes[n];
  if (node.matrix) return *node.matrix;
  Vec3d translation = node.translation, scale = node.scale;
  Quatd rotation = node.rotation;
  if (animation) {
    for (const auto& which : animation->ofNode[n]) {
      if (!which) continue;
      const GltfChannel& channel = animation->channels[*which];
      const auto [x, y, z, w] = channel.valueAt(t);
      switch (channel.path) {
        case GltfChannel::Path::translation:
          translation = {x, y, z};
          break;
        case GltfChannel::Path::rotation:
          rotation = {x, y, z, w};
          break;
        case GltfChannel::Path::scale:
          scale = {x, y, z};
          break;
        case GltfChannel::Path::weights:  // which are not among a node's
          break;
      }
    }
  }
  return affineOf(translation, rotation, scale);
}

Affine GltfFile::worldAt(std::size_t node, const GltfAnimation* animation, double t) const {
  Affine world = localAt(node, animation, t);
  for (auto n = nodes[node].parent; n; n = nodes[*n].parent) world = localAt(*n, animation, t) * world;
  return world;
}

std::vector<Affine> GltfFile::worldsAt(const GltfAnimation* animation, double t) const {
  std::vector<Affine> worlds(nodes.size());
  for (std::size_t n : parentsFirst) {
    const Affine local = localAt(n, animation, t);
    worlds[n] = nodes[n].parent ? worlds[*nodes[n].parent] * local : local;
  }
  return worlds;
}

bool GltfFile::moves(std::size_t node, const GltfAnimation* animation) const {
  if (!animation) return false;
  for (std::optional<std::size_t> n = node; n; n = nodes[*n].parent) {
    for (const auto& channel : animation->ofNode[*n]) {
      if (channel) return true;
    }
  }
  return false;
}

Result<Keyframes> GltfFile::motionOf(std::size_t node, const GltfAnimation* animation,
                                     const GltfPlacement& placement,
                                     std::optional<double> samplesPerSecond) const {
  const double start = animation ? animation->firstSeconds : 0;
  const double span = animation ? animation->lastSeconds - start : 0;
  RINGLET_ASSERT(!samplesPerSecond || *samplesPerSecond > 0, "samples are taken at a rate above 0");
  double gaps = 0, step = 0;  // between poses, and one of them [s]
  if (span > 0) {
    const double rate = samplesPerSecond ? *samplesPerSecond : samplesFor(*this, node, *animation);
    gaps = std::max(1.0, std::ceil(span * rate - 0.01));
    step = 1 / rate;
  }
  if (!(gaps < kMostPoses)) {
    return Error{fmt::format("the animation takes {:.4g} s, {:.4g} poses; at most {} are taken", span, gaps,
                             kMostPoses)};
  }
  Keyframes motion;
  if (gaps > 0) motion.secondsPerKey = step;
  const Affine turn = turnUp(placement.jointUp.value_or(placement.up), placement.upIsZ);
  const Quatd lift = rotationOf(turn.x, turn.y, turn.z);
  for (std::size_t k = 0; k <= static_cast<std::size_t>(gaps); ++k) {
    const double t = start + step * static_cast<double>(k);
    const Affine world = placement.map() * worldAt(node, animation, t);
    // Turned, the groom stands upright too: its axes are turned by the same.
    const auto rotation = nearestRotation(world);
    if (!rotation) {
      return Error{fmt::format(
          "at {:.4g} s node {} is flat or beyond all numbers (a scale of 0?); it has no rotation there", t,
          nodes[node].name)};
    }
    motion.poses.push_back({world.position, normalized(*rotation * lift.conjugate())});
  }
  return motion;
}

Result<Keyframes> readGltfMotion(const std::filesystem::path& path, const GltfMotionChoice& choice) {
  const auto file = readGltf(path);
  if (!file) return file.error();
  const auto node = file->find(choice.node);
  if (!node) return noSuchJoint(path.string(), "node", choice.node, file->names());
  const auto animation = file->animationNamed(choice.animation);
  if (!animation) return Error{fmt::format("{}: {}", path.string(), animation.error().message)};
  auto motion = file->motionOf(*node, *animation, choice.placement, choice.samplesPerSecond);
  if (!motion) return Error{fmt::format("{}: {}", path.string(), motion.error().message)};
  return motion;
}

}  // namespace ringlet
