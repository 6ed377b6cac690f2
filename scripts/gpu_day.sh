#!/usr/bin/env bash
# A few minutes on a GPU of a machine where nothing can be installed, compiled or downloaded. What is measured there is
# on disk as soon as it is known, the most valuable first.
#   bash scripts/gpu_day.sh pack FILE.tar.gz            all that such a machine needs, as one archive of 64 MiB at most
#   bash gpu_day.sh run FOLDER [SECONDS] [NAME...]      there, beside the unpacked archive; 420 s, or SECONDS; only items
#                                                       whose name begins with a NAME
#   bash gpu_day.sh list [NAME...]                      the items with their limits
#   bash gpu_day.sh check FOLDER [NAME...]              whether FOLDER tells of every item
# pack takes build/release, or $RINGLET_BUILD, with its benchmarks and tests (docs/performance.md). PATIENCE=4: each limit
# of `run` four times as long, for a slow device. VK_DRIVER_FILES: a driver that is found in no usual place.
# The machine needs Linux on x86-64, the build machine's glibc or a newer one, bash, tar, and a GPU with its driver.
# FOLDER gets facts.txt, summary.txt (a line an item), results.jsonl (an object an item: item exit seconds result),
# log.txt (what items print), clocks.csv (of NVIDIA). Where `run` itself is killed, unfinished.txt and unfinished.json have
# what its last item told. Exit status of `run`: 0 all is well, 1 an item failed or was left out; its line says so.
set -uo pipefail

scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/gpu_day

# Drivers use libraries that come along too, and may need the system's, which are newer: from here only those that the
# system has none of by that name, and all of them where it has older ones.
use_libraries() {
  local known path was=${LD_LIBRARY_PATH:-}
  known=$( (ldconfig -p || /sbin/ldconfig -p) 2>/dev/null)
  mkdir -p "$work/lib"
  for path in "$here"/lib/*; do
    grep -qF "	${path##*/} (" <<<"$known" || ln -s "$path" "$work/lib/"
  done
  export LD_LIBRARY_PATH=$work/lib${was:+:$was}
  ringlet --version >/dev/null 2>&1 || export LD_LIBRARY_PATH=$here/lib${was:+:$was}
}

# limited SECONDS COMMAND...: ends it, and no longer waits for it where a driver does not let it be ended. What it prints
# belongs into a file: a pipe would wait.
limited() { timeout -s KILL $(($1 + 8)) timeout -k 3 "$@"; }

# finds TYPES: whether a device of these types can be used.
finds() {
  limited 15 ringlet devices --json >"$work/devices" 2>>"$out/log.txt"
  tr -d '\n ' <"$work/devices" | grep -Eq "\"type\":\"($1)\"[^}]*\"usable\":true"
}
finds_gpu() { finds 'discrete|integrated|virtual'; }
finds_any() { finds '[a-z]*'; }

# The driver's file that the loader is to use, of those that it does not look for itself.
use_driver() { export VK_DRIVER_FILES=$1 VK_ICD_FILENAMES=$1; }
find_driver() {
  finds_gpu && return 0
  [ -n "${VK_DRIVER_FILES:-}" ] && { finds_any; return; }
  export LD_LIBRARY_PATH=$LD_LIBRARY_PATH:/usr/local/nvidia/lib64:/usr/local/nvidia/lib:/usr/lib/x86_64-linux-gnu
  local file folder library files=() which vendor=/usr/local/nvidia/share/glvnd/egl_vendor.d/10_nvidia.json
  [ -f $vendor ] && export __EGL_VENDOR_LIBRARY_FILENAMES=$vendor
  for file in /usr/local/nvidia/share/vulkan/icd.d/*.json /opt/*/share/vulkan/icd.d/*.json /etc/vulkan/icd.d/*.json \
    /usr/share/vulkan/icd.d/*.json; do
    [ -f "$file" ] && files+=("$file")
  done
  # Without a display NVIDIA's driver works through libEGL_nvidia too, and then needs no X.
  for library in libEGL_nvidia.so.0 libGLX_nvidia.so.0; do
    for folder in /usr/local/nvidia/lib64 /usr/local/nvidia/lib /usr/lib/x86_64-linux-gnu /usr/lib64; do
      [ -e "$folder/$library" ] || continue
      printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "1.3.0"}}\n' \
        "$folder/$library" >"$work/$library.json"
      files+=("$work/$library.json")
      echo "$folder/$library lacks: $(ldd "$folder/$library" 2>&1 | grep 'not found' | tr -d '\n')" >>"$out/facts.txt"
      break
    done
  done
  # A processor will do where there is nothing else: this script is tried there.
  for which in finds_gpu finds_any; do
    for file in ${files[@]+"${files[@]}"}; do
      use_driver "$file"
      $which && return 0
    done
    unset VK_DRIVER_FILES VK_ICD_FILENAMES
  done
  finds_any
}

facts() {
  {
    echo "ringlet $(cat "$here/commit" 2>/dev/null), $(date --utc)"
    sed -n 's/^PRETTY_NAME=//p' /etc/os-release
    uname -srm
    ldd --version 2>&1 | head -n 1
    grep -m 1 'model name' /proc/cpuinfo
    echo "$(nproc) cores, $(sed -n 's/^MemTotal: *//p' /proc/meminfo)"
    command -v nvidia-smi >/dev/null && limited 15 nvidia-smi -q >"$work/smi" && grep -E 'Product Name|Driver Version|VBIOS|Max$|Link Gen|Link Width|Current +:|FB Memory|Total +:|ECC Mode|MIG Mode|Graphics +:|SM +:|Memory +:' "$work/smi" | head -n 60
    echo "driver: ${VK_DRIVER_FILES:-found by the loader}; LD_LIBRARY_PATH $LD_LIBRARY_PATH"
    limited 15 ringlet devices
    limited 15 ringlet devices --json
  } >>"$out/facts.txt" 2>&1
}

# chosen NAME: whether it is among those that were asked for.
chosen() {
  local name
  [ ${#only[@]} -eq 0 ] && return 0
  for name in "${only[@]}"; do [[ $1 == "$name"* ]] && return 0; done
  return 1
}
say() { echo "$*" | tee -a "$out/summary.txt"; }

# item NAME LIMIT COMMAND...: runs it, no longer than LIMIT and than what is left. Its result is the object that it writes
# to $json, or else what it prints from the first line on that begins with {. Its output is on disk while it runs.
item() {
  local name=$1 most=$2 begin=$SECONDS code seconds result end logged
  shift 2
  chosen "$name" || return 0
  if [ "$mode" = list ]; then printf '%-28s %4s s  %s\n' "$name" "$most" "$*"; return 0; fi
  if [ $((limit - SECONDS)) -lt 5 ]; then leave_out "$name" "no time"; return 0; fi
  # A driver that gave up on its device may have it again.
  if [ "$gone" = 1 ] && ! finds_any; then leave_out "$name" "the device is gone"; return 0; fi
  gone=0
  most=$((most * ${PATIENCE:-1}))
  [ "$most" -le $((limit - SECONDS)) ] || most=$((limit - SECONDS))
  printf '\n==== %s: %s\n' "$name" "$*" >>"$out/log.txt"
  logged=$(stat -c %s "$out/log.txt")
  rm -f "$json"
  # As limited, but in the background, so that a signal to this script is heard meanwhile.
  timeout -s KILL $((most + 8)) timeout -k 3 "$most" "$@" >"$out/unfinished.txt" 2>>"$out/log.txt" &
  child=$!
  wait "$child" 2>/dev/null
  code=$?
  child='' seconds=$((SECONDS - begin))
  [ -s "$json" ] || sed -n '/^{/,$p' "$out/unfinished.txt" >"$json"
  result=$(sed 's/^ *//' "$json" | tr -d '\n')
  [[ $result == "{"*"}" ]] || result=null
  end=$(tail -c +$((logged + 1)) "$out/log.txt" | grep -v '^ *$' | tail -n 1 | cut -c1-160)
  cat "$out/unfinished.txt" >>"$out/log.txt"
  printf '{"item": "%s", "exit": %d, "seconds": %d, "result": %s}\n' "$name" $code $seconds "$result" >>"$out/results.jsonl"
  say "$(printf '%-28s %-12s %4d s  %s' "$name" "$(ending $code $((seconds < most)))" $seconds "$(figure "$result")")"
  rm -f "$out/unfinished.txt" "$json"
  if [ $code -ne 0 ]; then
    failures=$((failures + 1))
    [ -n "$end" ] && say "    $end"
    finds_any || gone=1
  fi
}
leave_out() {
  left=$((left + 1))
  say "$(printf '%-28s left out, %s' "$1" "$2")"
}
# ending STATUS EARLY: what an exit status says (src/program/cli/exit_codes.h; timeout's own).
ending() {
  case $1$2 in
    0?) echo fine ;;
    10?) echo "device lost" ;;
    1371) echo killed ;;
    124? | 1370) echo "out of time" ;;
    *) echo "exit $1" ;;
  esac
}
# Of a result, what a person wants to see at once.
figure() {
  grep -oE '"(ms_per_frame|median|seconds_per_frame|kernel|conforms)": *("[^"]*"|[0-9.e+-]+|true|false)' <<<"$1" | head -n 4 | tr '\n' ' '
}

# Grooms, made on other cores while the first items run.
make_grooms() {
  local one particles making=''
  trap 'kill $making 2>/dev/null; exit' TERM
  for one in 1x16 1000x64 1500x64 10000x32 100000x16 22813x64; do
    particles=${one#*x}
    ringlet make head --strands "${one%x*}" --particles "$particles" --turns $((particles < 32 ? particles / 4 : 8)) \
      --quiet -o "$work/new-$one.hair" &
    making=$!
    wait "$making" && mv "$work/new-$one.hair" "$work/$one.hair"
  done
}
# await STRANDSxPARTICLES: until that groom is made.
await() {
  while [ "$mode" = run ] && [ ! -s "$work/$1.hair" ] && kill -0 "$maker" 2>/dev/null; do sleep 0.2; done
}

stop_children() {
  local process
  for process in $child $clocks $maker; do kill "$process" 2>/dev/null; done
  rm -rf "$work"
}
run() {
  out=$(realpath -m "$1") here=$(dirname "$scripts") work=$(mktemp -d) json=$out/unfinished.json
  trap stop_children EXIT
  trap 'say "stopped by a signal after $SECONDS s"; exit 130' INT TERM HUP
  mkdir -p "$out" || exit 1
  rm -f "$out"/{facts.txt,summary.txt,results.jsonl,log.txt,clocks.csv,unfinished.txt,unfinished.json}
  # Caches of the run's own: what the driver compiles is timed once, and found again by later items.
  export PATH=$here/bin:$PATH HOME=$work XDG_CACHE_HOME=$work/cache RINGLET_CACHE_DIR=$work/cache/ringlet
  export __GL_SHADER_DISK_CACHE_PATH=$work/cache VK_LAYER_PATH=$here/layers${VK_LAYER_PATH:+:$VK_LAYER_PATH}
  mkdir -p "$RINGLET_CACHE_DIR"
  use_libraries
  find_driver
  local found=$?
  facts
  if [ $found -ne 0 ]; then
    say "no device that Ringlet can use; facts.txt and log.txt say what was found"
    exit 1
  fi
  say "$(printf '%-28s %-12s %4d s' facts fine "$SECONDS")"
  if command -v nvidia-smi >/dev/null; then
    nvidia-smi --query-gpu=timestamp,clocks.sm,clocks.mem,power.draw,temperature.gpu,utilization.gpu,memory.used \
      --format=csv -l 1 >"$out/clocks.csv" 2>/dev/null &
    clocks=$!
  fi
  make_grooms >"$work/grooms.txt" 2>&1 &
  maker=$!
  items
  cat "$work/grooms.txt" >>"$out/log.txt"
  say "$SECONDS s of $limit; $failures failed, $left left out"
  [ $((failures + left)) -eq 0 ]
}

# Every item has a line; those that ran have a result.
check() {
  local name missing=0
  while read -r name _; do
    grep -q "^$name " "$1/summary.txt" 2>/dev/null && continue
    echo "gpu_day: $1/summary.txt says nothing of $name" >&2
    missing=1
  done < <(echo facts; mode=list items)
  return $missing
}

usage() { sed -n '4,8s/^# *//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
mode=${1:-} limit=420 only=() out=. work=. here=. json=unfinished.json
child='' clocks='' maker='' failures=0 left=0 gone=0
shift || usage
case $mode in
  pack)
    [ $# -eq 1 ] || usage
    . "$scripts/pack.sh"
    pack "$1"
    ;;
  run | check | list)
    . "$scripts/items.sh"
    if [ "$mode" != list ]; then
      [ $# -ge 1 ] || usage
      folder=$1
      shift
    fi
    if [[ $mode == run && ${1:-} =~ ^[0-9]+$ ]]; then limit=$1; shift; fi
    only=("$@")
    case $mode in
      run) run "$folder" ;;
      check) check "$folder" ;;
      list) printf '%-28s %4s s  %s\n' facts - "always"; items ;;
    esac
    ;;
  *) usage ;;
esac
