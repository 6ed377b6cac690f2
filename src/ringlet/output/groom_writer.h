// Writes grooms, choosing the format by the ending of the file's name; and which formats there are. They are
// read by groom/groom_file.h.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/up_axis.h"

namespace ringlet {

/// What a file says of a groom beside its strands and their unit, where its format can.
struct GroomWriting {
  std::optional<UpAxis> up{};  // none: unknown, and not stated
  /// What nothing at rest has stays off: velocities, a head, clips; and a tip's width, as no other is known.
  UsdExtras usd{};
};

/// Writes a groom so that reading it gives the same bits. An existing file is replaced only once all is
/// written. Errors: another extension, a groom without strands, a strand of fewer than
/// two particles or with one that is not finite, what the format cannot hold, a full disk.
Status writeGroom(const std::filesystem::path& path, const Groom& groom, const GroomWriting& writing = {});

/// A row of the table of formats, of which options, help and messages are made.
struct WrittenGroomFormat {
  const char* ending;      // with its dot, in small letters
  bool isStating = false;  // its unit, its up axis, and what GroomWriting::usd has
  Status (*write)(const std::filesystem::path& path, const Groom& groom, const GroomWriting& writing);
};

std::span<const WrittenGroomFormat> writtenGroomFormats();
/// By the ending of the name, in upper or lower case; null for one that is none of theirs.
const WrittenGroomFormat* writtenGroomFormatOf(const std::filesystem::path& path);
/// All of their endings: ".hair", ".obj"; and as a sentence has them, `last` before the last of them: ".hair,
/// .obj ... and .usdc".
std::vector<std::string> writtenGroomEndings();
std::string writtenGroomEndings(const char* last);

}  // namespace ringlet
