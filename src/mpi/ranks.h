// Ranks: this process, and those that mpirun or srun started beside it for one run of hair. Rank 0 runs the
// program; each other one has a part of the hair and does what rank 0 says (rank_hair.h). Built without
// MPI, or started alone, a process is rank 0 of one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ringlet/solver/part_link.h"

namespace ringlet::mpi {

struct Ranks {
  int own = 0, count = 1;
};
Ranks ranks();

/// At the program's start; ranks but 0 say nothing on standard output and error from then on. What is wrong
/// with this command line on several ranks, or nothing.
std::string joinRanks(int argumentCount, char** arguments);
/// At its end, whatever that is: no rank waits for one that has left.
void leaveRanks(int exitCode);

/// Bytes from one rank to another, in order; rank 0 is one of the two.
void sendTo(int rank, std::span<const std::byte> bytes);
std::vector<std::byte> receiveFrom(int rank);
/// What rank 0 has, on every rank; all call this. Another rank may be told to leave instead.
std::vector<std::byte> fromFirst(std::vector<std::byte> bytes);
/// What rank 0 sends last.
inline constexpr std::uint32_t kLeave = 0;
inline bool saysLeave(std::span<const std::byte> bytes) {
  std::uint32_t call = kLeave + 1;
  if (bytes.size() == sizeof call) std::memcpy(&call, bytes.data(), sizeof call);
  return call == kLeave;
}

/// Whether rank 0 has told this one to leave.
bool isToldToLeave();

/// A PartLink among all ranks, each with a part. Where one fails, all end, with what it says.
std::unique_ptr<PartLink> linkRanks(std::vector<std::vector<std::uint32_t>> parts);
[[noreturn]] void endRanks(const std::string& why);

}  // namespace ringlet::mpi
