// Result<T>: a value, or a message that tells a person what failed and what to do.
// For the world's fault (file, device, memory, settings); the caller's own fault is an assert (assert.h).
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "ringlet/base/assert.h"

namespace ringlet {

/// Whose fault a failure is, for a program that decides what to do next: `ringlet` has an exit status for
/// each.
enum class Fault {
  other,
  input,         // a file that cannot be read: missing, no permission, changed meanwhile
  output,        // a file or folder that cannot be written
  diskFull,      // nor more of it: the disk, a quota, a limit of the process
  busy,          // another process is writing it
  hostMemory,    // is used up
  deviceMemory,  // likewise
  deviceLost,    // the driver gave up on it
  compile,       // the driver does not make a kernel
};

/// What failed, as a sentence for a person: what was tried, what was found, what to do.
struct Error {
  std::string message;
  Fault fault = Fault::other;
};

/// Either a T or an Error. Test it before use: `if (!result) return result.error();`
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Error error) : error_(std::move(error)) {}

  explicit operator bool() const { return value_.has_value(); }

  T& operator*() & {
    RINGLET_ASSERT(value_, "a Result was read without testing it");
    return *value_;
  }
  const T& operator*() const& {
    RINGLET_ASSERT(value_, "a Result was read without testing it");
    return *value_;
  }
  T&& operator*() && {
    RINGLET_ASSERT(value_, "a Result was read without testing it");
    return std::move(*value_);
  }
  T* operator->() { return &**this; }
  const T* operator->() const { return &**this; }

  const Error& error() const {
    RINGLET_ASSERT(!value_, "a Result without an error was asked for it");
    return error_;
  }

 private:
  std::optional<T> value_;
  Error error_;
};

/// The Result of an operation without a value: `Status{}` is success.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}

  explicit operator bool() const { return !error_; }
  const Error& error() const {
    RINGLET_ASSERT(error_, "a Status without an error was asked for it");
    return *error_;
  }

 private:
  std::optional<Error> error_;
};
using Status = Result<void>;

}  // namespace ringlet
