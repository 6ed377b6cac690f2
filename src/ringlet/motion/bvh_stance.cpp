// Implements motion/bvh_stance.h.
#include "ringlet/motion/bvh_stance.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace ringlet {
namespace {

constexpr std::size_t kMostLooks = 200;              // at frames
constexpr double kOften = 0.2, kMostly = 0.5;        // shares of the looks
constexpr double kUprightTrunk = 0.8;                // cosine of a standing trunk's angle to the up axis
constexpr double kShortest = 0.85, kTallest = 1.15;  // of who stands, as shares of the straightened length
constexpr double kHeadAbove = 1.0 / 9, kLeastAbove = 0.05;  // of the height: the head above its joint; where
                                                            // less is, the file leaves it out
constexpr double kLongBone = 0.5;                           // of a leg, as a share of its longest bone
constexpr double kFootOfLeg = 0.08;  // at most, of a leg: how far the ankle is above the floor
constexpr double kOnFloor = 0.1;     // of the height: how near to 0 feet on a floor are
constexpr double kThinnest = 0.02, kThickest = 0.3,
                 kLyingHigh = 0.4;  // of who lies on a floor, of the height

std::string lower(std::string_view text) {
  std::string result;
  for (char c : text) result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

bool holdsAny(const std::string& name, std::initializer_list<std::string_view> words) {
  const std::string own = lower(name);
  return std::ranges::any_of(words, [&](std::string_view word) { return own.find(word) != own.npos; });
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// The joints of a person, by their names and by how they hang together.
struct Person {
  std::size_t head = 0, hips = 0;
  bool hasTrunk = false;                       // a head, and hips further to the root
  std::vector<std::size_t> parts;              // trunk, head and legs
  std::vector<std::size_t> headTops;           // the head and all that it carries
  std::vector<std::vector<std::size_t>> legs;  // from the hips, without them, to each end
};

// The one nearest to the root whose name holds a word.
std::optional<std::size_t> jointCalled(const BvhFile& file, std::string_view word) {
  for (std::size_t j = 0; j < file.joints.size(); ++j)
    if (holdsAny(file.joints[j].name, {word})) return j;
  return std::nullopt;
}

// On the way from the root to the head: where it is called so, else where limbs part from it, else the root.
std::size_t hipsOf(const std::vector<std::size_t>& chain, const BvhFile& file) {
  for (const std::size_t j : chain)
    if (j != chain.back() && holdsAny(file.joints[j].name, {"hip", "pelvis"})) return j;
  std::vector<int> children(file.joints.size());
  for (std::size_t j = 1; j < file.joints.size(); ++j) ++children[file.joints[j].parent];
  for (const std::size_t j : chain)
    if (j != chain.back() && children[j] > 1) return j;
  return chain.front();
}

// What hangs off the way to the head: legs, arms, or what the head carries.
enum class Part { trunk, head, leg, other };

std::vector<Part> partsOf(const BvhFile& file, const std::vector<std::size_t>& chain, std::size_t hips) {
  std::vector<Part> parts(file.joints.size(), Part::other);
  std::vector<bool> onChain(file.joints.size()), isArm(file.joints.size());
  bool isBelow = false;
  for (const std::size_t j : chain) {
    onChain[j] = true;
    isBelow = isBelow || j == hips;
    if (isBelow) parts[j] = Part::trunk;
  }
  parts[chain.back()] = Part::head;
  for (std::size_t j = 1; j < file.joints.size(); ++j) {
    if (onChain[j]) continue;
    const std::size_t parent = file.joints[j].parent;
    const std::string& name = file.joints[j].name;
    isArm[j] = isArm[parent] || holdsAny(name, {"arm", "hand", "shoulder", "clavicle", "collar", "finger"});
    const bool isLeg = holdsAny(name, {"leg", "thigh", "calf", "shin", "knee", "foot", "ankle"});
    if (parts[parent] == Part::head) parts[j] = Part::head;
    if (parts[parent] == Part::leg || (isLeg && parts[parent] != Part::head) || (parent == hips && !isArm[j]))
      parts[j] = Part::leg;
  }
  return parts;
}

Person personOf(const BvhFile& file, std::optional<std::size_t> otherHead) {
  Person person;
  auto head = jointCalled(file, "head");
  if (!head) head = jointCalled(file, "neck");
  if (!head) head = otherHead;
  if (!head) return person;
  person.head = *head;
  std::vector<std::size_t> chain{*head};  // from the root
  while (file.joints[chain.back()].parent != chain.back()) chain.push_back(file.joints[chain.back()].parent);
  std::ranges::reverse(chain);
  person.hips = hipsOf(chain, file);
  person.hasTrunk = person.hips != person.head;
  if (!person.hasTrunk) return person;
  const std::vector<Part> parts = partsOf(file, chain, person.hips);
  std::vector<bool> hasChild(file.joints.size());
  for (std::size_t j = 1; j < file.joints.size(); ++j) hasChild[file.joints[j].parent] = true;
  for (std::size_t j = 0; j < file.joints.size(); ++j) {
    if (parts[j] != Part::other) person.parts.push_back(j);
    if (parts[j] == Part::head) person.headTops.push_back(j);
    if (parts[j] != Part::leg || hasChild[j]) continue;
    std::vector<std::size_t>& leg = person.legs.emplace_back();
    for (std::size_t k = j; parts[k] == Part::leg; k = file.joints[k].parent) leg.push_back(k);
    std::ranges::reverse(leg);
  }
  return person;
}

// Where of a leg the foot begins: at the joint that is called so, else where the last long bone ends. A thigh
// or a shin may be of several bones.
std::size_t ankleOf(const BvhFile& file, const std::vector<std::size_t>& leg,
                    const std::vector<double>& bones) {
  for (std::size_t k = 0; k < leg.size(); ++k)
    if (holdsAny(file.joints[leg[k]].name, {"foot", "ankle"})) return k;
  const double longest = *std::ranges::max_element(bones);
  std::size_t ankle = 0;
  for (std::size_t k = 1; k < leg.size(); ++k)
    if (bones[k] > 0 && bones[k] >= kLongBone * longest) ankle = k;
  return ankle;
}

// From the hips down a leg as if it were straight: down to where it begins, its bones, and what of the foot
// is below the ankle.
double straightLeg(const BvhFile& file, const std::vector<std::size_t>& leg, const std::vector<Vec3d>& places,
                   Vec3d hips, Vec3d trunk) {
  std::vector<double> bones{0};  // that end at each joint
  for (std::size_t k = 1; k < leg.size(); ++k)
    bones.push_back(length(places[leg[k]] - places[file.joints[leg[k]].parent]));
  const std::size_t ankle = ankleOf(file, leg, bones);
  double straight = std::max(0.0, -dot(places[leg.front()] - hips, trunk)), foot = 0;
  for (std::size_t k = 1; k < leg.size(); ++k) (k <= ankle ? straight : foot) += bones[k];
  return straight + std::min(foot, kFootOfLeg * straight);
}

// What one frame shows.
struct Look {
  std::vector<Vec3d> places;
  Vec3d trunk;  // from the hips to the head
  double straightened = 0;
  double aboveHead = 0;  // of it, what the joint of the head carries

  // The least and the most along an axis of some joints.
  std::array<double, 2> range(const std::vector<std::size_t>& joints, Vec3d axis) const {
    double low = INFINITY, high = -INFINITY;
    for (const std::size_t j : joints) {
      low = std::min(low, dot(places[j], axis));
      high = std::max(high, dot(places[j], axis));
    }
    return {low, high};
  }
};

Look lookAt(const BvhFile& file, const Person& person, std::vector<Vec3d> places) {
  Look look{std::move(places), {}, 0, 0};
  if (!person.hasTrunk) return look;
  const Vec3d hips = look.places[person.hips];
  look.trunk = look.places[person.head] - hips;
  const Vec3d along = normalizedOr(look.trunk, Vec3d{});
  double top = 0, leg = 0;
  for (const std::size_t j : person.headTops) top = std::max(top, dot(look.places[j] - hips, along));
  for (const auto& joints : person.legs)
    leg = std::max(leg, straightLeg(file, joints, look.places, hips, along));
  look.straightened = top + leg;
  look.aboveHead = top - length(look.trunk);
  return look;
}

std::vector<Vec3d> placesAtZeroAngles(const BvhFile& file) {
  std::vector<Vec3d> places;
  for (std::size_t j = 0; j < file.joints.size(); ++j)
    places.push_back((file.joints[j].parent == j ? Vec3d{} : places[file.joints[j].parent]) +
                     file.joints[j].offset);
  return places;
}

// Where the skeleton stands at zero angles: its head to one side of the hips, its feet to the other.
std::optional<FileAxis> restAxis(const BvhFile& file, const Person& person) {
  if (person.legs.empty()) return std::nullopt;
  const std::vector<Vec3d> places = placesAtZeroAngles(file);
  const auto axis = nearestFileAxis(places[person.head] - places[person.hips]);
  if (!axis) return std::nullopt;
  for (const auto& leg : person.legs) {
    const Vec3d down = places[leg.back()] - places[person.hips];
    if (!(dot(down, directionOf(*axis)) < -0.5 * length(down))) return std::nullopt;
  }
  return axis;
}

// All frames that are looked at, and what they show together.
class Looks {
 public:
  Looks(const BvhFile& file, const Person& person, std::size_t firstFrame) : person_(person) {
    const std::size_t count = file.frameCount() - firstFrame;
    const std::size_t step = (count + kMostLooks - 1) / kMostLooks;
    for (std::size_t frame = firstFrame; frame < file.frameCount(); frame += step)
      looks_.push_back(lookAt(file, person, file.placesAt(frame)));
    for (const Look& look : looks_) {
      if (const auto axis = nearestFileAxis(look.trunk)) ++votes_[static_cast<std::size_t>(*axis)];
    }
    if (!person.legs.empty()) addHead();
  }

  double share(FileAxis axis) const {
    return static_cast<double>(votes_[static_cast<std::size_t>(axis)]) / static_cast<double>(looks_.size());
  }
  FileAxis most() const { return static_cast<FileAxis>(std::ranges::max_element(votes_) - votes_.begin()); }
  double straightened() const {
    return medianOf([](const Look& look) { return look.straightened; });
  }
  double addedHead() const { return addedHead_; }
  // The lowest of the person along an axis is at its 0.
  bool isOnFloorOf(FileAxis axis) const {
    const double low = medianOf([&](const Look& look) { return rangeOf(look, axis)[0]; });
    return std::abs(low) <= kOnFloor * straightened();
  }
  // All of the person is a little above an axis' 0; `along`: while its trunk lies along that.
  bool liesOnFloorOf(FileAxis axis, std::optional<FileAxis> along = {}) const {
    const double size = straightened();
    const auto isAsked = [&](const Look& look) { return !along || nearestFileAxis(look.trunk) == along; };
    const double low = medianOf([&](const Look& look) { return rangeOf(look, axis)[0]; }, isAsked);
    const double high = medianOf([&](const Look& look) { return rangeOf(look, axis)[1]; }, isAsked);
    const double hips = medianOf(
        [&](const Look& look) { return dot(look.places[person_.hips], directionOf(axis)); }, isAsked);
    return low >= -kThinnest * size && high <= kLyingHigh * size && hips > kThinnest * size &&
           hips < kThickest * size;
  }
  // Of the frames in which the person stands; nothing where there is none.
  std::optional<double> standingHeight(FileAxis axis) const {
    const double size = straightened();
    std::vector<double> heights;
    for (const Look& look : looks_) {
      const auto [low, high] = rangeOf(look, axis);
      const bool isUpright = dot(look.trunk, directionOf(axis)) >= kUprightTrunk * length(look.trunk);
      if (isUpright && high - low >= kShortest * size && high - low <= kTallest * size)
        heights.push_back(high - low);
    }
    if (heights.empty()) return std::nullopt;
    return median(std::move(heights));
  }
  // Of a skeleton in which no person is seen: along the up axis, or where that is the least, along the most.
  double extent(FileAxis up, std::size_t jointCount) const {
    std::vector<std::size_t> all(jointCount);
    for (std::size_t j = 0; j < jointCount; ++j) all[j] = j;
    const auto along = [&](FileAxis axis) {
      return medianOf([&](const Look& look) {
        const auto [low, high] = look.range(all, directionOf(axis));
        return high - low;
      });
    };
    const double most = std::max({along(FileAxis::plusX), along(FileAxis::plusY), along(FileAxis::plusZ)});
    return along(up) >= 0.5 * most ? along(up) : most;
  }

 private:
  // Many skeletons end at the joint of the head, or at its eyes.
  void addHead() {
    const double size = straightened();
    const double above = medianOf([](const Look& look) { return look.aboveHead; });
    if (above >= kLeastAbove * size) return;
    addedHead_ = (size - above) * kHeadAbove / (1 - kHeadAbove);
    for (Look& look : looks_) look.straightened += addedHead_ - look.aboveHead;
  }
  std::array<double, 2> rangeOf(const Look& look, FileAxis axis) const {
    auto [low, high] = look.range(person_.parts, directionOf(axis));
    const Vec3d top = look.places[person_.head] + normalizedOr(look.trunk, Vec3d{}) * addedHead_;
    const double along = dot(top, directionOf(axis));
    return {std::min(low, along), std::max(high, along)};
  }
  double medianOf(const auto& number) const {
    return medianOf(number, [](const Look&) { return true; });
  }
  double medianOf(const auto& number, const auto& isAsked) const {
    std::vector<double> values;
    for (const Look& look : looks_)
      if (isAsked(look)) values.push_back(number(look));
    return median(std::move(values));
  }

  const Person& person_;
  std::vector<Look> looks_;
  std::array<int, 6> votes_{};  // by FileAxis
  double addedHead_ = 0;        // above its joint, along the trunk
};

// Of who lies and stands: the axis of standing, on whose floor it lies else; `axis` where none is.
FileAxis axisOfStanding(const Looks& looks, FileAxis axis) {
  for (int k = 0; k < 6; ++k) {
    const auto other = static_cast<FileAxis>(k);
    if (other != axis && looks.share(other) >= kOften && looks.share(axis) >= kOften &&
        looks.liesOnFloorOf(other, axis) && !looks.liesOnFloorOf(axis, other))
      axis = other;
  }
  return axis;
}

// The axis, as the header says.
void seeUp(const Looks& looks, std::optional<FileAxis> atRest, BvhStance& stance) {
  using Sight = BvhStance::Sight;
  const auto see = [&](Sight sight, FileAxis up) { stance.sight = sight, stance.up = up; };
  const FileAxis usual = atRest.value_or(FileAxis::plusY), along = looks.most();
  stance.along = along;
  const FileAxis often = looks.share(usual) >= kOften ? usual : along;
  if (const FileAxis standing = axisOfStanding(looks, often); standing != often)
    return see(standing == FileAxis::plusY ? Sight::upright : Sight::taken, standing);
  if (looks.share(usual) >= kOften) return see(Sight::upright, usual);
  if (looks.share(along) < kMostly) return see(Sight::unseen, FileAxis::plusY);
  if (along == FileAxis::plusY && looks.isOnFloorOf(along)) return see(Sight::upright, along);
  const bool isUpsideDown = atRest && dot(directionOf(usual), directionOf(along)) < 0;
  const bool standsThere = looks.isOnFloorOf(along) && !looks.liesOnFloorOf(usual);
  const bool mayStandThere = !atRest && !looks.liesOnFloorOf(usual);
  if (isUpsideDown || standsThere || mayStandThere || (!atRest && looks.isOnFloorOf(along)))
    return see(Sight::taken, along);
  see(Sight::lying, usual);
}

}  // namespace

BvhStance stanceOf(const BvhFile& file, std::size_t firstFrame, std::optional<FileAxis> stated,
                   std::optional<std::size_t> head) {
  BvhStance stance;
  const Person person = personOf(file, head);
  const Looks looks(file, person, firstFrame);
  stance.hasLegs = !person.legs.empty();
  const double straightened = looks.straightened();
  stance.hasTrunk = straightened > 0;
  if (stated) {
    stance.sight = BvhStance::Sight::stated;
    stance.up = *stated;
  } else if (person.hasTrunk && straightened > 0) {
    seeUp(looks, restAxis(file, person), stance);
  }
  if (straightened > 0) {
    const auto standing = looks.standingHeight(stance.up);
    stance.everStands = standing.has_value();
    stance.height = standing.value_or(straightened);
    stance.addedHead = looks.addedHead();
  } else {
    stance.height = looks.extent(stance.up, file.joints.size());
  }
  return stance;
}

}  // namespace ringlet
