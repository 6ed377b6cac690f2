// BodyWatch: how deep hair gets into bodies, over a run; into those that bend by their triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/groom/groom.h"
#include "ringlet/scene/body.h"

namespace ringlet {

/// Edge of a cell of its distance grid [m]; none of an exact form and of cloth.
std::optional<double> gridCellOf(const Body& body);
/// Depth up to which a body keeps hair out [m]; half a cell more where it has a grid.
double keepsOutWithin(const Body& body);

/// Over all frames given to look; of one body or all.
struct BodyNumbers {
  double deepest = 0;                       // deepest place of a particle in a body after it was outside of
                                            // it [m]
  std::int64_t strand = -1, particle = -1;  // this particle, groom order; or -1
  std::int64_t frame = -1;                  // the call of look in which it was seen, from 0
  std::size_t inside = 0;  // number of particles, times bodies, that have never been outside or on the
                           // surface
  std::size_t caught = 0;  // of those that had been, that were deeper than keepsOutWithin: between surfaces
                           // that close, hair has no place
  double nearest = 1e300;  // smallest distance from a body, or less: at least half of it, since distant
                           // particles are hardly measured; of cloth, from the box about it [m]
};

class BodyWatch {
 public:
  /// The first `rootCount` particles of a strand follow the head and are not counted.
  BodyWatch(const Groom& groom, std::span<const Body> bodies, int rootCount);

  /// Positions relative to the head's origin, groom order [m]; poses of the bodies in the world; points of
  /// the meshes that bend, of which the last sample counts, empty: as they were at first. Cost: some 20 ns a
  /// particle and body, 100 for a distance grid or a mesh that bends, of which 5,000 triangles take 3 ms more
  /// a look; less if the particle before it is far from the body.
  void look(std::span<const Vec3f> positions, const HeadPose& head, std::span<const BodyPose> poses,
            BodyPoints points = {});

  BodyNumbers numbers() const;
  BodyNumbers numbersOf(std::size_t body) const;
  /// Archives what was seen so far, for a checkpoint.
  void archive(Archive& archive) {
    archive.values(std::span(seen_));
    archive.values(std::span(numbers_));
    archive.value(looks_);
  }

 private:
  template <class Distance>
  void lookAt(std::size_t body, std::span<const Vec3f> positions, const Distance& distanceAt);

  std::vector<std::uint32_t> firstPoint_;
  std::vector<Body> bodies_;
  std::size_t rootCount_;
  std::vector<std::uint8_t> seen_;    // a value of Seen, by body, then particle
  std::vector<BodyNumbers> numbers_;  // of each body, without inside and caught
  std::int64_t looks_ = 0;
};

}  // namespace ringlet
