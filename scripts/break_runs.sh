#!/usr/bin/env bash
# Breaks a run of 100 frames with contacts, a body and air over and over, goes on with it each time, and holds every output
# against that of a run without a break. Usage: scripts/break_runs.sh [KILLS FULL_DISKS LOST_DEVICES] (200 50 20).
# Needs the preset ci, with its tests. Exit status 0: all alike.
set -euo pipefail
cd "$(dirname "$0")/.."
kills=${1:-200} disks=${2:-50} devices=${3:-20}
ringlet=$PWD/build/ci/ringlet layers=$PWD/build/ci/tests/layers
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
cd "$work"

"$ringlet" make head --strands 150 --particles 32 -o head.obj > make.txt
cat > scene.toml <<'END'
[groom]
file = "head.obj"
[motion]
kind = "shake"
[simulation]
frames = 100
steps_per_frame = 8
[contacts]
on = true
radius = 0.004
[air]
on = true
wind = [1, 0, 2]
[[body]]
name = "head"
shape = "sphere"
radius = 0.08
END
run=("$ringlet" simulate scene.toml --cache float32 --checkpoint 5 --resume --overwrite --quiet)
"${run[@]}" -o whole 2> whole.txt
size=$(stat -c %s whole/hair.usda)

# Ends a run that was broken, and looks at it.
differing=0 finished=0
finish() {
  [ -d out ] || return 0
  "${run[@]}" -o out 2> resume.txt || { echo "FAILED after $1: $(cat resume.txt)"; exit 1; }
  check "$1"
}
check() {
  finished=$((finished + 1))
  for file in hair.usda hair.rgc last.obj sheet.png; do
    cmp -s "whole/$file" "out/$file" || { echo "DIFFERS after $1: $file"; differing=$((differing + 1)); }
  done
  rm -rf out
}

for ((k = 1; k <= kills; ++k)); do
  "${run[@]}" -o out 2> killed.txt & pid=$!
  sleep "$(awk -v r=$RANDOM 'BEGIN { print 0.05 + 2.5 * r / 32768 }')"
  if ! kill -KILL $pid 2> /dev/null; then
    wait $pid && check "a run to its end"
    k=$((k - 1))
    continue
  fi
  wait $pid 2> /dev/null || true
done
finish "$kills kills"
echo "$kills kills: $finished whole runs, $differing files differ"

for ((k = 1; k <= disks; ++k)); do
  status=0
  (ulimit -f $((1 + RANDOM * size / 32768 / 1024)); exec "${run[@]}" -o out) 2> full.txt || status=$?
  [ $status = 6 ] || { echo "expected exit status 6, found $status: $(cat full.txt)"; exit 1; }
done
finish "$disks full disks"
echo "$disks full disks: $finished whole runs, $differing files differ"

for ((k = 1; k <= devices; ++k)); do
  status=0
  VK_LAYER_PATH=$layers VK_INSTANCE_LAYERS=VK_LAYER_RINGLET_fault RINGLET_FAULT=vkQueueSubmit:$((3 + RANDOM % 20)):-4 \
    "${run[@]}" -o out 2> lost.txt || status=$?
  if [ $status = 0 ]; then
    check "a run to its end"
    k=$((k - 1))
    continue
  fi
  [ $status = 10 ] || { echo "expected exit status 10, found $status: $(cat lost.txt)"; exit 1; }
done
finish "$devices lost devices"
echo "$devices lost devices: $finished whole runs, $differing files differ"
exit $((differing > 0))
