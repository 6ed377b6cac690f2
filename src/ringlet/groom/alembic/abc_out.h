// AbcOut: an Alembic archive on its way into bytes, as abc_archive.h draws it: a description of objects and
// properties, their samples, and the tree of groups and headers that leads to these.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/groom/alembic/abc_archive.h"
#include "ringlet/groom/alembic/abc_format.h"

namespace ringlet {

struct AbcOutProperty {
  std::string name, metadata{};
  AbcKind kind = AbcKind::compound;
  AbcType type = AbcType::boolean;
  unsigned width = 1;             // values of an element
  std::string values{};           // of the one sample that is stored, as the file has them
  std::size_t sampleBytes = 0;    // above 0: it moves, and each sample has so many bytes in place of `values`
  bool isCounted = false;         // it has a sample for each of the animation, as what moves has
  bool comesLater = false;        // its samples are known one frame after the others
  std::uint32_t sampleCount = 1;  // that the header states
  std::uint64_t samples = 0;      // the place of the group of its samples
  std::vector<AbcOutProperty> parts{};  // of a compound

  bool isMoving() const { return sampleBytes > 0; }
  /// Children of the group of samples for each of them: an array has its dimensions as well.
  std::uint64_t childrenPerSample() const { return kind == AbcKind::array ? 2 : 1; }
};

struct AbcOutObject {
  std::string name, metadata{};
  std::vector<AbcOutProperty> properties{};
  std::vector<AbcOutObject> children{};
};

struct AbcOutSampling {
  double secondsPerFrame = 1, firstSecond = 0;
  std::uint32_t mostSamples = 1;
};

struct AbcOutArchive {
  std::string metadata;
  std::vector<AbcOutSampling> samplings{{}};  // isCounted properties have the last of them
  std::vector<AbcOutObject> objects{};
};

/// Little-endian bytes.
void putAbcU32(std::string& bytes, std::uint32_t value);
void putAbcU64(std::string& bytes, std::uint64_t value);
void putAbcF64(std::string& bytes, double value);
/// A number as the type has it; integers are rounded, and what the type does not hold becomes its nearest.
void putAbcNumber(std::string& bytes, AbcType type, double value);

/// How a group names data: at a place, or empty data.
constexpr std::uint64_t abcDataWord(std::uint64_t place) { return place | std::uint64_t{1} << 63; }
inline constexpr std::uint64_t kAbcNoData = abcDataWord(0);

/// 16 bytes that differ where the bytes do, but for one case in 2^64.
std::string abcDigest(std::string_view bytes);

/// The first 16 bytes of a file, which lead to the root group.
std::string abcFileHeader(std::uint64_t rootPlace);

/// Appends what is stored of a property and of its parts, multiples of 8 bytes, to `bytes`, which begin at
/// the file's begin, and sets their `samples`. What moves gets a group with room for `mostSamples`, each
/// empty data until a writer puts a place there.
void putAbcSamples(AbcOutProperty& property, std::uint32_t mostSamples, std::string& bytes);

struct AbcTree {
  std::string bytes;  // a multiple of 8; as many whatever the counts of samples are
  std::uint64_t rootPlace = 0;
};
/// The tree that stands at `place`, a multiple of 8. `content`: of which the hashes of objects are made; it
/// differs where samples do.
AbcTree abcTreeAt(std::uint64_t place, const AbcOutArchive& archive, std::string_view content);

/// A whole file of what never moves.
std::string abcFileOf(AbcOutArchive archive);

}  // namespace ringlet
