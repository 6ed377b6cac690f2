# shellcheck shell=bash disable=SC2154
# Packs what scripts/gpu_day.sh needs on a machine without packages.

most_mebibytes=64  # of the archive

# Libraries that every system has, and that must be the system's own.
is_systems() { [[ $1 =~ ^(lib(c|m|pthread|dl|rt|resolv)\.so\.|ld-linux) ]]; }

# add_libraries BINARY: those it names, not those it looks for while it runs.
add_libraries() {
  local name path
  while read -r name path; do
    is_systems "$name" || cp -Lu "$path" "$staged/lib/$name"
  done < <(ldd "$1" 2>/dev/null | sed -n 's/^\s*\([^ ]*\) => \(\/[^ ]*\) .*/\1 \2/p')
}

add_programs() {
  local program
  for program in ringlet bench/step_bench bench/heads_bench bench/contacts_bench tests/gpu_tests tests/kernels_tests; do
    if [ ! -x "$build/$program" ]; then
      echo "gpu_day: without $program, which is not in $build" >&2
      continue
    fi
    strip -o "$staged/bin/${program##*/}" "$build/$program"
    add_libraries "$build/$program"
  done
}

# The loader, and what drivers ask for that come without a desktop.
add_loader() {
  local name path
  for name in libvulkan.so.1 libGLdispatch.so.0 libEGL.so.1 libX11.so.6 libXext.so.6 libxcb.so.1 libXau.so.6 libXdmcp.so.6 \
    libbsd.so.0 libmd.so.0; do
    path=$(ldconfig -p | sed -n "s|^\s*${name//./\\.} (libc6,x86-64.*=> ||p" | head -n 1)
    [ -z "$path" ] || cp -Lu "$path" "$staged/lib/$name"
  done
  [ -f "$staged/lib/libvulkan.so.1" ] || echo "gpu_day: without the loader, libvulkan.so.1, which is not installed" >&2
}

add_layer() {
  local name=VkLayer_khronos_validation layer
  layer=$(find /usr/lib /usr/local/lib -name "lib$name.so" 2>/dev/null | head -n 1)
  if [ -z "$layer" ]; then
    echo "gpu_day: without the validation layer, which is not installed" >&2
    return
  fi
  strip -o "$staged/layers/lib$name.so" "$layer"
  sed "s|\"library_path\": \"[^\"]*\"|\"library_path\": \"./lib$name.so\"|" /usr/share/vulkan/explicit_layer.d/$name.json \
    >"$staged/layers/$name.json"
  add_libraries "$layer"
}

pack() {
  local archive build size
  archive=$(realpath -m "$1") build=$(realpath -m "${RINGLET_BUILD:-$scripts/../../build/release}")
  if [ ! -x "$build/ringlet" ]; then
    echo "gpu_day: no $build/ringlet to pack; docs/performance.md says how it is built" >&2
    exit 1
  fi
  cd "$scripts/../.." || exit 1
  staged=$(mktemp -d)
  trap 'rm -rf "$staged"' EXIT
  mkdir -p "$staged"/{bin,lib,layers,gpu_day} "$(dirname "$archive")"
  add_programs
  add_loader
  add_layer
  cp -r examples "$staged/examples"
  cp scripts/gpu_day.sh "$staged/" && cp scripts/gpu_day/items.sh "$staged/gpu_day/"
  git describe --always --dirty --abbrev=12 >"$staged/commit" 2>/dev/null
  tar -C "$staged" --sort=name --owner=0 --group=0 -cf - . | gzip -9 >"$archive" || exit 1
  size=$(stat -c %s "$archive")
  du -m --max-depth=1 "$staged" | sed "s|$staged/*|  |" | awk '{ printf "  %4d MiB  %s\n", $1, $2 }'
  awk -v bytes="$size" -v most=$most_mebibytes -v file="$archive" \
    'BEGIN { printf "gpu_day: %.1f MiB of %d in %s\n", bytes / 1048576, most, file; exit bytes > most * 1048576 }' || exit 1
}
