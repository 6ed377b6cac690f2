#!/usr/bin/env bash
# Fuzzes the readers: builds the fuzzers, makes their seeds, and runs each for so many seconds.
#   scripts/fuzz.sh SECONDS [FUZZER...]    hair_file, scene_run, ...; without names all of tests/fuzz
# Ends with 1 where a fuzzer found something (its input is in build/fuzz/findings), with 77 without Clang's libFuzzer.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:?usage: scripts/fuzz.sh SECONDS [FUZZER...]}
shift

program=$(mktemp)
trap 'rm -f "$program"' EXIT
if ! echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' |
  clang++ -fsanitize=fuzzer,address,undefined -x c++ - -o "$program" 2> /dev/null; then
  echo "SKIPPED, NOTHING WAS FUZZED: clang++ with libFuzzer is not installed (Debian: apt-get install clang)"
  exit 77
fi

fuzzers=("$@")
[ ${#fuzzers[@]} -gt 0 ] || for source in tests/fuzz/*_fuzz.cpp; do fuzzers+=("$(basename "$source" _fuzz.cpp)"); done
cmake --preset fuzz > /dev/null
cmake --build build/fuzz --target make_seeds "${fuzzers[@]/%/_fuzz}"

build=$PWD/build/fuzz seeds=$PWD/build/fuzz/seeds findings=$PWD/build/fuzz/findings
rm -rf "$seeds"
"$build/tests/fuzz/make_seeds" "$seeds"
mkdir -p "$findings"

# The value of a statistic that libFuzzer prints at its end.
statistic() { sed -n "s/^stat::$1: *//p" "$log"; }

# Limits a file, at which libFuzzer calls it a finding; each reader's own bound is kMemory of its fuzzer.
limits=(-timeout=10 -rss_limit_mb=1024 -malloc_limit_mb=256 -detect_leaks=1)
failed=0
printf '%-20s %11s %9s %9s %8s  %s\n' fuzzer files features 'slowest s' 'peak MB' findings
for fuzzer in "${fuzzers[@]}"; do
  corpus=$build/corpus/$fuzzer log=$build/$fuzzer.log
  mkdir -p "$corpus"
  words=()
  [ ! -f "$seeds/$fuzzer.dict" ] || words=(-dict="$seeds/$fuzzer.dict")
  found=none
  if ! "$build/tests/fuzz/${fuzzer}_fuzz" "${limits[@]}" "${words[@]}" -max_total_time="$seconds" -max_len=8192 \
    -print_final_stats=1 -artifact_prefix="$findings/$fuzzer-" "$corpus" "$seeds/$fuzzer" > "$log" 2>&1; then
    found=$(grep -m1 -E '^(ringlet|SUMMARY|==[0-9]+== ?ERROR)|runtime error' "$log" || echo "see $log")
    kept=$(sed -n 's/.*written to //p' "$log" | tail -1)
    found="$found (${kept:-see $log})"
    failed=1
  fi
  features=$(grep -oE 'ft: [0-9]+' "$log" | tail -1 | tr -dc 0-9 || true)
  printf '%-20s %11s %9s %9s %8s  %s\n' "$fuzzer" "$(statistic number_of_executed_units)" "${features:--}" \
    "$(statistic slowest_unit_time_sec)" "$(statistic peak_rss_mb)" "$found"
done
exit $failed
