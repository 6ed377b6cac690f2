// Implements interruption.h.
#include "program/interruption.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

#include "program/exit_codes.h"

namespace ringlet::program {
namespace {

// The signal may come to any thread.
std::atomic<int> interrupted = 0;
static_assert(std::atomic<int>::is_always_lock_free);

std::atomic<int> unheard = 0;      // EndsUnheard that live
constexpr unsigned kPatience = 2;  // [s]

void noteInterruption(int) {
  interrupted = 1;
  if (unheard > 0) alarm(kPatience);
}

// Only what a signal's handler may call.
void endUnheard(int) {
  if (unheard == 0) return;
  constexpr std::string_view kText = "ringlet: interrupted while the driver was at work; nothing is lost\n";
  (void)!write(STDERR_FILENO, kText.data(), kText.size());
  _exit(kExitInterrupted);
}

bool isIgnored(int signal) {
  struct sigaction now {};
  return sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

void catchInterruption() {
  struct sigaction action {};
  action.sa_handler = noteInterruption;
  // RESETHAND: the second one finds the system's own handler. RESTART: no file operation fails because of the
  // first.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    if (!isIgnored(signal)) sigaction(signal, &action, nullptr);  // as nohup asks for
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
