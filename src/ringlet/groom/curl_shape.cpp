// Implements groom/curl_shape.h: one helix fitted to all joints of a strand.
//
//        ê_i  /\  ê_{i+1}        theta_i: turn at the joint, about the normal b_i = ê_i x ê_{i+1}
//            /  \                phi:     turn of that normal about the edge between two joints
//      -----/ b_i \-----         w:       both composed: the helix's own turn about its axis per edge
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
// of pure noise and flat waves 0.2; a real groom's tight coils have 0.78 to 0.9.
constexpr double kLeastCoherence = 0.6;
constexpr std::size_t kShortestWindow = 8;  // joints; below, chance alone makes a few of them agree

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

// Any unit vector across a unit vector.
Vec3d anyNormal(Vec3d direction) {
  const Vec3d axis = std::abs(direction.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  return normalizedOr(cross(direction, axis), Vec3d{0, 0, 1});
}

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

// How much of the bending turns by phi per joint: 1 on a helix, near 0 on noise and on flat waves. Taken over
// windows of about a turn, so that a curl whose rate drifts along the strand still counts as one.
double coherence(std::span<const std::complex<double>> bends, double phi, double jointsPerTurn) {
  std::vector<std::complex<double>> sums{0.0};
  std::vector<double> sizes{0.0};
  for (std::size_t i = 0; i < bends.size(); ++i) {
    sums.push_back(sums.back() + bends[i] * std::polar(1.0, -phi * static_cast<double>(i)));
    sizes.push_back(sizes.back() + std::abs(bends[i]));
  }
  const double wanted = std::clamp(std::round(jointsPerTurn), 1.0, static_cast<double>(bends.size()));
  const std::size_t window =
      std::min(bends.size(), std::max(kShortestWindow, static_cast<std::size_t>(wanted)));
  double together = 0, apart = 0;
  for (std::size_t i = 0; i + window < sums.size(); ++i) {
    together += std::abs(sums[i + window] - sums[i]);
    apart += sizes[i + window] - sizes[i];
  }
  return apart > 0 ? together / apart : 0;
}

}  // namespace

CurlShape measureCurl(std::span<const Vec3d> strand) {
  if (strand.size() < 4) return {};
  const Edges edges = usableEdges(strand);
  if (edges.directions.size() < 3) return {};
  const auto edgeCount = static_cast<double>(edges.directions.size());

  std::vector<double> arcs(strand.size() - 1);
  measureArcs(strand, arcs);

  // Each joint counts by how much it bends: a straight root must not widen the ringlet below it.
  const std::vector<std::complex<double>> bends = measureBends(edges.directions);
  double weight = 0, thetaSum = 0, chordSum = 0, arcSum = 0;
  std::complex<double> phiSum = 0;
  for (std::size_t i = 0; i < bends.size(); ++i) {
    const double bend = std::abs(bends[i]);
    weight += bend;
    thetaSum += bend * bend;
    chordSum += bend * (edges.chords[i] + edges.chords[i + 1]) / 2;
    arcSum += bend * (arcs[edges.indices[i]] + arcs[edges.indices[i + 1]]) / 2;
    if (i > 0) phiSum += bends[i] * std::conj(bends[i - 1]);
  }
  if (!(thetaSum > 0)) return {};
  const double theta = thetaSum / weight, chord = chordSum / weight, arc = arcSum / weight;
  const double phi = std::arg(phiSum);
  const double curledShare = weight / theta / static_cast<double>(bends.size());  // 1: all joints bend alike

  // w: two turns about axes at right angles compose to cos(w/2) = cos(theta/2) cos(phi/2).
  const double w = 2 * std::acos(std::clamp(std::cos(theta / 2) * std::cos(phi / 2), -1.0, 1.0));
  if (!(w > 0) || w > kTurn / kFewestParticlesPerTurn) return {};
  if (coherence(bends, phi, kTurn / (curledShare * w)) < kLeastCoherence) return {};

  // The axis of that turn meets the edge at a known angle: along it is rise, across it a chord 2 r sin(w/2).
  const double alongAxis = std::cos(theta / 2) * std::abs(std::sin(phi / 2)) / std::sin(w / 2);
  const double acrossAxis = std::sqrt(std::max(0.0, 1 - alongAxis * alongAxis));

  CurlShape shape;
  shape.turns = curledShare * edgeCount * w / kTurn;
  shape.turnLength = arc * kTurn / w;
  shape.radius = chord * acrossAxis / (2 * std::sin(w / 2));
  shape.pitch = chord * alongAxis * kTurn / w;
  shape.handedness = phi < 0 ? -1 : 1;

  // Less than the whole of one turn, with room for rounding, or too shallow to matter.
  if (shape.turns < kFewestTurns - 1e-9 || kTurn * shape.radius < kShallowestCurl * shape.pitch) return {};
  return shape;
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
