#!/usr/bin/env bash
# NVK, Mesa's open driver of NVIDIA GPUs, on a device that does nothing: kernels compile as for a GPU that is not there, and
# nothing runs. Fetches into build/drivers/nvk what it needs and does not find there: Debian trixie's libraries with the NVK of
# its backports (64 MB), and of Mesa's source (47 MB) the no-op device, which it builds (nvk_shim.c). It needs gcc. Programs
# of this build run on trixie's libraries where it has them, on this machine's else.
#   bash scripts/second_drivers/nvk.sh sm90 build/ci/ringlet kernels --statistics
#   sm75 Turing, sm86 Ampere (GA102), sm89 Ada, sm90 Hopper, sm120 Blackwell (GB202)
# second_drivers.sh takes its functions.

nvk=${drivers:-$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/build/drivers}/nvk
nvk_scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=scripts/second_drivers/debian.sh
. "$nvk_scripts/debian.sh"

# nvk_packages: trixie's libraries and NVK, and Mesa's source, into $nvk.
nvk_packages() {
  local deb
  rm -rf "$nvk"
  mkdir -p "$nvk/mesa" "$nvk/root"
  use_suites "$nvk/apt" trixie trixie-backports src:trixie &&
    apt_there install --yes --download-only --no-install-recommends mesa-vulkan-drivers/trixie-backports libdrm-dev patchelf || return 1
  for deb in "$nvk"/apt/cache/archives/*.deb; do dpkg-deb -x "$deb" "$nvk/root" || return 1; done
  (cd "$nvk" && apt_there source --download-only mesa) &&
    tar xf "$nvk"/mesa_*.orig.tar.xz -C "$nvk/mesa" --strip-components=1 --wildcards '*/include' '*/src/util' '*/src/c11' \
      '*/src/drm-shim' '*/src/nouveau/drm-shim' '*/nv_object.xml.h' || return 1
  rm -rf "$nvk/apt" "$nvk"/mesa_*
}

# nvk_shim: the no-op device.
nvk_shim() {
  local util=()
  mapfile -t util < <(printf 'src/util/%s.c\n' anon_file hash_table log memstream os_misc ralloc set simple_mtx u_call_once u_debug vma)
  (cd "$nvk/mesa" && gcc -shared -fPIC -O1 -w -std=gnu11 -fvisibility=hidden -ffunction-sections -Wl,--gc-sections -Wl,-z,defs \
    -D_GNU_SOURCE -DHAVE_PTHREAD -DHAVE_SECURE_GETENV -DHAVE_ENDIAN_H -DHAVE_STRUCT_TIMESPEC -DHAVE_MEMFD_CREATE \
    -Iinclude -Isrc "-I$nvk/root/usr/include" "-I$nvk/root/usr/include/libdrm" -o "$nvk/libshim.so" \
    "$nvk_scripts/nvk_shim.c" src/drm-shim/device.c src/drm-shim/drm_shim.c "${util[@]}" src/c11/impl/threads_posix.c -lpthread -ldl)
}

# fetch_nvk: what run_nvk needs; fails where it cannot be had.
fetch_nvk() {
  local driver
  [ -f "$nvk/lib" ] && [ "$nvk/libshim.so" -nt "$nvk_scripts/nvk_shim.c" ] && return 0
  command -v gcc >/dev/null || return 1
  [ -f "$nvk/lib" ] || nvk_packages || return 1
  nvk_shim || return 1
  driver=$(find "$nvk/root/usr/lib" -name libvulkan_nouveau.so | head -n 1)
  [ -n "$driver" ] || return 1
  printf '{"ICD": {"api_version": "1.3.0", "library_path": "%s"}, "file_format_version": "1.0.0"}\n' "$driver" >"$nvk/nvk.json"
  dirname "$driver" >"$nvk/lib"
}

# nvk_program PROGRAM: a copy of it that trixie's libraries run, which it names. `ringlet kernels` runs itself again.
nvk_program() {
  local lib loader copy=$nvk/bin/${1##*/}
  lib=$(cat "$nvk/lib")
  loader=$(find "$lib" -name 'ld-linux*.so.*' | head -n 1)
  mkdir -p "$nvk/bin"
  "$loader" --library-path "$lib" "$nvk/root/usr/bin/patchelf" --set-interpreter "$loader" --output "$copy.$$" "$1" || return 1
  mv "$copy.$$" "$copy" && echo "$copy"
}

# run_nvk SM PROGRAM ARGUMENT...
run_nvk() {
  local chipset copy
  case $1 in
    sm75) chipset=160 ;;
    sm86) chipset=172 ;;
    sm89) chipset=190 ;;
    sm90) chipset=180 ;;
    sm120) chipset=1b2 ;;
    *) echo "nvk: no GPU '$1'; there are sm75, sm86, sm89, sm90, sm120" >&2; return 2 ;;
  esac
  copy=$(nvk_program "$2") || return 1
  shift 2
  env NVK_I_WANT_A_BROKEN_VULKAN_DRIVER=1 NOUVEAU_CHIPSET=$chipset MESA_SHADER_CACHE_DISABLE=1 VK_ICD_FILENAMES="$nvk/nvk.json" \
    VK_DRIVER_FILES="$nvk/nvk.json" LD_LIBRARY_PATH="$(cat "$nvk/lib")" LD_PRELOAD="$nvk/libshim.so" "$copy" "$@"
}

if [ "${BASH_SOURCE[0]}" = "$0" ]; then
  set -uo pipefail
  [ $# -ge 2 ] || { sed -n '2,8p' "$0" >&2; exit 2; }
  mkdir -p "${nvk%/*}/logs"
  fetch_nvk >"${nvk%/*}/logs/fetch_nvk.txt" 2>&1 || { tail -n 3 "${nvk%/*}/logs/fetch_nvk.txt" >&2; echo "nvk: could not be fetched or built" >&2; exit 1; }
  run_nvk "$@"
fi
