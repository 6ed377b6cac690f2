// Implements groom/moving_groom.h.
#include "ringlet/groom/moving_groom.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "ringlet/base/file_ending.h"
#include "ringlet/base/text_of.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/groom/alembic/abc_archive.h"
#include "ringlet/groom/alembic/abc_groom.h"
#include "ringlet/groom/usd/usd_file.h"
#include "ringlet/groom/usd/usd_groom.h"
#include "ringlet/groom/usd/usd_value_at.h"
#include "ringlet/groom/usd/usda_file.h"
#include "ringlet/groom/usd/usdc_file.h"
#include "ringlet/groom/usd/usdz_file.h"

namespace ringlet {
// A file of either format. Its bytes outlive all views of them.
class MovingGroom::Layer {
 public:
  Layer(std::vector<std::byte> bytes, const std::filesystem::path& path)
      : bytes_(std::move(bytes)), path_(path) {}
  virtual ~Layer() = default;

  virtual Status open(std::vector<double>& seconds) = 0;  // adds its times, in any order
  virtual Result<LoadedGroom> at(double seconds, const GroomReading& reading) = 0;

  class Alembic;
  class Usd;

 protected:
  const std::vector<std::byte> bytes_;
  const std::filesystem::path path_;
};

class MovingGroom::Layer::Alembic final : public Layer {
 public:
  using Layer::Layer;

  Status open(std::vector<double>& seconds) override {
    auto archive = AbcArchive::of(bytes_, path_.string());
    if (!archive) return archive.error();
    archive_ = std::move(*archive);
    auto times = abcGroomTimes(*archive_);
    if (!times) return times.error();
    seconds = std::move(*times);
    return {};
  }
  Result<LoadedGroom> at(double seconds, const GroomReading& reading) override {
    return abcGroomAt(seconds, *archive_, reading);
  }

 private:
  std::optional<AbcArchive> archive_{};
};

// Of text all samples are read once; a crate is read anew at each time, without its other samples.
class MovingGroom::Layer::Usd final : public Layer {
 public:
  using Layer::Layer;

  Status open(std::vector<double>& seconds) override {
    const std::string name = path_.string();
    crate_ = bytes_;
    if (isUsdz(bytes_)) {
      const auto first = firstOfUsdz(bytes_, name);
      if (!first) return first.error();
      crate_ = *first;
    }
    isText_ = !isUsdc(crate_);
    auto layer = isText_ ? readUsdLayer(crate_, name, UsdContent::movingStrands)
                         : readUsdc(crate_, name, {.keepsPlaces = true});
    if (!layer) return layer.error();
    const auto rate = usdTimeCodesPerSecond(*layer, name);
    if (!rate) return rate.error();
    codesPerSecond_ = *rate;
    for (const double code : usdGroomTimes(*layer, name)) seconds.push_back(code / *rate);
    if (isText_) text_ = std::move(*layer);
    return {};
  }

  Result<LoadedGroom> at(double seconds, const GroomReading& reading) override {
    const double code = seconds * codesPerSecond_;
    const std::string name = path_.string();
    if (isText_) {
      moveTo(code);
      return groomOfUsd(text_, reading, name);
    }
    auto layer = readUsdc(crate_, name, {.time = code});
    if (!layer) return layer.error();
    layer->byteCount = crate_.size();
    return groomOfUsd(*layer, reading, name);
  }

 private:
  void moveTo(double code) {
    for (UsdPrim& prim : text_.prims)
      for (UsdAttribute& attribute : prim.attributes) {
        if (attribute.samples.empty()) continue;
        const double at = usdTimeOf(attribute.name, code);
        const auto after = std::ranges::upper_bound(attribute.samples, at, {}, &UsdSample::time);
        const UsdSample& before = after == attribute.samples.begin() ? *after : *(after - 1);
        attribute.value =
            goesBetweenUsdSamples(attribute.name) ? usdValueAt(attribute.samples, at) : before.value;
        attribute.isSampled = false;
      }
  }

  std::span<const std::byte> crate_{};
  UsdLayer text_{};
  bool isText_ = false;
  double codesPerSecond_ = 1;
};

MovingGroom::MovingGroom(std::unique_ptr<Layer> layer) : layer_(std::move(layer)) {}
MovingGroom::~MovingGroom() = default;
MovingGroom::MovingGroom(MovingGroom&&) noexcept = default;
MovingGroom& MovingGroom::operator=(MovingGroom&&) noexcept = default;

Result<MovingGroom> MovingGroom::open(const std::filesystem::path& path) {
  auto bytes = readWholeFile(path);
  if (!bytes) return bytes.error();
  std::unique_ptr<Layer> layer;
  if (endingOf(path) == ".abc") {
    layer = std::make_unique<Layer::Alembic>(std::move(*bytes), path);
  } else {
    layer = std::make_unique<Layer::Usd>(std::move(*bytes), path);
  }
  MovingGroom moving(std::move(layer));
  std::vector<double>& seconds = moving.seconds_;
  if (Status opened = moving.layer_->open(seconds); !opened) return opened.error();
  std::ranges::sort(seconds);
  seconds.erase(std::unique(seconds.begin(), seconds.end()), seconds.end());
  return moving;
}

Result<LoadedGroom> MovingGroom::at(double seconds, const GroomReading& reading) const {
  return layer_->at(seconds, reading);
}

}  // namespace ringlet
