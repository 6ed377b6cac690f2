// PictureFiles: where pictures go: a PNG or EXR file a frame, a film, or panels of one PNG.
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

/// Whether the name is one picture's: .png or .exr.
bool isPicture(const std::filesystem::path& path);

struct PictureTarget {
  std::filesystem::path path;   // one picture's or a film's name; else a folder for frame.0001.png and so on
  bool isExr = false;           // of a folder
  double framesPerSecond = 24;  // of a film
  std::optional<PictureLegend> legend{};  // of all but EXR files
  int panels = 0;                         // above 0: so many pictures are side by side in the one of `path`
  std::function<Status(int frame, Picture picture)> take{};  // in place of files
};

class PictureFiles {
 public:
  /// Makes the folder they are in. `size`: of all pictures. Errors: it cannot be made; films cannot.
  static Result<PictureFiles> open(const PictureTarget& target, const PictureSize& size);

  /// What the renderer has drawn, as the picture of a frame.
  Status write(int frame, const HairRenderer& renderer);
  /// A film, or a picture of panels, is whole then.
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
