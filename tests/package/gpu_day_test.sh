#!/usr/bin/env bash
# scripts/gpu_day.sh among items that hang, are killed, fail and lose their device: each has its line and its result, and
# the next one begins. No device is needed: `ringlet` is a script here.
#   gpu_day_test.sh SOURCE_FOLDER
set -euo pipefail
source=$1
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
fail() { echo "gpu_day_test: $*" >&2; tail -n 99 "$work"/*/summary.txt "$work"/*/log.txt >&2; exit 1; }

mkdir -p "$work/day/bin" "$work/day/lib" "$work/day/gpu_day"
cp "$source/scripts/gpu_day.sh" "$work/day/"
bash "$source/scripts/gpu_day.sh" list > "$work/list.txt" || fail "cannot list its items"
[ "$(grep -c ' s  ' "$work/list.txt")" -gt 30 ] || fail "lists few items: $(cat "$work/list.txt")"

cat > "$work/day/bin/ringlet" <<'END'
#!/usr/bin/env bash
case $1 in
  devices) [ -e "$(dirname "$0")/gone" ] || echo '[{"type": "discrete", "usable": true}]' ;;
  hang) echo begun; trap '' TERM; sleep 60 & wait ;;
  half) printf '{"checks": [\n1,\n2]}\n' > "$2"; sleep 60 ;;
  killed) kill -KILL $$ ;;
  fails) echo '{"ms_per_frame": 3}'; echo "ringlet: it cannot" >&2; exit 11 ;;
  lost) touch "$(dirname "$0")/gone"; echo "the device is lost" >&2; exit 10 ;;
  back) rm -f "$(dirname "$0")/gone" ;;
  fine) printf 'some text\n{\n  "ms_per_frame": 1.25,\n  "device": "none"\n}\n' ;;
esac
END
chmod +x "$work/day/bin/ringlet"
cat > "$work/day/gpu_day/items.sh" <<'END'
items() {
  item hang 1 ringlet hang
  item half 1 ringlet half "$json"
  item killed 5 ringlet killed
  item fails 5 ringlet fails
  item lost 5 ringlet lost
  item after 5 ringlet fine
  [ "$mode" != run ] || ringlet back
  item fine 5 ringlet fine
}
END

# line PATTERN: of the summary.
line() { grep -Eq "$1" "$work/out/summary.txt" || fail "no line $1"; }
result() { grep -Eq "$1" "$work/out/results.jsonl" || fail "no result $1: $(cat "$work/out/results.jsonl")"; }
if bash "$work/day/gpu_day.sh" run "$work/out" 60 > "$work/printed.txt"; then fail "says that all is well"; fi
line '^facts +fine'
line '^hang +out of time +[4-9] s'
line '^half +out of time'
line '^killed +killed'
line '^fails +exit 11 .*"ms_per_frame": 3'
line '^    ringlet: it cannot'
line '^lost +device lost'
line '^after +left out, the device is gone'
line '^fine +fine .*"ms_per_frame": 1.25'
line '5 failed, 1 left out'
result '^[{]"item": "half", "exit": 124, "seconds": [0-9]+, "result": [{]"checks": [[]1,2[]][}][}]$'
result '"item": "fine", "exit": 0, "seconds": [0-9]+, "result": [{]"ms_per_frame": 1.25,"device": "none"[}][}]$'
grep -q '^begun$' "$work/out/log.txt" || fail "what an item printed before it hung is lost"
bash "$work/day/gpu_day.sh" check "$work/out" || fail "an item has no line"
sed -i '/^killed/d' "$work/out/summary.txt"
if bash "$work/day/gpu_day.sh" check "$work/out" 2> "$work/check.txt"; then fail "does not miss an item"; fi
grep -q 'nothing of killed' "$work/check.txt" || fail "misses another item: $(cat "$work/check.txt")"

# Items by name, and time that runs out.
bash "$work/day/gpu_day.sh" run "$work/out" fine fails > "$work/printed.txt" && fail "says that all is well"
[ "$(grep -c '^[a-z]' "$work/out/summary.txt")" = 3 ] || fail "runs others than were asked for"
bash "$work/day/gpu_day.sh" run "$work/out" 4 fine > "$work/printed.txt" && fail "says that all was run"
line '^fine +left out, no time'

# Ended from outside, it ends its item and leaves what that told.
bash "$work/day/gpu_day.sh" run "$work/out" 60 half > "$work/printed.txt" & day=$!
for ((turn = 0; turn < 100; ++turn)); do [ -s "$work/out/unfinished.json" ] && break; sleep 0.05; done
kill -TERM $day
if wait $day; then fail "is not ended by a signal"; fi
line 'stopped by a signal'
grep -q checks "$work/out/unfinished.json" || fail "an item that is ended from outside leaves nothing"
echo "gpu_day_test: each item is accounted for"
