# shellcheck shell=bash disable=SC2154
# What scripts/gpu_day.sh runs, the most valuable first: `item` and its variables are that script's.

nothing=(--no-usd --no-sheet --no-last --json --overwrite)  # of files a run writes

# simulate NAME LIMIT STRANDSxPARTICLES OPTIONS...: a run that writes nothing; stages, waits and memory are in its JSON. A
# folder for each: a run that was killed may still hold its own.
simulate() {
  local name=$1 most=$2 groom=$3
  shift 3
  chosen "$name" || return 0
  await "$groom"
  item "$name" "$most" ringlet simulate "$work/$groom.hair" --motion turn "${nothing[@]}" -o "$work/run-$name" "$@"
}

items() {
  local method part steps size
  # Does it work at all?
  item conform_quick 120 ringlet conform --quick --json "$json"
  # Hair alone.
  simulate hair_1000x64_60hz 40 1000x64 --fps 60 --steps-per-frame 4 --frames 600
  simulate hair_1000x64_24hz 40 1000x64 --steps-per-frame 8 --frames 600
  simulate hair_1500x64 40 1500x64 --steps-per-frame 8 --frames 400
  simulate hair_10000x32 40 10000x32 --steps-per-frame 8 --frames 300
  simulate hair_100000x16 40 100000x16 --steps-per-frame 8 --frames 100
  simulate hair_22813x64 40 22813x64 --steps-per-frame 8 --frames 60
  # The host's share: a strand for the device, all else for the host.
  simulate host_1x16 40 1x16 --steps-per-frame 8 --frames 3000
  # Contacts, by stage. The largest takes 20 s to start.
  for method in auto explicit; do
    simulate contacts_1000x64_$method 40 1000x64 --steps-per-frame 8 --frames 96 --contacts $method
    simulate contacts_10000x32_$method 40 10000x32 --steps-per-frame 8 --frames 48 --contacts $method
  done
  simulate contacts_22813x64_auto 70 22813x64 --steps-per-frame 8 --frames 24 --contacts auto
  # What some of the device's abilities are worth, against the run above that has them all.
  for part in texels timestamps mapping; do
    RINGLET_WITHOUT=$part simulate without_$part 40 10000x32 --steps-per-frame 8 --frames 48 --contacts auto
  done
  # Workgroups of other sizes than 64.
  for size in 32 128; do
    RINGLET_GROUP_SIZE=$size simulate groups_of_$size 40 1000x64 --steps-per-frame 8 --frames 200
  done
  # Bodies: their kernel is the largest by far, and may take the driver's compiler long.
  item kernels_bodies 90 ringlet kernels --statistics --only ', bodies,' --json "$json"
  item body_walk_head 60 ringlet scene walk_head --strands 1000 --seconds 1 --json --quiet
  item body_bust 60 ringlet scene bust --strands 1000 --seconds 1 --json --quiet
  item body_character 60 ringlet simulate "$here/examples/character.toml" --frames 96 "${nothing[@]}" -o "$work/run-character"
  # What the compiler makes of the others.
  for part in 'hair alone' contacts 'a volume' contact_ volume_; do
    item "kernels_of_${part// /_}" 60 ringlet kernels --statistics --only "$part" --json "$json"
  done
  # Shapes, lanes x run.
  item tune 90 ringlet tune --seconds 60 --particles 16 32 64 128 --quiet --report "$json"
  # Hair alone with 1 to 32 steps a dispatch, all of the same length: what a step costs falls towards its arithmetic.
  for steps in 1 2 4 16 32; do
    simulate steps_$steps 40 10000x32 --steps-per-frame $steps --fps $((192 / steps)) --frames 200
  done
  # Many heads, pictures, contacts by stage without a scene, frames that are held against the reference.
  item heads_100 40 heads_bench 100 100 32 --json
  item heads_16 40 heads_bench 16 1000 64 --json
  simulate render_run 20 1000x64 --frames 12 --cache float32
  item render_30000 40 ringlet render "$work/run-render_run" --hairs 30000 --size 1920x1080 --json --quiet -o "$work/pictures"
  item render_100000 40 ringlet render "$work/run-render_run" --hairs 100000 --size 1920x1080 --json --quiet -o "$work/pictures"
  item contacts_bench 60 contacts_bench --benchmark_out="$json" --benchmark_out_format=json
  item step_bench 60 step_bench --benchmark_out="$json" --benchmark_out_format=json
  # Shapes with contacts, as a volume, among bodies: many kernels to compile.
  item tune_work 120 ringlet tune --work contacts,volume,bodies --seconds 90 --particles 16 64 128 --quiet --report "$json"
  # What is checked: tests (by path: those that die start themselves again), a run with the validation layer, then conform.
  item gpu_tests 60 env RINGLET_REQUIRE_GPU=1 "$here/bin/gpu_tests" --gtest_brief=1
  item kernels_tests 60 env RINGLET_REQUIRE_GPU=1 "$here/bin/kernels_tests" --gtest_brief=1 \
    --gtest_filter='ContactLists.*:ContactStep.RepeatsBitwise*:Volume*:BucketStarts.*:StrandStep.*EveryShape*'
  RINGLET_VALIDATION=1 simulate validated 60 1000x64 --contacts auto --frames 4
  item conform_all 300 ringlet conform --json "$json"
}
