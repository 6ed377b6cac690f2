// Implements groom/curl_shape.h: one helix fitted to all joints of a strand.
//
//        ê_i  /\  ê_{i+1}        theta_i: turn at the joint, about the normal b_i = ê_i x ê_{i+1}
//            /  \                phi:     turn of that normal about the edge between two joints
//      -----/ b_i \-----         w:       both composed: the helix's own turn about its axis per edge
//
// phi > 0 is a right-handed turn, phi < 0 a left-handed one; at a perversion it changes sign.
#include "ringlet/groom/curl_shape.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// An edge shorter than this share of the mean says nothing about direction: files hold 6e-6 beside 4e-2.
constexpr double kShortestEdgeShare = 1e-3;

// With fewer particles per turn it looks like a zigzag, which has two, and so does noise on a line.
constexpr double kFewestParticlesPerTurn = 2.5;

// Share of the bending that must turn with the fitted helix. Chance reaches 0.6 on one strand in a thousand
// of pure noise and flat waves 0.2; a real groom's tight coils have 0.9. Hands that change along the strand
// fit noise better, too, and so must fit the strand better.
constexpr double kLeastCoherence = 0.6;
constexpr double kLeastCoherenceOfTwoHands = 0.8;
constexpr std::size_t kShortestWindow = 8;  // joints; below, chance alone makes a few of them agree

// A stretch has a hand where phi is at least this share of w: a flat ring has none.
constexpr double kLeastTwist = 0.05;

// A stretch of a curled strand is straight if it bends by less than this share of the strand's mean.
constexpr double kStraightBendShare = 0.3;

// Documented in the header.
constexpr double kFewestTurns = 1;
constexpr double kShallowestCurl = 0.1;

// The edges that have a direction, and where they stand in the strand.
struct Edges {
  std::vector<Vec3d> directions;
  std::vector<double> chords;
  std::vector<std::size_t> indices;
};

Edges usableEdges(std::span<const Vec3d> strand) {
  const std::size_t edgeCount = strand.size() - 1;
  double sum = 0;
  for (std::size_t i = 0; i < edgeCount; ++i) {
    const double chord = length(strand[i + 1] - strand[i]);
    if (std::isfinite(chord)) sum += chord;
  }
  const double shortest = kShortestEdgeShare * sum / static_cast<double>(edgeCount);

  Edges edges;
  for (std::size_t i = 0; i < edgeCount; ++i) {
    const Vec3d edge = strand[i + 1] - strand[i];
    const double chord = length(edge);
    if (!std::isfinite(chord) || chord <= shortest) continue;
    edges.directions.push_back(edge / chord);
    edges.chords.push_back(chord);
    edges.indices.push_back(i);
  }
  return edges;
}

// The angle between two unit vectors, exact also near 0 and pi [rad].
double angleBetween(Vec3d a, Vec3d b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

// Each joint's bend as a complex number: size theta [rad], argument the bend's axis in a frame that goes
// along the strand without twist. On a helix it turns by phi per joint; on a flat wave it only changes sign.
std::vector<std::complex<double>> measureBends(std::span<const Vec3d> directions) {
  std::vector<std::complex<double>> bends;
  bends.reserve(directions.size());
  Vec3d normal = anyNormal(directions.front());
  for (std::size_t i = 0; i + 1 < directions.size(); ++i) {
    const Vec3d axis = cross(directions[i], directions[i + 1]);
    const double sine = length(axis), cosine = dot(directions[i], directions[i + 1]);
    if (sine == 0) {
      bends.emplace_back(0);
      continue;
    }
    const Vec3d unitAxis = axis / sine;
    const Vec3d binormal = cross(directions[i], normal);
    bends.push_back(std::atan2(sine, cosine) * std::complex(dot(unitAxis, normal), dot(unitAxis, binormal)));

    // Carry the normal over the joint by the smallest rotation, and keep it across the edge.
    normal = normal * cosine + cross(axis, normal) + unitAxis * (dot(unitAxis, normal) * (1 - cosine));
    normal = normal - directions[i + 1] * dot(normal, directions[i + 1]);
    normal = normalizedOr(normal, anyNormal(directions[i + 1]));
  }
  return bends;
}

// A range of joints.
struct Range {
  std::size_t begin = 0, end = 0;
};

// What the joints of a strand say, in the order of its usable edges: joint i lies between edges i and i + 1.
class Joints {
 public:
  explicit Joints(std::span<const Vec3d> strand) : edges_(usableEdges(strand)) {
    if (edges_.directions.size() < 3) return;
    std::vector<double> arcs(strand.size() - 1);
    measureArcs(strand, arcs);
    for (std::size_t index : edges_.indices) arcs_.push_back(arcs[index]);
    bends_ = measureBends(edges_.directions);
    for (const std::complex<double>& bend : bends_) sizes_.push_back(std::abs(bend));
    // A first guess of the turn needs the hands, and the hands over a turn need its length.
    readHands(kShortestWindow);
    readHands(jointsPerTurn());
  }

  bool areEnough() const { return !bends_.empty(); }
  Range all() const { return {0, bends_.size()}; }

  // The helix that the joints of a range follow; straight if there is none. Each joint counts by its bend.
  CurlShape fit(Range range) const {
    const Turn turn = turnOf(range);
    if (!(turn.w > 0) || turn.w > kTurn / kFewestParticlesPerTurn) return {};

    // The axis of that turn meets the edge at a known angle: along it is rise, across it a chord 2 r
    // sin(w/2).
    const double alongAxis =
        std::cos(turn.theta / 2) * std::abs(std::sin(turn.phi / 2)) / std::sin(turn.w / 2);
    const double acrossAxis = std::sqrt(std::max(0.0, 1 - alongAxis * alongAxis));
    CurlShape shape;
    shape.turns = turn.curledShare * static_cast<double>(range.end - range.begin) * turn.w / kTurn;
    shape.turnLength = turn.arc * kTurn / turn.w;
    shape.radius = turn.chord * acrossAxis / (2 * std::sin(turn.w / 2));
    shape.pitch = turn.chord * alongAxis * kTurn / turn.w;
    if (kTurn * shape.radius < kShallowestCurl * shape.pitch) return {};
    return shape;
  }

  // Right-handed joints less left-handed ones, each counting by its bend, as a share of all.
  double handBalance(Range range) const {
    double balance = 0, all = 0;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      balance += sizes_[i] * hands_[i];
      all += sizes_[i];
    }
    return all > 0 ? balance / all : 0;
  }

  int perversions(Range range) const {
    int count = 0;
    for (std::size_t i = range.begin + 1; i < range.end; ++i) count += hands_[i] != hands_[i - 1] ? 1 : 0;
    return count;
  }

  // How much of the bending turns with the helix: 1 on one, near 0 on noise and on flat waves. Taken over
  // windows of about a turn, so that a curl whose rate drifts along the strand still counts as one.
  double coherence() const {
    const double phi = turnOf(all()).phi;
    std::vector<std::complex<double>> sums{0.0};
    std::vector<double> sizes{0.0};
    double phase = 0;
    for (std::size_t i = 0; i < bends_.size(); ++i) {
      if (i > 0) phase += phi * hands_[i];
      sums.push_back(sums.back() + bends_[i] * std::polar(1.0, -phase));
      sizes.push_back(sizes.back() + sizes_[i]);
    }
    const std::size_t window = std::min(bends_.size(), std::max(kShortestWindow, jointsPerTurn()));
    double together = 0, apart = 0;
    for (std::size_t i = 0; i + window < sums.size(); ++i) {
      together += std::abs(sums[i + window] - sums[i]);
      apart += sizes[i + window] - sizes[i];
    }
    return apart > 0 ? together / apart : 0;
  }

  // Joints of a turn where the strand is curled.
  std::size_t jointsPerTurn() const {
    const Turn turn = turnOf(all());
    const double count = static_cast<double>(bends_.size());
    if (!(turn.w > 0)) return bends_.size();
    return static_cast<std::size_t>(std::clamp(std::round(kTurn / (turn.curledShare * turn.w)), 1.0, count));
  }

  // Mean bend of a range's joints [rad], and their arc length.
  double meanBend(Range range) const {
    double sum = 0;
    for (std::size_t i = range.begin; i < range.end; ++i) sum += sizes_[i];
    return sum / static_cast<double>(range.end - range.begin);
  }
  double arcOf(Range range) const {
    double sum = 0;
    for (std::size_t i = range.begin; i < range.end; ++i) sum += (arcs_[i] + arcs_[i + 1]) / 2;
    return sum;
  }

 private:
  // Means over joints, weighted by their bends.
  struct Turn {
    double theta = 0, phi = 0, w = 0;  // phi >= 0 by the joints' hands [rad]
    double chord = 0, arc = 0;         // of an edge [unit]
    double curledShare = 0;            // 1: all joints bend alike
  };

  Turn turnOf(Range range) const {
    double weight = 0, thetaSum = 0, chordSum = 0, arcSum = 0, along = 0, across = 0;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const double bend = sizes_[i];
      weight += bend;
      thetaSum += bend * bend;
      chordSum += bend * (edges_.chords[i] + edges_.chords[i + 1]) / 2;
      arcSum += bend * (arcs_[i] + arcs_[i + 1]) / 2;
      if (i == range.begin) continue;
      const std::complex<double> onwards = bends_[i] * std::conj(bends_[i - 1]);
      along += onwards.real();
      across += onwards.imag() * hands_[i];
    }
    if (!(thetaSum > 0)) return {};
    Turn turn{
        .theta = thetaSum / weight, .phi = std::abs(std::atan2(across, along)), .chord = chordSum / weight};
    turn.arc = arcSum / weight;
    turn.curledShare = weight / turn.theta / static_cast<double>(range.end - range.begin);
    // Two turns about axes at right angles compose to cos(w/2) = cos(theta/2) cos(phi/2).
    turn.w = 2 * std::acos(std::clamp(std::cos(turn.theta / 2) * std::cos(turn.phi / 2), -1.0, 1.0));
    return turn;
  }

  // Each joint's hand: the sign of phi over a window about it; where that is next to nothing, as before it.
  void readHands(std::size_t wanted) {
    const std::size_t count = bends_.size();
    if (hands_.empty()) hands_.assign(count, 1);
    const double w = turnOf(all()).w;
    std::vector<double> across(count + 1, 0.0), sizes(count + 1, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
      const std::complex<double> onwards = i > 0 ? bends_[i] * std::conj(bends_[i - 1]) : 0.0;
      across[i + 1] = across[i] + onwards.imag();
      sizes[i + 1] = sizes[i] + std::abs(onwards);
    }
    const std::size_t half = std::max<std::size_t>(1, std::max(kShortestWindow, wanted) / 2);
    int hand = 0;
    std::vector<int> hands(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t from = i > half ? i - half : 0, to = std::min(count, i + half);
      const double turned = across[to] - across[from];
      if (std::abs(turned) > kLeastTwist * w * (sizes[to] - sizes[from])) hand = turned > 0 ? 1 : -1;
      hands[i] = hand;
    }
    // The root's joints before the first that has a hand have that one's.
    const auto known = std::find_if(hands.begin(), hands.end(), [](int h) { return h != 0; });
    std::fill(hands.begin(), known, known == hands.end() ? 1 : *known);
    hands_ = std::move(hands);
  }

  Edges edges_;
  std::vector<double> arcs_;                 // of the usable edges [unit]
  std::vector<std::complex<double>> bends_;  // of each joint
  std::vector<double> sizes_;                // of the bends [rad]
  std::vector<int> hands_;                   // +1 or -1, of each joint
};

// Of neither hand is what winds as much one way as the other, to a turn or half of what there is.
int handOf(double balance, double turns) {
  if (std::abs(balance) * turns < std::min(1.0, turns / 2)) return 0;
  return balance > 0 ? 1 : -1;
}

CurlShape wholeCurl(const Joints& joints) {
  CurlShape shape = joints.fit(joints.all());
  if (shape.turns == 0) return {};
  shape.perversions = joints.perversions(joints.all());
  if (joints.coherence() < (shape.perversions > 0 ? kLeastCoherenceOfTwoHands : kLeastCoherence)) return {};
  // There is one edge more than there are joints.
  shape.turns *= 1 + 1 / static_cast<double>(joints.all().end);
  // Less than the whole of one turn, with room for rounding.
  if (shape.turns < kFewestTurns - 1e-9) return {};
  shape.handedness = handOf(joints.handBalance(joints.all()), shape.turns);
  return shape;
}

}  // namespace

CurlShape measureCurl(std::span<const Vec3d> strand) {
  if (strand.size() < 4) return {};
  const Joints joints(strand);
  return joints.areEnough() ? wholeCurl(joints) : CurlShape{};
}

CurlAlong measureCurlAlong(std::span<const Vec3d> strand) {
  CurlAlong curl;
  if (strand.size() < 4) return curl;
  const Joints joints(strand);
  if (!joints.areEnough()) return curl;
  curl.whole = wholeCurl(joints);
  if (curl.whole.turns == 0) return curl;

  const std::size_t count = joints.all().end;
  const std::size_t stretchCount =
      std::max<std::size_t>(1, count / std::max(kShortestWindow, joints.jointsPerTurn()));
  for (std::size_t k = 0; k < stretchCount; ++k) {
    const Range range{count * k / stretchCount, count * (k + 1) / stretchCount};
    if (joints.meanBend(range) < kStraightBendShare * joints.meanBend(joints.all())) continue;
    CurlShape shape = joints.fit(range);
    if (shape.turns == 0) continue;
    shape.handedness = handOf(joints.handBalance(range), shape.turns);
    shape.perversions = joints.perversions({range.begin > 0 ? range.begin - 1 : 0, range.end});
    curl.stretches.push_back({.length = joints.arcOf(range), .shape = shape});
  }
  return curl;
}

void measureArcs(std::span<const Vec3d> strand, std::span<double> arcs) {
  RINGLET_ASSERT(arcs.size() + 1 == std::max<std::size_t>(strand.size(), 1),
                 "measureArcs needs one arc per edge");
  if (arcs.empty()) return;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const double chord = length(strand[i + 1] - strand[i]);
    arcs[i] = std::isfinite(chord) ? chord : 0;
  }

  // Edges too short to have a direction are stepped over, and stay chords.
  const Edges edges = usableEdges(strand);
  const std::size_t count = edges.directions.size();
  double before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool isFirst = i == 0, isLast = i + 1 == count;
    const double after = isLast ? before : angleBetween(edges.directions[i], edges.directions[i + 1]);
    const double halfAngle = (isFirst ? after : (before + after) / 2) / 2;
    if (halfAngle > 0) arcs[edges.indices[i]] *= halfAngle / std::sin(halfAngle);
    before = after;
  }
}

}  // namespace ringlet
