// Implements groom/usd/usd_groom.h.
#include "ringlet/groom/usd/usd_groom.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "ringlet/base/quoted.h"
#include "ringlet/groom/cubic_curve.h"
#include "ringlet/groom/strands_of_points.h"
#include "ringlet/groom/usd/usd_transform.h"

namespace ringlet {
namespace {

constexpr const char* kFlatten = "flatten the file first, as `usdcat --flatten` does";
constexpr double kSmallestUnit = 1e-6, kLargestUnit = 1000;  // [m], as --unit may be
// Of a file's bytes: a point takes eight at least, and four of a cubic curve make 29 particles at most.
// Arrays that many prims share could make more.
constexpr std::size_t kParticlesPerByte = 4, kFreeParticles = 65536;
constexpr std::size_t kMostNamed = 6;  // in a sentence

// Why curves are not drawn, and so not read.
enum class LeftOut : std::uint8_t { no, inactive, abstract, over, invisible, proxy, prototype };
constexpr std::array<const char*, 7> kLeftOutWords{
    "", "inactive", "of a class", "only an `over`", "invisible", "proxies", "below an instancer"};

// What a prim has of its own and from those above it.
struct Inherited {
  std::uint32_t transform = 0;          // into the transforms
  std::uint32_t composed = kNoUsdPrim;  // the topmost that brings in others
  LeftOut leftOut = LeftOut::no;
  std::uint32_t deformed = kNoUsdPrim;  // the nearest that binds to a skeleton or to blend shapes
  std::uint32_t unplaced = kNoUsdPrim;  // the topmost whose transforms cannot be followed
  bool hasStrands = false;              // curves that are read, itself or below it
  std::string_view purpose;
};

// How many there are of a kind, and where the first is.
struct Found {
  std::size_t count = 0;
  std::uint32_t firstPrim = kNoUsdPrim;

  void add(std::uint32_t prim) {
    if (count++ == 0) firstPrim = prim;
  }
};

// Prims of one fault, or curves.
struct Unread : Found {
  std::string sentence;  // of the first
};

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

class UsdGroomMaker {
 public:
  UsdGroomMaker(const UsdLayer& layer, const GroomReading& reading, const std::string& name)
      : layer_(layer), reading_(reading), name_(name) {}

  Result<LoadedGroom> make() {
    if (Status read = readUnitAndAxis(); !read) return read.error();
    findCurves();
    if (curves_ == 0) return nothingFound();
    if (!layer_.composedBy.empty()) {
      return Error{fmt::format("{}: has {}, other files that are not read here; {}", name_, layer_.composedBy,
                               kFlatten)};
    }
    for (std::uint32_t i = 0; i < layer_.prims.size(); ++i) {
      if (!inherited_[i].hasStrands) continue;
      if (Status placed = placePrim(i); !placed) return placed.error();
      if (!isCurves(i)) continue;
      if (Status read = readCurves(i); !read) return read.error();
    }
    if (loaded_.groom.strandCount() == 0) return noStrand();
    warn();
    return std::move(loaded_);
  }

 private:
  bool isCurves(std::uint32_t prim) const { return layer_.prims[prim].type == "BasisCurves"; }

  std::string pathOf(std::uint32_t prim) const { return usdPathOf(layer_, prim); }
  Error wrong(std::uint32_t prim, const std::string& sentence) const {
    return Error{fmt::format("{}: {}: {}", name_, pathOf(prim), sentence)};
  }
  // A prim that cannot be read, with what is wrong at `prim` or above it.
  void leaveOut(std::uint32_t prim, const std::string& sentence) {
    ++unreadCount_;
    auto same = std::ranges::find(unread_, sentence, &Unread::sentence);
    if (same == unread_.end()) {
      if (unread_.size() == kMostNamed) return;
      same = unread_.insert(same, Unread{{}, sentence});
    }
    same->add(prim);
  }
  Error noStrand() const {
    if (!unread_.empty()) return wrong(unread_.front().firstPrim, unread_.front().sentence);
    if (notFinite_.count > 0) return wrong(notFinite_.firstPrim, notFinite_.sentence);
    return Error{fmt::format("{}: {} without a strand{}", name_, counted(curves_, "BasisCurves prim"),
                             tooShort_.count > 0
                                 ? fmt::format(": {} have too few points", counted(tooShort_.count, "curve"))
                                 : "")};
  }
  void warn(const std::string& sentence) {
    loaded_.warnings.push_back(fmt::format("{}: {}", name_, sentence));
  }

  Status readUnitAndAxis() {
    if (layer_.metresPerUnit) {
      const double unit = *layer_.metresPerUnit;
      loaded_.statesUnit = unit >= kSmallestUnit && unit <= kLargestUnit;
      if (loaded_.statesUnit) {
        loaded_.groom.metresPerUnit = unit;
      } else {
        warn(fmt::format("states a unit of {} m, which no hair has; it is left aside", unit));
      }
    }
    transforms_.emplace_back();
    if (layer_.upAxis.empty()) return {};
    if (layer_.upAxis != "Y" && layer_.upAxis != "Z")
      return Error{fmt::format("{}: found up axis {}; expected Y or Z", name_, quoted(layer_.upAxis))};
    loaded_.statesUp = true;
    const bool isZ = layer_.upAxis == "Z";
    if (isZ == reading_.upIsZ) return {};
    transforms_[0] = isZ ? UsdTransform{{Vec3d{1, 0, 0}, Vec3d{0, 0, -1}, Vec3d{0, 1, 0}}, {}}
                         : UsdTransform{{Vec3d{1, 0, 0}, Vec3d{0, 0, 1}, Vec3d{0, -1, 0}}, {}};
    loaded_.isTurned = true;
    warn(fmt::format("turned from {0} up, which it states, to {1} up (--up {0} keeps its axes)",
                     isZ ? 'Z' : 'Y', isZ ? 'Y' : 'Z'));
    return {};
  }

  // What is read and what is left out, and which prims are above what is read.
  void findCurves() {
    inherited_.reserve(layer_.prims.size());
    for (std::uint32_t i = 0; i < layer_.prims.size(); ++i) {
      const UsdPrim& prim = layer_.prims[i];
      Inherited own = prim.parent == kNoUsdPrim ? Inherited{} : inherited_[prim.parent];
      own.hasStrands = false;
      own.purpose = usdTokenOf(prim, "purpose", own.purpose);
      if (own.composed == kNoUsdPrim && !prim.composedBy.empty()) own.composed = i;
      if (!prim.deformedBy.empty()) own.deformed = i;
      if (own.leftOut == LeftOut::no) own.leftOut = leftOutBy(prim);
      const LeftOut why = own.leftOut == LeftOut::no && own.purpose == "proxy" ? LeftOut::proxy : own.leftOut;
      inherited_.push_back(own);
      ++types_[prim.type];
      if (!isCurves(i)) {
        if (prim.type == "PointInstancer") inherited_.back().leftOut = LeftOut::prototype;
        continue;
      }
      if (why != LeftOut::no) {
        ++leftOut_[static_cast<std::size_t>(why)];
        continue;
      }
      ++curves_;
      (own.purpose == "guide" ? guides_ : others_) = true;
      for (std::uint32_t above = i; above != kNoUsdPrim && !inherited_[above].hasStrands;
           above = layer_.prims[above].parent)
        inherited_[above].hasStrands = true;
    }
  }

  static LeftOut leftOutBy(const UsdPrim& prim) {
    if (!prim.isActive) return LeftOut::inactive;
    if (prim.specifier == UsdSpecifier::abstract) return LeftOut::abstract;
    if (prim.specifier == UsdSpecifier::over) return LeftOut::over;
    return usdTokenOf(prim, "visibility", "") == "invisible" ? LeftOut::invisible : LeftOut::no;
  }

  // "2 Mesh, 1 NurbsCurves".
  std::string typesFound() const {
    std::vector<std::pair<std::size_t, std::string_view>> found;
    for (const auto& [type, count] : types_) found.push_back({count, type});
    std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string text;
    for (std::size_t i = 0; i < std::min(found.size(), kMostNamed); ++i) {
      const std::string name = quoted(found[i].second);
      text += fmt::format("{}{} {}", i > 0 ? ", " : "", found[i].first,
                          found[i].second.empty() ? "without a type" : name.substr(1, name.size() - 2));
    }
    return found.size() > kMostNamed ? text + " and others" : text;
  }
  // "1 inactive, 2 invisible".
  std::string leftOutFound() const {
    std::string text;
    for (std::size_t i = 1; i < leftOut_.size(); ++i) {
      if (leftOut_[i] > 0)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", leftOut_[i], kLeftOutWords[i]);
    }
    return text;
  }

  Error nothingFound() const {
    std::string sentence = "found no prims; expected BasisCurves";
    if (const std::string leftOut = leftOutFound(); !leftOut.empty()) {
      sentence = fmt::format("all its BasisCurves are left out: {}; expected some that are drawn", leftOut);
    } else if (!layer_.prims.empty()) {
      sentence = fmt::format("found no BasisCurves, of which strands are made, but {}", typesFound());
    }
    const auto composed =
        std::ranges::find_if(inherited_, [](const Inherited& prim) { return prim.composed != kNoUsdPrim; });
    if (composed != inherited_.end()) {
      sentence +=
          fmt::format("; {} has {}, which are not followed: {}", usdPathOf(layer_, composed->composed),
                      layer_.prims[composed->composed].composedBy, kFlatten);
    } else if (!layer_.composedBy.empty()) {
      sentence += fmt::format("; it has {}, which are not followed: {}", layer_.composedBy, kFlatten);
    }
    return Error{fmt::format("{}: {}", name_, sentence)};
  }

  Status placePrim(std::uint32_t index) {
    const UsdPrim& prim = layer_.prims[index];
    Inherited& own = inherited_[index];
    if (own.composed != kNoUsdPrim) {
      return wrong(own.composed, fmt::format("has {}, which bring in more than this file holds; {}",
                                             layer_.prims[own.composed].composedBy, kFlatten));
    }
    if (prim.parent != kNoUsdPrim) own.unplaced = inherited_[prim.parent].unplaced;
    if (own.unplaced != kNoUsdPrim) return {};
    const auto placement = usdPlacementOf(prim);
    if (!placement) {
      own.unplaced = index;
      unplaced_[index] = placement.error().message;
      return {};
    }
    for (const std::string& op : placement->valueless) {
      if (valueless_.count == 0) valueless_.sentence = op;
      valueless_.add(index);
    }
    for (const UsdAttribute& attribute : prim.attributes) noteSamples(attribute);
    own.transform = prim.parent == kNoUsdPrim || placement->isOfWorld ? 0 : inherited_[prim.parent].transform;
    if (placement->transform == UsdTransform{}) return {};
    transforms_.push_back(placement->transform.then(transforms_[own.transform]));
    own.transform = static_cast<std::uint32_t>(transforms_.size() - 1);
    return {};
  }

  void noteSamples(const UsdAttribute& attribute) {
    if (!attribute.isSampled || isUsdValue(attribute.name) || attribute.emptyTime) return;
    firstTime_ = moves_ ? std::min(firstTime_, *attribute.time) : *attribute.time;
    moves_ = true;
  }

  // --- A prim's strands.

  // How a prim's curves are to be understood.
  struct Form {
    bool isCubic = true, isPinned = false;
    CubicBasis basis = CubicBasis::bezier;
  };

  Result<Form> formOf(std::uint32_t index) const {
    const auto unfit = [](const std::string& sentence) { return Error{sentence}; };
    const UsdPrim& prim = layer_.prims[index];
    for (const std::string_view name : {"type", "basis", "wrap", "points", "curveVertexCounts"}) {
      const UsdAttribute* attribute = usdAttributeOf(prim, name);
      if (attribute && !attribute->drivenBy.empty())
        return unfit(fmt::format("its {} are given by {}, which is not followed", name, attribute->drivenBy));
    }
    const std::string_view type = usdTokenOf(prim, "type", "cubic"),
                           basis = usdTokenOf(prim, "basis", "bezier"),
                           wrap = usdTokenOf(prim, "wrap", "nonperiodic");
    if (type != "cubic" && type != "linear")
      return unfit(fmt::format("found type {}; expected linear or cubic", quoted(type)));
    if (wrap == "periodic")
      return unfit("its curves are closed loops (wrap 'periodic'); a strand has a root and a tip");
    if (wrap != "nonperiodic" && wrap != "pinned")
      return unfit(fmt::format("found wrap {}; expected nonperiodic or pinned", quoted(wrap)));
    Form form{.isCubic = type == "cubic", .isPinned = wrap == "pinned"};
    if (!form.isCubic) return form;
    if (basis == "bspline") {
      form.basis = CubicBasis::bspline;
    } else if (basis == "catmullRom") {
      form.basis = CubicBasis::catmullRom;
    } else if (basis != "bezier") {
      return unfit(fmt::format("found basis {}; expected bezier, bspline or catmullRom", quoted(basis)));
    }
    return form;
  }

  // Whether points and counts are such, and fit each other.
  static Status checkCounts(const UsdValue& points, const UsdValue& counts) {
    if (!points.numbers.empty() && points.width != 3)
      return Error{fmt::format("its points have {} numbers each; expected 3", points.width)};
    if (!counts.numbers.empty() && counts.width != 1)
      return Error{"found tuples as curveVertexCounts; expected whole numbers"};
    double sum = 0;
    for (const double count : counts.numbers) {
      if (!(count >= 0 && count <= 4294967295.0) || count != std::floor(count))
        return Error{fmt::format("found {} in curveVertexCounts; expected counts of points", count)};
      sum += count;
    }
    const std::size_t pointCount = points.numbers.size() / 3;
    if (sum == static_cast<double>(pointCount)) return {};
    return Error{fmt::format("its curveVertexCounts add up to {}, and it has {} points; expected as many{}",
                             sum, pointCount,
                             counts.numbers.empty() ? std::string("; ") + kSayPointsPerStrand : "")};
  }
  // Of a prim without, where all curves are said to have as many.
  Status addCounts(std::size_t pointCount, UsdValue& counts) {
    const std::size_t each = reading_.pointsPerStrand;
    if (each == 0) return {};
    if (Status whole = checkWholeStrands(pointCount, reading_.pointsPerStrand); !whole) return whole;
    counts.numbers.assign(pointCount / each, static_cast<double>(each));
    return {};
  }

  // Fails only where the groom becomes too large: what is wrong with one prim leaves it out.
  Status readCurves(std::uint32_t index) {
    if (const std::uint32_t above = inherited_[index].unplaced; above != kNoUsdPrim) {
      leaveOut(above, unplaced_[above]);
      return {};
    }
    const auto form = formOf(index);
    if (!form) {
      leaveOut(index, form.error().message);
      return {};
    }
    static const UsdAttribute none{};
    const UsdAttribute* pointsFound = usdAttributeOf(layer_.prims[index], "points");
    const UsdAttribute* countsFound = usdAttributeOf(layer_.prims[index], "curveVertexCounts");
    const UsdValue& points = (pointsFound ? pointsFound : &none)->value;
    UsdValue counts = (countsFound ? countsFound : &none)->value;
    Status fits;
    if (counts.numbers.empty() && points.width == 3) fits = addCounts(points.numbers.size() / 3, counts);
    if (fits) fits = checkCounts(points, counts);
    if (!fits) {
      leaveOut(index, fits.error().message);
      return {};
    }
    if (points.numbers.empty()) {
      empty_.add(index);
      return {};
    }
    if (pointsFound->emptyTime) begunEmpty_.add(index);
    if (inherited_[index].deformed != kNoUsdPrim) deformed_.add(index);
    const std::size_t pointCount = points.numbers.size() / 3;
    const std::span<const double> numbers(points.numbers);
    const auto firstStrand = static_cast<std::uint32_t>(loaded_.groom.strandCount());
    std::vector<std::size_t> kept;  // curves that are strands
    std::size_t first = 0;
    for (std::size_t c = 0; c < counts.numbers.size(); ++c) {
      const auto count = static_cast<std::size_t>(counts.numbers[c]);
      if (Status added = addStrand(index, c, numbers.subspan(3 * first, 3 * count), *form); !added)
        return added;
      first += count;
      if (firstStrand + kept.size() < loaded_.groom.strandCount()) kept.push_back(c);
    }
    if (reading_.keepsPrims) {
      loaded_.prims.push_back({.path = exactPathOf(index),
                               .firstStrand = firstStrand,
                               .strandCount = static_cast<std::uint32_t>(kept.size()),
                               .toGroom = transforms_[inherited_[index].transform],
                               .isWhole = !form->isCubic && kept.size() == counts.numbers.size(),
                               .values = {}});
      keepValues(layer_.prims[index], counts.numbers.size(), pointCount, kept, loaded_.prims.back());
    }
    return {};
  }

  // Names as they are, for files; those of messages are usdPathOf's.
  std::string exactPathOf(std::uint32_t prim) const {
    std::string path;
    for (; prim != kNoUsdPrim; prim = layer_.prims[prim].parent)
      path = "/" + std::string(layer_.prims[prim].name) + path;
    return path;
  }

  // What is said of a prim's curves and fits them. Where not all of them are strands, or points particles,
  // only what is said of all or of each curve still fits.
  void keepValues(const UsdPrim& prim, std::size_t curveCount, std::size_t pointCount,
                  const std::vector<std::size_t>& kept, GroomPrim& into) {
    for (const UsdAttribute& attribute : prim.attributes) {
      if (!isUsdValue(attribute.name)) continue;
      const bool isIndexed = usdAttributeOf(prim, std::string(attribute.name) + ":indices") != nullptr;
      const bool isWidths = attribute.name == "widths";
      std::string_view per = attribute.interpolation;
      if (per.empty()) per = isWidths ? "vertex" : attribute.name == "ids" ? "uniform" : "constant";
      const UsdValue& value = attribute.value;
      const std::size_t size = std::max(value.numbers.size() / value.width, value.texts.size());
      const bool isOfEach = per == "uniform", isOfPoints = per == "vertex" || per == "varying";
      const bool fits = isIndexed || per == "constant" || (isOfEach && size == curveCount) ||
                        (isOfPoints && into.isWhole && size == pointCount);
      if (value.isBlocked || attribute.isSampled || size == 0 || !attribute.drivenBy.empty() || !fits ||
          (isIndexed && !into.isWhole)) {
        ++valuesLeft_;
        continue;
      }
      GroomValue& carried = into.values.emplace_back();
      carried = {std::string(attribute.name),
                 std::string(attribute.type),
                 std::string(attribute.interpolation),
                 value.numbers,
                 {value.texts.begin(), value.texts.end()}};
      if (!isOfEach || kept.size() == curveCount) continue;
      carried.numbers.clear();
      carried.texts.clear();
      for (const std::size_t curve : kept) {
        if (!value.texts.empty()) carried.texts.emplace_back(value.texts[curve]);
        for (std::size_t i = 0; i < value.width && !value.numbers.empty(); ++i)
          carried.numbers.push_back(value.numbers[curve * value.width + i]);
      }
    }
  }

  Status addStrand(std::uint32_t prim, std::size_t curve, std::span<const double> numbers, const Form& form) {
    const std::size_t count = numbers.size() / 3;
    const bool isStrand = form.isCubic ? isCubicCount(form.basis, form.isPinned, count) : count >= 2;
    if (!isStrand) {
      tooShort_.add(prim);
      return {};
    }
    points_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d p{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
      if (!isFloat(p)) {
        noteNoPlace(prim, curve, i, p);
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
      return Error{
          fmt::format("{}: its strands have too many particles; at most 2^32 - 1 can be read", name_)};
    if (groom.points.size() + points_.size() > kParticlesPerByte * layer_.byteCount + kFreeParticles) {
      return wrong(prim, fmt::format("its strands bring the file to {} particles, too many for its {} bytes",
                                     groom.points.size() + points_.size(), layer_.byteCount));
    }
    const UsdTransform& transform = transforms_[inherited_[prim].transform];
    const bool isPlaced = transform != UsdTransform{};  // else the file's own bits stay
    for (std::size_t i = 0; isPlaced && i < points_.size(); ++i) {
      points_[i] = transform(points_[i]);
      if (isFloat(points_[i])) continue;
      noteNoPlace(prim, curve, i, points_[i]);
      return {};
    }
    cubic_ += form.isCubic;
    loose_ += form.isCubic && form.basis != CubicBasis::bezier && !form.isPinned;
    for (const Vec3d& p : points_) groom.points.push_back(Vec3f(p));
    groom.firstPoint.push_back(static_cast<std::uint32_t>(groom.points.size()));
    return {};
  }

  static bool isFloat(Vec3d p) {
    constexpr double kMost = std::numeric_limits<float>::max();
    return std::abs(p.x) <= kMost && std::abs(p.y) <= kMost && std::abs(p.z) <= kMost;
  }
  void noteNoPlace(std::uint32_t prim, std::size_t curve, std::size_t point, Vec3d p) {
    if (notFinite_.count == 0) {
      notFinite_.sentence = fmt::format("found ({}, {}, {}) for curve {}, point {}; expected finite numbers",
                                        p.x, p.y, p.z, curve, point);
    }
    notFinite_.add(prim);
  }

  // --- What a person should hear.

  void warn() {
    if (const std::string leftOut = leftOutFound(); !leftOut.empty())
      warn(fmt::format("left out BasisCurves that are not drawn: {}", leftOut));
    warnOfUnread();
    if (deformed_.count > 0) {
      const std::uint32_t first = deformed_.firstPrim;
      const std::string_view by = layer_.prims[inherited_[first].deformed].deformedBy;
      const bool isSkeleton = by.find("blendShape") == by.npos;
      warn(fmt::format(
          "{} bound to {} ({}), which is not followed: the strands stand {}; bake the deformation into the "
          "points before the export",
          deformed_.count == 1
              ? pathOf(first) + " is"
              : fmt::format("{} BasisCurves prims, the first {}, are", deformed_.count, pathOf(first)),
          isSkeleton ? "a skeleton" : "blend shapes", by,
          isSkeleton ? "in their bind pose" : "as they are without any"));
    }
    if (guides_ && others_)
      warn("some BasisCurves have purpose 'guide' and some have not; all of them are strands of the groom");
    if (tooShort_.count > 0)
      warn(fmt::format("left out {}, which have too few points, the first of {}",
                       counted(tooShort_.count, "curve"), pathOf(tooShort_.firstPrim)));
    if (cubic_ > 0) {
      warn(fmt::format("{} cubic, cut into edges that stay within a thousandth of their length",
                       cubic_ == 1 ? "1 curve is" : fmt::format("{} curves are", cubic_)));
    }
    if (loose_ > 0) {
      warn(fmt::format(
          "{} short of the first and last point, as bspline and catmullRom do unless wrap is 'pinned'",
          loose_ == 1 ? "1 of them begins and ends" : fmt::format("{} of them begin and end", loose_)));
    }
    if (valuesLeft_ > 0)
      warn(fmt::format("left aside {} of curves, which move or do not fit the strands",
                       counted(valuesLeft_, "value")));
    if (begunEmpty_.count > 0) {
      const UsdAttribute& points = *usdAttributeOf(layer_.prims[begunEmpty_.firstPrim], "points");
      warn(fmt::format("{} without points at first, {} at time {}; read as at the first time with points, {}",
                       begunEmpty_.count == 1 ? "1 BasisCurves prim is"
                                              : fmt::format("{} BasisCurves prims are", begunEmpty_.count),
                       pathOf(begunEmpty_.firstPrim), *points.emptyTime, *points.time));
    }
    if (valueless_.count > 0) {
      warn(fmt::format(
          "left aside {} without a value, which `xformOpOrder` names, as USD does; the first is {} of {}",
          counted(valueless_.count, "transform"), valueless_.sentence, pathOf(valueless_.firstPrim)));
    }
    if (moves_) warn(fmt::format("it moves; read as it is at its first sample, at time {}", firstTime_));
    std::size_t elsewhere = 0;
    std::uint32_t first = kNoUsdPrim;
    for (std::uint32_t i = 0; i < inherited_.size(); ++i) {
      if (inherited_[i].composed != i) continue;
      first = std::min(first, i);
      ++elsewhere;
    }
    if (elsewhere > 0) {
      warn(fmt::format("{} has {}, which are not followed{}", usdPathOf(layer_, first),
                       layer_.prims[first].composedBy,
                       elsewhere > 1 ? fmt::format(", as {} in all", counted(elsewhere, "prim")) : ""));
    }
    for (const std::string_view type : {"HermiteCurves", "NurbsCurves"}) {
      if (types_.count(type))
        warn(fmt::format("{} {} left aside; only BasisCurves are read", types_[type], type));
    }
  }

  void warnOfUnread() {
    std::size_t named = 0;
    for (const Unread& unread : unread_) {
      named += unread.count;
      warn(fmt::format("left out {}, {}{}: {}", counted(unread.count, "BasisCurves prim"),
                       unread.count > 1 ? "the first " : "", pathOf(unread.firstPrim), unread.sentence));
    }
    if (unreadCount_ > named)
      warn(fmt::format("left out {} more for other faults",
                       counted(unreadCount_ - named, "BasisCurves prim")));
    if (empty_.count > 0)
      warn(fmt::format("left out {} without points, {}{}", counted(empty_.count, "BasisCurves prim"),
                       empty_.count > 1 ? "the first " : "", pathOf(empty_.firstPrim)));
    if (notFinite_.count > 0)
      warn(fmt::format("left out {}, the first of {}: {}", counted(notFinite_.count, "curve"),
                       pathOf(notFinite_.firstPrim), notFinite_.sentence));
  }

  const UsdLayer& layer_;
  const GroomReading& reading_;
  const std::string& name_;
  LoadedGroom loaded_;
  std::vector<UsdTransform> transforms_;
  std::vector<Inherited> inherited_;  // of each prim
  std::map<std::string_view, std::size_t> types_;
  std::array<std::size_t, kLeftOutWords.size()> leftOut_{};
  std::size_t valuesLeft_ = 0;
  std::vector<Unread> unread_;                     // prims of curves, by what is wrong with them
  std::size_t unreadCount_ = 0;                    // of all of these
  std::map<std::uint32_t, std::string> unplaced_;  // what is wrong with a prim's transforms
  Found empty_, begunEmpty_, deformed_;            // prims of curves
  Found tooShort_;                                 // curves
  Unread notFinite_;                               // curves
  Unread valueless_;                               // transforms, of which the sentence is the first's name
  std::size_t curves_ = 0, cubic_ = 0, loose_ = 0;
  bool guides_ = false, others_ = false, moves_ = false;
  double firstTime_ = 0;
  std::vector<Vec3d> points_, particles_;  // of a strand
};

}  // namespace

Result<LoadedGroom> groomOfUsd(const UsdLayer& layer, const GroomReading& reading, const std::string& name) {
  return UsdGroomMaker(layer, reading, name).make();
}

}  // namespace ringlet
