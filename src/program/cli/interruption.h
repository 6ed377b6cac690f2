// Signals: Ctrl-C, which is noticed between frames so that finished ones are kept, and signals that mean a
// failed call.
#pragma once

namespace ringlet::program {

/// From now on the first Ctrl-C (or SIGTERM, SIGHUP, SIGQUIT) only sets a flag; the second ends the program
/// at once. Ignored signals stay ignored. Writing to a closed pipe does not end the program.
void catchInterruption();

/// Whether the first signal has come.
bool wasInterrupted();

/// For phases in which the driver may work for minutes without anyone checking the flag: while one of these
/// lives, a first signal that is not noticed within two seconds ends the program with kExitInterrupted. Use
/// it only where this loses nothing: every file is replaced as a whole, and no other thread writes files.
/// Call catchInterruption before.
class EndsUnheard {
 public:
  EndsUnheard();
  ~EndsUnheard();
  EndsUnheard(const EndsUnheard&) = delete;
};

/// Makes writing a file beyond RLIMIT_FSIZE fail instead of ending the program.
void failInsteadOfEnding();

}  // namespace ringlet::program
