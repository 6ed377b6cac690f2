#!/usr/bin/env bash
# Runs what has threads, and what reads and writes files, under sanitizers: scripts/sanitize.sh [PRESET...], sanitize
# (addresses, undefined behaviour) and threads (data races); both without a name. Builds each preset first, without its
# tests of kernels: an hour on two cores; of clang-sanitize, which has no tests, the program only, as CI does. Exit status 0:
# nothing found.
set -euo pipefail
cd "$(dirname "$0")/.."
presets=("$@")
[ ${#presets[@]} -gt 0 ] || presets=(sanitize threads)
tests=(base_tests output_tests view_tests ringlet_python ringlet_python_stubs)
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT

# lavapipe and the compiler in it are not instrumented, leak as they are unloaded, and hand over by atomics of their own; so
# does Python, whose lock guards its counts.
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 RINGLET_REQUIRE_GPU=1
cat > "$work/races.txt" <<'END'
race:libvulkan_lvp
race:libLLVM
race:^Py_INCREF
race:^Py_DECREF
END
export TSAN_OPTIONS="suppressions=$work/races.txt ignore_noninstrumented_modules=1 second_deadlock_stack=1 die_after_fork=0"

# Of a scene with contacts, a body, wind that turns, keys, a goal and every output; on both backends, cut and gone on with,
# on two devices and as a sweep of two runs at a time.
write_scene() {
  "$ringlet" make head --strands 60 --particles 24 -o head.obj
  cat > scene.toml <<'END'
[groom]
file = "head.obj"
[motion]
kind = "shake"
[simulation]
frames = 24
steps_per_frame = 4
[contacts]
on = true
radius = 0.004
[air]
on = true
wind = [1, 0, 2]
gust = 0.5
[goal]
strength = 0.1
[[body]]
name = "head"
shape = "sphere"
radius = 0.08
END
}
program_runs() {
  local all=(--cache float32 --also hair.usdc,hair.pc2 --checkpoint 4 --overwrite --quiet)
  "$ringlet" simulate scene.toml "${all[@]}" -o gpu
  "$ringlet" simulate scene.toml "${all[@]}" --backend reference --frames 6 -o reference
  "$ringlet" simulate scene.toml "${all[@]}" --devices 0,0 --contacts explicit -o two
  "$ringlet" simulate scene.toml --clips 5 --usd-values velocities --overwrite --quiet -o clips
  "$ringlet" sweep scene.toml --vary material.dials.hold=1,2 --vary simulation.frames=6 --jobs 2 --quiet -o sweep
  "$ringlet" render gpu/hair.rgc --frames 1:3 --size 320x180 --quiet -o pictures
  "$ringlet" convert gpu/hair.usdc hair.rgc --overwrite
  "$ringlet" measure head.obj gpu > measure.txt
}
killed_run() {
  "$ringlet" simulate scene.toml --frames 4000 --checkpoint 2 --resume --overwrite --quiet -o killed & local pid=$!
  sleep 20
  kill -TERM $pid
  wait $pid || [ $? = 130 ]
}

for preset in "${presets[@]}"; do
  cmake --preset "$preset" > /dev/null
  has_tests=$(grep -c '^RINGLET_BUILD_TESTS:BOOL=ON' "build/$preset/CMakeCache.txt" || true)
  targets=(ringlet_program)
  [ "$has_tests" = 0 ] || targets+=("${tests[@]}")
  cmake --build --preset "$preset" --target "${targets[@]}"
  ringlet=$PWD/build/$preset/ringlet
  mkdir "$work/$preset"
  pushd "$work/$preset" > /dev/null  # no &&, behind which a failure would count for nothing
  write_scene
  program_runs
  killed_run
  popd > /dev/null
  # UsdReader limits its own memory to less than a sanitizer needs.
  [ "$has_tests" = 0 ] || ctest --preset "$preset" -E '^output/UsdReader$' -R '^(base|output|view/S|python/(hair|lifetimes|animations)$)' --no-tests=error
  echo "$preset: nothing found"
done
