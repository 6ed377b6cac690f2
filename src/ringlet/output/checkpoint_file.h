// The file that a run which was killed goes on from: what it was a run of, how many frames were done, and all
// that the frames after them depend on.
//
//   magic 8 | version u64 | checksum64 of the content u64 | bytes of the content u64 | content
//
// The content is an Archive (base/archive.h), as the machine has it in memory: the program that wrote it
// reads it, on such a machine. A file that is damaged, or another version's, is refused.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet {

/// Something a run depends on, and what it was: {"simulation.fps", "24"}.
struct RunFact {
  std::string name, value;
  bool operator==(const RunFact&) const = default;
};

struct Checkpoint {
  std::vector<RunFact> facts;       // of the run
  int everyFrames = 0;              // there is one
  int frame = 0;                    // frames done
  std::vector<std::byte> computed;  // state of the solver; empty for frame 0
  std::vector<std::byte> written;   // state of the writers and measures
};

/// Replaces the file; it is on the disk when this returns. A crash at any time leaves the one before or this
/// one. Errors: those of a file that cannot be written.
Status writeCheckpoint(const std::filesystem::path& path, Checkpoint checkpoint);

/// Errors: no such file, no checkpoint, one of another version, damaged.
Result<Checkpoint> readCheckpoint(const std::filesystem::path& path);

/// The first few differences between two runs, as "simulation.fps is 30 and was 24; ..."; empty if they are
/// equal.
std::string differencesOf(const std::vector<RunFact>& now, const std::vector<RunFact>& before);

}  // namespace ringlet
