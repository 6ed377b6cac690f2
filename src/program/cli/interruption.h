// Signals: Ctrl-C, noticed between frames so that what is finished can be kept, and those that are failures
// of a call.
#pragma once

namespace ringlet::program {

/// From now on the first Ctrl-C (or SIGTERM, SIGHUP, SIGQUIT) only sets a flag; the second ends the program
/// at once. A signal that is ignored stays so. Output that nobody reads any more is lost, and ends nothing.
void catchInterruption();

/// Whether it has come.
bool wasInterrupted();

/// Where the driver may be at work for minutes, in which nobody asks: while one of these lives, a first
/// signal that is not heard for two seconds ends the program with kExitInterrupted. Only where that loses
/// nothing: no file is written that is not replaced as a whole, and no other thread writes one.
/// catchInterruption comes before.
class EndsUnheard {
 public:
  EndsUnheard();
  ~EndsUnheard();
  EndsUnheard(const EndsUnheard&) = delete;
};

/// A file larger than the process may write (RLIMIT_FSIZE) fails to be written, and does not end the program.
void failInsteadOfEnding();

}  // namespace ringlet::program
