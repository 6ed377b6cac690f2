#!/usr/bin/env bash
# The main job on the embedded default: a head of ringlets (examples/demo.toml) on the best Vulkan device there is.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh demo
cmake --preset demo
cmake --build --preset demo

out=${1:-out/demo}
mkdir -p "$out"
build/release/ringlet simulate examples/demo.toml --sheet rendered --overwrite -o "$out"
echo
echo "Results are in $(realpath "$out"):"
echo "  sheet.png   six frames side by side"
echo "  hair.usda   the animation, for USD programs (docs/pipelines.md: Blender, Houdini, Maya)"
echo "  last.obj    the last frame as OBJ polylines"
