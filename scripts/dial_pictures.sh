#!/usr/bin/env bash
# Draws the picture of docs/art-direction.md: what each dial does at half, at one and at double. Needs ffmpeg.
# Usage: scripts/dial_pictures.sh RINGLET PICTURE (the program; a .webp file)
set -euo pipefail
ringlet=$(realpath "$1") picture=$(realpath -m "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# A soft curl that is held to the side, at rest; and one on a head that shakes.
cat > side.toml << 'END'
[groom]
generate = "curl"
turns = 7
length = 0.2
rotate_degrees = [0, 0, 70]
[material]
core_stiffness = 10
bend_stiffness = 4
bend_damping_ratio = 0.4
[simulation]
frames = 120
preload = 0
[[camera]]
name = "camera"
eye = [0.078, -0.1, 0.9]
target = [0.078, -0.1, 0]
field_of_view = 17
END
cat > shaken.toml << 'END'
[groom]
generate = "curl"
turns = 7
radius = 0.012
[material]
core_stiffness = 10
bend_stiffness = 3
[motion]
kind = "shake"
amplitude = 0.06
frequency = 1.2
[simulation]
frames = 54
[[camera]]
name = "camera"
eye = [0, -0.125, 0.9]
target = [0, -0.125, 0]
field_of_view = 20
bind = "head"
END

panel=10
draw() {  # SCENE FRAME DIAL VALUE...
  local scene=$1 frame=$2 dial=$3
  for value in "${@:4}"; do
    "$ringlet" simulate "$scene.toml" "--$dial" "$value" -o run --overwrite --quiet 2> /dev/null
    "$ringlet" render run --scene "$scene.toml" --camera camera --frames "$frame:$frame" --size 110x150 \
      -o "panel$panel.png" --quiet
    rm -r run
    panel=$((panel + 1))
  done
}
draw shaken 44 bounce 0.5 1 2
draw shaken 54 spring-back 0.5 1 2
for dial in weight hold curl-keep root-hold tip-hold; do draw side 120 "$dial" 0.5 1 2; done
draw side 120 wet 0 0.5 1
ffmpeg -v error -y -start_number 10 -i panel%d.png -filter_complex tile=12x2:padding=2 -frames:v 1 -quality 80 "$picture"
