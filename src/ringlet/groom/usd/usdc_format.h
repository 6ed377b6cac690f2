// The crate format (.usdc) in numbers, in one place for its reader (usdc_file.h) and its writer
// (output/usd/usdc_writer.h).
//
//   byte   0  "PXR-USDC"
//          8  u8 major, minor, patch version
//         16  u64 where the table of contents begins
//             u64 count, and for each section char name[16], u64 begin, u64 size
//
//   TOKENS     u64 count, u64 size, packed: texts that end with NUL
//   STRINGS    u64 count, u32 token[count]
//   FIELDS     u64 count, packed integers: its name's token; packed: u64 value[count]
//   FIELDSETS  u64 count, packed integers: fields, each set ended by -1
//   PATHS      u64 count, u64 of these stored, three times packed integers: path, token (negative: of a
//              property), jump to the next sibling (-2 leaf, -1 child only, 0 sibling only): depth first
//   SPECS      u64 count, three times packed integers: path, first entry of its field set, what it is
//
//   Packed is u64 size and so many bytes (usdc_codec.h). A value is 64 bits: from the top array, inline,
//   packed, five that are 0, 8 of type, 48 of payload: the value itself, or where it begins.
//
//   array         u64 count, the elements; u32 before 0.7.0, and before 0.5.0 u32 1 in front
//   dictionary    u64 count; each u32 string, i64 8, u64 value, where values inside stand before theirs: as
//   of time
//                 samples, the 8 says how far on
//   list of names as of paths, with u32 string in place of path
//   list of paths u8 of which lists there are (usdc_values.cpp); each u64 count, u32 path[count]
//   time samples  i64 8, the value of the times (a vector of doubles); i64 8, u64 count, u64 value[count].
//                 The 8 is how far on that stands which is meant; readers follow it, from its own place
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ringlet::usdc {

inline constexpr std::string_view kMagic = "PXR-USDC";
inline constexpr std::size_t kHeaderSize = 88, kVersionOffset = 8, kTableOffset = 16, kSectionSize = 32,
                             kNameSize = 16;
inline constexpr unsigned kOldestMinor = 4, kNewestMinor = 13;  // that are read, 0.4.0 to 0.13.0
inline constexpr unsigned kWrittenMinor = 8;                    // every reader since 2020 knows it
inline constexpr std::array<std::string_view, 6> kSections{"TOKENS",    "STRINGS", "FIELDS",
                                                           "FIELDSETS", "PATHS",   "SPECS"};
inline constexpr std::uint32_t kNone = 0xffffffff;  // ends a field set
inline constexpr std::size_t kFewestPacked = 16;    // elements of an array that is packed

/// Jumps of PATHS; above 0: a child, and the sibling so many entries on.
inline constexpr std::int32_t kLeaf = -2, kChildOnly = -1, kSiblingOnly = 0;

enum class SpecType : std::uint32_t { attribute = 1, prim = 6, root = 7, relationship = 8, last = 11 };

// Types of values that are no numbers or texts, or are named in the code.
inline constexpr std::uint32_t kBoolType = 1, kIntType = 3, kFloatType = 8, kDoubleType = 9, kStringType = 10,
                               kTokenType = 11, kAssetType = 12, kMatrix4dType = 15, kHalf2Type = 21,
                               kVec3fType = 24, kDictionaryType = 31, kTokenListType = 32,
                               kStringListType = 33, kPathListType = 34, kTokenVectorType = 41,
                               kSpecifierType = 42, kVariabilityType = 44, kVariantMapType = 45,
                               kSamplesType = 46, kDoubleVectorType = 48, kStringVectorType = 50,
                               kBlockType = 51;

/// Of a list that changes another: which of its parts there are.
inline constexpr std::byte kPrependedItems{32};

/// A type of values: numbers of one kind, so many an element; or texts.
enum class Kind : std::uint8_t { none, boolean, u8, i32, u32, i64, u64, half, f32, f64, token, string };
struct Type {
  Kind kind = Kind::none;
  std::uint8_t width = 1;
  bool isQuaternion = false, isMatrix = false;
};

/// By the type's number in a value.
inline constexpr std::array<Type, 31> kTypes = {{{},
                                                 {Kind::boolean},
                                                 {Kind::u8},
                                                 {Kind::i32},
                                                 {Kind::u32},
                                                 {Kind::i64},
                                                 {Kind::u64},
                                                 {Kind::half},
                                                 {Kind::f32},
                                                 {Kind::f64},
                                                 {Kind::string},
                                                 {Kind::token},
                                                 {},
                                                 {Kind::f64, 4, false, true},
                                                 {Kind::f64, 9, false, true},
                                                 {Kind::f64, 16, false, true},
                                                 {Kind::f64, 4, true},
                                                 {Kind::f32, 4, true},
                                                 {Kind::half, 4, true},
                                                 {Kind::f64, 2},
                                                 {Kind::f32, 2},
                                                 {Kind::half, 2},
                                                 {Kind::i32, 2},
                                                 {Kind::f64, 3},
                                                 {Kind::f32, 3},
                                                 {Kind::half, 3},
                                                 {Kind::i32, 3},
                                                 {Kind::f64, 4},
                                                 {Kind::f32, 4},
                                                 {Kind::half, 4},
                                                 {Kind::i32, 4}}};

/// Bytes of one number of the kind.
constexpr std::size_t sizeOf(Kind kind) {
  switch (kind) {
    case Kind::boolean:
    case Kind::u8:
      return 1;
    case Kind::half:
      return 2;
    case Kind::i64:
    case Kind::u64:
    case Kind::f64:
      return 8;
    default:
      return 4;
  }
}

/// The 64 bits of a value.
struct Rep {
  std::uint64_t bits = 0;

  bool isArray() const { return bits >> 63 & 1; }
  bool isInline() const { return bits >> 62 & 1; }
  bool isPacked() const { return bits >> 61 & 1; }
  bool isKnown() const { return (bits >> 56 & 31) == 0; }
  std::uint32_t type() const { return static_cast<std::uint32_t>(bits >> 48 & 255); }
  std::uint64_t payload() const { return bits & 0xffffffffffff; }
  std::uint32_t low() const { return static_cast<std::uint32_t>(bits); }
  Rep asType(std::uint32_t type) const {
    return {(bits & ~(std::uint64_t{255} << 48)) | std::uint64_t{type} << 48};
  }

  static constexpr Rep inlined(std::uint32_t type, std::uint32_t value) {
    return {std::uint64_t{1} << 62 | std::uint64_t{type} << 48 | value};
  }
  static constexpr Rep at(std::uint32_t type, std::uint64_t place) {
    return {std::uint64_t{type} << 48 | place};
  }
  static constexpr Rep arrayAt(std::uint32_t type, std::uint64_t place) {
    return {std::uint64_t{1} << 63 | std::uint64_t{type} << 48 | place};
  }
};
/// "None": there is no value.
inline constexpr Rep kBlock = Rep::inlined(kBlockType, 0);

}  // namespace ringlet::usdc
