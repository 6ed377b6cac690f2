// MovingGroom: the strands of a USD or Alembic file whose curves move, at any time.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

class MovingGroom {
 public:
  /// Errors: those of readWholeFile(), and of the file's structure. The file, and of text the numbers of all
  /// samples, stay in memory.
  static Result<MovingGroom> open(const std::filesystem::path& path);
  ~MovingGroom();
  MovingGroom(MovingGroom&&) noexcept;
  MovingGroom& operator=(MovingGroom&&) noexcept;

  /// The times at which curves, or what places them, have a sample [s], rising; of USD the file's time codes
  /// over its rate. One or none: nothing moves.
  const std::vector<double>& seconds() const { return seconds_; }

  /// What readGroom() gives, but of this time: points and transforms go straight between two samples, all
  /// else is as at the sample before, and visibility as at the first; GroomReading::rootEnd is left aside.
  /// Errors: as there. Cost: the file's structure, and two samples.
  Result<LoadedGroom> at(double seconds, const GroomReading& reading) const;

 private:
  class Layer;
  explicit MovingGroom(std::unique_ptr<Layer> layer);

  std::unique_ptr<Layer> layer_;
  std::vector<double> seconds_{};
};

}  // namespace ringlet
