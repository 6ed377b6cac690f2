// Implements motion/motion_doubts.h.
#include "ringlet/motion/motion_doubts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

namespace ringlet {
namespace {

constexpr double kLeastUnit = 1e-6, kMostUnit = 1000;     // that scenes and options take [m]
constexpr double kMostPerson = 3, kLeastPerson = 0.3;     // tall [m]
constexpr double kMostHead = 10;                          // of a head above what carries it, a stage too [m]
constexpr double kLeastFigure = 0.15, kLeastTrunk = 0.3;  // of a head above what carries it [m]
constexpr int kTrunk = 2;       // bones from which on a figure has a trunk, which stands or lies
constexpr int kFullFigure = 3;  // bones from which on a figure may be called small
constexpr double kPlacement = 4, kFirstPlacement = 30;  // steps so many times longer than all below are none
constexpr std::size_t kLooks = 100;                     // at an animation
constexpr double kSeldom = 0.2, kMostly = 0.8;          // shares of them

std::string upOption(FileAxis up) {
  return fmt::format("--motion-up {0} (up = \"{0}\" of [motion])", nameOf(up));
}

void doubtFrames(const BvhFile& file, const std::string& name, std::vector<std::string>& doubts) {
  const std::size_t stated = file.statedFrameCount, found = file.foundFrameCount;
  if (found == stated) return;
  doubts.push_back(fmt::format("{} states {} frames and holds {}; {} are read", name, stated, found,
                               found > stated ? fmt::format("the first {}", stated) : "these"));
}

void doubtUnit(const BvhStance& stance, const std::string& name, std::vector<std::string>& doubts) {
  const double unit = unitOf(stance);
  if (!(stance.height > 0) || unit != kTall / stance.height) {
    doubts.push_back(fmt::format(
        "{} names no unit, and its skeleton is {}: its unit is taken to be a centimetre; --motion-unit (unit "
        "of [motion]) says another",
        name,
        stance.height > 0 ? fmt::format("{:.4g} units tall, which no person is in any unit", stance.height)
                          : "one point, which has no height"));
    return;
  }
  const char* how = stance.hasTrunk && !stance.everStands
                        ? "straightened, since it stands in none of its frames,"
                        : "as it stands in its frames,";
  const std::string head =
      stance.addedHead > 0
          ? fmt::format(", {:.4g} of them for the head, of which it has the joint only,", stance.addedHead)
          : std::string();
  doubts.push_back(fmt::format(
      "{} names no unit; {} its skeleton of {:.4g} units{} is taken to be {} m tall, a unit {:.4g} m", name,
      how, stance.height, head, kTall, unit));
}

void doubtStatedUnit(const BvhStance& stance, double unit, const std::string& name,
                     std::vector<std::string>& doubts) {
  const double tall = stance.height * unit;
  const bool isWhole = stance.hasLegs && stance.everStands;
  if (tall <= kMostPerson && !(isWhole && tall < kLeastPerson)) return;
  doubts.push_back(fmt::format(
      "{}: its skeleton of {:.4g} units is {:.4g} m tall with units of {:.4g} m, which no person is; it is "
      "{} m tall with --motion-unit {:.4g}",
      name, stance.height, tall, unit, kTall, unitOf(stance)));
}

void doubtUp(const BvhStance& stance, const std::string& name, bool upIsZ, std::vector<std::string>& doubts) {
  using Sight = BvhStance::Sight;
  const char* groomUp = upIsZ ? "Z" : "Y";
  const bool isUsual = stance.up == FileAxis::plusY;
  if (stance.sight == Sight::lying) {
    doubts.push_back(fmt::format(
        "{}: the person lies along {} in all its frames, or {} is the file's up axis; {} is taken for it, "
        "and the person to lie; where it stands, {} says so",
        name, nameOf(stance.along), nameOf(stance.along), nameOf(stance.up), upOption(stance.along)));
    return;
  }
  if (stance.sight == Sight::taken || (stance.sight == Sight::upright && !isUsual)) {
    const FileAxis other = isUsual ? FileAxis::plusZ : FileAxis::plusY;
    const bool isGrooms = nameOf(stance.up) == groomUp;
    doubts.push_back(fmt::format(
        "{}: the person stands along {}, which is taken for the file's up axis{}; where the person lies, {} "
        "says so",
        name, nameOf(stance.up),
        isGrooms ? ", the groom's too" : fmt::format(" and turned to the groom's {}", groomUp),
        upOption(other)));
  }
}

// The nodes that carry a head, in some looks at them.
struct Figure {
  std::size_t foot = 0;            // where it stands
  int bones = 0;                   // between nodes at different places
  std::size_t hips = 0;            // called so; else the foot
  std::vector<Vec3d> rise, trunk;  // from foot and hips to the head, in each look, in the world [m]
  std::vector<Vec3d> heads;
};

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

bool isHips(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name.find("hip") != name.npos || name.find("pelvis") != name.npos;
}

// Where a node and those above it are, look after look.
std::vector<std::vector<Vec3d>> placesOf(const GltfFile& file, const std::vector<std::size_t>& chain,
                                         const GltfAnimation* animation, const Affine& map) {
  const double first = animation ? animation->firstSeconds : 0;
  const double span = animation ? animation->lastSeconds - first : 0;
  std::vector<std::vector<Vec3d>> places;
  for (std::size_t look = 0; look < (span > 0 ? kLooks : 1); ++look) {
    const double t = first + span * static_cast<double>(look) / static_cast<double>(kLooks - 1);
    std::vector<Vec3d>& now = places.emplace_back(chain.size());
    Affine world = map;
    for (std::size_t k = chain.size(); k-- > 0;) {
      world = world * file.localAt(chain[k], animation, t);
      now[k] = world.position;
    }
  }
  return places;
}

Figure figureOf(const GltfFile& file, std::size_t node, const GltfAnimation* animation, const Affine& map) {
  std::vector<std::size_t> chain{node};  // from the head up
  while (file.nodes[chain.back()].parent) chain.push_back(*file.nodes[chain.back()].parent);
  const auto places = placesOf(file, chain, animation, map);
  Figure figure;
  double below = 0;
  for (std::size_t k = 1; k < chain.size(); ++k) {
    std::vector<double> steps;
    for (const auto& now : places) steps.push_back(length(now[k - 1] - now[k]));
    const double step = median(std::move(steps));
    const double most = figure.bones == 0 ? INFINITY : figure.bones == 1 ? kFirstPlacement : kPlacement;
    if (step > most * below) break;
    if (step > 0) ++figure.bones;
    below += step;
    figure.foot = k;
  }
  figure.hips = figure.foot;
  for (std::size_t k = figure.foot; k > 0; --k)
    if (isHips(file.nodes[chain[k]].name)) figure.hips = k;
  for (const auto& now : places) {
    figure.rise.push_back(now[0] - now[figure.foot]);
    figure.trunk.push_back(now[0] - now[figure.hips]);
    figure.heads.push_back(now[0]);
  }
  figure.foot = chain[figure.foot];
  figure.hips = chain[figure.hips];
  return figure;
}

double heightAlong(const std::vector<Vec3d>& ways, Vec3d up) {
  std::vector<double> heights;
  for (const Vec3d& way : ways) heights.push_back(dot(way, up));
  return median(std::move(heights));
}

// Units in which a head that is so high is as high as one.
std::string unitsFor(double height, double unit) {
  constexpr std::array<double, 7> kUnits{1, 0.01, 0.0254, 0.001, 0.3048, 0.1, 100};
  const auto among = [&](double low, double high) {
    std::vector<std::string> texts;
    for (const double other : kUnits) {
      const double then = height / unit * other;
      if (other != unit && then >= low && then <= high)
        texts.push_back(fmt::format("{:.3g} m with --motion-unit {}", then, other));
    }
    return texts;
  };
  std::vector<std::string> texts = among(1.2, 2.2);  // above the floor
  if (texts.empty()) texts = among(0.4, 1.2);        // above the hips
  if (texts.empty()) return "is the unit right (--motion-unit)?";
  return fmt::format("it would be {}", fmt::join(texts, " or "));
}

// The axis along which the trunk lies nearly always; Y, where it ever stands or lies along none.
FileAxis trunkAxis(const Figure& figure) {
  std::array<std::size_t, 6> votes{};
  for (const Vec3d& way : figure.trunk) {
    const auto axis = nearestFileAxis(way);
    if (axis && length(way) >= kLeastTrunk) ++votes[static_cast<std::size_t>(*axis)];
  }
  const auto count = static_cast<double>(figure.trunk.size());
  const auto share = [&](FileAxis axis) {
    return static_cast<double>(votes[static_cast<std::size_t>(axis)]) / count;
  };
  const auto most = static_cast<FileAxis>(std::ranges::max_element(votes) - votes.begin());
  return share(most) < kMostly || share(FileAxis::plusY) > kSeldom ? FileAxis::plusY : most;
}

}  // namespace

double unitOf(const BvhStance& stance) {
  const double unit = kTall / stance.height;
  return unit >= kLeastUnit && unit <= kMostUnit ? unit : 0.01;
}

std::vector<std::string> doubtsOf(const BvhFile& file, const BvhStance& stance, const std::string& name,
                                  std::optional<double> metresPerUnit, bool upIsZ) {
  std::vector<std::string> doubts;
  doubtFrames(file, name, doubts);
  if (metresPerUnit) {
    doubtStatedUnit(stance, *metresPerUnit, name, doubts);
  } else {
    doubtUnit(stance, name, doubts);
  }
  doubtUp(stance, name, upIsZ, doubts);
  return doubts;
}

std::vector<std::string> doubtsOf(const GltfFile& file, std::size_t node, const GltfAnimation* animation,
                                  const GltfPlacement& placement, bool statesUp, const std::string& name) {
  std::vector<std::string> doubts;
  const double unit = placement.metresPerUnit;
  // Turned so that Y is the file's up axis; where that is not stated, it is glTF's.
  const Affine turn = turnUp(placement.up, false);
  const Affine map{turn.x * unit, turn.y * unit, turn.z * unit, {}};
  const Figure figure = figureOf(file, node, animation, map);
  const bool isLone = figure.bones == 0;
  const FileAxis along = figure.bones < kTrunk || statesUp ? FileAxis::plusY : trunkAxis(figure);
  const Vec3d up = directionOf(along);
  double height = heightAlong(isLone ? figure.heads : figure.rise, up);
  if (!file.nodes[figure.foot].parent) {
    // Hips that are the root stand above the floor, or farther up, as a character on a tower.
    const double whole = heightAlong(figure.heads, up);
    if (whole > height && whole - height <= kPlacement * height) height = whole;
  }
  const std::string& head = file.nodes[node].name;
  if (height > kMostHead || (figure.bones >= kFullFigure && height > 0 && height < kLeastFigure)) {
    const bool isRoot = isLone || !file.nodes[figure.foot].parent;
    doubts.push_back(fmt::format("{}: the node {} stands {:.3g} m above {}, which no head does; {}", name,
                                 head, height,
                                 isRoot ? "the root of the file" : "the node " + file.nodes[figure.foot].name,
                                 unitsFor(height, unit)));
  }
  if (along != FileAxis::plusY) {
    doubts.push_back(fmt::format(
        "{}: the node {} is along {} from {}, where glTF has Y up: the person lies, or the file has another "
        "axis up, which {} says",
        name, head, nameOf(along), file.nodes[figure.hips].name, upOption(along)));
  }
  return doubts;
}

}  // namespace ringlet
