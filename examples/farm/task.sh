# What a task of a farm does around a command of ringlet; sourced by shots.sbatch and sweep.sbatch (docs/farm.md).
#   run_task COMMAND...   runs it, passes the scheduler's signal on, and leaves its exit status in $status
#   end_task              says what is to be done next, tells Slurm, and ends with that status
# Without Slurm the same words are said, and nobody is told.
# FARM_STARTS: so often a task is started at most, preemptions included.

starts=${FARM_STARTS:-20}
cores=${SLURM_CPUS_PER_TASK:-${SLURM_CPUS_ON_NODE:-1}}

# On a disk of the node, and kept from one task to the next: compiled kernels are of this node's driver.
cache=${FARM_CACHE:-${TMPDIR:-/tmp}/ringlet-cache-$(id -u)}
mkdir -p -m 700 "$cache"
export RINGLET_CACHE_DIR=$cache/ringlet MESA_SHADER_CACHE_DIR=$cache
export LP_NUM_THREADS=$cores   # lavapipe's; it would take all cores of the node where Slurm does not bind tasks

say() { echo "farm: task ${SLURM_ARRAY_TASK_ID:-} of job ${SLURM_JOB_ID:-none}, start $((${SLURM_RESTART_COUNT:-0} + 1)): $*" >&2; }

# Slurm sends USR1 to this shell alone, some time before the time limit (--signal=B:USR1@...): it is passed on as TERM.
# TERM it sends to every process of the task. That one is not passed on: a second signal ends ringlet without a checkpoint.
ended_by=nobody
passed_on=no
run_task() {
  "$@" < /dev/null &
  child=$!
  trap 'noted=yes; ended_by=us; [ "$passed_on" = yes ] || kill -TERM "$child"; passed_on=yes' USR1
  trap 'noted=yes; ended_by=slurm' TERM
  noted=yes
  while [ "$noted" = yes ]; do   # a trap ends `wait` early
    noted=no
    wait "$child"
    status=$?
  done
}

# tell COMMAND WHY: Slurm puts this task back into its queue (requeue), or holds it there (requeuehold).
tell() {
  if [ $((${SLURM_RESTART_COUNT:-0} + 1)) -ge "$starts" ]; then
    say "$2, and this was the last start of $starts; gives up"
  elif [ -z "${SLURM_JOB_ID:-}" ]; then
    say "$2; start it again"
  else
    say "$2; $1"
    scontrol "$1" "$SLURM_JOB_ID"
  fi
}

end_task() {
  case $status in
    0) say "done" ;;
    130 | 143)  # a signal
      case $ended_by in
        us) tell requeue "the time is nearly up" ;;
        slurm) say "Slurm ended it; where it was preempted or put back, it goes on" ;;
        *) say "a person ended it" ;;
      esac ;;
    6) tell requeuehold "the disk is full: make room, then scontrol release" ;;
    7) tell requeue "another run has the folder" ;;
    8 | 9) tell requeue "memory is used up" ;;
    10) tell requeue "the device was lost" ;;
    13[0-9] | 1[4-9][0-9]) tell requeue "signal $((status - 128)) ended the program" ;;
    3) say "done, but some particles have no position; gives up, since the next start gives the same bits" ;;
    *) say "exit status $status; gives up, since the next start fails likewise" ;;
  esac
  exit "$status"
}
