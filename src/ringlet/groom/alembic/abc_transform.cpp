// Implements groom/alembic/abc_transform.h.
#include "ringlet/groom/alembic/abc_transform.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

namespace ringlet {
namespace {

constexpr std::string_view kXformSchema = "AbcGeom_Xform_v3", kXformCompound = ".xform";
constexpr std::size_t kMostOps = 1024;  // of all objects above one; programs write less than 20 each

UsdTransform abcTurn(Vec3d axis, double degrees) {
  const double size = length(axis);
  if (!(size > 0)) return {};
  return rigidTransform(fromRotationVector(axis * (degrees * std::numbers::pi / 180 / size)), {});
}

}  // namespace

std::size_t AbcTransforms::widthOf(Op op) {
  constexpr std::array<std::size_t, 7> kWidths{3, 3, 4, 16, 1, 1, 1};
  return kWidths[static_cast<std::size_t>(op)];
}

// Points are rows, as in USD.
UsdTransform AbcTransforms::transformOf(Op op, const double* n) {
  switch (op) {
    case Op::scale:
      return {{Vec3d{n[0], 0, 0}, Vec3d{0, n[1], 0}, Vec3d{0, 0, n[2]}}, {}};
    case Op::translate:
      return {UsdTransform{}.rows, {n[0], n[1], n[2]}};
    case Op::turn:
      return abcTurn({n[0], n[1], n[2]}, n[3]);
    case Op::matrix:
      return {{Vec3d{n[0], n[1], n[2]}, Vec3d{n[4], n[5], n[6]}, Vec3d{n[8], n[9], n[10]}},
              {n[12], n[13], n[14]}};
    case Op::turnX:
      return abcTurn({1, 0, 0}, n[0]);
    case Op::turnY:
      return abcTurn({0, 1, 0}, n[0]);
    case Op::turnZ:
      return abcTurn({0, 0, 1}, n[0]);
  }
  return {};
}

// One object's, and how much all of them may take.
class AbcTransforms::Reader {
 public:
  explicit Reader(const AbcArchive& archive)
      : archive_(archive), knotsLeft_(archive.byteCount() / 8), numbersLeft_(archive.mostNumbers()) {}

  Result<Xform> read(std::uint32_t object) {
    object_ = object;
    Xform xform;
    const auto all = archive_.propertiesOf(object);
    if (!all) return all.error();
    const AbcProperty* compound = abcPropertyNamed(*all, kXformCompound);
    if (!compound) return xform;
    const auto own = archive_.propertiesOf(*compound);
    if (!own) return own.error();
    if (const AbcProperty* inherits = abcPropertyNamed(*own, ".inherits")) {
      if (Status read = readTrack(*inherits, 1, xform.inherits); !read) return read.error();
    }
    const AbcProperty* ops = abcPropertyNamed(*own, ".ops");
    if (!ops || ops->sampleCount == 0) return xform;
    if (Status read = readOps(*ops, xform.ops); !read) return read.error();
    if (xform.ops.empty()) return xform;
    const AbcProperty* values = abcPropertyNamed(*own, ".vals");
    if (!values) return wrong("has .ops without .vals");
    std::size_t width = 0;
    for (const Op op : xform.ops) width += widthOf(op);
    if (Status read = readTrack(*values, width, xform.values); !read) return read.error();
    if (Status checked = checkMatrices(xform); !checked) return checked.error();
    return xform;
  }

 private:
  Error wrong(const std::string& sentence) const { return archive_.wrong(object_, sentence); }

  Status readOps(const AbcProperty& property, std::vector<Op>& ops) {
    if (property.isChanging()) return wrong("its .ops change over time, which is not followed");
    const auto sample = archive_.stored(property, 0);
    if (!sample) return sample.error();
    if (sample->numberCount() > opsLeft_)
      return wrong(fmt::format("found {} operations and others above; expected at most {} together",
                               sample->numberCount(), kMostOps));
    opsLeft_ -= sample->numberCount();
    for (std::size_t k = 0; k < sample->numberCount(); ++k) {
      const double code = sample->number(k);
      const double kind = std::floor(code / 16);  // below that: a hint for whoever shows it
      if (!(kind >= 0 && kind <= 6)) return wrong(fmt::format("found operation {}; expected 0 to 111", code));
      ops.push_back(static_cast<Op>(kind));
    }
    return {};
  }

  Status readTrack(const AbcProperty& property, std::size_t width, Track& track) {
    const auto knots = archive_.knotsOf(property);
    if (!knots) return knots.error();
    if (knots->size() > knotsLeft_ || knots->size() * width > numbersLeft_)
      return wrong(fmt::format("found {} samples of {}, more than a file of {} bytes has room for",
                               knots->size(), property.path(), archive_.byteCount()));
    knotsLeft_ -= knots->size();
    numbersLeft_ -= knots->size() * width;
    track.width = width;
    for (const AbcKnot& knot : *knots) {
      const auto sample = archive_.stored(property, knot.stored);
      if (!sample) return sample.error();
      if (sample->numberCount() != width)
        return wrong(fmt::format("found {} numbers in sample {} of {}; expected {}", sample->numberCount(),
                                 knot.sample + 1, property.path(), width));
      track.seconds.push_back(knot.seconds);
      for (std::size_t k = 0; k < width; ++k) {
        track.numbers.push_back(sample->number(k));
        if (!std::isfinite(track.numbers.back()))
          return wrong(fmt::format("found a number in sample {} of {} that is not finite", knot.sample + 1,
                                   property.path()));
      }
    }
    return {};
  }

  Status checkMatrices(const Xform& xform) const {
    const Track& values = xform.values;
    for (std::size_t from = 0; from < values.numbers.size(); from += values.width) {
      const double* n = values.numbers.data() + from;
      for (const Op op : xform.ops) {
        if (op == Op::matrix && (n[3] != 0 || n[7] != 0 || n[11] != 0 || n[15] != 1))
          return wrong("found a matrix whose last column is not 0, 0, 0, 1; expected an affine one");
        n += widthOf(op);
      }
    }
    return {};
  }

  const AbcArchive& archive_;
  std::uint32_t object_ = 0;
  std::size_t opsLeft_ = kMostOps, knotsLeft_ = 0, numbersLeft_ = 0;
};

Result<AbcTransforms> AbcTransforms::of(const AbcArchive& archive, std::uint32_t object) {
  AbcTransforms transforms;
  Reader reader(archive);
  const std::vector<AbcObject>& objects = archive.objects();
  for (std::uint32_t above = objects[object].parent; above != 0; above = objects[above].parent) {
    if (abcValueOf(objects[above].metadata, "schema") != kXformSchema) continue;
    auto xform = reader.read(above);
    if (!xform) return xform.error();
    transforms.xforms_.push_back(std::move(*xform));
  }
  return transforms;
}

std::vector<double> AbcTransforms::seconds() const {
  std::vector<double> all;
  for (const Xform& xform : xforms_) {
    for (const Track* track : {&xform.values, &xform.inherits})
      if (track->seconds.size() > 1) all.insert(all.end(), track->seconds.begin(), track->seconds.end());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<double> AbcTransforms::Track::at(double t) const {
  const auto after = std::ranges::upper_bound(seconds, t) - seconds.begin();
  const auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after, 1) - 1);
  const double* before = numbers.data() + k * width;
  std::vector<double> mixed(before, before + width);
  if (after == 0 || k + 1 == seconds.size()) return mixed;
  const double share = (t - seconds[k]) / (seconds[k + 1] - seconds[k]);
  for (std::size_t n = 0; n < width; ++n) mixed[n] += (before[width + n] - before[n]) * share;
  return mixed;
}

UsdTransform AbcTransforms::at(double seconds) const {
  UsdTransform all;
  for (const Xform& xform : xforms_) {
    if (!xform.ops.empty()) {
      const std::vector<double> values = xform.values.at(seconds);
      const double* numbers = values.data();
      UsdTransform own;  // the last operation acts first
      for (const Op op : xform.ops) {
        own = transformOf(op, numbers).then(own);
        numbers += widthOf(op);
      }
      all = all.then(own);
    }
    if (!xform.inherits.seconds.empty() && xform.inherits.at(seconds)[0] < 1) break;
  }
  return all;
}

}  // namespace ringlet
