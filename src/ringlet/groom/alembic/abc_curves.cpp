// Implements groom/alembic/abc_curves.h.
#include "ringlet/groom/alembic/abc_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "ringlet/groom/cubic_curve.h"

namespace ringlet {
namespace {

constexpr unsigned kLinearType = 1, kVariableType = 2, kPeriodicWrap = 1;
constexpr std::uint8_t kNoAbcBasis = 0, kBezierBasis = 1, kBsplineBasis = 2, kCatmullRomBasis = 3;
constexpr std::array<const char*, 6> kBasisNames{"none",        "Bezier",  "B-spline",
                                                 "Catmull-Rom", "Hermite", "power"};
constexpr double kLinearOrder = 2, kCubicOrder = 4;  // degree and 1

class AbcCurvesReader {
 public:
  AbcCurvesReader(const AbcArchive& archive, const std::vector<AbcProperty>& properties, AbcBudget& budget)
      : archive_(archive), properties_(properties), budget_(budget) {}

  Result<AbcCurves> read(std::uint32_t object, const AbcReading& reading) {
    made_.curves.object = object;
    if (Status read = readPoints(reading.seconds); !read) return read.error();
    if (made_.numbers.empty()) return std::move(made_);
    if (Status read = readForm(); !read) return read.error();
    if (abcPropertyNamed(properties_, "nVertices")) {
      auto counts = numbersOf("nVertices", AbcType::u8, AbcType::i64);
      if (!counts) return counts.error();
      made_.curves.counts = std::move(*counts);
    }
    made_.curves.numbers = made_.numbers;
    if (Status fits = made_.curves.fitCounts(reading.pointsPerStrand, "nVertices"); !fits)
      return fits.error();
    if (Status even = checkWeights(); !even) return even.error();
    const bool mayHaveKnots = made_.form.isCubic && made_.form.basis == CubicBasis::bspline;
    if (mayHaveKnots && abcPropertyNamed(properties_, ".knots")) {
      if (Status followed = followKnots(); !followed) return followed.error();
    }
    return std::move(made_);
  }

 private:
  static Error unfit(const std::string& sentence) { return Error{sentence}; }

  // What is stored of a property for the sample that is read, or the last before it.
  std::uint32_t storedAt(const AbcProperty& property) const {
    const std::uint32_t sample = std::min(sample_, property.sampleCount - 1);
    if (!property.isChanging() || sample < property.firstChanged) return 0;
    return std::min(sample, property.lastChanged) - property.firstChanged + 1;
  }
  Result<AbcSample> sampleOf(const AbcProperty& property, std::uint32_t stored) const {
    auto sample = archive_.stored(property, stored);
    if (sample && !budget_.take(1 + sample->numberCount())) return budget_.state().error();
    return sample;
  }
  // Of a type from the lowest to the highest.
  Result<std::vector<double>> numbersOf(std::string_view name, AbcType lowest, AbcType highest) const {
    const AbcProperty* property = abcPropertyNamed(properties_, name);
    if (!property || property->kind == AbcKind::compound || property->sampleCount == 0)
      return unfit(fmt::format("has no {}", name));
    if (property->type < lowest || property->type > highest)
      return unfit(fmt::format("found {} of {}; expected {}", name, nameOf(property->type),
                               lowest == AbcType::f16 ? "floats" : "integers"));
    const auto sample = sampleOf(*property, storedAt(*property));
    if (!sample) return sample.error();
    std::vector<double> numbers(sample->numberCount());
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = sample->number(k);
    return numbers;
  }

  // Those of the first sample that has some, or of the last; or those at a time.
  Status readPoints(std::optional<double> seconds) {
    const AbcProperty* property = abcPropertyNamed(properties_, "P");
    if (!property || property->kind == AbcKind::compound || property->sampleCount == 0)
      return unfit("has no P");
    if (property->type < AbcType::f16 || property->type > AbcType::f64 || property->width != 3)
      return unfit(fmt::format("found P of {} {} an element; expected 3 floats", property->width,
                               nameOf(property->type)));
    if (property->isChanging()) {
      const auto knots = archive_.knotsOf(*property);
      if (!knots) return knots.error();
      if (!budget_.take(knots->size())) return budget_.state();
      if (seconds) return readPointsAt(*seconds, *property, *knots);
      for (const AbcKnot& knot : *knots) {
        const auto sample = sampleOf(*property, knot.stored);
        if (!sample) return sample.error();
        made_.seconds = knot.seconds;
        sample_ = knot.sample;
        if (sample->elementCount() > 0) break;
        if (!made_.emptySeconds) made_.emptySeconds = knot.seconds;
      }
    }
    auto numbers = numbersOf("P", AbcType::f16, AbcType::f64);
    if (!numbers) return numbers.error();
    made_.numbers = std::move(*numbers);
    return {};
  }

  Status readPointsAt(double seconds, const AbcProperty& property, const std::vector<AbcKnot>& knots) {
    const auto after = std::ranges::upper_bound(knots, seconds, {}, &AbcKnot::seconds);
    const AbcKnot& knot = after == knots.begin() ? *after : *(after - 1);
    sample_ = knot.sample;
    auto numbers = numbersOf("P", AbcType::f16, AbcType::f64);
    if (!numbers) return numbers.error();
    made_.numbers = std::move(*numbers);
    if (after == knots.begin() || after == knots.end() || !(seconds > knot.seconds)) return {};
    const auto next = sampleOf(property, after->stored);
    if (!next) return next.error();
    if (next->numberCount() != made_.numbers.size()) return {};
    const double share = (seconds - knot.seconds) / (after->seconds - knot.seconds);
    for (std::size_t k = 0; k < made_.numbers.size(); ++k)
      made_.numbers[k] += (next->number(k) - made_.numbers[k]) * share;
    return {};
  }

  Status readForm() {
    const auto said = numbersOf("curveBasisAndType", AbcType::u8, AbcType::i64);
    if (!said) return said.error();
    if (said->size() < 3)
      return unfit(fmt::format("found {} numbers in curveBasisAndType; expected 4", said->size()));
    const double type = (*said)[0], wrap = (*said)[1], basis = (*said)[2];
    if (!(type >= 0 && type <= kVariableType))
      return unfit(fmt::format("found curves of type {}; expected 0 (cubic), 1 (linear) or 2", type));
    if (wrap == kPeriodicWrap)
      return unfit("its curves are closed loops (periodic); a strand has a root and a tip");
    if (wrap != 0) return unfit(fmt::format("found wrap {}; expected 0 (nonperiodic) or 1", wrap));
    if (!(basis >= 0 && basis < kBasisNames.size()))
      return unfit(fmt::format("found basis {}; expected 0 to 5", basis));
    const auto number = static_cast<std::uint8_t>(basis);
    if (type == kLinearType) {
      made_.form.isCubic = false;
      return {};
    }
    return type == kVariableType ? readVariableForm(number) : setBasis(number);
  }

  Status setBasis(std::uint8_t basis) {
    if (basis < kBezierBasis || basis > kCatmullRomBasis)
      return unfit(
          fmt::format("its cubic curves have the basis '{}'; expected Bezier, B-spline or Catmull-Rom",
                      kBasisNames[basis]));
    made_.form = {.isCubic = true,
                  .isPinned = false,
                  .basis = basis == kBezierBasis    ? CubicBasis::bezier
                           : basis == kBsplineBasis ? CubicBasis::bspline
                                                    : CubicBasis::catmullRom};
    return {};
  }

  // Curves with orders of their own. Blender calls polylines and Catmull-Rom curves through all of their
  // points so, and writes no orders.
  Status readVariableForm(std::uint8_t basis) {
    std::vector<double> orders;
    if (abcPropertyNamed(properties_, ".orders")) {
      auto found = numbersOf(".orders", AbcType::u8, AbcType::i64);
      if (!found) return found.error();
      orders = std::move(*found);
    }
    if (orders.empty() && basis == kNoAbcBasis) {
      made_.form.isCubic = false;
      return {};
    }
    if (orders.empty()) {
      if (Status set = setBasis(basis); !set) return set;
      made_.form.isPinned = made_.form.basis == CubicBasis::catmullRom;
      return {};
    }
    const auto [low, high] = std::ranges::minmax(orders);
    if (low == kLinearOrder && high == kLinearOrder) {
      made_.form.isCubic = false;
      return {};
    }
    if (low == kCubicOrder && high == kCubicOrder) return setBasis(basis);
    return unfit(fmt::format(
        "its curves are of orders from {} to {}; expected all of order 2 (linear) or 4 (cubic)", low, high));
  }

  Status checkWeights() {
    if (!made_.form.isCubic || !abcPropertyNamed(properties_, "w")) return {};
    const auto weights = numbersOf("w", AbcType::f16, AbcType::f64);
    if (!weights) return budget_.state();  // none
    if (std::ranges::all_of(*weights, [&](double weight) { return weight == weights->front(); })) return {};
    return unfit("its points have weights (w), which are not read; expected the same for all of them");
  }

  // Curves of a B-spline with knots as Bezier curves, which end where they do.
  Status followKnots() {
    const auto all = numbersOf(".knots", AbcType::f16, AbcType::f64);
    if (!all) {
      made_.hasOtherKnots = true;
      return budget_.state();
    }
    std::vector<Vec3d> bezier;
    std::vector<double> counts;
    std::span<const double> numbers(made_.numbers), knots(*all);
    for (const double said : made_.curves.counts) {
      const auto count = static_cast<std::size_t>(said);
      if (count + 4 > knots.size() || !areCubicKnots(knots.first(count + 4), count)) {
        made_.hasOtherKnots = true;
        return {};
      }
      std::vector<Vec3d> points;
      for (std::size_t k = 0; k < 3 * count; k += 3)
        points.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
      const std::size_t before = bezier.size();
      appendBezierOfKnots(points, knots.first(count + 4), bezier);
      counts.push_back(static_cast<double>(bezier.size() - before));
      numbers = numbers.subspan(3 * count);
      knots = knots.subspan(count + 4);
    }
    made_.hasOtherKnots = !knots.empty();
    if (made_.hasOtherKnots) return {};
    made_.numbers.clear();
    for (const Vec3d& p : bezier) made_.numbers.insert(made_.numbers.end(), {p.x, p.y, p.z});
    made_.curves.numbers = made_.numbers;
    made_.curves.counts = std::move(counts);
    made_.form.basis = CubicBasis::bezier;
    return {};
  }

  const AbcArchive& archive_;
  const std::vector<AbcProperty>& properties_;
  AbcBudget& budget_;
  std::uint32_t sample_ = 0;
  AbcCurves made_{};
};

}  // namespace

Result<AbcCurves> readAbcCurves(const AbcArchive& archive, std::uint32_t object,
                                const std::vector<AbcProperty>& properties, const AbcReading& reading,
                                AbcBudget& budget) {
  return AbcCurvesReader(archive, properties, budget).read(object, reading);
}

}  // namespace ringlet
