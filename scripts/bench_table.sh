#!/usr/bin/env bash
# The strand kernel's table of docs/performance.md, in Markdown, from what scripts/bench.sh wrote.
#   scripts/bench_table.sh bench/results/<device>/kernels_bench.csv
set -euo pipefail
[[ $# -eq 1 && -f $1 ]] || { echo "usage: scripts/bench_table.sh FILE.csv" >&2; exit 2; }

echo "| particles | lanes x run | steps a dispatch | device ms a step | times faster than the double reference | times the loop's time | share of the peak |"
echo "|---|---|---|---|---|---|---|"
# Rows of 2,048 strands; a pair of rows, 4 and 8 steps, makes one of the table.
awk -F, '
  /^name,/ { for (i = 1; i <= NF; ++i) { gsub(/"/, "", $i); column[$i] = i } next }
  /^"strand_step.*strands:2048/ {
    match($1, /particles:[0-9]+/); particles = substr($1, RSTART + 10, RLENGTH - 10)
    kernel = $column["label"]; sub(/^"lanes /, "", kernel); sub(/ \(.*/, "", kernel)
    row = sprintf("%.2f %.0f %.2f %.2f", $column["device_ms"], $column["over_reference"], $column["over_hand"], $column["of_peak"])
    if ($1 ~ /steps:4/) { split(row, four, " "); next }
    split(row, eight, " ")
    printf "| %s | %s | 4, 8 |", particles, kernel
    for (i = 1; i <= 4; ++i) printf " %s, %s |", four[i], eight[i]
    print ""
  }' "$1"
