#!/usr/bin/env bash
# Breaks what takes long over and over, begins it again each time, and holds what it wrote in the end, file by file and name
# by name, against what it writes without a break. Usage: scripts/break_runs.sh [KILLS FULL_DISKS LOST_DEVICES] (200 50 20).
# KILLS are divided among the jobs below; full disks and lost devices meet `simulate`. Needs the preset ci, with its
# tests. Exit status 0: all alike, and nothing left over.
set -euo pipefail
set -m # else what runs beside would ignore SIGINT
cd "$(dirname "$0")/.."
kills=${1:-200} disks=${2:-50} devices=${3:-20}
ringlet=$PWD/build/ci/ringlet layers=$PWD/build/ci/tests/layers
export LC_ALL=C OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
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

# Every job writes into the folder "out", and goes on there when it is called again.
again=(--checkpoint 5 --resume --overwrite --quiet -o out)
simulate() { exec "$ringlet" simulate scene.toml --cache float32 --also hair.usdc,hair.abc,hair.pc2 "${again[@]}"; }
clips() { exec "$ringlet" simulate scene.toml --clips 10 --usd-values velocities --no-sheet "${again[@]}"; }
ranks() {
  exec mpirun --oversubscribe -n 2 "$ringlet" simulate scene.toml --cache float32 --no-sheet --contacts explicit "${again[@]}"
}
sweep() {
  exec "$ringlet" sweep scene.toml --vary material.dials.hold=1,2 --vary simulation.frames=50 --jobs 2 --quiet -o out
}
render() { exec "$ringlet" render whole.rgc --frames 1:12 --size 480x270 --quiet -o out; }
convert() { mkdir -p out && exec "$ringlet" convert whole.rgc out/hair.usdc --overwrite; }
jobs=(simulate clips ranks sweep render convert)

# What a job wrote, but for times of day and of stepping, which are in the tables of a sweep.
names() { (cd "$1" && find . | LC_ALL=C sort); }
alike() { # JOB
  local file
  [ "$(names "whole_$1")" = "$(names out)" ] || { diff <(names "whole_$1") <(names out) || true; return 1; }
  (cd "whole_$1" && find . -type f) | while read -r file; do
    case $file in
      *run.json | *sweep.json | *sweep.csv) ;;
      *) cmp -s "whole_$1/$file" "out/$file" || { echo "$file differs"; return 1; } ;;
    esac
  done
}

differing=0 finished=0
check() { # JOB AFTER
  finished=$((finished + 1))
  alike "$1" > differs.txt || { echo "DIFFERS, $1 after $2: $(cat differs.txt)"; differing=$((differing + 1)); }
  rm -rf out
}
finish() { # JOB AFTER
  [ -d out ] || return 0
  ("$1") > resume.txt 2>&1 || { echo "FAILED, $1 after $2: $(cat resume.txt)"; exit 1; }
  check "$1" "$2"
}

# A process of the job: itself, or one that it started.
one_of() {
  local all
  mapfile -t all < <(echo "$1"; pgrep -P "$1" || true)
  echo "${all[RANDOM % ${#all[@]}]}"
}

# Half of the signals cannot be caught.
signals=(KILL TERM KILL INT KILL HUP)
break_job() { # JOB KILLS
  local k pid status ended=0 signal began=$EPOCHREALTIME most
  ("$1") > whole.txt 2>&1 || { echo "FAILED, $1 without a break: $(cat whole.txt)"; exit 1; }
  most=$(awk -v from="$began" -v to="$EPOCHREALTIME" 'BEGIN { print to - from }')
  mv out "whole_$1"
  for ((k = 0; k < $2; )); do
    "$1" > killed.txt 2>&1 & pid=$!
    sleep "$(awk -v r=$RANDOM -v most=$most 'BEGIN { print most * r / 32768 }')"
    signal=${signals[RANDOM % ${#signals[@]}]}
    if kill -s "$signal" "$(one_of $pid)" 2> /dev/null; then k=$((k + 1)); fi
    status=0
    wait $pid 2> /dev/null || status=$?
    while pgrep -f -- "^$ringlet " > /dev/null; do sleep 0.1; done # ranks outlive an mpirun that is killed, and keep the folder
    case $status in
      0) check "$1" "a run to its end" && ended=$((ended + 1)) ;;
      13[07] | 12[89] | 143 | 255 | 12) ;; # of a signal; mpirun of a rank that was killed
      1) # mpirun that got the signal itself; its ranks say nothing, or that they were interrupted
        if [ "$1" != ranks ] || grep -qv ': warning: \|: interrupted after ' killed.txt; then
          echo "UNEXPECTED exit status 1, $1 after SIG$signal: $(cat killed.txt)" && differing=$((differing + 1))
        fi ;;
      *)
        echo "UNEXPECTED exit status $status, $1 after SIG$signal: $(cat killed.txt)" && differing=$((differing + 1)) ;;
    esac
  done
  finish "$1" "$2 kills"
  echo "$1: $2 kills, $((ended + 1)) runs to their end"
}

each=$(((kills + ${#jobs[@]} - 1) / ${#jobs[@]}))
for job in "${jobs[@]}"; do
  [ "$each" = 0 ] || break_job "$job" "$each"
  [ "$job" != simulate ] || [ "$each" = 0 ] || cp whole_simulate/hair.rgc whole.rgc
done
echo "$((each * ${#jobs[@]})) kills: $finished whole runs, $differing differ"

[ -d whole_simulate ] || { (simulate) > whole.txt 2>&1 && mv out whole_simulate; }
size=$(stat -c %s whole_simulate/hair.usda)
for ((k = 1; k <= disks; ++k)); do
  status=0
  (ulimit -f $((1 + RANDOM * size / 32768 / 1024)); simulate) > full.txt 2>&1 || status=$?
  [ $status = 6 ] || { echo "expected exit status 6, found $status: $(cat full.txt)"; exit 1; }
done
finish simulate "$disks full disks"
echo "$disks full disks: $finished whole runs, $differing differ"

for ((k = 1; k <= devices; ++k)); do
  status=0
  (
    export VK_LAYER_PATH=$layers VK_INSTANCE_LAYERS=VK_LAYER_RINGLET_fault
    export RINGLET_FAULT=vkQueueSubmit:$((3 + RANDOM % 20)):-4
    simulate
  ) > lost.txt 2>&1 || status=$?
  if [ $status = 0 ]; then
    check simulate "a run to its end"
    k=$((k - 1))
    continue
  fi
  [ $status = 10 ] || { echo "expected exit status 10, found $status: $(cat lost.txt)"; exit 1; }
done
finish simulate "$devices lost devices"
echo "$devices lost devices: $finished whole runs, $differing differ"
exit $((differing > 0))
