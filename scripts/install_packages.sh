#!/usr/bin/env bash
# Installs the Debian packages ringlet is built from and tested with; skips what is there. Run as root or with sudo.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config                                   # the build
  libvulkan-dev libvulkan-volk-dev glslang-tools                     # Vulkan, its loader's entry points, the shader compiler
  mesa-vulkan-drivers vulkan-validationlayers                        # a Vulkan device without a GPU; the layers the tests run under
  libeigen3-dev libgtest-dev libbenchmark-dev                        # reference, tests, benchmarks
  libcli11-dev libfmt-dev nlohmann-json3-dev libpng-dev zlib1g-dev   # the program and its outputs
  libzstd-dev                                                        # caches of animations
  libtomlplusplus-dev                                                # material files
  libtinygltf-dev                                                    # glTF motion
  libglfw3-dev libimgui-dev xvfb xdotool                             # the window of `ringlet view`, and its test without a screen
  gnuplot-nox                                                        # plots
  python3-dev pybind11-dev python3-numpy python3-pytest              # the Python module and its tests
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "ringlet: all packages are installed"
  exit 0
fi

sudo=()
[ "$(id -u)" -eq 0 ] || sudo=(sudo)
echo "ringlet: installing ${missing[*]}"
"${sudo[@]}" apt-get update -qq
"${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
