#!/usr/bin/env bash
# Runs what is quick on Vulkan drivers other than the machine's own: SwiftShader, lavapipe at 128 and 512 bits, newer
# lavapipe and RADV from Debian's backports, RADV's null hardware and NVK on a device that does nothing, which only
# compile. Fetches them into build/drivers (SwiftShader by npm, and it needs brotli; Mesa by apt-get from the mirror this
# machine uses; for NVK, Debian trixie's libraries and Mesa's source too, 110 MB, and it needs gcc). What cannot be had is
# skipped, and the table at the end says so. Nothing is installed. Needs a build: bash scripts/test.sh, or
# cmake --preset ci && cmake --build --preset ci. Takes 45 to 75 minutes on two cores, of which NVK 13.
#   bash scripts/second_drivers.sh               everything
#   bash scripts/second_drivers.sh swiftshader   only rows whose driver begins so
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

only=${1:-}
drivers=$PWD/build/drivers
build=build/ci
logs=$drivers/logs
mkdir -p "$logs"
[ -x $build/ringlet ] || { echo "second_drivers: no $build/ringlet; build first: cmake --preset ci && cmake --build --preset ci" >&2; exit 1; }
# shellcheck source=scripts/second_drivers/nvk.sh
. scripts/second_drivers/nvk.sh
export RINGLET_REQUIRE_GPU=1 MESA_SHADER_CACHE_DISABLE=1 RINGLET_CACHE_DIR=$drivers/cache

table=()
failures=0

# row DRIVER WHAT RESULT SECONDS
row() {
  table+=("$(printf '%-22s  %-34s  %-8s  %s' "$1" "$2" "$3" "$4")")
}
# wanted DRIVER: whether its rows are.
wanted() { [[ ${1,,} == "${only,,}"* ]]; }
# try DRIVER WHAT COMMAND...: one row; what the command prints goes to a log.
try() {
  local driver=$1 what=$2 begin=$SECONDS log result=ok
  shift 2
  wanted "$driver" || return 0
  log="$logs/${driver// /_}-${what//[^a-zA-Z0-9]/_}.txt"
  echo "second_drivers: $driver: $what ..."
  "$@" >"$log" 2>&1 || { result=FAILED; failures=$((failures + 1)); tail -n 15 "$log"; echo "  (all of it: $log)"; }
  row "$driver" "$what" "$result" "$((SECONDS - begin)) s"
}
# skip DRIVER WHY
skip() {
  wanted "$1" || return 0
  echo "second_drivers: SKIPPED $1: $2" >&2
  row "$1" "$2" SKIPPED ""
}

# fetch_swiftshader: into $drivers/swiftshader. The archive is an npm package that carries it.
fetch_swiftshader() {
  local version=147.0.0
  [ -f "$drivers/swiftshader/vk_swiftshader_icd.json" ] && return 0
  command -v npm >/dev/null && command -v brotli >/dev/null || return 1
  (cd "$drivers" && npm pack --silent "@sparticuz/chromium@$version" && tar xf sparticuz-chromium-$version.tgz package/bin/swiftshader.tar.br &&
    brotli -dfo swiftshader.tar package/bin/swiftshader.tar.br && mkdir -p swiftshader && tar xf swiftshader.tar -C swiftshader &&
    rm -r package swiftshader.tar sparticuz-chromium-$version.tgz) >"$logs/fetch_swiftshader.txt" 2>&1
  [ -f "$drivers/swiftshader/vk_swiftshader_icd.json" ]
}

# fetch_mesa: the backports' Mesa drivers, unpacked to $drivers/mesa with ICD files that name them.
fetch_mesa() {
  local suite
  [ -f "$drivers/mesa/lvp.json" ] && [ -f "$drivers/mesa/radeon.json" ] && return 0
  suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-}-backports")
  mkdir -p "$drivers/mesa/debs"
  (use_suites "$drivers/apt" "$suite" && cd "$drivers/mesa/debs" &&
    for package in mesa-vulkan-drivers libdrm2 libdrm-amdgpu1; do
      apt_there download "$package/$suite" || apt_there download "$package" || exit 1
    done
    for deb in ./*.deb; do dpkg-deb -x "$deb" .. || exit 1; done) >"$logs/fetch_mesa.txt" 2>&1 || return 1
  local lib
  lib=$(dirname "$(find "$drivers/mesa/usr/lib" -name libvulkan_radeon.so | head -n 1)") || return 1
  [ -f "$lib/libvulkan_lvp.so" ] || return 1
  for name in lvp radeon; do
    printf '{"ICD": {"api_version": "1.3.0", "library_path": "%s/libvulkan_%s.so"}, "file_format_version": "1.0.0"}\n' \
      "$lib" "$name" >"$drivers/mesa/$name.json"
  done
  echo "$lib" >"$drivers/mesa/lib"
}

icd() { env "VK_ICD_FILENAMES=$1" "VK_DRIVER_FILES=$1" "${@:2}"; }

# quick DRIVER PREFIX...: gpu tests, conform, lists, repeats, a volume beside contacts, divided hair, heads and cuts, and pictures.
quick() {
  local driver=$1
  shift
  try "$driver" "gpu tests" "$@" $build/tests/gpu_tests --gtest_brief=1
  try "$driver" "conform --quick" "$@" $build/ringlet conform --quick
  try "$driver" "contact lists" "$@" $build/tests/kernels_tests --gtest_brief=1 --gtest_filter='ContactLists.*'
  try "$driver" "a run with contacts repeats" "$@" $build/tests/kernels_tests --gtest_brief=1 \
    --gtest_filter='ContactStep.RepeatsBitwise*:VolumeStep.RepeatsBitwise*'
  try "$driver" "a volume beside contacts" "$@" $build/tests/kernels_tests --gtest_brief=1 --gtest_filter='VolumeStep.Beside*'
  try "$driver" "divided hair" "$@" $build/tests/kernels_tests --gtest_brief=1 \
    --gtest_filter='VolumeGather.*:DividedHair.PartsWhat*'
  try "$driver" "many heads, cuts, profiles" "$@" $build/tests/kernels_tests --gtest_brief=1 \
    --gtest_filter='HairFrames*:*OneOfManyHeads*:Cut.*:CutContacts.Lands*:Profiles.*'
  try "$driver" "pictures" "$@" $build/tests/program_tests --gtest_brief=1 --gtest_filter='Golden.*'
}

for bits in 128 512; do
  lavapipe=(env "LP_NATIVE_VECTOR_WIDTH=$bits")
  quick "lavapipe $bits bits" "${lavapipe[@]}"
  try "lavapipe $bits bits" "every shape" "${lavapipe[@]}" RINGLET_EVERY_SHAPE=1 $build/tests/kernels_tests --gtest_brief=1 \
    --gtest_filter='*EveryShape*'
done

if ! wanted SwiftShader; then
  :
elif fetch_swiftshader; then
  quick SwiftShader icd "$drivers/swiftshader/vk_swiftshader_icd.json"
else
  skip SwiftShader "could not be fetched (npm and brotli?)"
fi

if ! wanted "lavapipe of backports" && ! wanted "RADV of backports"; then
  :
elif fetch_mesa; then
  newer() { LD_LIBRARY_PATH=$(cat "$drivers/mesa/lib") icd "$drivers/mesa/$1.json" "${@:2}"; }
  quick "lavapipe of backports" newer lvp
  for family in navi21 navi31 vega10; do
    try "RADV of backports" "kernels, $family" newer radeon env RADV_FORCE_FAMILY=$family $build/ringlet kernels
  done
else
  skip "lavapipe of backports" "could not be fetched (apt-get?)"
  skip "RADV of backports" "could not be fetched (apt-get?)"
fi

radv=$(find /usr/share/vulkan/icd.d -name 'radeon_icd*.json' 2>/dev/null | head -n 1)
if [ -n "$radv" ]; then
  for family in navi21 vega10; do
    try "RADV of this machine" "kernels, $family" icd "$radv" env RADV_FORCE_FAMILY=$family $build/ringlet kernels
  done
else
  skip "RADV of this machine" "no radeon_icd in /usr/share/vulkan/icd.d"
fi

if ! wanted "NVK of trixie"; then
  :
elif fetch_nvk >"$logs/fetch_nvk.txt" 2>&1; then
  for gpu in sm75 sm86 sm89 sm90 sm120; do
    try "NVK of trixie" "kernels, $gpu" run_nvk $gpu $build/ringlet kernels --statistics
  done
else
  skip "NVK of trixie" "cannot be had (apt-get, gcc?)"
fi

[ ${#table[@]} -gt 0 ] || { echo "second_drivers: no driver's name begins with '$only'" >&2; exit 1; }
printf '\n%-22s  %-34s  %-8s  %s\n' driver what result time
printf '%s\n' "${table[@]}"
[ $failures -eq 0 ] || { echo "second_drivers: $failures failed" >&2; exit 1; }
