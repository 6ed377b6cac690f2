// AbcArchive: what an Alembic file has in its Ogawa container: objects below each other, and their properties
// with samples over time. It knows no schema. Numbers of samples are decoded where they are asked for.
//   root      0 data i32 0; 1 data i32 library version (10000 major + 100 minor + patch); 2 the top object;
//             3 data, metadata of the archive; 4 data, time samplings; 5 data, table of metadata texts
//   sampling  u32 most samples, f64 time per cycle [s], u32 n, n f64 times [s]
//   table     texts, each u8 length and bytes; index 0: no text, i: the i-th, 255: the text stands in place
//   object    group: compound of its properties, child objects ..., data of their headers:
//             a child: u32 length, name, u8 metadata index; and 32 bytes of hashes at the end
//   compound  group: a group a property ..., data of their headers:
//             u32 bits; sample count; first and last changed sample; sampling; length, name; metadata.
//             Numbers have the size that the bits say; which of them are there they say too (abc_archive.cpp)
//   samples   scalar: a data each; array: data and its dimensions, u64 each; no dimensions where it has one.
//             Data begins with 16 bytes of a digest. Texts end with a 0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/alembic/ogawa_file.h"

namespace ringlet {

/// Of a property, by the format's numbers. wideText is not read.
enum class AbcType : std::uint8_t {
  boolean,
  u8,
  i8,
  u16,
  i16,
  u32,
  i32,
  u64,
  i64,
  f16,
  f32,
  f64,
  text,
  wideText
};
std::string_view nameOf(AbcType type);
std::size_t sizeOfAbc(AbcType type);  // of a value [bytes]

struct AbcObject {
  std::uint32_t parent = 0;     // of the top object its own
  std::string_view name{};      // empty: the top object
  std::string_view metadata{};  // "key=value;key=value"
  OgawaGroup parts{};
};

enum class AbcKind { compound, scalar, array };

struct AbcProperty {
  std::uint32_t object = 0;
  std::string_view within{};  // the compound's name; empty: the object's own
  std::string_view name{};
  std::string_view metadata{};
  AbcKind kind = AbcKind::compound;
  // Of samples:
  AbcType type = AbcType::boolean;
  unsigned width = 1;                               // values of an element
  std::uint32_t sampleCount = 0;                    // 1 and more, or 0: it has none
  std::uint32_t firstChanged = 0, lastChanged = 0;  // 0, 0: all are as the first
  std::uint32_t sampling = 0;
  OgawaChild place{};

  /// ".geom/P", for messages.
  std::string path() const;
  /// Samples as the file stores them: those before the first changed one are as sample 0, those after the
  /// last changed one as that.
  std::uint32_t storedCount() const {
    return sampleCount == 0 ? 0 : lastChanged - firstChanged + 1 + isChanging();
  }
  bool isChanging() const { return lastChanged > 0; }
  /// Which sample is the first that has what is stored at k.
  std::uint32_t sampleOfStored(std::uint32_t k) const { return k == 0 ? 0 : firstChanged + k - 1; }
};

/// A sample from which another one begins to hold, or up to which one holds.
struct AbcKnot {
  std::uint32_t sample = 0;
  std::uint32_t stored = 0;  // which one is stored for it
  double seconds = 0;
};

/// What is stored of one sample: a view of the file.
class AbcSample {
 public:
  AbcSample() = default;
  AbcSample(AbcType type, unsigned width, std::span<const std::byte> values);

  AbcType type() const { return type_; }
  std::span<const std::byte> bytes() const { return values_; }
  /// Numbers, or elements of `width` numbers; of texts 0.
  std::size_t numberCount() const;
  std::size_t elementCount() const { return numberCount() / width_; }
  /// k is less than numberCount().
  double number(std::size_t k) const;
  std::vector<std::string_view> texts() const;

 private:
  AbcType type_ = AbcType::boolean;
  unsigned width_ = 1;
  std::span<const std::byte> values_{};
};

class AbcArchive {
 public:
  /// Reads samplings, metadata and objects; `bytes` outlive it. Memory and time are linear in the file.
  /// Errors: those of OgawaFile; another version; parts that are missing or do not fit; objects more than 64
  /// deep, or more than the file has room for, as in a tree that goes in circles.
  static Result<AbcArchive> of(std::span<const std::byte> bytes, const std::string& name);

  const std::string& name() const { return file_.name(); }
  std::size_t byteCount() const { return file_.byteCount(); }
  /// What the file says of itself, "key=value;key=value".
  std::string_view metadata() const { return metadata_; }
  /// Parents first; the first is the top object.
  const std::vector<AbcObject>& objects() const { return objects_; }
  /// "/body/tube"; of the top object "/".
  std::string pathOf(std::uint32_t object) const;

  /// In the file's order.
  Result<std::vector<AbcProperty>> propertiesOf(std::uint32_t object) const;
  Result<std::vector<AbcProperty>> propertiesOf(const AbcProperty& compound) const;

  /// What is stored at k < storedCount(). Errors: fewer samples than announced; bytes that are no whole
  /// elements, or not as many as the dimensions say; texts of wide characters.
  Result<AbcSample> stored(const AbcProperty& property, std::uint32_t k) const;
  /// Where in the file that is: of two with one place the samples are equal.
  Result<OgawaChild> placeOfStored(const AbcProperty& property, std::uint32_t k) const;
  /// The samples that say all of its course, by rising time: one of what never changes. Errors: no sample;
  /// fewer stored than announced; a sampling without a time for one; times that do not rise.
  Result<std::vector<AbcKnot>> knotsOf(const AbcProperty& property) const;

  /// A bound on the numbers that a reader makes of samples: equal ones are stored once, so that a file may
  /// have more numbers than bytes.
  std::size_t mostNumbers() const { return 16 * byteCount() + (1 << 16); }
  /// "NAME: PATH: SENTENCE".
  Error wrong(std::uint32_t object, const std::string& sentence) const;

 private:
  struct Sampling {
    double perCycle = 1;
    std::span<const std::byte> times{};  // f64
  };
  struct Reading;

  explicit AbcArchive(OgawaFile file) : file_(std::move(file)) {}
  Status readParts();
  Status checkVersion(const OgawaGroup& root) const;
  Status readSamplings(std::span<const std::byte> bytes);
  Status readTexts(std::span<const std::byte> bytes);
  Status readObjects(const OgawaGroup& root);
  Status addChildren(std::uint32_t parent);
  Result<std::vector<AbcProperty>> propertiesIn(OgawaChild group, const AbcProperty& like) const;
  Result<AbcProperty> propertyAt(Reading& reading, const AbcProperty& like) const;
  static bool readSampleNumbers(Reading& reading, std::uint32_t bits, AbcProperty& property);
  Status checkDimensions(const AbcProperty& property, std::uint32_t k, const AbcSample& sample) const;
  Result<double> secondsOf(const AbcProperty& property, std::uint32_t sample) const;
  Error wrong(const AbcProperty& property, const std::string& sentence) const;
  Result<std::string_view> metadataAt(Reading& reading, std::uint32_t index, unsigned size) const;
  Error broken(const std::string& what) const;

  OgawaFile file_;
  std::string_view metadata_{};
  std::vector<Sampling> samplings_{};
  std::vector<std::string_view> texts_{};  // by metadata index
  std::vector<AbcObject> objects_{};
};

/// The one of this name; nullptr: there is none.
const AbcProperty* abcPropertyNamed(const std::vector<AbcProperty>& properties, std::string_view name);

/// The value of a key in a metadata text; empty where there is none.
std::string_view abcValueOf(std::string_view metadata, std::string_view key);
/// The same, of a value that is a number; nothing where it is none.
std::optional<double> abcNumberOf(std::string_view metadata, std::string_view key);

}  // namespace ringlet
