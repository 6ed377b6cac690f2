// Implements groom/usd/usd_groom.h.
#include "ringlet/groom/usd/usd_groom.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "ringlet/base/quoted.h"
#include "ringlet/groom/curve_strands.h"
#include "ringlet/groom/usd/usd_transform.h"

namespace ringlet {
namespace {

constexpr const char* kFlatten = "flatten the file first, as `usdcat --flatten` does";
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

class UsdGroomMaker {
 public:
  UsdGroomMaker(const UsdLayer& layer, const GroomReading& reading, const std::string& name)
      : layer_(layer),
        reading_(reading),
        name_(name),
        strands_(name, "BasisCurves prim", layer.byteCount,
                 [this](std::uint32_t prim) { return pathOf(prim); }) {}

  Result<LoadedGroom> make() {
    strands_.loaded().hasUsdPrims = true;
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
    if (strands_.loaded().groom.strandCount() == 0) return strands_.noStrand(curves_);
    warn();
    return std::move(strands_.loaded());
  }

  std::vector<double> times() {
    findCurves();
    std::vector<double> codes;
    for (std::uint32_t p = 0; p < layer_.prims.size(); ++p) {
      if (!inherited_[p].hasStrands) continue;
      for (const UsdAttribute& attribute : layer_.prims[p].attributes) {
        if (!attribute.isSampled || !goesBetweenUsdSamples(attribute.name)) continue;
        for (const UsdSample& sample : attribute.samples) codes.push_back(sample.time);
        for (const UsdSamplePlace& place : attribute.places) codes.push_back(place.time);
      }
    }
    return codes;
  }

 private:
  bool isCurves(std::uint32_t prim) const { return layer_.prims[prim].type == "BasisCurves"; }

  std::string pathOf(std::uint32_t prim) const { return usdPathOf(layer_, prim); }
  Error wrong(std::uint32_t prim, const std::string& sentence) const {
    return Error{fmt::format("{}: {}: {}", name_, pathOf(prim), sentence)};
  }
  void warn(const std::string& sentence) { strands_.warn(sentence); }

  Status readUnitAndAxis() {
    if (layer_.metresPerUnit) strands_.takeUnit(*layer_.metresPerUnit);
    transforms_.emplace_back();
    if (layer_.upAxis.empty()) return {};
    if (layer_.upAxis != "Y" && layer_.upAxis != "Z")
      return Error{fmt::format("{}: found up axis {}; expected Y or Z", name_, quoted(layer_.upAxis))};
    transforms_[0] = strands_.takeUp(layer_.upAxis == "Z", reading_.upIsZ);
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
      if (valueless_.count == 0) firstValueless_ = op;
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

  Result<CurveForm> formOf(std::uint32_t index) const {
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
    CurveForm form{.isCubic = type == "cubic", .isPinned = wrap == "pinned"};
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

  Result<ObjectCurves> curvesOf(std::uint32_t index) const {
    ObjectCurves curves{.object = index};
    const UsdAttribute* points = usdAttributeOf(layer_.prims[index], "points");
    const UsdAttribute* counts = usdAttributeOf(layer_.prims[index], "curveVertexCounts");
    if (points && !points->value.numbers.empty() && points->value.width != 3)
      return Error{fmt::format("its points have {} numbers each; expected 3", points->value.width)};
    if (counts && !counts->value.numbers.empty() && counts->value.width != 1)
      return Error{"found tuples as curveVertexCounts; expected whole numbers"};
    if (points) curves.numbers = points->value.numbers;
    if (counts) curves.counts = counts->value.numbers;
    const bool hasPoints = points && points->value.width == 3;
    if (Status fits = curves.fitCounts(hasPoints ? reading_.pointsPerStrand : 0, "curveVertexCounts"); !fits)
      return fits.error();
    return curves;
  }

  // Fails only where the groom becomes too large: what is wrong with one prim leaves it out.
  Status readCurves(std::uint32_t index) {
    if (const std::uint32_t above = inherited_[index].unplaced; above != kNoUsdPrim) {
      strands_.leaveOut(above, unplaced_[above]);
      return {};
    }
    const auto form = formOf(index);
    if (!form) {
      strands_.leaveOut(index, form.error().message);
      return {};
    }
    const auto curves = curvesOf(index);
    if (!curves) {
      strands_.leaveOut(index, curves.error().message);
      return {};
    }
    if (curves->numbers.empty()) {
      strands_.leaveOutEmpty(index);
      return {};
    }
    if (usdAttributeOf(layer_.prims[index], "points")->emptyTime) begunEmpty_.add(index);
    if (inherited_[index].deformed != kNoUsdPrim) deformed_.add(index);
    const UsdTransform& transform = transforms_[inherited_[index].transform];
    LoadedGroom& loaded = strands_.loaded();
    const auto firstStrand = static_cast<std::uint32_t>(loaded.groom.strandCount());
    const auto kept = strands_.add(*curves, *form, transform);
    if (!kept) return kept.error();
    if (!reading_.keepsPrims) return {};
    loaded.prims.push_back({.path = exactPathOf(index),
                            .firstStrand = firstStrand,
                            .strandCount = static_cast<std::uint32_t>(kept->size()),
                            .toGroom = transform,
                            .isWhole = !form->isCubic && kept->size() == curves->counts.size(),
                            .values = {}});
    keepValues(layer_.prims[index], *curves, *kept, loaded.prims.back());
    return {};
  }

  // Names as they are, for files; those of messages are usdPathOf's.
  std::string exactPathOf(std::uint32_t prim) const {
    std::string path;
    for (; prim != kNoUsdPrim; prim = layer_.prims[prim].parent)
      path = "/" + std::string(layer_.prims[prim].name) + path;
    return path;
  }

  // What is said of a prim's curves and fits them.
  void keepValues(const UsdPrim& prim, const ObjectCurves& curves, const std::vector<std::size_t>& kept,
                  GroomPrim& into) {
    for (const UsdAttribute& attribute : prim.attributes) {
      if (!isUsdValue(attribute.name)) continue;
      std::string_view per = attribute.interpolation;
      if (per.empty())
        per = attribute.name == "widths" ? "vertex" : attribute.name == "ids" ? "uniform" : "constant";
      const UsdValue& value = attribute.value;
      if (value.isBlocked || attribute.isSampled || !attribute.drivenBy.empty()) {
        strands_.leaveValue();
        continue;
      }
      const bool isIndexed = usdAttributeOf(prim, std::string(attribute.name) + ":indices") != nullptr;
      strands_.keepValue({std::string(attribute.name),
                          std::string(attribute.type),
                          std::string(attribute.interpolation),
                          value.numbers,
                          {value.texts.begin(), value.texts.end()}},
                         per, value.width, isIndexed, curves, kept, into);
    }
  }

  // --- What a person should hear.

  void warn() {
    if (const std::string leftOut = leftOutFound(); !leftOut.empty())
      warn(fmt::format("left out BasisCurves that are not drawn: {}", leftOut));
    strands_.warnOfUnread();
    if (deformed_.count > 0) {
      const std::uint32_t first = deformed_.first;
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
    strands_.warnOfShort();
    strands_.warnOfCubic(", as bspline and catmullRom do unless wrap is 'pinned'");
    strands_.warnOfValues();
    if (begunEmpty_.count > 0) {
      const UsdAttribute& points = *usdAttributeOf(layer_.prims[begunEmpty_.first], "points");
      warn(fmt::format("{} without points at first, {} at time {}; read as at the first time with points, {}",
                       begunEmpty_.count == 1 ? "1 BasisCurves prim is"
                                              : fmt::format("{} BasisCurves prims are", begunEmpty_.count),
                       pathOf(begunEmpty_.first), *points.emptyTime, *points.time));
    }
    if (valueless_.count > 0) {
      warn(fmt::format(
          "left aside {} without a value, which `xformOpOrder` names, as USD does; the first is {} of {}",
          countedNoun(valueless_.count, "transform"), firstValueless_, pathOf(valueless_.first)));
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
                       elsewhere > 1 ? fmt::format(", as {} in all", countedNoun(elsewhere, "prim")) : ""));
    }
    for (const std::string_view type : {"HermiteCurves", "NurbsCurves"}) {
      if (types_.count(type))
        warn(fmt::format("{} {} left aside; only BasisCurves are read", types_[type], type));
    }
  }

  const UsdLayer& layer_;
  const GroomReading& reading_;
  const std::string& name_;
  CurveStrands strands_;
  std::vector<UsdTransform> transforms_;
  std::vector<Inherited> inherited_;  // of each prim
  std::map<std::string_view, std::size_t> types_;
  std::array<std::size_t, kLeftOutWords.size()> leftOut_{};
  std::map<std::uint32_t, std::string> unplaced_;  // what is wrong with a prim's transforms
  FoundObjects begunEmpty_, deformed_;             // prims of curves
  FoundObjects valueless_;                         // transforms
  std::string firstValueless_;
  std::size_t curves_ = 0;
  bool guides_ = false, others_ = false, moves_ = false;
  double firstTime_ = 0;
};

}  // namespace

Result<LoadedGroom> groomOfUsd(const UsdLayer& layer, const GroomReading& reading, const std::string& name) {
  return UsdGroomMaker(layer, reading, name).make();
}

std::vector<double> usdGroomTimes(const UsdLayer& layer, const std::string& name) {
  return UsdGroomMaker(layer, {}, name).times();
}

}  // namespace ringlet
