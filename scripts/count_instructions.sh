#!/usr/bin/env bash
# Counts what RADV compiles the strand kernel to, shape by shape, in the step loop: instructions a particle and
# step, spills, registers, size of the code. No hardware is needed.
#
#   scripts/count_instructions.sh [-f FAMILY] [-s SUBGROUP] [-k KERNEL] [LANESxRUN]...
#     FAMILY    navi21 (default), navi31, vega10: what RADV_FORCE_FAMILY takes
#     SUBGROUP  32 or 64 invocations (default: the one Ringlet asks this device for)
#     KERNEL    alone (default), contacts, air, bodies
#   COMPILE     the program that compiles (default build/ci/bench/compile_strand_kernel); a command prefix that
#               chooses the driver goes before it: COMPILE="/opt/mesa/run build/ci/bench/compile_strand_kernel"
# The driver must be RADV and print its assembler; Mesa 25.0.7 does for these families. The step loop is the
# largest backward branch. VALU: vector instructions of a lane, without those of rate 1/4 (trans); a_part.: both, for
# each particle of its run. On RDNA a subgroup of 64 issues each twice. Spills are dwords of a lane, loaded and stored.
set -euo pipefail
family=navi21 subgroup= kernel=alone
while getopts f:s:k: option; do
  case $option in
    f) family=$OPTARG ;;
    s) subgroup=$OPTARG ;;
    k) kernel=$OPTARG ;;
    *) sed -n '2,13p' "$0" >&2; exit 2 ;;
  esac
done
shift $((OPTIND - 1))
[ $# -gt 0 ] || set -- 2x8 4x4 4x8 8x4 8x8 16x4 16x8 32x4 32x8
compile=${COMPILE:-build/ci/bench/compile_strand_kernel}

countLoop='
!/^\t/ && !/^BB/ { other = $0 }
/^BB[0-9]+:/ { sub(":", "", $1); label[$1] = NR; next }
!/^\t[a-z]/ { next }
{
  text[NR] = $1; isLine[NR] = 1
  encoding = $0; sub(/.*; /, "", encoding); gsub(/ /, "", encoding); bytes += length(encoding) / 2
  spills[NR] = /^\tscratch_/ || /^\tbuffer_(load|store)_dword(x[234])? v[^ ]* off, s\[[0-9:]+\], s[0-9]/
  width[NR] = match($1, /(x|b)[0-9]+$/) ? substr($1, RSTART + 1) : 1
  if (width[NR] >= 32) width[NR] /= 32
  rest = $0; sub(/;.*/, "", rest)
  while (match(rest, /v\[?[0-9]+(:[0-9]+)?/)) {
    n = substr(rest, RSTART, RLENGTH); sub(/v\[?([0-9]+:)?/, "", n)
    if (n + 0 > vgprs) vgprs = n + 0
    rest = substr(rest, RSTART + RLENGTH)
  }
  if ($1 ~ /^s_c?branch/ && ($2 in label) && NR - label[$2] > last - begin) { begin = label[$2]; last = NR }
}
END {
  for (i = begin; i <= last; ++i) {
    if (!isLine[i]) continue
    if (text[i] ~ /^v_s?(rcp|rsq|sqrt|exp|log|sin|cos)_/) ++trans
    else if (text[i] ~ /^v_/) ++valu
    if (text[i] ~ /^ds_/) ++lds
    if (spills[i] && text[i] ~ /load/) loads += width[i]
    if (spills[i] && text[i] ~ /store/) stores += width[i]
  }
  if (last == 0) { print "no step loop was printed (is the driver RADV? see COMPILE); the last other line: " other; exit 1 }
  printf "%6d +%4d %8.1f %6d %7d %7d %7d %6.1f\n", valu, trans, (valu + trans) / run, lds, loads, stores, vgprs + 1, bytes / 1024
}'

printf '%s, %s, subgroup %s\n' "$family" "$kernel" "${subgroup:-default}"
printf '%-6s %6s %5s %8s %6s %7s %7s %7s %6s\n' shape VALU trans a_part. LDS loaded stored VGPRs KiB
for shape in "$@"; do
  printf '%-6s ' "$shape"
  RADV_FORCE_FAMILY=$family RADV_DEBUG=asm MESA_SHADER_CACHE_DISABLE=1 \
    $compile "${shape%x*}" "${shape#*x}" "$kernel" $subgroup 2>&1 | awk -v run="${shape#*x}" "$countLoop"
done
