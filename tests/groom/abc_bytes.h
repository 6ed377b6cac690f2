// Alembic files for tests, as the Ogawa container has them: objects with properties, samples as asked for.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace ringlet::test {

/// The little-endian bytes of a number; of several one after another.
template <class T>
std::string abcNumber(T value) {
  std::string bytes(sizeof value, '\0');
  if constexpr (std::is_floating_point_v<T>) {
    return abcNumber(
        std::bit_cast<std::conditional_t<sizeof value == 8, std::uint64_t, std::uint32_t>>(value));
  } else {
    for (std::size_t k = 0; k < sizeof value; ++k)
      bytes[k] = static_cast<char>(static_cast<std::make_unsigned_t<T>>(value) >> 8 * k & 0xff);
    return bytes;
  }
}
template <class T>
std::string abcNumbers(const std::vector<T>& values) {
  std::string bytes;
  for (const T value : values) bytes += abcNumber(value);
  return bytes;
}

class AbcBytes {
 public:
  enum Kind : std::uint32_t { compound, scalar, array };
  enum Type : std::uint32_t { boolean = 0, u8 = 1, u16 = 3, i32 = 6, f16 = 9, f32 = 10, f64 = 11, text = 12 };

  struct Property {
    std::string name{};
    Kind kind = compound;
    Type type = boolean;
    std::uint32_t width = 1;
    std::vector<std::string> samples{};  // what is stored
    std::uint32_t sampling = 0;
    // More samples than are stored: from the first to the last they change; 0, 0 and `count`: constant.
    std::uint32_t count = 0, firstChanged = 0, lastChanged = 0;
    std::vector<std::uint64_t> dimensions{};
    std::string metadata{};
    std::vector<Property> parts{};  // of a compound
  };
  struct Object {
    std::string name{}, metadata{};
    std::vector<Property> properties{};
    std::vector<Object> children{};
  };
  struct Sampling {
    double perCycle = 1;
    std::vector<double> times{0};
  };
  static constexpr double kNoCycle = 1.7976931348623157e308 / 32;

  std::vector<Sampling> samplings{{}};
  std::vector<Object> objects{};
  std::int32_t version = 0, library = 10812;
  bool isInPlace = false;  // metadata stands where it is needed, not in the table

  std::string bytes() {
    file_ = std::string("Ogawa\xff\0\1", 8) + std::string(8, '\0');
    table_.clear();
    const std::uint64_t top = put(Object{.children = objects});
    std::string times, texts;
    for (const Sampling& sampling : samplings)
      times += abcNumber<std::uint32_t>(1) + abcNumber(sampling.perCycle) +
               abcNumber(static_cast<std::uint32_t>(sampling.times.size())) + abcNumbers(sampling.times);
    for (const std::string& one : table_) texts += static_cast<char>(one.size()) + one;
    const std::uint64_t root = group({data(abcNumber(version)), data(abcNumber(library)), top,
                                      data("made by a test"), data(times), data(texts)});
    return file_.replace(8, 8, abcNumber(root));
  }

 private:
  std::uint64_t data(const std::string& bytes) {
    const std::uint64_t place = bytes.empty() ? 0 : file_.size();
    if (!bytes.empty()) file_ += abcNumber<std::uint64_t>(bytes.size()) + bytes;
    return place | std::uint64_t{1} << 63;
  }
  std::uint64_t group(const std::vector<std::uint64_t>& children) {
    const std::uint64_t place = file_.size();
    file_ += abcNumber<std::uint64_t>(children.size()) + abcNumbers(children);
    return place;
  }
  std::uint32_t indexOf(const std::string& metadata) {
    if (metadata.empty()) return 0;
    if (isInPlace || metadata.size() > 255) return 255;
    const auto found = std::find(table_.begin(), table_.end(), metadata);
    if (found == table_.end()) table_.push_back(metadata);
    return static_cast<std::uint32_t>(std::find(table_.begin(), table_.end(), metadata) - table_.begin() + 1);
  }

  std::uint64_t put(const Object& object) {
    std::string headers;
    std::vector<std::uint64_t> parts{put(object.properties)};
    for (const Object& child : object.children) {
      const std::uint32_t index = indexOf(child.metadata);
      headers +=
          abcNumber(static_cast<std::uint32_t>(child.name.size())) + child.name + static_cast<char>(index);
      if (index == 255)
        headers += abcNumber(static_cast<std::uint32_t>(child.metadata.size())) + child.metadata;
      parts.push_back(put(child));
    }
    parts.push_back(data(headers + std::string(32, '\0')));
    return group(parts);
  }
  std::uint64_t put(const std::vector<Property>& properties) {
    if (properties.empty()) return 0;
    std::string headers;
    std::vector<std::uint64_t> places;
    for (const Property& property : properties) {
      headers += headerOf(property);
      places.push_back(property.kind == compound ? put(property.parts) : putSamples(property));
    }
    places.push_back(data(headers));
    return group(places);
  }
  std::uint64_t putSamples(const Property& property) {
    std::vector<std::uint64_t> places;
    std::vector<std::pair<std::string, std::uint64_t>> known;  // equal samples are stored once
    for (const std::string& sample : property.samples) {
      auto found =
          std::find_if(known.begin(), known.end(), [&](const auto& one) { return one.first == sample; });
      if (found == known.end()) {
        known.emplace_back(sample, data(std::string(16, '#') + sample));
        found = known.end() - 1;
      }
      places.push_back(found->second);
      if (property.kind == array) places.push_back(data(abcNumbers(property.dimensions)));
    }
    return group(places);
  }

  // Counts of 1, 2 or 4 bytes, as the largest needs.
  std::string headerOf(const Property& p) {
    const std::uint32_t index = indexOf(p.metadata);
    const auto stored = static_cast<std::uint32_t>(p.samples.size());
    const std::uint32_t count = std::max(p.count, stored);
    const bool hasChanged = p.lastChanged > 0, isConstant = stored == 1 && !hasChanged;
    const auto most = std::max({count, p.sampling, static_cast<std::uint32_t>(p.name.size()),
                                static_cast<std::uint32_t>(p.metadata.size())});
    const std::uint32_t hint = most < 256 ? 0 : most < 65536 ? 1 : 2;
    const auto number = [&](std::uint32_t value) {
      return abcNumber(value).substr(0, std::size_t{1} << hint);
    };
    std::string header =
        abcNumber(p.kind | hint << 2 | p.type << 4 | (p.sampling > 0 ? 0x100u : 0) |
                  (hasChanged ? 0x200u : 0) | (isConstant ? 0x800u : 0) | p.width << 12 | index << 20);
    if (p.kind != compound) {
      header += number(count);
      if (hasChanged) header += number(p.firstChanged) + number(p.lastChanged);
      if (p.sampling > 0) header += number(p.sampling);
    }
    header += number(static_cast<std::uint32_t>(p.name.size())) + p.name;
    return index == 255 ? header + number(static_cast<std::uint32_t>(p.metadata.size())) + p.metadata
                        : header;
  }

  std::string file_{};
  std::vector<std::string> table_{};
};

}  // namespace ringlet::test
