// CrateValues: what the values of a crate (.usdc) are: numbers, texts, time samples. Only those that are
// asked for are decoded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/usd/usd_layer.h"
#include "ringlet/groom/usd/usdc_structure.h"

namespace ringlet::usdc {

class CrateValues {
 public:
  /// The structure, read, must live as long.
  explicit CrateValues(const CrateStructure& crate) : crate_(crate) {}

  /// Numbers or texts, of `mostElements` elements at most. All that is ever decoded is bounded by the size of
  /// the file.
  Result<UsdValue> valueOf(Rep rep, std::uint64_t mostElements = ~std::uint64_t{0});
  Result<double> numberOf(Rep rep);
  Result<std::string_view> nameOf(Rep rep);

  /// Of an attribute's samples the first, all, or where each of them is.
  enum class Kept { first, all, places };
  Status readSamples(Rep rep, std::uint64_t mostElements, Kept kept, UsdAttribute& attribute);
  /// The value at a time, of usd_value_at.h; at most two samples are decoded.
  Status readSamplesAt(double time, Rep rep, std::uint64_t mostElements, UsdAttribute& attribute);

  /// Whether valueOf() knows values of this type; an asset is a token.
  static bool isRead(Rep rep);
  /// Calls take(key, value) for each entry, until one fails. Errors: no dictionary; one of more entries than
  /// kMostUsdEntries; more of all than the file's size allows.
  template <class Take>
  Status readDictionary(Rep rep, Take take) {
    auto left = beginDictionary(rep);
    if (!left) return left.error();
    for (std::uint64_t at = rep.payload() + 8; *left > 0; --*left) {
      const auto entry = entryAt(at);
      if (!entry) return entry.error();
      if (Status taken = take(entry->key, entry->value); !taken) return taken;
      at = entry->end;
    }
    return {};
  }
  /// The lists of a list of names, in the order in which they count.
  Status readNameEdits(Rep rep, std::vector<UsdNameEdit>& edits);

  /// Whether a list of changes, a dictionary or a list of names holds something. What we do not know does.
  bool isFilled(Rep rep) const;

 private:
  struct Entry {
    std::string_view key{};
    Rep value{};
    std::uint64_t end = 0;  // where the next begins
  };
  Result<std::uint64_t> beginDictionary(Rep rep);
  Result<Entry> entryAt(std::uint64_t at) const;
  double numberAt(Kind kind, std::uint64_t at) const;
  Result<Type> typeOf(Rep rep) const;
  Status readInline(Rep rep, const Type& type, UsdValue& value);
  void readNumbers(const Type& type, std::uint64_t at, std::size_t count, UsdValue& value) const;
  Status readArray(Rep rep, const Type& type, std::uint64_t mostElements, UsdValue& value);
  Result<std::uint64_t> placeAfter(std::uint64_t at) const;
  struct Samples {
    std::uint64_t count = 0, times = 0, reps = 0;  // and where these are, 8 bytes each
  };
  Result<Samples> samplesOf(Rep rep) const;
  double timeOf(const Samples& samples, std::uint64_t i) const;
  Result<UsdValue> sampleOf(const Samples& samples, std::uint64_t i, std::uint64_t mostElements);
  Status checkTimes(const Samples& samples) const;

  const CrateStructure& crate_;
  std::uint64_t numbersRead_ = 0, entriesRead_ = 0;
};

}  // namespace ringlet::usdc
