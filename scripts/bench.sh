#!/usr/bin/env bash
# Builds release and runs every benchmark; each verifies before it times. Figures go to bench/results/<device>/*.csv, with how
# they came about in their first lines. For figures worth keeping: on a quiet machine.
#   scripts/bench.sh                      all of it, some 6 minutes on two cores
#   scripts/bench.sh --quick --json FILE  what matters about the strand kernel, in less than a minute, as JSON
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  echo "usage: scripts/bench.sh [--quick --json FILE]" >&2
  exit 2
}
quick=false
json=
while [[ $# -gt 0 ]]; do
  case $1 in
    --quick) quick=true ;;
    --json) [[ $# -ge 2 ]] || usage; json=$2; shift ;;
    *) usage ;;
  esac
  shift
done
if [[ $quick == true && -z $json || $quick == false && -n $json ]]; then usage; fi
json=${json:+$(realpath -m "$json")}

# A tree that is configured was made ready before; otherwise what it needs is installed.
[[ -f build/release/CMakeCache.txt ]] || scripts/install_packages.sh
cmake --preset release -DRINGLET_BUILD_BENCHMARKS=ON > /dev/null
targets=(quick_bench)
$quick || targets+=(kernels_bench step_bench contacts_bench quality_bench)
cmake --build --preset release --target "${targets[@]}"

bin=build/release/bench
if $quick; then
  mkdir -p "$(dirname "$json")"
  exec $bin/quick_bench "$json"
fi

log=$(mktemp -d)
trap 'rm -rf "$log"' EXIT

# header COMMAND: what a figure needs to be believed.
header() {
  echo "# commit $(git describe --always --dirty --abbrev=12), $(date --utc +%Y-%m-%d)"
  sed -nE 's/^((device|[0-9]+ cores|hand-vectorised loop)[:;] .*)/# \1/p' "$log/out"
  echo "# $1"
}
# The device's name, as its programs print it, made into a folder's.
folder() {
  local name
  name=$(sed -n 's/^device: \([^(]*\) (.*/\1/p' "$log/out" | head -n 1 | tr '[:upper:]' '[:lower:]' | tr -cs 'a-z0-9' '-')
  echo "bench/results/$(sed 's/^-*//; s/-*$//' <<< "$name")"
}
# save NAME: the rows in $log/csv.
save() {
  local to
  to=$(folder)
  mkdir -p "$to"
  { header "$bin/$1"; cat "$log/csv"; } > "$to/$1.csv"
  echo "wrote $to/$1.csv"
}

for name in kernels_bench step_bench contacts_bench; do
  $bin/$name --benchmark_out="$log/csv" --benchmark_out_format=csv | tee "$log/out"
  save $name
done
# A table for people, its columns two spaces apart.
$bin/quality_bench | tee "$log/out"
sed -e '/^device: /d' -e 's/, / /' -e 's/   */,/g' "$log/out" > "$log/csv"
save quality_bench
