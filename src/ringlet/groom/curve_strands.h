// CurveStrands: curves of a file's objects (prims of USD, objects of Alembic), linear or cubic, made into the
// strands of one groom; what is said of them beside their points; and what had to be left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/cubic_curve.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/groom/usd/usd_matrix.h"

namespace ringlet {

/// How an object's curves are to be understood.
struct CurveForm {
  bool isCubic = true, isPinned = false;
  CubicBasis basis = CubicBasis::bezier;
};

/// How many there are of a kind, and which object has the first.
struct FoundObjects {
  std::size_t count = 0;
  std::uint32_t first = std::numeric_limits<std::uint32_t>::max();

  void add(std::uint32_t object) {
    if (count++ == 0) first = object;
  }
};

/// "1 curve", "2 curves".
std::string countedNoun(std::size_t count, std::string_view noun);

/// An object's points and how many of them each of its curves has.
struct ObjectCurves {
  std::uint32_t object = 0;
  std::span<const double> numbers{};  // 3 a point: a view
  std::vector<double> counts{};       // a curve; as the file has them

  std::size_t pointCount() const { return numbers.size() / 3; }
  /// Where the file has no counts and all strands are said to have as many points, they are filled in. Error:
  /// counts that are no numbers of points, or add up to another one than there are. `countsName` is the
  /// file's word for them.
  Status fitCounts(std::uint32_t pointsPerStrand, std::string_view countsName);
};

class CurveStrands {
 public:
  using PathOf = std::function<std::string(std::uint32_t object)>;

  /// `name` and `byteCount` are the file's; `noun` is what an object with curves is called, "BasisCurves
  /// prim"; `pathOf` is asked for messages.
  CurveStrands(std::string name, std::string noun, std::size_t byteCount, PathOf pathOf);

  /// What was read so far; warnings are added to it.
  LoadedGroom& loaded() { return loaded_; }
  void warn(const std::string& sentence);

  /// The file states its unit [m]; one that no hair has is left aside, with a warning.
  void takeUnit(double metresPerUnit);
  /// The file states its up axis. What comes back turns its points to the one that is wanted, of which a
  /// warning tells where that is another.
  UsdTransform takeUp(bool isZ, bool wantsZ);

  /// Curves, whose counts fit, become strands where the transform puts them. What comes back are those that
  /// did: curves of too few points, or with one that is not finite, are left out and counted. Error: the
  /// groom becomes larger than the file's size allows. Cost: linear in points and particles.
  Result<std::vector<std::size_t>> add(const ObjectCurves& curves, const CurveForm& form,
                                       const UsdTransform& transform);
  /// An object that cannot be read, with what is wrong at `object` or above it.
  void leaveOut(std::uint32_t object, const std::string& sentence);
  void leaveOutEmpty(std::uint32_t object) { empty_.add(object); }

  /// A value of elements of `width` numbers (or of texts), `per` constant, uniform, vertex or varying. It is
  /// kept where it fits the strands, else counted as left aside: where not all curves are strands, or points
  /// particles, only what is said of all or of each curve still fits. `isIndexed`: indices stand beside it.
  void keepValue(const GroomValue& value, std::string_view per, std::size_t width, bool isIndexed,
                 const ObjectCurves& curves, const std::vector<std::size_t>& kept, GroomPrim& prim);
  void leaveValue() { ++valuesLeft_; }

  /// Why there is no strand. `objectCount`: objects with curves.
  Error noStrand(std::size_t objectCount) const;
  /// Of objects and curves that were left out, of curves of too few points, of cubic ones, and of values.
  void warnOfUnread();
  void warnOfShort();
  /// `because`: why curves end short of their points: ", as bspline and catmullRom do".
  void warnOfCubic(std::string_view because);
  void warnOfValues();

 private:
  struct Unread : FoundObjects {
    std::string sentence;  // of the first
  };
  Status addStrand(std::uint32_t object, std::size_t curve, std::span<const double> numbers,
                   const CurveForm& form, const UsdTransform& transform);
  void noteNoPlace(std::uint32_t object, std::size_t curve, std::size_t point, Vec3d p);
  Error wrong(std::uint32_t object, const std::string& sentence) const;

  std::string name_, noun_;
  std::size_t byteCount_ = 0;
  PathOf pathOf_;
  LoadedGroom loaded_{};
  std::vector<Unread> unread_{};  // objects, by what is wrong with them
  std::size_t unreadCount_ = 0;   // of all of these
  FoundObjects empty_{};          // objects
  FoundObjects tooShort_{};       // curves
  Unread notFinite_{};            // curves
  std::size_t cubic_ = 0, loose_ = 0, valuesLeft_ = 0;
  std::vector<Vec3d> points_{}, particles_{};  // of a strand
};

}  // namespace ringlet
