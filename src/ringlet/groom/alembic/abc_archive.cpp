// Implements groom/alembic/abc_archive.h.
#include "ringlet/groom/alembic/abc_archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "ringlet/base/half.h"
#include "ringlet/base/little_endian.h"
#include "ringlet/base/quoted.h"
#include "ringlet/base/text_of.h"
#include "ringlet/groom/alembic/abc_format.h"

namespace ringlet {
namespace {

constexpr std::size_t kRootParts = 6;
constexpr std::uint32_t kOldestLibrary = 9999;  // 0.99.99, the first to write Ogawa
constexpr std::size_t kMostAbcDepth = 64;
constexpr std::size_t kMostAbcName = 1024;  // of an object or a property [bytes]
constexpr std::size_t kBytesAnObject = 32;  // at least, in any file: its group, its header
// A time per cycle as long as this says that every sample has a time of its own.
constexpr double kAcyclic = std::numeric_limits<double>::max() / 32;

// Of the counts in a property's header [bytes].
unsigned numberSizeOf(std::uint32_t bits) {
  constexpr std::array<unsigned, 4> kSizes{1, 2, 4, 4};
  return kSizes[(bits & kAbcSizeBits) >> 2];
}

}  // namespace

std::string_view nameOf(AbcType type) {
  constexpr std::array<std::string_view, 14> kNames{"bool",    "uint8",   "int8",   "uint16",   "int16",
                                                    "uint32",  "int32",   "uint64", "int64",    "float16",
                                                    "float32", "float64", "text",   "wide text"};
  return kNames[static_cast<std::size_t>(type)];
}

std::size_t sizeOfAbc(AbcType type) {
  constexpr std::array<std::size_t, 14> kSizes{1, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8, 1, 4};
  return kSizes[static_cast<std::size_t>(type)];
}

std::string AbcProperty::path() const {
  return within.empty() ? std::string(name) : fmt::format("{}/{}", within, name);
}

AbcSample::AbcSample(AbcType type, unsigned width, std::span<const std::byte> values)
    : type_(type), width_(width), values_(values) {}

std::size_t AbcSample::numberCount() const {
  return type_ == AbcType::text ? 0 : values_.size() / sizeOfAbc(type_);
}

double AbcSample::number(std::size_t k) const {
  const std::size_t at = k * sizeOfAbc(type_);
  const auto byte = [&] { return std::to_integer<std::uint8_t>(values_[at]); };
  switch (type_) {
    case AbcType::boolean:
      return byte() != 0;
    case AbcType::u8:
      return byte();
    case AbcType::i8:
      return static_cast<std::int8_t>(byte());
    case AbcType::u16:
      return readU16(values_, at);
    case AbcType::i16:
      return static_cast<std::int16_t>(readU16(values_, at));
    case AbcType::u32:
      return readU32(values_, at);
    case AbcType::i32:
      return static_cast<std::int32_t>(readU32(values_, at));
    case AbcType::u64:
      return static_cast<double>(readU64(values_, at));
    case AbcType::i64:
      return static_cast<double>(static_cast<std::int64_t>(readU64(values_, at)));
    case AbcType::f16:
      return halfValue(readU16(values_, at));
    case AbcType::f32:
      return readF32(values_, at);
    case AbcType::f64:
      return readF64(values_, at);
    case AbcType::text:
    case AbcType::wideText:
      break;
  }
  return 0;
}

std::vector<std::string_view> AbcSample::texts() const {
  std::vector<std::string_view> all;
  if (type_ != AbcType::text) return all;
  std::string_view rest = textOf(values_);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\0'), rest.size());
    all.push_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return all;
}

// Takes numbers and texts one after another.
struct AbcArchive::Reading {
  std::span<const std::byte> bytes;
  std::size_t at = 0;

  std::size_t left() const { return bytes.size() - at; }
  // A number of 1, 2 or 4 bytes; false: the data ends before it.
  bool take(unsigned size, std::uint32_t& number) {
    if (left() < size) return false;
    number = size == 4   ? readU32(bytes, at)
             : size == 2 ? readU16(bytes, at)
                         : std::to_integer<std::uint32_t>(bytes[at]);
    at += size;
    return true;
  }
  bool take(std::size_t size, std::string_view& text) {
    if (left() < size) return false;
    text = textOf(bytes.subspan(at, size));
    at += size;
    return true;
  }
};

Error AbcArchive::broken(const std::string& what) const { return Error{fmt::format("{}: {}", name(), what)}; }

Result<AbcArchive> AbcArchive::of(std::span<const std::byte> bytes, const std::string& name) {
  auto file = OgawaFile::of(bytes, name);
  if (!file) return file.error();
  AbcArchive archive(std::move(*file));
  if (Status read = archive.readParts(); !read) return read.error();
  return archive;
}

Status AbcArchive::readParts() {
  const auto root = file_.root();
  if (!root) return root.error();
  if (root->size() < kRootParts)
    return broken(fmt::format("found {} parts at its root; expected {}", root->size(), kRootParts));
  if (Status good = checkVersion(*root); !good) return good;
  const auto metadata = file_.data((*root)[3]);
  if (!metadata) return metadata.error();
  metadata_ = textOf(*metadata);
  const auto samplings = file_.data((*root)[4]);
  if (!samplings) return samplings.error();
  if (Status read = readSamplings(*samplings); !read) return read;
  const auto texts = file_.data((*root)[5]);
  if (!texts) return texts.error();
  if (Status read = readTexts(*texts); !read) return read;
  return readObjects(*root);
}

Status AbcArchive::checkVersion(const OgawaGroup& root) const {
  std::uint32_t numbers[2]{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto data = file_.data(root[k]);
    if (!data) return data.error();
    if (data->size() != 4)
      return file_.wrong(root[k].place(), fmt::format("a version of {} bytes", data->size()), "one of 4");
    numbers[k] = readU32(*data, 0);
  }
  if (numbers[0] != 0)
    return broken(fmt::format("found version {} of Alembic archives; expected 0", numbers[0]));
  if (numbers[1] < kOldestLibrary)
    return broken(fmt::format("found library version {}; expected {} or more", numbers[1], kOldestLibrary));
  return {};
}

Status AbcArchive::readSamplings(std::span<const std::byte> bytes) {
  constexpr std::size_t kHead = 16;
  for (std::size_t at = 0; at < bytes.size();) {
    if (bytes.size() - at < kHead) return broken("its time samplings end early");
    const double perCycle = readF64(bytes, at + 4);
    const std::size_t count = readU32(bytes, at + 12);
    at += kHead;
    if (count == 0 || count > (bytes.size() - at) / 8)
      return broken(
          fmt::format("found a time sampling of {} times; expected 1 to {}", count, (bytes.size() - at) / 8));
    samplings_.push_back({perCycle, bytes.subspan(at, 8 * count)});
    at += 8 * count;
  }
  return {};
}

Status AbcArchive::readTexts(std::span<const std::byte> bytes) {
  texts_.emplace_back();
  Reading reading{bytes};
  while (reading.left() > 0) {
    std::uint32_t size = 0;
    std::string_view text;
    if (!reading.take(1, size) || !reading.take(std::size_t{size}, text))
      return broken("its table of metadata ends early");
    if (texts_.size() < kAbcTextInPlace) texts_.push_back(text);
  }
  return {};
}

Result<std::string_view> AbcArchive::metadataAt(Reading& reading, std::uint32_t index, unsigned size) const {
  if (index != kAbcTextInPlace) {
    if (index < texts_.size()) return texts_[index];
    return broken(fmt::format("found metadata {}; expected at most {}", index, texts_.size() - 1));
  }
  std::uint32_t length = 0;
  std::string_view text;
  if (!reading.take(size, length) || !reading.take(std::size_t{length}, text))
    return broken("metadata ends early");
  return text;
}

Status AbcArchive::readObjects(const OgawaGroup& root) {
  const auto top = file_.group(root[2]);
  if (!top) return top.error();
  objects_.push_back({0, {}, {}, *top});
  std::vector<std::uint8_t> depths{0};
  for (std::uint32_t k = 0; k < objects_.size(); ++k) {
    if (Status added = addChildren(k); !added) return added;
    depths.resize(objects_.size(), static_cast<std::uint8_t>(depths[k] + 1));
    if (depths.back() > kMostAbcDepth)
      return broken(fmt::format("found objects more than {} deep", kMostAbcDepth));
  }
  return {};
}

// An object without parts has no children.
Status AbcArchive::addChildren(std::uint32_t parent) {
  const OgawaGroup parts = objects_[parent].parts;
  if (parts.size() == 0) return {};
  const auto headers = file_.data(parts[parts.size() - 1]);
  if (!headers) return headers.error();
  const std::size_t size = headers->size() - std::min(headers->size(), kAbcHashesBytes);
  Reading reading{headers->first(size)};
  const std::size_t last = parts.size() - 1, most = file_.byteCount() / kBytesAnObject;
  for (std::size_t child = 1; reading.left() > 0; ++child) {
    AbcObject object{.parent = parent};
    std::uint32_t length = 0, index = 0;
    if (!reading.take(4, length) || !reading.take(std::size_t{length}, object.name) ||
        !reading.take(1, index))
      return wrong(parent, "the headers of its children end early");
    if (length > kMostAbcName) return wrong(parent, fmt::format("found a child's name of {} bytes", length));
    const auto metadata = metadataAt(reading, index, 4);
    if (!metadata) return metadata.error();
    object.metadata = *metadata;
    if (child >= last)
      return wrong(parent, fmt::format("found headers of more than {} children", last == 0 ? 0 : last - 1));
    const auto group = file_.group(parts[child]);
    if (!group) return group.error();
    object.parts = *group;
    if (objects_.size() > most)
      return broken(fmt::format("found more than {} objects in {} bytes", most, file_.byteCount()));
    objects_.push_back(object);
  }
  return {};
}

std::string AbcArchive::pathOf(std::uint32_t object) const {
  if (object == 0) return "/";
  std::vector<std::string_view> names;
  for (; object != 0; object = objects_[object].parent) names.push_back(objects_[object].name);
  std::string path;
  for (auto part = names.rbegin(); part != names.rend(); ++part) path.append("/").append(*part);
  return path;
}

Error AbcArchive::wrong(std::uint32_t object, const std::string& sentence) const {
  return broken(fmt::format("{}: {}", pathOf(object), sentence));
}
Error AbcArchive::wrong(const AbcProperty& property, const std::string& sentence) const {
  return wrong(property.object, fmt::format("{}: {}", property.path(), sentence));
}

Result<std::vector<AbcProperty>> AbcArchive::propertiesOf(std::uint32_t object) const {
  const OgawaGroup parts = objects_[object].parts;
  if (parts.size() == 0) return std::vector<AbcProperty>();
  return propertiesIn(parts[0], {.object = object});
}

Result<std::vector<AbcProperty>> AbcArchive::propertiesOf(const AbcProperty& compound) const {
  if (compound.kind != AbcKind::compound) return wrong(compound, "found samples; expected a compound");
  return propertiesIn(compound.place, {.object = compound.object, .within = compound.name});
}

Result<std::vector<AbcProperty>> AbcArchive::propertiesIn(OgawaChild group, const AbcProperty& like) const {
  std::vector<AbcProperty> properties;
  const auto parts = file_.group(group);
  if (!parts) return parts.error();
  if (parts->size() == 0) return properties;
  const std::size_t last = parts->size() - 1;
  const auto headers = file_.data((*parts)[last]);
  if (!headers) return headers.error();
  for (Reading reading{*headers}; reading.left() > 0;) {
    auto property = propertyAt(reading, like);
    if (!property) return property.error();
    if (properties.size() == last)
      return wrong(*property, fmt::format("found a header more than the {} properties", last));
    property->place = (*parts)[properties.size()];
    properties.push_back(*property);
  }
  return properties;
}

Result<AbcProperty> AbcArchive::propertyAt(Reading& reading, const AbcProperty& like) const {
  AbcProperty property = like;
  const auto early = [&] { return wrong(like.object, "the headers of its properties end early"); };
  std::uint32_t bits = 0, length = 0;
  if (!reading.take(4, bits)) return early();
  const std::uint32_t kind = bits & kAbcKindBits, type = bits >> kAbcTypeShift & 15;
  property.kind = kind == 0 ? AbcKind::compound : kind == 1 ? AbcKind::scalar : AbcKind::array;
  if (type > static_cast<std::uint32_t>(AbcType::wideText))
    return wrong(like.object, fmt::format("found a property of type {}; expected at most 13", type));
  property.type = static_cast<AbcType>(type);
  property.width = bits >> kAbcWidthShift & 255;
  const bool hasSamples = property.kind != AbcKind::compound;
  if (hasSamples && !readSampleNumbers(reading, bits, property)) return early();
  if (!reading.take(numberSizeOf(bits), length) || !reading.take(std::size_t{length}, property.name))
    return early();
  if (length > kMostAbcName)
    return wrong(like.object, fmt::format("found a property's name of {} bytes", length));
  const auto metadata = metadataAt(reading, bits >> kAbcMetadataShift & 255, numberSizeOf(bits));
  if (!metadata) return metadata.error();
  property.metadata = *metadata;
  const bool changesWithin = property.firstChanged > 0 && property.firstChanged <= property.lastChanged &&
                             property.lastChanged < property.sampleCount;
  const bool neverChanges = property.firstChanged == 0 && property.lastChanged == 0;
  if (hasSamples && (property.width == 0 || (!changesWithin && !neverChanges)))
    return wrong(property, fmt::format("found {} values an element, {} samples that change from {} to {}",
                                       property.width, property.sampleCount, property.firstChanged,
                                       property.lastChanged));
  return property;
}

bool AbcArchive::readSampleNumbers(Reading& reading, std::uint32_t bits, AbcProperty& property) {
  const unsigned size = numberSizeOf(bits);
  if (!reading.take(size, property.sampleCount)) return false;
  if ((bits & kAbcHasChanged) != 0) {
    if (!reading.take(size, property.firstChanged) || !reading.take(size, property.lastChanged)) return false;
  } else if ((bits & kAbcIsConstant) == 0 && property.sampleCount > 1) {
    property.firstChanged = 1;
    property.lastChanged = property.sampleCount - 1;
  }
  return (bits & kAbcHasSampling) == 0 || reading.take(size, property.sampling);
}

Result<OgawaChild> AbcArchive::placeOfStored(const AbcProperty& property, std::uint32_t k) const {
  const auto group = file_.group(property.place);
  if (!group) return group.error();
  const std::uint64_t each = property.kind == AbcKind::array ? 2 : 1;
  if ((k + 1) * each > group->size())
    return wrong(property, fmt::format("found {} stored samples; expected {}", group->size() / each,
                                       property.storedCount()));
  return (*group)[k * each];
}

Result<AbcSample> AbcArchive::stored(const AbcProperty& property, std::uint32_t k) const {
  const auto place = placeOfStored(property, k);
  if (!place) return place.error();
  const auto data = file_.data(*place);
  if (!data) return data.error();
  if (property.type == AbcType::wideText) return wrong(property, "texts of wide characters are not read");
  const AbcSample sample(property.type, property.width,
                         data->subspan(std::min(data->size(), kAbcDigestBytes)));
  if (property.type == AbcType::text) return sample;
  const std::size_t size = sizeOfAbc(property.type) * property.width;
  if (sample.bytes().size() % size != 0)
    return wrong(property, fmt::format("found {} bytes in sample {}; expected whole elements of {}",
                                       sample.bytes().size(), property.sampleOfStored(k) + 1, size));
  if (property.kind == AbcKind::scalar && sample.elementCount() != 1)
    return wrong(property, fmt::format("found {} elements in sample {}; expected 1", sample.elementCount(),
                                       property.sampleOfStored(k) + 1));
  if (Status checked = checkDimensions(property, k, sample); !checked) return checked.error();
  return sample;
}

Status AbcArchive::checkDimensions(const AbcProperty& property, std::uint32_t k,
                                   const AbcSample& sample) const {
  if (property.kind != AbcKind::array) return {};
  const auto group = file_.group(property.place);
  if (!group) return group.error();
  const auto dimensions = file_.data((*group)[2 * std::size_t{k} + 1]);
  if (!dimensions) return dimensions.error();
  if (dimensions->empty()) return {};
  std::uint64_t count = 1;
  bool fits = true;
  for (std::size_t at = 0; fits && at + 8 <= dimensions->size(); at += 8) {
    const std::uint64_t side = readU64(*dimensions, at);
    fits = side == 0 || count <= sample.elementCount() / side;
    count *= fits ? side : 1;
  }
  if (fits && count == sample.elementCount()) return {};
  return wrong(property, fmt::format("found {} elements in sample {}; its dimensions say another number",
                                     sample.elementCount(), property.sampleOfStored(k) + 1));
}

Result<double> AbcArchive::secondsOf(const AbcProperty& property, std::uint32_t sample) const {
  if (property.sampling >= samplings_.size())
    return wrong(property, fmt::format("found time sampling {}; expected less than {}", property.sampling,
                                       samplings_.size()));
  const auto& [perCycle, times] = samplings_[property.sampling];
  const std::size_t count = times.size() / 8;
  if (perCycle < kAcyclic)  // a cycle has `count` samples
    return readF64(times, 8 * (sample % count)) + static_cast<double>(sample / count) * perCycle;
  if (sample >= count)
    return wrong(property, fmt::format("found {} times for {} samples", count, property.sampleCount));
  return readF64(times, 8 * std::size_t{sample});
}

Result<std::vector<AbcKnot>> AbcArchive::knotsOf(const AbcProperty& property) const {
  if (property.sampleCount == 0) return wrong(property, "has no samples");
  if (const auto last = placeOfStored(property, property.storedCount() - 1); !last) return last.error();
  std::vector<AbcKnot> knots{{0, 0, 0}};
  if (property.isChanging()) {
    if (property.firstChanged > 1) knots.push_back({property.firstChanged - 1, 0, 0});
    for (std::uint32_t k = 1; k < property.storedCount(); ++k)
      knots.push_back({property.sampleOfStored(k), k, 0});
    if (property.lastChanged + 1 < property.sampleCount)
      knots.push_back({property.sampleCount - 1, property.storedCount() - 1, 0});
  }
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const auto seconds = secondsOf(property, knots[k].sample);
    if (!seconds) return seconds.error();
    knots[k].seconds = *seconds;
    if (!std::isfinite(*seconds) || (k > 0 && !(*seconds > knots[k - 1].seconds)))
      return wrong(property,
                   fmt::format("sample {} is at {} s; expected a time after that of the sample before",
                               knots[k].sample + 1, *seconds));
  }
  return knots;
}

const AbcProperty* abcPropertyNamed(const std::vector<AbcProperty>& properties, std::string_view name) {
  const auto found = std::ranges::find(properties, name, &AbcProperty::name);
  return found == properties.end() ? nullptr : &*found;
}

std::string_view abcValueOf(std::string_view metadata, std::string_view key) {
  while (!metadata.empty()) {
    const std::size_t end = std::min(metadata.find(';'), metadata.size());
    const std::string_view entry = metadata.substr(0, end);
    metadata.remove_prefix(std::min(end + 1, metadata.size()));
    if (entry.starts_with(key) && entry.size() > key.size() && entry[key.size()] == '=')
      return entry.substr(key.size() + 1);
  }
  return {};
}

std::optional<double> abcNumberOf(std::string_view metadata, std::string_view key) {
  const std::string_view text = abcValueOf(metadata, key);
  double number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, number);
  if (code != std::errc() || stop != end) return std::nullopt;
  return number;
}

}  // namespace ringlet
