// Numbers of the Alembic format that its reader and its writer share; what stands where is drawn in
// abc_archive.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace ringlet {

/// Before the values of every sample, and behind the headers of an object's children [bytes].
inline constexpr std::size_t kAbcDigestBytes = 16, kAbcHashesBytes = 32;
/// In place of a metadata index: the text follows.
inline constexpr std::uint32_t kAbcTextInPlace = 255;

/// Of a property's header: bits 0 and 1 its kind, 2 and 3 the size of the numbers behind, which of these are
/// there, and what they would say.
inline constexpr std::uint32_t kAbcKindBits = 0x3, kAbcSizeBits = 0xc, kAbcHasSampling = 0x100,
                               kAbcHasChanged = 0x200, kAbcIsHomogenous = 0x400, kAbcIsConstant = 0x800;
inline constexpr std::uint32_t kAbcScalar = 1, kAbcArray = 2, kAbcArrayOfOne = 3;
inline constexpr unsigned kAbcTypeShift = 4, kAbcWidthShift = 12, kAbcMetadataShift = 20;

}  // namespace ringlet
