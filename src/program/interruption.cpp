// Implements interruption.h.
#include "program/interruption.h"

#include <atomic>
#include <csignal>

namespace ringlet::program {
namespace {

// The signal may come to any thread.
std::atomic<int> interrupted = 0;
static_assert(std::atomic<int>::is_always_lock_free);

void noteInterruption(int) { interrupted = 1; }

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
  std::signal(SIGPIPE, SIG_IGN);
}

bool wasInterrupted() { return interrupted != 0; }

void failInsteadOfEnding() { std::signal(SIGXFSZ, SIG_IGN); }

}  // namespace ringlet::program
