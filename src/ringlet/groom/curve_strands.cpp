// Implements groom/curve_strands.h.
#include "ringlet/groom/curve_strands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ringlet/groom/strands_of_points.h"

namespace ringlet {
namespace {

// Of a file's bytes: a point takes six at least, and four of a cubic curve make 29 particles at most. Arrays
// that many objects share could make more.
constexpr std::size_t kParticlesPerByte = 4, kFreeParticles = 65536;
constexpr std::size_t kMostFaults = 6;                       // that are named
constexpr double kSmallestUnit = 1e-6, kLargestUnit = 1000;  // [m], as --unit may be

// Whether the nearest floats are finite: the shortest text of the largest one is a larger number.
bool isFloat(Vec3d p) {
  constexpr double kBeyond = 0x1.ffffffp127;  // nearer to what follows the largest
  return std::abs(p.x) < kBeyond && std::abs(p.y) < kBeyond && std::abs(p.z) < kBeyond;
}

}  // namespace

std::string countedNoun(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

Status ObjectCurves::fitCounts(std::uint32_t pointsPerStrand, std::string_view countsName) {
  if (counts.empty() && pointsPerStrand > 0) {
    if (Status whole = checkWholeStrands(pointCount(), pointsPerStrand); !whole) return whole;
    counts.assign(pointCount() / pointsPerStrand, static_cast<double>(pointsPerStrand));
  }
  double sum = 0;
  for (const double count : counts) {
    if (!(count >= 0 && count <= 4294967295.0) || count != std::floor(count))
      return Error{fmt::format("found {} in {}; expected counts of points", count, countsName)};
    sum += count;
  }
  if (sum == static_cast<double>(pointCount())) return {};
  return Error{fmt::format("its {} add up to {}, and it has {} points; expected as many{}", countsName, sum,
                           pointCount(), counts.empty() ? std::string("; ") + kSayPointsPerStrand : "")};
}

CurveStrands::CurveStrands(std::string name, std::string noun, std::size_t byteCount, PathOf pathOf)
    : name_(std::move(name)), noun_(std::move(noun)), byteCount_(byteCount), pathOf_(std::move(pathOf)) {}

void CurveStrands::warn(const std::string& sentence) {
  loaded_.warnings.push_back(fmt::format("{}: {}", name_, sentence));
}

void CurveStrands::takeUnit(double metresPerUnit) {
  loaded_.statesUnit = metresPerUnit >= kSmallestUnit && metresPerUnit <= kLargestUnit;
  if (loaded_.statesUnit) {
    loaded_.groom.metresPerUnit = metresPerUnit;
  } else {
    warn(fmt::format("states a unit of {} m, which no hair has; it is left aside", metresPerUnit));
  }
}

UsdTransform CurveStrands::takeUp(bool isZ, bool wantsZ) {
  loaded_.statesUp = true;
  if (isZ == wantsZ) return {};
  loaded_.isTurned = true;
  warn(fmt::format("turned from {0} up, which it states, to {1} up (--up {0} keeps its axes)",
                   isZ ? 'Z' : 'Y', isZ ? 'Y' : 'Z'));
  return isZ ? UsdTransform{{Vec3d{1, 0, 0}, Vec3d{0, 0, -1}, Vec3d{0, 1, 0}}, {}}
             : UsdTransform{{Vec3d{1, 0, 0}, Vec3d{0, 0, 1}, Vec3d{0, -1, 0}}, {}};
}

Error CurveStrands::wrong(std::uint32_t object, const std::string& sentence) const {
  return Error{fmt::format("{}: {}: {}", name_, pathOf_(object), sentence)};
}

void CurveStrands::leaveOut(std::uint32_t object, const std::string& sentence) {
  ++unreadCount_;
  auto same = std::ranges::find(unread_, sentence, &Unread::sentence);
  if (same == unread_.end()) {
    if (unread_.size() == kMostFaults) return;
    same = unread_.insert(same, Unread{{}, sentence});
  }
  same->add(object);
}

Result<std::vector<std::size_t>> CurveStrands::add(const ObjectCurves& curves, const CurveForm& form,
                                                   const UsdTransform& transform) {
  std::vector<std::size_t> kept;
  std::size_t first = 0, strandCount = loaded_.groom.strandCount();
  for (std::size_t c = 0; c < curves.counts.size(); ++c) {
    const auto count = static_cast<std::size_t>(curves.counts[c]);
    if (Status added =
            addStrand(curves.object, c, curves.numbers.subspan(3 * first, 3 * count), form, transform);
        !added)
      return added.error();
    first += count;
    if (strandCount < loaded_.groom.strandCount()) kept.push_back(c);
    strandCount = loaded_.groom.strandCount();
  }
  return kept;
}

Status CurveStrands::addStrand(std::uint32_t object, std::size_t curve, std::span<const double> numbers,
                               const CurveForm& form, const UsdTransform& transform) {
  const std::size_t count = numbers.size() / 3;
  const bool isStrand = form.isCubic ? isCubicCount(form.basis, form.isPinned, count) : count >= 2;
  if (!isStrand) {
    tooShort_.add(object);
    return {};
  }
  points_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d p{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    if (!isFloat(p)) {
      noteNoPlace(object, curve, i, p);
      return {};
    }
    points_.push_back(p);
  }
  if (form.isCubic) {
    particles_.clear();
    appendCubic(points_, form.basis, form.isPinned, particles_);
    std::swap(points_, particles_);
  }
  Groom& groom = loaded_.groom;
  if (points_.size() > std::numeric_limits<std::uint32_t>::max() - groom.points.size())
    return Error{fmt::format("{}: its strands have too many particles; at most 2^32 - 1 can be read", name_)};
  if (groom.points.size() + points_.size() > kParticlesPerByte * byteCount_ + kFreeParticles) {
    return wrong(object, fmt::format("its strands bring the file to {} particles, too many for its {} bytes",
                                     groom.points.size() + points_.size(), byteCount_));
  }
  const bool isPlaced = transform != UsdTransform{};  // else the file's own bits stay
  for (std::size_t i = 0; isPlaced && i < points_.size(); ++i) {
    points_[i] = transform(points_[i]);
    if (isFloat(points_[i])) continue;
    noteNoPlace(object, curve, i, points_[i]);
    return {};
  }
  cubic_ += form.isCubic;
  loose_ += form.isCubic && form.basis != CubicBasis::bezier && !form.isPinned;
  for (const Vec3d& p : points_) groom.points.push_back(Vec3f(p));
  groom.firstPoint.push_back(static_cast<std::uint32_t>(groom.points.size()));
  return {};
}

void CurveStrands::noteNoPlace(std::uint32_t object, std::size_t curve, std::size_t point, Vec3d p) {
  if (notFinite_.count == 0) {
    notFinite_.sentence = fmt::format("found ({}, {}, {}) for curve {}, point {}; expected finite numbers",
                                      p.x, p.y, p.z, curve, point);
  }
  notFinite_.add(object);
}

void CurveStrands::keepValue(const GroomValue& value, std::string_view per, std::size_t width, bool isIndexed,
                             const ObjectCurves& curves, const std::vector<std::size_t>& kept,
                             GroomPrim& prim) {
  const std::size_t size = std::max(value.numbers.size() / width, value.texts.size());
  const std::size_t curveCount = curves.counts.size();
  const bool isOfEach = per == "uniform", isOfPoints = per == "vertex" || per == "varying";
  const bool fits = isIndexed || per == "constant" || (isOfEach && size == curveCount) ||
                    (isOfPoints && prim.isWhole && size == curves.pointCount());
  if (size == 0 || !fits || (isIndexed && !prim.isWhole)) {
    leaveValue();
    return;
  }
  GroomValue& carried = prim.values.emplace_back(value);
  if (!isOfEach || kept.size() == curveCount) return;
  carried.numbers.clear();
  carried.texts.clear();
  for (const std::size_t curve : kept) {
    if (!value.texts.empty()) carried.texts.push_back(value.texts[curve]);
    for (std::size_t i = 0; i < width && !value.numbers.empty(); ++i)
      carried.numbers.push_back(value.numbers[curve * width + i]);
  }
}

Error CurveStrands::noStrand(std::size_t objectCount) const {
  if (!unread_.empty()) return wrong(unread_.front().first, unread_.front().sentence);
  if (notFinite_.count > 0) return wrong(notFinite_.first, notFinite_.sentence);
  return Error{fmt::format(
      "{}: {} without a strand{}", name_, countedNoun(objectCount, noun_),
      tooShort_.count > 0 ? fmt::format(": {} have too few points", countedNoun(tooShort_.count, "curve"))
                          : "")};
}

void CurveStrands::warnOfUnread() {
  std::size_t named = 0;
  for (const Unread& unread : unread_) {
    named += unread.count;
    warn(fmt::format("left out {}, {}{}: {}", countedNoun(unread.count, noun_),
                     unread.count > 1 ? "the first " : "", pathOf_(unread.first), unread.sentence));
  }
  if (unreadCount_ > named)
    warn(fmt::format("left out {} more for other faults", countedNoun(unreadCount_ - named, noun_)));
  if (empty_.count > 0)
    warn(fmt::format("left out {} without points, {}{}", countedNoun(empty_.count, noun_),
                     empty_.count > 1 ? "the first " : "", pathOf_(empty_.first)));
  if (notFinite_.count > 0)
    warn(fmt::format("left out {}, the first of {}: {}", countedNoun(notFinite_.count, "curve"),
                     pathOf_(notFinite_.first), notFinite_.sentence));
}

void CurveStrands::warnOfShort() {
  if (tooShort_.count > 0)
    warn(fmt::format("left out {}, which have too few points, the first of {}",
                     countedNoun(tooShort_.count, "curve"), pathOf_(tooShort_.first)));
}

void CurveStrands::warnOfCubic(std::string_view because) {
  if (cubic_ > 0) {
    warn(fmt::format("{} cubic, cut into edges that stay within a thousandth of their length",
                     cubic_ == 1 ? "1 curve is" : fmt::format("{} curves are", cubic_)));
  }
  if (loose_ > 0) {
    warn(fmt::format(
        "{} short of the first and last point{}",
        loose_ == 1 ? "1 of them begins and ends" : fmt::format("{} of them begin and end", loose_),
        because));
  }
}

void CurveStrands::warnOfValues() {
  if (valuesLeft_ > 0)
    warn(fmt::format("left aside {} of curves, which move or do not fit the strands",
                     countedNoun(valuesLeft_, "value")));
}

}  // namespace ringlet
