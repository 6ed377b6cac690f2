#!/usr/bin/env bash
# Starts a Slurm of one node for itself, and tries the arrays of examples/farm on it: shots that are preempted, put back, killed
# and short of time have the bits of shots without a break, a broken scene is not started again, two tasks on one folder harm
# nothing. Usage: scripts/try_slurm.sh [COMMAND...]: that command in place of the trial, with Slurm's environment.
# Needs Debian's slurmctld, slurmd and slurm-client, and `ringlet` in PATH; takes two to three minutes. No service is touched:
# the daemons have their own folder and ports, listen here only, need no munge, and end with this script.
set -euo pipefail
cd "$(dirname "$0")/.."
for needed in slurmctld slurmd sbatch ringlet; do
  command -v "$needed" > /dev/null || { echo "SKIPPED, NOTHING WAS TESTED: $needed is not in PATH"; exit 77; }
done

work=$(mktemp -d) && mkdir "$work/state" "$work/spool"
host=$(hostname -s) me=$(id -un) cores=$(nproc)
memory=$(awk '/MemTotal/ { print int($2 / 1024) }' /proc/meminfo)
cat > "$work/slurm.conf" << END
ClusterName=try
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$me
SlurmdUser=$me
SlurmctldPort=17817
SlurmdPort=17818
# No secret is asked for. A task that is put back may start after 5 s and not after 2 minutes.
AuthType=auth/none
AuthInfo=cred_expire=5
CredType=cred/none
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SchedulerParameters=sched_interval=1,bf_interval=1
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
KillWait=30
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cores RealMemory=$memory
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE PriorityTier=1
PartitionName=urgent Nodes=$host MaxTime=INFINITE PriorityTier=10 PreemptMode=OFF
END
export SLURM_CONF=$work/slurm.conf

finish() {
  scancel --quiet --user="$me" 2> /dev/null || true
  for _ in $(seq 100); do [ -z "$(squeue -h 2> /dev/null)" ] && break; sleep 0.1; done
  for daemon in slurmd slurmctld; do
    [ ! -s "$work/$daemon.pid" ] || kill "$(cat "$work/$daemon.pid")" 2> /dev/null || true
  done
  sleep 1
  rm -rf "$work"
}
trap finish EXIT
slurmctld && slurmd
for _ in $(seq 100); do sinfo -h -o %T 2> /dev/null | grep -q idle && break; sleep 0.1; done
sinfo -h -o %T | grep -q idle || { echo "the node does not come up:"; tail "$work"/*.log; exit 1; }
if [ $# -gt 0 ]; then "$@"; exit; fi

failed=0
check() {  # WHAT COMMAND...
  if "${@:2}"; then echo "ok      $1"; else echo "FAILED  $1"; failed=1; fi
}
hash_of() { sed -n 's/.*"positions_hash": "\(.*\)".*/\1/p' "$1" 2> /dev/null | tail -1; }
wait_for() {  # SECONDS COMMAND...
  local end=$((SECONDS + $1))
  until "${@:2}"; do [ $SECONDS -lt $end ] || return 1; sleep 0.1; done
}
is_over() { [ -z "$(squeue -h -j "$1" 2> /dev/null)" ]; }
frames_in() { [ ! -e "$1" ] && echo 0 || grep -c '"frame"' "$1" || true; }
has_frames() { [ "$(frames_in "$1")" -ge "$2" ]; }
state_of() { scontrol show job "$1" | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p' | head -1; }
submit() { sbatch --parsable --output="$work/%x-%A_%a.log" "$@"; }

# 1. The array of the examples, all at once, as often as there are cores.
export FARM_OUT=$work/plain FARM_CACHE=$work/cache
array=$(submit examples/farm/shots.sbatch)
wait_for 300 is_over "$array" || true
check "8 shots are done" [ "$(ls "$work"/plain/*/report.json | wc -l)" = 8 ]

# 2. Longer shots, first without a break, then each broken in its own way.
for k in 1 2 3 4 5 6 7 8; do
  cat > "$work/shot$k.toml" << END
[groom]
generate = "head"
strands = 1500
particles = 48
[motion]
kind = "shake"
amplitude = 0.0$k
[simulation]
frames = 300
[air]
wind = [1, 0, $k]
[[key]]
time = 1
material.dials.weight = 1
[[key]]
time = 2
material.dials.weight = 0.$k
[[key]]
time = 3
material.dials.weight = 1
[output]
files = []
cache = "16bit"
END
  echo "shot$k $work/shot$k.toml"
done > "$work/shots.txt"
export FARM_SHOTS=$work/shots.txt FARM_OUT=$work/whole
array=$(submit examples/farm/shots.sbatch)
wait_for 600 is_over "$array" || true
check "8 longer shots are done without a break" [ "$(ls "$work"/whole/*/report.json | wc -l)" = 8 ]

export FARM_OUT=$work/broken
break_it() {  # SHOT HOW JOB
  wait_for 120 has_frames "$work/broken/shot$1/progress.jsonl" 60 || return 1
  case $2 in
    preempted) wait_for 30 is_over "$(sbatch --parsable --output=/dev/null -p urgent -n "$cores" --wrap "sleep 1")" ;;
    "put back") scontrol requeue "$3" ;;
    "ended by a signal") scancel --signal=USR1 --batch "$3" ;;
    killed) kill -KILL "$(head -1 "$work/broken/shot$1/.ringlet.lock")" ;;
  esac
}
k=0
for how in preempted "put back" "ended by a signal" killed preempted "put back" "ended by a signal" killed; do
  k=$((k + 1))
  job=$(submit --array=$k --cpus-per-task="$cores" examples/farm/shots.sbatch)
  check "shot $k is $how" break_it $k "$how" "$job"
  wait_for 120 is_over "$job" || true
  check "  and has the bits of the shot without a break: $(hash_of "$work/whole/shot$k/report.json")" \
    [ "$(hash_of "$work/broken/shot$k/report.json")" = "$(hash_of "$work/whole/shot$k/report.json")" ]
  check "  in every frame" cmp -s "$work/broken/shot$k/hair.rgc" "$work/whole/shot$k/hair.rgc"
  echo "        $(($(frames_in "$work/broken/shot$k/progress.jsonl") - 300)) of 300 frames were computed twice;" \
    "went on from frame $(sed -n 's/.*"resumed_from": \(.*\),/\1/p' "$work/broken/shot$k/report.json")"
done

# 3. What cannot be done is not started again.
echo "[groom" > "$work/bad.toml"
echo "bad $work/bad.toml" > "$work/bad.txt"
job=$(FARM_SHOTS=$work/bad.txt submit --array=1 examples/farm/shots.sbatch)
wait_for 60 is_over "$job" || true
check "a broken scene fails, once" [ "$(state_of "$job"),$(grep -c 'gives up' "$work/shots-${job}_1.log")" = FAILED,1 ]
check "  and was not put back" grep -q "Restarts=0" <(scontrol show job "$job")

# 4. Two tasks on one folder, at once.
if [ "$cores" -ge 2 ]; then
  FARM_OUT=$work/two
  one=$(submit --array=1 examples/farm/shots.sbatch)
  two=$(submit --array=1 examples/farm/shots.sbatch)
  wait_for 180 is_over "$one" || true
  wait_for 180 is_over "$two" || true
  check "of two tasks on one folder one waits" grep -q "another run has the folder" "$work"/shots-"$one"_1.log "$work"/shots-"$two"_1.log
  check "  and both end well: $(state_of "$one"), $(state_of "$two")" [ "$(state_of "$one"),$(state_of "$two")" = COMPLETED,COMPLETED ]
  check "  with the bits of one" cmp -s "$work/two/shot1/hair.rgc" "$work/whole/shot1/hair.rgc"
fi

# 5. A sweep in parts, one of which is put back, and its table.
FARM_OUT=$work
array=$(submit --array=1-4 examples/farm/sweep.sbatch)
wait_for 60 has_frames "$work/sweep/progress-1.jsonl" 10 && scontrol requeue "${array}_1"
wait_for 180 is_over "$array" || true
bash examples/farm/sweep.sbatch 2> "$work/sweep.log"
check "a sweep of 12 runs in 4 parts is done" [ "$(wc -l < "$work/sweep/sweep.csv")" = 13 ]
exit $failed
