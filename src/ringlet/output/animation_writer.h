// AnimationWriter: an animation of strands on its way into a file, whatever its format; and the formats there
// are. Programs go through the table.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/groom/usd/usd_matrix.h"
#include "ringlet/output/cache_format.h"
#include "ringlet/output/up_axis.h"

namespace ringlet {

/// Frames come one by one into `PATH.partial`; finish() renames it to PATH, so a PATH that is there is
/// finished. A frame that fails (full disk) leaves the frames before it. Without finish() the partial file
/// stays if it holds a frame.
class AnimationWriter {
 public:
  virtual ~AnimationWriter() = default;
  /// Points in the world, in the file's unit, in groom order, finite (see finite_points.h). `head`: where the
  /// head is, rigid, in that unit; only files that keep its motion apart look at it.
  virtual Status addFrame(std::span<const Vec3f> points, const UsdTransform& head = {}) = 0;
  /// What was added is on the disk.
  virtual Status sync() = 0;
  /// Closes the file with the frames so far (at least one) and gives it its name.
  virtual Status finish() = 0;
  virtual int frameCount() const = 0;
  /// The farthest that a point of the file may be from the one that was added [m]; nothing: formats that
  /// keep every bit.
  virtual std::optional<double> errorBound() const { return std::nullopt; }

 protected:
  AnimationWriter() = default;
  AnimationWriter(AnimationWriter&&) = default;
};

/// Where the head's motion is.
enum class UsdHead {
  baked,      // in the points, which stand in the world
  transform,  // in a transform of the prim, which brings points that are seen from the head to the world
  none,       // nowhere: points are seen from the head, and something else carries the prim
};

/// The guides that a strand of a groom follows, strands of it too, and their shares, which add up to 1. A
/// guide follows itself.
struct ClosestGuides {
  std::array<std::uint32_t, 3> strands{};
  std::array<float, 3> shares{1, 0, 0};

  bool operator==(const ClosestGuides&) const = default;
};

/// What a USD or Alembic file may say beside points, widths and extents.
struct UsdExtras {
  std::optional<float> tipDiameter{};    // strands are evenly thinner from root to tip [file unit]
  std::vector<float> widthFactors{};     // of each strand, on both diameters; empty: all 1
  bool ids = false;                      // int[] primvars:id, a number a strand, from 0
  bool rest = false;                     // point3f[] primvars:rest, the topology's own points
  bool velocities = false;               // vector3f[] [file unit/s], not in text: see usdc_writer.h
  bool unreal = false;                   // what Unreal's importer of grooms reads (usd_unreal.h)
  std::vector<std::uint32_t> groupOf{};  // each strand's, for Unreal: a number of groupNames; empty: none
  std::vector<std::string> groupNames{};
  std::vector<ClosestGuides> closestGuides{};  // of each strand, for Unreal; empty: unknown
  UsdHead head = UsdHead::baked;
  int firstTimeCode = 1;  // of the first frame
  int clipFrames = 0;     // above 0: .usda has value clips of so many frames (usd_clips_writer.h)
  // The groom's file, where it is USD; it is looked at while the writer is made.
  const LoadedGroom* origin = nullptr;
  bool originValues = false;  // what that says of its curves beside their points
  bool originPrims = false;   // crates only: the prims are changes of the origin's, in their own places
};

struct AnimationOptions {
  double framesPerSecond = 24;
  double metresPerUnit = 0.01;  // unit of points and diameter
  UpAxis up = UpAxis::y;
  float diameter = 0.05f;  // of every strand [file unit]; 0: unknown, as of grooms
  int frameCount = 1;      // most frames that will come; fewer may
  CachePrecision precision = CachePrecision::float32;  // of formats that have several
  UsdExtras usd{};                                     // of USD and Alembic files
};

/// A row of the table of formats, of which options, keys of scene files, help and messages are made.
struct AnimationFormat {
  const char* extension;       // with its dot
  const char* note = "";       // for help, in brackets behind the extension
  bool hasPrecisions = false;  // AnimationOptions::precision
  bool isRead = false;         // by AnimationReader; of others points go out only
  bool hasValues = false;      // looks at AnimationOptions::usd
  /// Goes on with PATH.partial after its first `frameCount` frames, to the bytes of a file written in one go;
  /// with 0 it begins anew. Only the topology's strand lengths are used. Errors: the file is not that of such
  /// an animation, or has fewer whole frames.
  Result<std::unique_ptr<AnimationWriter>> (*resume)(const std::filesystem::path& path, const Groom& topology,
                                                     const AnimationOptions& options, int frameCount);
};

std::span<const AnimationFormat> animationFormats();
/// The endings of those that have a property, for sentences: ".usda, .usdc or .rgc". `last`: the word before
/// the last of them.
std::string animationEndings(bool AnimationFormat::*property, const char* last);
/// By the ending of the name; null for one that is none of theirs.
const AnimationFormat* animationFormatOf(const std::filesystem::path& path);
/// Begins an animation in the format of the ending; a PATH.partial that is there is replaced. Errors: another
/// ending, with those there are; those of AnimationFormat::resume.
Result<std::unique_ptr<AnimationWriter>> createAnimation(const std::filesystem::path& path,
                                                         const Groom& topology,
                                                         const AnimationOptions& options);

}  // namespace ringlet
