// Implements conform_check.h.
#include "program/device/conform_check.h"

namespace ringlet::program {

const char* wordOf(Check::Outcome outcome) {
  switch (outcome) {
    case Check::Outcome::right:
      return "right";
    case Check::Outcome::wrong:
      return "WRONG";
    case Check::Outcome::quirk:
      return "quirk";
    case Check::Outcome::skipped:
      return "skipped";
  }
  return "WRONG";
}

}  // namespace ringlet::program
