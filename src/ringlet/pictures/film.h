// Film: a video file, which ffmpeg makes from pictures one after another. It is called FILE.partial until it
// is whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/pictures/program_input.h"

namespace ringlet {

/// Whether the name has the ending of a film: .mp4, .webp or .gif.
bool isFilm(const std::filesystem::path& path);
/// Whether films can be made here. The error says what to install or which other output to ask for.
Status checkFilms();

class Film {
 public:
  /// Sizes in pixels. Errors: as for checkFilms.
  static Result<Film> start(const std::filesystem::path& path, int width, int height, double framesPerSecond);
  Film(Film&&) = default;
  Film& operator=(Film&&) = delete;
  ~Film();  // removes an unfinished film

  /// Rows from the top, each pixel three bytes: red, green, blue.
  Status add(std::span<const std::byte> pixels) { return ffmpeg_.write(pixels); }
  Status finish();

 private:
  Film(std::filesystem::path path, std::filesystem::path partial, ProgramInput ffmpeg)
      : path_(std::move(path)), partial_(std::move(partial)), ffmpeg_(std::move(ffmpeg)) {}

  std::filesystem::path path_, partial_;  // partial_ is empty after a move or when done
  ProgramInput ffmpeg_;
};

}  // namespace ringlet
