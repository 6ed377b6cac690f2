#!/usr/bin/env bash
# Writes the API reference of the headers that are installed, of C++ and C, as HTML: api_reference.sh [FOLDER]
# FOLDER is build/api where it is not said. A warning of doxygen's is an error. Without doxygen it says so and ends with 77.
set -euo pipefail
cd "$(dirname "$0")/.."
out=$(realpath -m "${1:-build/api}")
command -v doxygen > /dev/null || { echo "api_reference: doxygen is not installed (Debian: doxygen); nothing was written" >&2; exit 77; }

# The lists of src/CMakeLists.txt say what is installed.
headers=$(sed -n '/^set(\(core\|io\)_headers/,/)$/p' src/CMakeLists.txt | tr -s ' ()' '\n' | grep '\.h$' | sed 's|^|src/ringlet/|')
[ "$(wc -w <<< "$headers")" -gt 50 ] || { echo "api_reference: src/CMakeLists.txt lists few headers that are installed; was the list renamed?" >&2; exit 1; }

mkdir -p "$out"
log=$(mktemp) && trap 'rm -f "$log"' EXIT
doxygen - > "$log" 2>&1 << END || { grep -E 'warning|error' "$log" >&2 || cat "$log" >&2; exit 1; }
PROJECT_NAME = Ringlet
PROJECT_BRIEF = "Headers of the library, in C++ and C"
OUTPUT_DIRECTORY = "$out"
HTML_OUTPUT = .
GENERATE_LATEX = NO
INPUT = $(tr '\n' ' ' <<< "$headers")
FILTER_PATTERNS = *.h="awk -f scripts/api_reference.awk"
STRIP_FROM_PATH = src
STRIP_FROM_INC_PATH = src
FULL_PATH_NAMES = YES
EXTRACT_ALL = YES
JAVADOC_AUTOBRIEF = YES
AUTOLINK_SUPPORT = NO
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
PREDEFINED = __cplusplus
SORT_MEMBER_DOCS = NO
DISABLE_INDEX = NO
GENERATE_TREEVIEW = YES
HAVE_DOT = NO
WARN_AS_ERROR = FAIL_ON_WARNINGS
QUIET = YES
END
echo "api_reference: $(wc -w <<< "$headers") headers: $out/index.html"
