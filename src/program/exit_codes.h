// What the program returns to the shell.
#pragma once

namespace ringlet::program {

inline constexpr int kExitFine = 0;
inline constexpr int kExitFailed = 1;         // the world's fault: a file, the device, memory
inline constexpr int kExitUsage = 2;          // the command line makes no sense
inline constexpr int kExitNonfinite = 3;      // the run ended, but some particles have no position
inline constexpr int kExitInterrupted = 130;  // Ctrl-C, as shells have it: 128 + SIGINT

}  // namespace ringlet::program
