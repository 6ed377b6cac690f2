// Film: pictures one after the other in one file, which ffmpeg makes. It is FILE.partial until it is whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/pictures/program_input.h"

namespace ringlet {

/// Whether the name is a film's: .mp4, .webp or .gif.
bool isFilm(const std::filesystem::path& path);
/// Whether films can be made here. The error says what to install, or what else can be asked for.
Status checkFilms();

class Film {
 public:
  /// Sizes in pixels. Errors: as for checkFilms.
  static Result<Film> start(const std::filesystem::path& path, int width, int height, double framesPerSecond);
  Film(Film&&) = default;
  Film& operator=(Film&&) = delete;
  ~Film();  // removes a film that was not finished

  /// Rows from the top, of red, green and blue bytes.
  Status add(std::span<const std::byte> pixels) { return ffmpeg_.write(pixels); }
  Status finish();

 private:
  Film(std::filesystem::path path, std::filesystem::path partial, ProgramInput ffmpeg)
      : path_(std::move(path)), partial_(std::move(partial)), ffmpeg_(std::move(ffmpeg)) {}

  std::filesystem::path path_, partial_;  // the second empty where it was moved from, or is done
  ProgramInput ffmpeg_;
};

}  // namespace ringlet
