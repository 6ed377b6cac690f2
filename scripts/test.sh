#!/usr/bin/env bash
# Builds with warnings as errors and runs every test, GPU tests under the Vulkan validation layers.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset ci
cmake --build --preset ci

# Every driver package brings a device (lavapipe at least), so a test that finds none has failed.
export RINGLET_REQUIRE_GPU=1
# Two at a time: many tests keep one core busy only.
ctest --preset ci --parallel 2 --no-tests=error "$@"
