#!/usr/bin/env bash
# Looks through sources with clang-tidy, as .clang-tidy says; changes nothing. About 15 s a file and core.
#   scripts/tidy.sh [FILE...]    without files: the library, the reference, parity and the program
# Ends with 1 where something was found, with 77 where it cannot be looked for.
set -euo pipefail
cd "$(dirname "$0")/.."
if ! command -v clang-tidy > /dev/null; then
  echo "SKIPPED, NOTHING WAS LOOKED THROUGH: clang-tidy is not installed (Debian: apt-get install clang-tidy)"
  exit 77
fi
cmake --preset clang -B build/tidy -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON > /dev/null
# What sources include and the build writes: the kernels.
ninja -C build/tidy -t targets all | sed -n 's/^\(shaders\/ringlet_shaders\/.*\.h\): CUSTOM_COMMAND.*/\1/p' |
  xargs ninja -C build/tidy >&2  # what does not compile is said
files=("$@")
[ ${#files[@]} -gt 0 ] || mapfile -t files < <(find src reference -name '*.cpp' | sort)
printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -I{} clang-tidy --quiet -p build/tidy {} 2> /dev/null
echo "clang-tidy finds nothing in ${#files[@]} files."
