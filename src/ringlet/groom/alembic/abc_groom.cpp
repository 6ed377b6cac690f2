// Implements groom/alembic/abc_groom.h.
#include "ringlet/groom/alembic/abc_groom.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ringlet/base/quoted.h"
#include "ringlet/groom/alembic/abc_archive.h"
#include "ringlet/groom/alembic/abc_curves.h"
#include "ringlet/groom/alembic/abc_hair.h"
#include "ringlet/groom/alembic/abc_params.h"
#include "ringlet/groom/alembic/abc_transform.h"
#include "ringlet/groom/curve_strands.h"

namespace ringlet {
namespace {

constexpr std::string_view kCurveSchema = "AbcGeom_Curve_v2";
constexpr std::size_t kMostAbcKinds = 6;  // that are named
constexpr double kHidden = 0, kVisible = 1;
constexpr const char* kExportCurves =
    "export the hair as curves, as splines or guides are written, and not as a mesh or as points";

// What objects of a schema are called; empty: one that says nothing of what is drawn.
struct AbcKindName {
  std::string_view schema, one, many;
};
constexpr AbcKindName kKindNames[] = {{"AbcGeom_PolyMesh_v1", "mesh", "meshes"},
                                      {"AbcGeom_SubD_v1", "subdivision surface", "subdivision surfaces"},
                                      {"AbcGeom_Points_v1", "point cloud", "point clouds"},
                                      {"AbcGeom_NuPatch_v2", "NURBS patch", "NURBS patches"},
                                      {"AbcGeom_Xform_v3", "transform", "transforms"},
                                      {"AbcGeom_Camera_v1", "camera", "cameras"},
                                      {"AbcGeom_Light_v1", "light", "lights"},
                                      {"AbcGeom_FaceSet_v1", "face set", "face sets"}};

std::string countedKind(std::size_t count, std::string_view schema) {
  const auto* known = std::ranges::find(kKindNames, schema, &AbcKindName::schema);
  if (known == std::end(kKindNames))
    return countedNoun(count, schema.empty() ? "object without a schema" : "object of " + quoted(schema));
  return fmt::format("{} {}", count, count == 1 ? known->one : known->many);
}

class AbcGroomMaker {
 public:
  AbcGroomMaker(const AbcArchive& archive, const GroomReading& reading, std::optional<double> seconds)
      : archive_(archive),
        reading_(reading),
        seconds_(seconds),
        budget_(archive),
        strands_(archive.name(), "curves object", archive.byteCount(),
                 [&archive](std::uint32_t object) { return archive.pathOf(object); }) {}

  Result<LoadedGroom> make() {
    if (Status looked = lookAtObjects(); !looked) return looked.error();
    readUnitAndAxis();
    std::size_t curvesCount = 0;
    for (const std::uint32_t object : inFileOrder()) {
      if (objects_[object].schema != kCurveSchema || !isDrawn(object)) continue;
      ++curvesCount;
      if (Status read = readObject(object); !read) return read.error();
    }
    if (curvesCount == 0) return nothingFound();
    if (strands_.loaded().groom.strandCount() == 0) return strands_.noStrand(curvesCount);
    warn();
    return std::move(strands_.loaded());
  }

  Result<std::vector<double>> times() {
    if (Status looked = lookAtObjects(); !looked) return looked.error();
    std::vector<double> all;
    for (std::uint32_t object = 0; object < objects_.size(); ++object) {
      if (objects_[object].schema != kCurveSchema || !isDrawn(object)) continue;
      for (const double seconds : timesOf(object)) all.push_back(seconds);
      if (!budget_.state()) return budget_.state().error();
    }
    return all;
  }

 private:
  struct Object {
    std::string_view schema{};
    std::size_t chain = 0;  // properties of it and of those above it
    bool isHidden = false;
  };

  // Of an archive that Ringlet wrote.
  void readUnitAndAxis() {
    if (const auto unit = abcNumberOf(archive_.metadata(), kAbcUnit)) strands_.takeUnit(*unit);
    const std::string_view up = abcValueOf(archive_.metadata(), kAbcUp);
    if (up == "Y" || up == "Z") turn_ = strands_.takeUp(up == "Z", reading_.upIsZ);
  }

  // Parents come first.
  Status lookAtObjects() {
    const std::vector<AbcObject>& all = archive_.objects();
    objects_.resize(all.size());
    for (std::uint32_t k = 0; k < all.size(); ++k) {
      const auto properties = archive_.propertiesOf(k);
      if (!properties) return properties.error();
      if (!budget_.take(1 + properties->size())) return budget_.state();
      Object& own = objects_[k];
      own.schema = abcValueOf(all[k].metadata, "schema");
      own.chain = properties->size() + 1;
      if (k > 0) {
        const Object& above = objects_[all[k].parent];
        own.chain += above.chain;
        own.isHidden = above.isHidden;
        ++kinds_[own.schema];
      }
      if (const auto visible = visibilityOf(*properties)) own.isHidden = *visible == kHidden;
      instances_ += abcPropertyNamed(*properties, ".instanceSource") != nullptr;
      hiddenCurves_ += own.isHidden && own.schema == kCurveSchema;
    }
    return {};
  }

  // At first; nothing where what is above decides.
  std::optional<double> visibilityOf(const std::vector<AbcProperty>& properties) const {
    const AbcProperty* visible = abcPropertyNamed(properties, "visible");
    if (!visible || visible->kind == AbcKind::compound || visible->sampleCount == 0) return std::nullopt;
    const auto sample = archive_.stored(*visible, 0);
    if (!sample || sample->numberCount() == 0) return std::nullopt;
    const double number = sample->number(0);
    return number == kHidden || number == kVisible ? std::optional(number) : std::nullopt;
  }
  bool isDrawn(std::uint32_t object) const { return !objects_[object].isHidden; }

  // Depth first; the archive has them level by level.
  std::vector<std::uint32_t> inFileOrder() const {
    const std::vector<AbcObject>& all = archive_.objects();
    constexpr std::uint32_t kNone = 0;  // the top object is nobody's child
    std::vector<std::uint32_t> firstChild(all.size(), kNone), next(all.size(), kNone), order, open{0};
    for (auto k = static_cast<std::uint32_t>(all.size() - 1); k > 0; --k) {
      next[k] = firstChild[all[k].parent];
      firstChild[all[k].parent] = k;
    }
    order.reserve(all.size());
    while (!open.empty()) {
      const std::uint32_t object = open.back();
      open.pop_back();
      order.push_back(object);
      if (object != 0 && next[object] != kNone) open.push_back(next[object]);
      if (firstChild[object] != kNone) open.push_back(firstChild[object]);
    }
    return order;
  }

  // What is wrong with an object, without the file's name and its own path.
  std::string sentenceOf(std::uint32_t object, const Error& error) const {
    std::string_view text = error.message;
    for (const std::string& start : {archive_.name() + ": ", archive_.pathOf(object) + ": "})
      if (text.starts_with(start)) text.remove_prefix(start.size());
    return std::string(text);
  }
  // It is left out, unless it is the budget's.
  Status leaveOut(std::uint32_t object, const Error& error) {
    if (budget_.state()) strands_.leaveOut(object, sentenceOf(object, error));
    return budget_.state();
  }

  Result<std::vector<AbcProperty>> geometryOf(std::uint32_t object) {
    const auto all = archive_.propertiesOf(object);
    if (!all) return all.error();
    const AbcProperty* compound = abcPropertyNamed(*all, ".geom");
    if (!compound) return Error{"has no .geom"};
    auto own = archive_.propertiesOf(*compound);
    if (!own) {
      budget_.fail(own.error());
    } else if (!budget_.take(own->size())) {
      return budget_.state().error();
    }
    return own;
  }

  Result<UsdTransform> placeOf(std::uint32_t object, std::optional<double> seconds) {
    if (!budget_.take(objects_[object].chain)) return budget_.state().error();
    const auto transforms = AbcTransforms::of(archive_, object);
    if (!transforms) return transforms.error();
    const std::vector<double> times = transforms->seconds();
    if (!budget_.take(times.size())) return budget_.state().error();
    if (!seconds && !times.empty()) seconds = times.front();
    if (seconds) noteMoves(*seconds);
    const UsdTransform place = transforms->at(seconds.value_or(0));
    return strands_.loaded().isTurned ? place.then(turn_) : place;
  }
  void noteMoves(double seconds) { firstTime_ = firstTime_ ? std::min(*firstTime_, seconds) : seconds; }

  // Of what moves; what cannot be read has none.
  std::vector<double> timesOf(std::uint32_t object) {
    std::vector<double> all;
    const auto properties = geometryOf(object);
    const AbcProperty* points = properties ? abcPropertyNamed(*properties, "P") : nullptr;
    if (points && points->kind != AbcKind::compound && points->isChanging()) {
      const auto knots = archive_.knotsOf(*points);
      if (knots && budget_.take(knots->size()))
        for (const AbcKnot& knot : *knots) all.push_back(knot.seconds);
    }
    if (!budget_.take(objects_[object].chain)) return all;
    const auto transforms = AbcTransforms::of(archive_, object);
    if (!transforms) return all;
    const std::vector<double> moves = transforms->seconds();
    if (budget_.take(moves.size())) all.insert(all.end(), moves.begin(), moves.end());
    return all;
  }

  // Fails only where the groom becomes too large or the file's structure is broken.
  Status readObject(std::uint32_t object) {
    const auto properties = geometryOf(object);
    if (!properties) return leaveOut(object, properties.error());
    const auto made =
        readAbcCurves(archive_, object, *properties,
                      {.pointsPerStrand = reading_.pointsPerStrand, .seconds = seconds_}, budget_);
    if (!made) return leaveOut(object, made.error());
    if (made->numbers.empty()) {
      strands_.leaveOutEmpty(object);
      return {};
    }
    const auto place = placeOf(object, seconds_ ? seconds_ : made->seconds);
    if (!place) return leaveOut(object, place.error());
    if (made->emptySeconds) {
      if (begunEmpty_.count == 0) emptyTimes_ = {*made->emptySeconds, *made->seconds};
      begunEmpty_.add(object);
    }
    if (made->hasOtherKnots) otherKnots_.add(object);
    LoadedGroom& loaded = strands_.loaded();
    const auto firstStrand = static_cast<std::uint32_t>(loaded.groom.strandCount());
    const auto kept = strands_.add(made->curves, made->form, *place);
    if (!kept) return kept.error();
    if (!reading_.keepsPrims) return {};
    std::string path = archive_.pathOf(object);
    if (!budget_.take(path.size())) return budget_.state();
    loaded.prims.push_back({.path = std::move(path),
                            .firstStrand = firstStrand,
                            .strandCount = static_cast<std::uint32_t>(kept->size()),
                            .toGroom = *place,
                            .isWhole = !made->form.isCubic && kept->size() == made->curves.counts.size(),
                            .values = {}});
    return keepParams(*properties, *made, *kept, loaded.prims.back());
  }

  Status keepParams(const std::vector<AbcProperty>& properties, const AbcCurves& made,
                    const std::vector<std::size_t>& kept, GroomPrim& prim) {
    std::vector<AbcProperty> params;
    for (const std::string_view name : {"width", "uv", "N", ".velocities"})
      if (const AbcProperty* found = abcPropertyNamed(properties, name)) params.push_back(*found);
    const AbcProperty* others = abcPropertyNamed(properties, ".arbGeomParams");
    if (others && others->kind == AbcKind::compound) {
      const auto own = archive_.propertiesOf(*others);
      if (!own) return own.error();
      if (!budget_.take(own->size())) return budget_.state();
      params.insert(params.end(), own->begin(), own->end());
    }
    std::set<std::string> names;  // of two with one name the first counts
    for (const AbcProperty& param : params) {
      auto read = readAbcParam(archive_, param, budget_);
      if (!budget_.state()) return budget_.state();
      if (read && names.insert(read->value.name).second) {
        keepParam(std::move(*read), made, kept, prim);
      } else {
        strands_.leaveValue();
      }
    }
    return {};
  }

  // Where no scope is stated, the size tells it.
  void keepParam(AbcParam param, const AbcCurves& made, const std::vector<std::size_t>& kept,
                 GroomPrim& prim) {
    if (param.value.name == "widths" && (param.width > 1 || !param.value.texts.empty())) {
      strands_.leaveValue();
      return;
    }
    std::string& per = param.value.interpolation;
    if (per.empty())
      per = param.size() == 1 ? "constant" : param.size() == made.curves.counts.size() ? "uniform" : "vertex";
    strands_.keepValue(param.value, per, param.width, false, made.curves, kept, prim);
  }

  // "1 mesh, 2 transforms".
  std::string kindsFound() const {
    std::vector<std::pair<std::size_t, std::string_view>> found;
    for (const auto& [schema, count] : kinds_) found.push_back({count, schema});
    std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string text;
    for (std::size_t i = 0; i < std::min(found.size(), kMostAbcKinds); ++i)
      text += (i > 0 ? ", " : "") + countedKind(found[i].first, found[i].second);
    return found.size() > kMostAbcKinds ? text + " and others" : text;
  }
  Error nothingFound() const {
    if (hiddenCurves_ > 0)
      return Error{fmt::format("{}: its {} hidden; expected some that are drawn", archive_.name(),
                               hiddenCurves_ == 1 ? "only curves object is"
                                                  : fmt::format("{} curves objects are all", hiddenCurves_))};
    if (kinds_.empty()) return Error{fmt::format("{}: holds no objects; expected curves", archive_.name())};
    return Error{fmt::format("{}: holds no curves, of which strands are made; it holds {}: {}",
                             archive_.name(), kindsFound(), kExportCurves)};
  }

  void warn() {
    if (hiddenCurves_ > 0)
      strands_.warn(fmt::format("left out curves that are not drawn: {} hidden", hiddenCurves_));
    strands_.warnOfUnread();
    strands_.warnOfShort();
    strands_.warnOfCubic(
        ", as B-splines without knots and Catmull-Rom curves do; where the points are the hair's, export linear "
        "curves");
    if (otherKnots_.count > 0)
      strands_.warn(
          fmt::format("{}, the first {}, with knots that do not fit; read as B-splines of even knots",
                      countedNoun(otherKnots_.count, "curves object"), archive_.pathOf(otherKnots_.first)));
    strands_.warnOfValues();
    if (begunEmpty_.count > 0)
      strands_.warn(
          fmt::format("{} without points at first, {} at {} s; read as at the first time with points, {} s",
                      begunEmpty_.count == 1 ? "1 curves object is"
                                             : fmt::format("{} curves objects are", begunEmpty_.count),
                      archive_.pathOf(begunEmpty_.first), emptyTimes_.first, emptyTimes_.second));
    if (firstTime_ && !seconds_)
      strands_.warn(fmt::format("it moves; read as it is at its first sample, at {} s", *firstTime_));
    if (instances_ > 0)
      strands_.warn(fmt::format("{} left aside; only the curves themselves are read",
                                countedNoun(instances_, "instance")));
    for (const std::string_view schema : {"AbcGeom_NuPatch_v2", "AbcGeom_Points_v1"}) {
      const auto found = kinds_.find(schema);
      if (found != kinds_.end())
        strands_.warn(fmt::format("{} left aside; only curves are read", countedKind(found->second, schema)));
    }
  }

  const AbcArchive& archive_;
  const GroomReading& reading_;
  std::optional<double> seconds_;  // none: each object's first
  AbcBudget budget_;
  CurveStrands strands_;
  UsdTransform turn_{};  // of all points, to the axis that is wanted
  std::vector<Object> objects_{};
  std::map<std::string_view, std::size_t> kinds_{};  // objects by their schema
  std::size_t instances_ = 0, hiddenCurves_ = 0;
  FoundObjects begunEmpty_{}, otherKnots_{};
  std::pair<double, double> emptyTimes_{};  // of the first: without points, and with some
  std::optional<double> firstTime_{};       // of what moves [s]
};

}  // namespace

Result<LoadedGroom> readAbcGroom(std::span<const std::byte> bytes, const std::filesystem::path& path,
                                 const GroomReading& reading) {
  const auto archive = AbcArchive::of(bytes, path.string());
  if (!archive) return archive.error();
  return AbcGroomMaker(*archive, reading, std::nullopt).make();
}

Result<LoadedGroom> abcGroomAt(double seconds, const AbcArchive& archive, const GroomReading& reading) {
  return AbcGroomMaker(archive, reading, seconds).make();
}

Result<std::vector<double>> abcGroomTimes(const AbcArchive& archive) {
  return AbcGroomMaker(archive, {}, std::nullopt).times();
}

}  // namespace ringlet
