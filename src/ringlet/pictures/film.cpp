// Implements film.h.
#include "ringlet/pictures/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "ringlet/base/whole_file.h"

namespace ringlet {
namespace {

constexpr OtherProgram kFfmpeg{"ffmpeg", "films are made", "ffmpeg"};

struct Kind {
  const char* extension;
  std::vector<std::string> options;  // for the encoder
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      // Players need even sizes and the colour space.
      {".mp4",
       {"-c:v", "libx264", "-crf", "17", "-pix_fmt", "yuv420p", "-vf",
        "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709", "-colorspace", "bt709",
        "-color_primaries", "bt709", "-color_trc", "bt709", "-movflags", "+faststart", "-f", "mp4"}},
      {".webp", {"-c:v", "libwebp_anim", "-q:v", "80", "-loop", "0", "-f", "webp"}},
      // A palette of its own for each film.
      {".gif", {"-filter_complex", "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-f", "gif"}},
  };
  return all;
}

const Kind* kindOf(const std::filesystem::path& path) {
  const auto found = std::ranges::find(kinds(), path.extension().string(), &Kind::extension);
  return found == kinds().end() ? nullptr : &*found;
}

}  // namespace

bool isFilm(const std::filesystem::path& path) { return kindOf(path) != nullptr; }

Status checkFilms() {
  const Status installed = checkInstalled(kFfmpeg);
  if (installed) return {};
  return Error{installed.error().message + "; for a PNG file a frame name a folder"};
}

Result<Film> Film::start(const std::filesystem::path& path, int width, int height, double framesPerSecond) {
  if (Status can = checkFilms(); !can) return can.error();
  if (Status can = checkReplaceable(path); !can) return can.error();
  const std::filesystem::path partial = path.string() + ".partial";
  std::error_code ignored;
  std::filesystem::remove(partial, ignored);  // ffmpeg would follow a symbolic link of that name
  std::vector<std::string> arguments = {"-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"};
  for (std::string each :
       {std::string("-video_size"), fmt::format("{}x{}", width, height), std::string("-framerate"),
        fmt::format("{}", framesPerSecond), std::string("-i"), std::string("pipe:0")})
    arguments.push_back(std::move(each));
  const std::vector<std::string>& options = kindOf(path)->options;
  arguments.insert(arguments.end(), options.begin(), options.end());
  arguments.push_back("file:" + partial.string());  // "file:" protects a colon in the path
  auto ffmpeg = ProgramInput::start(kFfmpeg, arguments);
  if (!ffmpeg) return ffmpeg.error();
  return Film(path, partial, std::move(*ffmpeg));
}

Film::~Film() {
  if (partial_.empty()) return;
  ffmpeg_.end();
  std::error_code code;
  std::filesystem::remove(partial_, code);
}

Status Film::finish() {
  if (Status made = ffmpeg_.finish(); !made) return made;
  std::error_code code;
  std::filesystem::rename(partial_, path_, code);
  if (code) return Error{fmt::format("cannot write {}: {}", path_.string(), code.message()), Fault::output};
  partial_.clear();
  return {};
}

}  // namespace ringlet
