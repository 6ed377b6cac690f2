// Implements groom/alembic/abc_out.h.
#include "ringlet/groom/alembic/abc_out.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "ringlet/base/assert.h"
#include "ringlet/base/checksum.h"
#include "ringlet/base/half.h"

namespace ringlet {
namespace {

constexpr std::uint32_t kCountsOf4 = 2 << 2;  // counts in a property's header have 4 bytes
constexpr std::uint32_t kArchiveVersion = 0, kLibraryVersion = 10812;  // the form of that library
constexpr std::size_t kMostTexts = 254, kMostTextBytes = 255;          // of the table of metadata

void padAbc(std::string& bytes) { bytes.resize((bytes.size() + 7) / 8 * 8, '\0'); }

void putAbcInteger(std::string& bytes, std::uint64_t value, unsigned size) {
  for (unsigned i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

template <class Integer>
Integer nearestAbc(double value) {
  constexpr double kLow = static_cast<double>(std::numeric_limits<Integer>::min()),
                   kHigh = static_cast<double>(std::numeric_limits<Integer>::max());
  if (!(value > kLow)) return std::numeric_limits<Integer>::min();
  if (!(value < kHigh)) return std::numeric_limits<Integer>::max();
  return static_cast<Integer>(std::nearbyint(value));
}

// Signed ones are extended beyond their own bits.
std::uint64_t abcBitsOf(AbcType type, double value) {
  switch (type) {
    case AbcType::boolean:
      return value != 0 ? 1 : 0;
    case AbcType::u8:
      return nearestAbc<std::uint8_t>(value);
    case AbcType::i8:
      return static_cast<std::uint64_t>(nearestAbc<std::int8_t>(value));
    case AbcType::u16:
      return nearestAbc<std::uint16_t>(value);
    case AbcType::i16:
      return static_cast<std::uint64_t>(nearestAbc<std::int16_t>(value));
    case AbcType::u32:
      return nearestAbc<std::uint32_t>(value);
    case AbcType::i32:
      return static_cast<std::uint64_t>(nearestAbc<std::int32_t>(value));
    case AbcType::u64:
      return nearestAbc<std::uint64_t>(value);
    case AbcType::i64:
      return static_cast<std::uint64_t>(nearestAbc<std::int64_t>(value));
    case AbcType::f16:
      return halfBits(static_cast<float>(value));
    case AbcType::f32:
      return std::bit_cast<std::uint32_t>(static_cast<float>(value));
    case AbcType::f64:
      return std::bit_cast<std::uint64_t>(value);
    case AbcType::text:
    case AbcType::wideText:
      break;
  }
  RINGLET_ASSERT(false, "a type of numbers");
  return 0;
}

// Groups and data, appended at a place of the file.
class AbcTreeMaker {
 public:
  AbcTreeMaker(std::uint64_t place, const AbcOutArchive& archive, std::string_view content)
      : place_(place), archive_(archive), content_(content) {}

  AbcTree make() {
    const std::uint64_t top = putObject("", {}, archive_.objects);
    std::string version, library, samplings, texts;
    putAbcU32(version, kArchiveVersion);
    putAbcU32(library, kLibraryVersion);
    for (const AbcOutSampling& sampling : archive_.samplings) {
      putAbcU32(samplings, sampling.mostSamples);
      putAbcF64(samplings, sampling.secondsPerFrame);
      putAbcU32(samplings, 1);
      putAbcF64(samplings, sampling.firstSecond);
    }
    for (const std::string& text : texts_) {
      texts.push_back(static_cast<char>(text.size()));
      texts += text;
    }
    std::vector<std::uint64_t> parts{putData(version), putData(library), top};
    for (const std::string& data : {archive_.metadata, samplings, texts}) parts.push_back(putData(data));
    const std::uint64_t root = putGroup(parts);
    return {std::move(bytes_), root};
  }

 private:
  std::uint64_t here() const { return place_ + bytes_.size(); }

  std::uint64_t putData(std::string_view data) {
    if (data.empty()) return kAbcNoData;
    const std::uint64_t place = here();
    putAbcU64(bytes_, data.size());
    bytes_ += data;
    padAbc(bytes_);
    return abcDataWord(place);
  }
  std::uint64_t putGroup(const std::vector<std::uint64_t>& children) {
    const std::uint64_t place = here();
    putAbcU64(bytes_, children.size());
    for (const std::uint64_t child : children) putAbcU64(bytes_, child);
    return place;
  }

  // A place in the table; kAbcTextInPlace: the text stands where it is needed.
  std::uint32_t indexOf(const std::string& text) {
    if (text.empty()) return 0;
    const auto known = std::ranges::find(texts_, text);
    const auto index = static_cast<std::size_t>(known - texts_.begin());
    if (known == texts_.end()) {
      if (text.size() > kMostTextBytes || texts_.size() == kMostTexts) return kAbcTextInPlace;
      texts_.push_back(text);
    }
    return static_cast<std::uint32_t>(index + 1);
  }

  std::uint64_t putObject(const std::string& name, const std::vector<AbcOutProperty>& properties,
                          const std::vector<AbcOutObject>& children) {
    std::vector<std::uint64_t> parts{putCompound(properties)};
    std::string headers;
    for (const AbcOutObject& child : children) {
      const std::uint32_t index = indexOf(child.metadata);
      putAbcU32(headers, static_cast<std::uint32_t>(child.name.size()));
      headers += child.name;
      headers.push_back(static_cast<char>(index));
      if (index == kAbcTextInPlace) {
        putAbcU32(headers, static_cast<std::uint32_t>(child.metadata.size()));
        headers += child.metadata;
      }
      parts.push_back(putObject(child.name, child.properties, child.children));
    }
    // Hashes of the properties, and of what is below.
    const std::string content(content_);
    headers += abcDigest(name + content) + abcDigest(content + headers);
    parts.push_back(putData(headers));
    return putGroup(parts);
  }

  std::uint64_t putCompound(const std::vector<AbcOutProperty>& properties) {
    if (properties.empty()) return 0;
    std::vector<std::uint64_t> parts;
    std::string headers;
    for (const AbcOutProperty& property : properties) {
      putHeader(property, headers);
      parts.push_back(property.kind == AbcKind::compound ? putCompound(property.parts) : property.samples);
    }
    parts.push_back(putData(headers));
    return putGroup(parts);
  }

  void putHeader(const AbcOutProperty& property, std::string& headers) {
    const std::uint32_t index = indexOf(property.metadata);
    std::uint32_t bits = kCountsOf4 | index << kAbcMetadataShift;
    const auto sampling = static_cast<std::uint32_t>(property.isCounted ? archive_.samplings.size() - 1 : 0);
    if (property.kind != AbcKind::compound) {
      const bool isOne = !property.isMoving() && property.type != AbcType::text &&
                         property.kind == AbcKind::array &&
                         property.values.size() == property.width * sizeOfAbc(property.type);
      bits |= property.kind == AbcKind::scalar ? kAbcScalar : isOne ? kAbcArrayOfOne : kAbcArray;
      bits |= static_cast<std::uint32_t>(property.type) << kAbcTypeShift | kAbcIsHomogenous |
              property.width << kAbcWidthShift;
      if (!property.isMoving() || property.sampleCount <= 1) bits |= kAbcIsConstant;
      if (sampling > 0) bits |= kAbcHasSampling;
    }
    putAbcU32(headers, bits);
    if (property.kind != AbcKind::compound) putAbcU32(headers, property.sampleCount);
    if ((bits & kAbcHasSampling) != 0) putAbcU32(headers, sampling);
    putAbcU32(headers, static_cast<std::uint32_t>(property.name.size()));
    headers += property.name;
    if (index != kAbcTextInPlace) return;
    putAbcU32(headers, static_cast<std::uint32_t>(property.metadata.size()));
    headers += property.metadata;
  }

  std::uint64_t place_;
  const AbcOutArchive& archive_;
  std::string_view content_;
  std::string bytes_{};
  std::vector<std::string> texts_{};
};

void putSamplesBelow(std::vector<AbcOutObject>& objects, std::string& bytes) {
  for (AbcOutObject& object : objects) {
    for (AbcOutProperty& property : object.properties) putAbcSamples(property, 1, bytes);
    putSamplesBelow(object.children, bytes);
  }
}

}  // namespace

void putAbcU32(std::string& bytes, std::uint32_t value) { putAbcInteger(bytes, value, 4); }
void putAbcU64(std::string& bytes, std::uint64_t value) { putAbcInteger(bytes, value, 8); }
void putAbcF64(std::string& bytes, double value) {
  putAbcInteger(bytes, std::bit_cast<std::uint64_t>(value), 8);
}
void putAbcNumber(std::string& bytes, AbcType type, double value) {
  putAbcInteger(bytes, abcBitsOf(type, value), static_cast<unsigned>(sizeOfAbc(type)));
}

// One pass: a half of the bytes, the other half.
std::string abcDigest(std::string_view bytes) {
  const auto all = std::as_bytes(std::span(bytes));
  const std::size_t half = bytes.size() / 16 * 8;
  std::string digest;
  putAbcU64(digest, checksum64(all.first(half)));
  putAbcU64(digest, checksum64(all.subspan(half)));
  return digest;
}

std::string abcFileHeader(std::uint64_t rootPlace) {
  std::string bytes("Ogawa\xff\0\1", 8);
  putAbcU64(bytes, rootPlace);
  return bytes;
}

void putAbcSamples(AbcOutProperty& property, std::uint32_t mostSamples, std::string& bytes) {
  for (AbcOutProperty& part : property.parts) putAbcSamples(part, mostSamples, bytes);
  if (property.kind == AbcKind::compound) return;
  std::vector<std::uint64_t> words(
      property.childrenPerSample() * (property.isMoving() ? std::uint64_t{mostSamples} : 1), kAbcNoData);
  if (!property.isMoving()) {
    words[0] = abcDataWord(bytes.size());
    putAbcU64(bytes, kAbcDigestBytes + property.values.size());
    bytes += abcDigest(property.values) + property.values;
    padAbc(bytes);
  }
  if (property.type == AbcType::text && property.kind == AbcKind::array) {  // of texts the size does not tell
    words[1] = abcDataWord(bytes.size());
    putAbcU64(bytes, 8);
    putAbcU64(bytes, static_cast<std::uint64_t>(std::ranges::count(property.values, '\0')));
  }
  property.samples = bytes.size();
  putAbcU64(bytes, words.size());
  for (const std::uint64_t word : words) putAbcU64(bytes, word);
}

AbcTree abcTreeAt(std::uint64_t place, const AbcOutArchive& archive, std::string_view content) {
  RINGLET_ASSERT(place % 8 == 0, "trees stand at multiples of 8");
  return AbcTreeMaker(place, archive, content).make();
}

std::string abcFileOf(AbcOutArchive archive) {
  std::string bytes = abcFileHeader(0);
  putSamplesBelow(archive.objects, bytes);
  const AbcTree tree = abcTreeAt(bytes.size(), archive, abcDigest(bytes));
  bytes += tree.bytes;
  bytes.replace(0, 16, abcFileHeader(tree.rootPlace));
  return bytes;
}

}  // namespace ringlet
