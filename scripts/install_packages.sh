#!/usr/bin/env bash
# Installs the Debian packages ringlet is built from and tested with; skips what is there. Run as root or with sudo.
# With the word demo only those of the program and the library. Without those of `extras` everything else is built and
# tested.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config                                   # the build
  libvulkan-dev libvulkan-volk-dev glslang-tools                     # Vulkan, its loader's entry points, the shader compiler
  mesa-vulkan-drivers                                                # a Vulkan device without a GPU
  libeigen3-dev                                                      # the reference
  libcli11-dev libfmt-dev nlohmann-json3-dev libpng-dev zlib1g-dev   # the program and its outputs
  libzstd-dev                                                        # caches of animations
  libtomlplusplus-dev                                                # material files
  libtinygltf-dev                                                    # glTF motion
)

tests=(
  vulkan-validationlayers libgtest-dev libbenchmark-dev              # the layers the tests run under; tests, benchmarks
  python3-dev pybind11-dev python3-numpy python3-pytest              # the Python module and its tests
)

extras=(
  libglfw3-dev libimgui-dev xvfb xdotool                             # the window of `ringlet view`, and its test without a screen
  gnuplot-nox                                                        # plots
  libopenmpi-dev openmpi-bin libmetis-dev                            # runs on several ranks, and their parts of the hair
  ffmpeg                                                             # films of `ringlet render`
)

if [ "${1:-}" = demo ]; then
  extras=()
else
  packages+=("${tests[@]}")
fi

# missing PACKAGE...: those that are not installed.
missing() {
  local package
  for package in "$@"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || echo "$package"
  done
}
mapfile -t needed < <(missing "${packages[@]}")
mapfile -t wanted < <(missing "${extras[@]}")
if [ ${#needed[@]} -eq 0 ] && [ ${#wanted[@]} -eq 0 ]; then
  echo "ringlet: all packages are installed"
  exit 0
fi

sudo=()
[ "$(id -u)" -eq 0 ] || sudo=(sudo)
install() {
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@"
}
echo "ringlet: installing ${needed[*]} ${wanted[*]}"
"${sudo[@]}" apt-get update -qq || [ ${#needed[@]} -eq 0 ]
[ ${#needed[@]} -eq 0 ] || install "${needed[@]}"
[ ${#wanted[@]} -eq 0 ] || install "${wanted[@]}" ||
  echo "ringlet: could not install ${wanted[*]}; \`ringlet view\`, plots and films do without" >&2
