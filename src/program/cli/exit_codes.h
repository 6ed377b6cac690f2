// The exit statuses of the program.
#pragma once

#include "program/cli/standard_error.h"
#include "ringlet/base/result.h"

namespace ringlet::program {

inline constexpr int kExitFine = 0;
inline constexpr int kExitFailed = 1;         // an environment failure that is none of those below
inline constexpr int kExitUsage = 2;          // the command line is invalid
inline constexpr int kExitNonfinite = 3;      // the run ended, but some particles have no position
inline constexpr int kExitInput = 4;          // a file cannot be read, or has the wrong content
inline constexpr int kExitOutput = 5;         // a file or folder cannot be written
inline constexpr int kExitDiskFull = 6;       // or the quota or the maximum file size is reached
inline constexpr int kExitBusy = 7;           // another run has the folder
inline constexpr int kExitHostMemory = 8;     // host memory is used up
inline constexpr int kExitDeviceMemory = 9;   // device memory is used up
inline constexpr int kExitDeviceLost = 10;    // the driver gave up on the device
inline constexpr int kExitCompile = 11;       // the driver cannot compile a kernel
inline constexpr int kExitInterrupted = 130;  // Ctrl-C, as shells have it: 128 + SIGINT

inline int exitCodeOf(const Error& error) {
  switch (error.fault) {
    case Fault::input:
      return kExitInput;
    case Fault::output:
      return kExitOutput;
    case Fault::diskFull:
      return kExitDiskFull;
    case Fault::busy:
      return kExitBusy;
    case Fault::hostMemory:
      return kExitHostMemory;
    case Fault::deviceMemory:
      return kExitDeviceMemory;
    case Fault::deviceLost:
      return kExitDeviceLost;
    case Fault::compile:
      return kExitCompile;
    case Fault::other:
      break;
  }
  return kExitFailed;
}

/// Prints what ended the command and returns its exit status.
inline int fail(const char* command, const Error& error) {
  say("ringlet {}: {}\n", command, error.message);
  return exitCodeOf(error);
}

}  // namespace ringlet::program
