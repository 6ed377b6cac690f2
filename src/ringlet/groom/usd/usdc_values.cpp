// Implements groom/usd/usdc_values.h.
#include "ringlet/groom/usd/usdc_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "ringlet/base/half.h"
#include "ringlet/base/little_endian.h"
#include "ringlet/groom/usd/usd_value_at.h"

namespace ringlet::usdc {
namespace {

// Bounds on what a file unpacks to, of its size: equal values are stored once, so that a file may have more
// numbers than bytes.
constexpr std::size_t kNumbersPerByte = 16, kFreeNumbers = 1 << 16;
// Entries of dictionaries and names in lists, likewise.
constexpr std::size_t kEntriesPerByte = 1, kFreeEntries = 1 << 10;

}  // namespace

double CrateValues::numberAt(Kind kind, std::uint64_t at) const {
  switch (kind) {
    case Kind::boolean:
      return std::to_integer<unsigned>(crate_.bytes()[at]) != 0;
    case Kind::u8:
      return std::to_integer<unsigned>(crate_.bytes()[at]);
    case Kind::i32:
      return static_cast<std::int32_t>(readU32(crate_.bytes(), at));
    case Kind::i64:
      return static_cast<double>(static_cast<std::int64_t>(readU64(crate_.bytes(), at)));
    case Kind::u64:
      return static_cast<double>(readU64(crate_.bytes(), at));
    case Kind::half:
      return halfValue(readU16(crate_.bytes(), at));
    case Kind::f32:
      return readF32(crate_.bytes(), at);
    case Kind::f64:
      return readF64(crate_.bytes(), at);
    default:
      return readU32(crate_.bytes(), at);
  }
}

Result<Type> CrateValues::typeOf(Rep rep) const {
  const std::uint32_t number = rep.type();
  const Type type = number < kTypes.size() ? kTypes[number] : Type{};
  if (!rep.isKnown())
    return Error{fmt::format("{}: found a value that edits an array, of a newer USD", crate_.name())};
  if (type.kind == Kind::none)
    return Error{
        fmt::format("{}: found a value of type {}; expected numbers or names", crate_.name(), number)};
  return type;
}

// Of `elements` at most.
Result<UsdValue> CrateValues::valueOf(Rep rep, std::uint64_t mostElements) {
  UsdValue value;
  if (rep.type() == kBlockType) {
    value.isBlocked = true;
    return value;
  }
  const auto type = typeOf(rep);
  if (!type) return type.error();
  value.width = type->width;
  const bool isText = type->kind == Kind::token || type->kind == Kind::string;
  const bool isAlwaysInline = (type->width == 1 && sizeOf(type->kind) <= 4) || rep.type() == kHalf2Type;
  Status read;
  if (rep.isArray()) {
    read = readArray(rep, *type, mostElements, value);
  } else if (isText) {
    auto text = crate_.textOf(type->kind, rep.low());
    if (!text) return text.error();
    value.texts.push_back(*text);
  } else if (rep.isInline() || isAlwaysInline) {
    read = readInline(rep, *type, value);
  } else {
    if (!crate_.has(rep.payload(), type->width * sizeOf(type->kind)))
      return crate_.ended(rep.payload(), "a value");
    readNumbers(*type, rep.payload(), 1, value);
  }
  if (!read) return read.error();
  // Stored i, j, k, r; as in text the real part comes first.
  if (type->isQuaternion) {
    for (std::size_t i = 0; i + 4 <= value.numbers.size(); i += 4)
      std::rotate(value.numbers.begin() + static_cast<std::ptrdiff_t>(i),
                  value.numbers.begin() + static_cast<std::ptrdiff_t>(i + 3),
                  value.numbers.begin() + static_cast<std::ptrdiff_t>(i + 4));
  }
  return value;
}

Status CrateValues::readInline(Rep rep, const Type& type, UsdValue& value) {
  const std::uint32_t bits = rep.low();
  const auto small = [&](std::size_t i) {
    return static_cast<double>(static_cast<std::int8_t>(bits >> 8 * i));
  };
  if (type.isMatrix) {
    const std::size_t side = type.width == 4 ? 2 : type.width == 9 ? 3 : 4;
    value.numbers.assign(type.width, 0);
    for (std::size_t i = 0; i < side; ++i) value.numbers[i * side + i] = small(i);
  } else if (rep.type() == kHalf2Type) {
    value.numbers = {halfValue(bits & 0xffff), halfValue(bits >> 16)};
  } else if (type.width > 1) {
    if (type.isQuaternion)
      return Error{fmt::format("{}: found a quaternion in a value's own bits", crate_.name())};
    for (std::size_t i = 0; i < type.width; ++i) value.numbers.push_back(small(i));
  } else if (type.kind == Kind::half) {
    value.numbers = {halfValue(bits & 0xffff)};
  } else if (type.kind == Kind::f32 || type.kind == Kind::f64) {
    value.numbers = {std::bit_cast<float>(bits)};
  } else if (type.kind == Kind::boolean || type.kind == Kind::u8) {
    value.numbers = {static_cast<double>(bits & 255)};
  } else if (type.kind == Kind::i32 || type.kind == Kind::i64) {
    value.numbers = {static_cast<double>(static_cast<std::int32_t>(bits))};
  } else {
    value.numbers = {static_cast<double>(bits)};
  }
  return {};
}

void CrateValues::readNumbers(const Type& type, std::uint64_t at, std::size_t count, UsdValue& value) const {
  value.numbers.reserve(count * type.width);
  for (std::size_t i = 0; i < count * type.width; ++i, at += sizeOf(type.kind))
    value.numbers.push_back(numberAt(type.kind, at));
}

Status CrateValues::readArray(Rep rep, const Type& type, std::uint64_t mostElements, UsdValue& value) {
  if (rep.payload() == 0) return {};
  CrateStructure::Cursor cursor{rep.payload(), crate_.bytes().size()};
  const bool isShortCount = crate_.minorVersion() < 7;
  if (crate_.minorVersion() < 5) cursor.at += 4;  // the rank, which is 1
  if (!crate_.has(cursor.at, isShortCount ? 4 : 8)) return crate_.ended(rep.payload(), "an array");
  const std::uint64_t count =
      isShortCount ? readU32(crate_.bytes(), cursor.at) : readU64(crate_.bytes(), cursor.at);
  cursor.at += isShortCount ? 4 : 8;
  if (count > mostElements)
    return crate_.wrong(rep.payload(), fmt::format("{} elements", count),
                        fmt::format("at most {}", mostElements));

  const bool isPacked = rep.isPacked() && crate_.minorVersion() >= 5 && count >= kFewestPacked;
  const std::size_t size = type.width * sizeOf(type.kind);
  if (!isPacked && count > cursor.left() / size)
    return crate_.ended(rep.payload(), fmt::format("{} elements", count));
  const std::uint64_t most = crate_.mostOf(kNumbersPerByte, kFreeNumbers);
  if (count > most || count * type.width > most - numbersRead_) {
    return crate_.wrong(rep.payload(), fmt::format("{} more elements", count),
                        fmt::format("at most {} numbers in so small a file", most));
  }
  numbersRead_ += count * type.width;

  if (isPacked) {
    if (type.width != 1 || (type.kind != Kind::i32 && type.kind != Kind::u32)) {
      return crate_.wrong(rep.payload(), fmt::format("a packed array of type {}", rep.type()),
                          "integers, which alone can be packed here");
    }
    const auto integers = crate_.takeIntegers(cursor, static_cast<std::size_t>(count));
    if (!integers) return integers.error();
    value.numbers.assign(integers->begin(), integers->end());
    if (type.kind == Kind::u32) {
      for (double& number : value.numbers) number += number < 0 ? 4294967296.0 : 0;
    }
  } else if (type.kind == Kind::token || type.kind == Kind::string) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto text = crate_.textOf(type.kind, readU32(crate_.bytes(), cursor.at + 4 * i));
      if (!text) return text.error();
      value.texts.push_back(*text);
    }
  } else {
    readNumbers(type, cursor.at, static_cast<std::size_t>(count), value);
  }
  return {};
}

// Where the value stands that the number at `at` leads to; it counts from itself, and never backwards.
Result<std::uint64_t> CrateValues::placeAfter(std::uint64_t at) const {
  if (!crate_.has(at, 8)) return crate_.ended(at, "time samples");
  const std::uint64_t step = readU64(crate_.bytes(), at);
  if (step < 8 || step > crate_.bytes().size() || !crate_.has(at + step, 8))
    return crate_.wrong(at, fmt::format("a value {} bytes on", step), "one in the file, behind this");
  return at + step;
}

// None: count is 0.
Result<CrateValues::Samples> CrateValues::samplesOf(Rep rep) const {
  const auto times = placeAfter(rep.payload());
  if (!times) return times.error();
  const Rep timesRep{readU64(crate_.bytes(), *times)};
  const bool isList =
      timesRep.type() == kDoubleVectorType || (timesRep.type() == kDoubleType && timesRep.isArray());
  if (!isList || !crate_.has(timesRep.payload(), 8)) return crate_.wrong(*times, "no list of times", "one");
  Samples samples{.count = readU64(crate_.bytes(), timesRep.payload()), .times = timesRep.payload() + 8};
  if (samples.count == 0) return samples;
  if (samples.count > (crate_.bytes().size() - samples.times) / 8)
    return crate_.ended(*times, fmt::format("{} times", samples.count));
  const auto values = placeAfter(*times + 8);
  if (!values) return values.error();
  samples.reps = *values + 8;
  if (readU64(crate_.bytes(), *values) != samples.count || !crate_.has(*values, 8 + 8 * samples.count))
    return crate_.ended(*values, fmt::format("{} samples", samples.count));
  return samples;
}

double CrateValues::timeOf(const Samples& samples, std::uint64_t i) const {
  return readF64(crate_.bytes(), samples.times + 8 * i);
}

Result<UsdValue> CrateValues::sampleOf(const Samples& samples, std::uint64_t i, std::uint64_t mostElements) {
  return valueOf({readU64(crate_.bytes(), samples.reps + 8 * i)}, mostElements);
}

Status CrateValues::checkTimes(const Samples& samples) const {
  for (std::uint64_t i = 0; i < samples.count; ++i)
    if (!std::isfinite(timeOf(samples, i)) || (i > 0 && !(timeOf(samples, i) > timeOf(samples, i - 1))))
      return crate_.wrong(samples.times - 8, "times that do not rise", "finite ones, in order");
  return {};
}

Status CrateValues::readSamples(Rep rep, std::uint64_t mostElements, Kept kept, UsdAttribute& attribute) {
  const auto samples = samplesOf(rep);
  if (!samples) return samples.error();
  if (samples->count == 0) return {};
  if (Status rising = checkTimes(*samples); !rising) return rising;
  attribute.time = timeOf(*samples, 0);
  attribute.isSampled = samples->count > 1;
  if (kept == Kept::places) {
    for (std::uint64_t i = 0; i < samples->count; ++i)
      attribute.places.push_back({timeOf(*samples, i), readU64(crate_.bytes(), samples->reps + 8 * i)});
    return {};
  }
  // All; or of what may begin empty the first that is not, else the first.
  for (std::uint64_t i = 0; i < samples->count; ++i) {
    auto value = sampleOf(*samples, i, mostElements);
    if (!value) return value.error();
    if (kept == Kept::all) {
      attribute.samples.push_back({timeOf(*samples, i), std::move(*value)});
      continue;
    }
    const bool isEmpty = value->numbers.empty() && value->texts.empty();
    if (i > 0 && isEmpty) continue;
    if (i > 0) attribute.emptyTime = timeOf(*samples, 0);
    attribute.time = timeOf(*samples, i);
    attribute.value = std::move(*value);
    if (!isEmpty || !mayBeginEmpty(attribute.name)) break;
  }
  if (kept == Kept::all) attribute.value = attribute.samples.front().value;
  return {};
}

Status CrateValues::readSamplesAt(double time, Rep rep, std::uint64_t mostElements, UsdAttribute& attribute) {
  const auto samples = samplesOf(rep);
  if (!samples) return samples.error();
  if (samples->count == 0) return {};
  if (Status rising = checkTimes(*samples); !rising) return rising;
  time = usdTimeOf(attribute.name, time);
  std::uint64_t after = 0;
  while (after < samples->count && !(timeOf(*samples, after) > time)) ++after;
  std::vector<UsdSample> around;
  for (std::uint64_t i = after - (after > 0); i < std::min(after + 1, samples->count); ++i) {
    auto value = sampleOf(*samples, i, mostElements);
    if (!value) return value.error();
    around.push_back({timeOf(*samples, i), std::move(*value)});
    if (around.back().time == time || !goesBetweenUsdSamples(attribute.name)) break;
  }
  attribute.time = time;
  attribute.value = usdValueAt(around, time);
  return {};
}

bool CrateValues::isRead(Rep rep) {
  return rep.isKnown() && (rep.type() == kBlockType || rep.type() == kAssetType ||
                           (rep.type() < kTypes.size() && kTypes[rep.type()].kind != Kind::none));
}

// How many entries it has.
Result<std::uint64_t> CrateValues::beginDictionary(Rep rep) {
  if (rep.type() != kDictionaryType || !rep.isKnown())
    return crate_.wrong(rep.payload(), fmt::format("a value of type {}", rep.type()), "a dictionary");
  if (rep.isInline()) return std::uint64_t{0};
  if (!crate_.has(rep.payload(), 8)) return crate_.ended(rep.payload(), "a dictionary");
  const std::uint64_t count = readU64(crate_.bytes(), rep.payload());
  if (count > kMostUsdEntries)
    return crate_.wrong(rep.payload(), fmt::format("a dictionary of {} entries", count),
                        fmt::format("at most {}", kMostUsdEntries));
  const std::uint64_t most = crate_.mostOf(kEntriesPerByte, kFreeEntries);
  if (count > most - entriesRead_)
    return crate_.wrong(rep.payload(), fmt::format("{} more entries of dictionaries", count),
                        fmt::format("at most {} in so small a file", most));
  entriesRead_ += count;
  return count;
}

Result<CrateValues::Entry> CrateValues::entryAt(std::uint64_t at) const {
  if (!crate_.has(at, 4)) return crate_.ended(at, "an entry of a dictionary");
  const auto key = crate_.textOf(Kind::string, readU32(crate_.bytes(), at));
  if (!key) return key.error();
  const auto value = placeAfter(at + 4);
  if (!value) return value.error();
  return Entry{*key, {readU64(crate_.bytes(), *value)}, *value + 8};
}

Status CrateValues::readNameEdits(Rep rep, std::vector<UsdNameEdit>& edits) {
  std::uint64_t at = rep.payload();
  if (rep.type() != kStringListType || !crate_.has(at, 1)) return crate_.wrong(at, "no list of names", "one");
  const unsigned lists = std::to_integer<unsigned>(crate_.bytes()[at++]);
  constexpr std::pair<unsigned, std::string_view> kLists[] = {{2, ""},        {4, "add"},    {32, "prepend"},
                                                              {64, "append"}, {8, "delete"}, {16, "reorder"}};
  if ((lists & 3) == 1) edits.emplace_back();  // explicit, and empty
  for (const auto& [bit, edit] : kLists) {
    if ((lists & bit) == 0) continue;
    if (!crate_.has(at, 8)) return crate_.ended(at, "a list of names");
    const std::uint64_t count = readU64(crate_.bytes(), at);
    at += 8;
    if (count > kMostUsdEntries || !crate_.has(at, 4 * count))
      return crate_.ended(at, fmt::format("{} names", count));
    if (count > crate_.mostOf(kEntriesPerByte, kFreeEntries) - entriesRead_)
      return crate_.wrong(at, fmt::format("{} more names", count), "fewer in so small a file");
    entriesRead_ += count;
    UsdNameEdit& names = edits.emplace_back(UsdNameEdit{.edit = edit});
    for (std::uint64_t k = 0; k < count; ++k, at += 4) {
      const auto name = crate_.textOf(Kind::string, readU32(crate_.bytes(), at));
      if (!name) return name.error();
      names.names.push_back(*name);
    }
  }
  return {};
}

// Whether a list of changes, a dictionary or a list of names holds something. What we do not know does.
bool CrateValues::isFilled(Rep rep) const {
  const std::uint64_t at = rep.payload();
  const std::uint32_t type = rep.type();
  if (type == kDictionaryType && (rep.isInline() || !crate_.has(at, 8))) return false;
  if (type == kDictionaryType || type == kVariantMapType || type == kStringVectorType)
    return crate_.has(at, 8) && readU64(crate_.bytes(), at) > 0;
  const bool isListEdit = (type >= 32 && type <= 39) || type == 55;
  if (!isListEdit) return type != kBlockType;
  if (!crate_.has(at, 1)) return true;
  // Bits of the lists that follow, each with its count: explicit 2, added 4, prepended 32, appended 64
  // bring in, deleted 8 and ordered 16 do not. The first that brings in stands first.
  const unsigned lists = std::to_integer<unsigned>(crate_.bytes()[at]);
  if ((lists & (2 | 4 | 32 | 64)) == 0) return false;
  return !crate_.has(at + 1, 8) || readU64(crate_.bytes(), at + 1) > 0 ||
         std::popcount(lists & (2u | 4 | 32 | 64)) > 1;
}

Result<double> CrateValues::numberOf(Rep rep) {
  const auto value = valueOf(rep);
  if (!value) return value.error();
  if (value->numbers.size() != 1)
    return Error{fmt::format("{}: found {} numbers; expected one", crate_.name(), value->numbers.size())};
  return value->numbers.front();
}
Result<std::string_view> CrateValues::nameOf(Rep rep) {
  const auto value = valueOf(rep);
  if (!value) return value.error();
  if (value->texts.size() != 1)
    return Error{fmt::format("{}: found {} names; expected one", crate_.name(), value->texts.size())};
  return value->texts.front();
}

}  // namespace ringlet::usdc
