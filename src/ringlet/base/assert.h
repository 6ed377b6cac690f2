// RINGLET_ASSERT: the caller broke a rule of the interface (a span of the wrong size). On in every build
// type, because the checks are cheap and a wrong size would otherwise become wrong hair.
#pragma once

#include <cstdio>
#include <cstdlib>

#define RINGLET_ASSERT(condition, message)                                                        \
  do {                                                                                            \
    if (!(condition)) {                                                                           \
      std::fprintf(stderr, "ringlet: %s:%d: %s (%s)\n", __FILE__, __LINE__, message, #condition); \
      std::abort();                                                                               \
    }                                                                                             \
  } while (false)
