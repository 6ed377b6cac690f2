// Whose fault it is that a file could not be written.
#pragma once

#include <cerrno>

#include "ringlet/base/result.h"

namespace ringlet {

/// Of an errno: EFBIG is a file larger than the process may write, or the file system has.
inline Fault writeFault(int code) {
  return code == ENOSPC || code == EDQUOT || code == EFBIG ? Fault::diskFull : Fault::output;
}

}  // namespace ringlet
