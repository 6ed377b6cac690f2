#!/usr/bin/env bash
# Checks how the sources are formatted; changes nothing. Ends with 1 where something is wrong, with 77 where it cannot be checked.
#   scripts/check_format.sh cpp       C++ as clang-format 14 writes it
#   scripts/check_format.sh shaders   no line of a shader is longer than 120 columns
set -euo pipefail
cd "$(dirname "$0")/.."

# files TEST...: sources that find's TEST is true of.
files() { find . \( -path ./build -o -path './.*' -o -path ./out \) -prune -o -type f \( "$@" \) -print | sort; }

case ${1:-} in
  cpp)
    if ! version=$(clang-format --version 2> /dev/null); then
      echo "SKIPPED, NOTHING WAS CHECKED: clang-format is not installed (Debian: apt-get install clang-format-14)"
      exit 77
    fi
    # Other versions format some lines otherwise.
    if [[ $version != *"version 14."* ]]; then
      echo "SKIPPED, NOTHING WAS CHECKED: clang-format 14 is needed, found: $version"
      exit 77
    fi
    files -name '*.cpp' -o -name '*.h' ! -path './shaders/*' | xargs clang-format --dry-run -Werror
    ;;
  shaders)
    long=$(files -path './shaders/*' -o -name '*.comp' | LC_ALL=C.UTF-8 xargs grep -nE '^.{121,}' || true)
    if [[ -n $long ]]; then
      echo "$long"
      echo "Shaders have at most 120 columns."
      exit 1
    fi
    ;;
  *)
    echo "usage: scripts/check_format.sh cpp|shaders" >&2
    exit 2
    ;;
esac
