// PictureFiles: where pictures are written: a PNG or EXR file for each frame, a film, or panels of one PNG.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/output/picture.h"
#include "ringlet/pictures/film.h"
#include "ringlet/pictures/picture_legend.h"
#include "ringlet/render/hair_renderer.h"

namespace ringlet {

/// Whether the name has the ending of a picture: .png or .exr.
bool isPicture(const std::filesystem::path& path);

struct PictureTarget {
  std::filesystem::path path;   // file name of a picture or film; else a folder for frame.0001.png and so on
  bool isExr = false;           // the files of a folder
  double framesPerSecond = 24;  // of a film
  std::optional<PictureLegend> legend{};  // drawn into all but EXR files
  int panels = 0;                         // above 0: number of pictures that are put side by side into one
  std::function<Status(int frame, Picture picture)> take{};  // receives pictures in place of files
};

class PictureFiles {
 public:
  /// Makes the folder. `size`: of every picture. Errors: the folder cannot be made; films cannot be made.
  static Result<PictureFiles> open(const PictureTarget& target, const PictureSize& size);

  /// Writes what the renderer has drawn as the picture of a frame.
  Status write(int frame, const HairRenderer& renderer);
  /// Completes a film or a picture of panels.
  Status finish();

  int count() const { return count_; }
  /// The first and the last file.
  const std::vector<std::filesystem::path>& outputs() const { return outputs_; }

 private:
  PictureFiles(const PictureTarget& target, const PictureSize& size) : target_(target), size_(size) {}
  Status add(int frame, const std::filesystem::path& path, const Picture& image);
  std::filesystem::path pathOf(int frame) const;

  PictureTarget target_;
  PictureSize size_;
  std::optional<Film> film_;
  std::optional<Picture> panels_;
  int count_ = 0;
  std::vector<std::filesystem::path> outputs_;
};

}  // namespace ringlet
