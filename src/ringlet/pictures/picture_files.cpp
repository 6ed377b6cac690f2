// Implements picture_files.h.
#include "ringlet/pictures/picture_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "ringlet/output/exr_file.h"

namespace ringlet {
namespace {

constexpr Colour kLabel{150, 150, 150};

Picture imageOf(std::span<const std::uint32_t> pixels, const PictureSize& size) {
  Picture image(size.width, size.height, {});
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    image.pixels[i] = {static_cast<std::uint8_t>(pixels[i]), static_cast<std::uint8_t>(pixels[i] >> 8),
                       static_cast<std::uint8_t>(pixels[i] >> 16)};
  }
  return image;
}

}  // namespace

bool isPicture(const std::filesystem::path& path) {
  return path.extension() == ".png" || path.extension() == ".exr";
}

Result<PictureFiles> PictureFiles::open(const PictureTarget& target, const PictureSize& size) {
  if (target.take) return PictureFiles(target, size);
  const bool isFile = isPicture(target.path) || isFilm(target.path);
  const std::filesystem::path folder = isFile ? target.path.parent_path() : target.path;
  std::error_code code;
  if (!folder.empty()) std::filesystem::create_directories(folder, code);
  if (code)
    return Error{fmt::format("cannot make the folder {}: {}", folder.string(), code.message()),
                 Fault::output};
  PictureFiles self(target, size);
  if (isFilm(target.path)) {
    auto film = Film::start(target.path, size.width, size.height, target.framesPerSecond);
    if (!film) return film.error();
    self.film_.emplace(std::move(*film));
  }
  return self;
}

std::filesystem::path PictureFiles::pathOf(int frame) const {
  if (film_ || isPicture(target_.path)) return target_.path;
  return target_.path / fmt::format("frame.{:04}.{}", frame, target_.isExr ? "exr" : "png");
}

Status PictureFiles::write(int frame, const HairRenderer& renderer) {
  if (target_.take) {
    const auto pixels = renderer.picture();
    if (!pixels) return pixels.error();
    ++count_;
    return target_.take(frame, imageOf(*pixels, size_));
  }
  const std::filesystem::path path = pathOf(frame);
  Status written;
  if (path.extension() == ".exr") {
    const auto light = renderer.light();
    if (!light) return light.error();
    written = writeExr(path, size_.width, size_.height, *light);
  } else {
    const auto pixels = renderer.picture();
    if (!pixels) return pixels.error();
    Picture image = imageOf(*pixels, size_);
    if (target_.legend) drawLegend(*target_.legend, image);
    written = add(frame, path, image);
  }
  if (!written) return written;
  if (outputs_.size() > (film_ || panels_ ? 0 : 1)) outputs_.pop_back();
  outputs_.push_back(path);
  ++count_;
  return {};
}

Status PictureFiles::add(int frame, const std::filesystem::path& path, const Picture& image) {
  if (film_) return film_->add(std::as_bytes(std::span(image.pixels)));
  if (target_.panels == 0) return image.writePng(path);
  if (!panels_) panels_.emplace(target_.panels * size_.width, size_.height, Colour{});
  for (int y = 0; y < size_.height; ++y)
    std::copy_n(&image.pixels[static_cast<std::size_t>(y) * size_.width], size_.width,
                &panels_->at(count_ * size_.width, y));
  panels_->drawText(std::to_string(frame), count_ * size_.width + 14, size_.height - 35, 3, kLabel);
  return {};
}

Status PictureFiles::finish() {
  if (count_ == 0) return {};
  if (panels_) return panels_->writePng(target_.path);
  return film_ ? film_->finish() : Status{};
}

}  // namespace ringlet
