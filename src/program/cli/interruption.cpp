// Implements interruption.h.
#include "program/cli/interruption.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

#include "program/cli/exit_codes.h"

namespace ringlet::program {
namespace {

// The signal may arrive on any thread.
std::atomic<int> interrupted = 0;
static_assert(std::atomic<int>::is_always_lock_free);

std::atomic<int> unheard = 0;      // number of living EndsUnheard
constexpr unsigned kPatience = 2;  // [s]

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};

bool isIgnored(int signal) {
  struct sigaction now {};
  return sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

// Calls only functions that are allowed in a signal handler, such as sigaction and raise.
void noteInterruption(int signal) {
  const bool isSecond = interrupted.exchange(1) != 0;
  // For the next signal of any kind the system's own handler runs.
  for (const int each : kSignals) {
    if (!isIgnored(each)) std::signal(each, SIG_DFL);
  }
  // The second signal arrived before the first was handled.
  if (isSecond) raise(signal);
  if (unheard > 0) alarm(kPatience);
}

// Calls only functions that are allowed in a signal handler.
void endUnheard(int) {
  if (unheard == 0) return;
  constexpr std::string_view kText = "ringlet: interrupted while the driver was at work; nothing is lost\n";
  (void)!write(STDERR_FILENO, kText.data(), kText.size());
  _exit(kExitInterrupted);
}

}  // namespace

void catchInterruption() {
  struct sigaction action {};
  action.sa_handler = noteInterruption;
  action.sa_flags = SA_RESTART;  // file operations do not fail because of the first signal
  for (const int signal : kSignals) {
    if (!isIgnored(signal)) sigaction(signal, &action, nullptr);  // stays ignored, as under nohup
  }
  struct sigaction late {};
  late.sa_handler = endUnheard;
  late.sa_flags = SA_RESTART;
  sigaction(SIGALRM, &late, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

bool wasInterrupted() { return interrupted != 0; }

EndsUnheard::EndsUnheard() {
  ++unheard;
  if (interrupted != 0) alarm(kPatience);
}
EndsUnheard::~EndsUnheard() {
  if (--unheard == 0) alarm(0);
}

void failInsteadOfEnding() { std::signal(SIGXFSZ, SIG_IGN); }

}  // namespace ringlet::program
