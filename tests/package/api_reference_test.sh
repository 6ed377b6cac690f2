#!/usr/bin/env bash
# The API reference is made without a warning, has every function of C and what comments behind members say; a comment that doxygen
# warns of fails it. Skipped, with 77, where doxygen is not installed.
#   api_reference_test.sh REPOSITORY
set -euo pipefail
root=$1
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
fail() { echo "api_reference_test: $*" >&2; exit 1; }
command -v doxygen > /dev/null || { echo "SKIPPED, NOTHING WAS TESTED: doxygen is not installed"; exit 77; }

"$root/scripts/api_reference.sh" "$work/api" > "$work/out.txt" 2>&1 || fail "$(cat "$work/out.txt")"
[ -s "$work/api/index.html" ] || fail "there is no index.html"
# Names that pages have, each once.
names=$work/names.txt
find "$work/api" -name '*.html' -not -name '*_source.html' -exec grep -ohwE 'ringlet_[a-z_0-9]+|Simulation|HairAsset|Settings|readGroom' {} + | sort -u > "$names"
for name in $(sed -n 's/.*\b\(ringlet_[a-z_0-9]*\)(.*/\1/p' "$root"/src/ringlet/c/*.h) Simulation HairAsset Settings readGroom; do
  grep -qx "$name" "$names" || fail "$name is not in the reference"
done
grep -q 'capsule \[m\]' "$work/api"/structringlet_1_1Body.html || fail "what stands behind a member of C++ is not in the reference"
grep -q '1 for the short form of .rgc' "$work/api"/structringlet__animation__options.html ||
  fail "what stands behind a member of C is not in the reference"

# A list that says what is not there, as doxygen tells.
mkdir -p "$work/copy"
cp -r "$root/scripts" "$work/copy"
mkdir -p "$work/copy/src" && cp -r "$root/src/ringlet" "$root/src/CMakeLists.txt" "$work/copy/src"
rm "$work/copy/src/ringlet/scene/settings.h"
! "$work/copy/scripts/api_reference.sh" "$work/broken" > "$work/out.txt" 2>&1 || fail "a header that is not there is no error"
grep -q "scene/settings.h" "$work/out.txt" || fail "the missing header is not named: $(cat "$work/out.txt")"
