// Implements ranks.h.
#include "mpi/ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "ringlet/base/archive.h"

#ifdef RINGLET_HAS_MPI
#include <fcntl.h>
#include <mpi.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <thread>

namespace ringlet::mpi {
namespace {

Ranks here;
MPI_Comm rowsBetween = MPI_COMM_NULL;  // of the parts' rows alone
int standardError = -1;                // where it was before this rank fell silent
std::vector<bool> isTold;              // on rank 0, of each: to leave; on another, its own
bool hasServed = false;                // another, whose hair was asked for

// A launcher of MPI says how many it starts.
bool isStartedWithOthers() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
    if (const char* value = std::getenv(name))
      if (std::string_view(name) == "PMIX_RANK" || std::string_view(value) != "1") return true;
  return false;
}

void fallSilent() {
  standardError = dup(STDERR_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere < 0) return;
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

// MPI's own wait keeps a core busy, on which a device of the kind CPU could work.
void waitFor(int rank) {
  int isHere = 0;
  constexpr std::chrono::microseconds kFirst(20), kLongest(300);
  for (auto sleep = kFirst; MPI_Iprobe(rank, 0, MPI_COMM_WORLD, &isHere, MPI_STATUS_IGNORE), !isHere;
       sleep = std::min(kLongest, 3 * sleep / 2))
    std::this_thread::sleep_for(sleep);
}

class RankLink : public PartLink {
 public:
  RankLink(std::vector<std::vector<std::uint32_t>> parts, std::size_t own)
      : PartLink(std::move(parts), own) {}

  Status exchange(std::span<const Message> messages) override {
    std::vector<MPI_Request> requests;
    for (const auto& [part, out, in] : messages) {
      const int rank = static_cast<int>(part);
      MPI_Irecv(in.data(), lengthOf(in), MPI_UINT32_T, rank, 0, rowsBetween, &requests.emplace_back());
      MPI_Isend(out.data(), lengthOf(out), MPI_UINT32_T, rank, 0, rowsBetween, &requests.emplace_back());
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    return {};
  }
  Status sum(std::span<std::uint32_t> numbers) override {
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_UINT32_T, MPI_SUM,
                  rowsBetween);
    return {};
  }
  Status largest(std::span<std::int32_t> numbers) override {
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_INT32_T, MPI_MAX,
                  rowsBetween);
    return {};
  }
  void fail(const Error& why) override { endRanks(why.message); }

 private:
  // In units of 4 bytes: as integers they go far enough.
  static int lengthOf(std::span<const std::byte> bytes) {
    return static_cast<int>(bytes.size() / sizeof(std::uint32_t));
  }
};

}  // namespace

Ranks ranks() { return here; }

std::string joinRanks(int argumentCount, char** arguments) {
  if (!isStartedWithOthers()) return {};
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &here.own);
  MPI_Comm_size(MPI_COMM_WORLD, &here.count);
  MPI_Comm_dup(MPI_COMM_WORLD, &rowsBetween);
  isTold.resize(static_cast<std::size_t>(here.count));
  if (here.own > 0) fallSilent();
  const std::string_view command = argumentCount > 1 ? arguments[1] : "";
  if (here.count == 1 || command == "simulate" || command == "scene") return {};
  return fmt::format("only simulate and scene run on several ranks; start `ringlet {}` without them",
                     command);
}

void leaveRanks(int exitCode) {
  if (rowsBetween == MPI_COMM_NULL) return;
  const std::uint32_t leave = kLeave;
  if (here.own == 0) {
    for (int rank = 1; rank < here.count; ++rank)
      if (!isTold[static_cast<std::size_t>(rank)]) sendTo(rank, std::as_bytes(std::span(&leave, 1)));
  } else {
    if (!hasServed) {
      Archive answer = Archive::writing();
      std::string why = fmt::format("rank {} has no hair: it ended with exit status {}", here.own, exitCode);
      answer.text(why);
      sendTo(0, answer.take());
    }
    while (!isTold[static_cast<std::size_t>(here.own)]) (void)receiveFrom(0);
  }
  MPI_Comm_free(&rowsBetween);
  MPI_Finalize();
}

bool isToldToLeave() { return here.own > 0 && isTold[static_cast<std::size_t>(here.own)]; }

void sendTo(int rank, std::span<const std::byte> bytes) {
  if (rank > 0 && saysLeave(bytes)) isTold[static_cast<std::size_t>(rank)] = true;
  if (rank == 0) hasServed = true;
  std::uint64_t size = bytes.size();
  MPI_Send(&size, 1, MPI_UINT64_T, rank, 0, MPI_COMM_WORLD);
  constexpr std::size_t kMost = std::size_t{1} << 30;
  for (std::size_t at = 0; at < bytes.size(); at += kMost)
    MPI_Send(bytes.data() + at, static_cast<int>(std::min(kMost, bytes.size() - at)), MPI_BYTE, rank, 0,
             MPI_COMM_WORLD);
}

std::vector<std::byte> receiveFrom(int rank) {
  std::uint64_t size = 0;
  waitFor(rank);
  MPI_Recv(&size, 1, MPI_UINT64_T, rank, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  std::vector<std::byte> bytes(size);
  constexpr std::size_t kMost = std::size_t{1} << 30;
  for (std::size_t at = 0; at < bytes.size(); at += kMost)
    MPI_Recv(bytes.data() + at, static_cast<int>(std::min(kMost, bytes.size() - at)), MPI_BYTE, rank, 0,
             MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  if (here.own > 0 && saysLeave(bytes)) isTold[static_cast<std::size_t>(here.own)] = true;
  return bytes;
}

std::vector<std::byte> fromFirst(std::vector<std::byte> bytes) {
  if (here.own > 0) return receiveFrom(0);
  for (int rank = 1; rank < here.count; ++rank) sendTo(rank, bytes);
  return bytes;
}

std::unique_ptr<PartLink> linkRanks(std::vector<std::vector<std::uint32_t>> parts) {
  return std::make_unique<RankLink>(std::move(parts), static_cast<std::size_t>(here.own));
}

void endRanks(const std::string& why) {
  const std::string line =
      fmt::format("ringlet: rank {}: {}; all ranks end, and a run with checkpoints goes on with --resume\n",
                  here.own, why);
  const int out = standardError >= 0 ? standardError : STDERR_FILENO;
  (void)!write(out, line.data(), line.size());
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();
}

}  // namespace ringlet::mpi

#else

namespace ringlet::mpi {

Ranks ranks() { return {}; }
std::string joinRanks(int, char**) {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (size == nullptr || std::string_view(size) == "1") return {};
  return "this ringlet was built without MPI, and runs without mpirun only; build it where libopenmpi-dev is "
         "installed";
}
void leaveRanks(int) {}
void sendTo(int, std::span<const std::byte>) {}
std::vector<std::byte> receiveFrom(int) { return {}; }
std::vector<std::byte> fromFirst(std::vector<std::byte> bytes) { return bytes; }
bool isToldToLeave() { return false; }
std::unique_ptr<PartLink> linkRanks(std::vector<std::vector<std::uint32_t>>) { return nullptr; }
void endRanks(const std::string&) { std::abort(); }

}  // namespace ringlet::mpi

#endif
