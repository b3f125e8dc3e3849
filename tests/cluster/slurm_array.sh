#!/bin/bash
# A study of 200 cases as a Slurm array on one node, with tasks killed on the way: nothing is lost, nothing counted twice,
# and the merged results are the bytes of one process. slurm_array.sh PROGRAM SOURCE; exit code 77: skipped.
#
# UNTIL: simulated time of a case [s], less on a busy machine. The node is brought up as root without systemd, in a temporary folder, and ended by the ids of its own processes.
set -u
program=$(realpath "$1") source=$(realpath "$2")
skip() { echo "skipped: $1"; exit 77; }
fail() { echo "failed: $1"; exit 1; }
[ "$(id -u)" -eq 0 ] || skip "a node of Slurm's own is brought up as root"
if ! command -v slurmctld slurmd sbatch munged > /dev/null; then
  apt-get install -y --no-install-recommends slurm-wlm munge > /dev/null 2>&1 || skip "slurm-wlm and munge cannot be installed"
fi
pgrep -x slurmctld > /dev/null && skip "a Slurm controller runs on this machine already"

folder=$(mktemp -d /tmp/trammel_slurm_XXXXXX)
mkdir -p "$folder"/spool "$folder"/state "$folder"/log
mkdir -p /run/munge /var/log/munge /var/lib/munge
chown munge:munge /run/munge /var/log/munge /var/lib/munge
chmod 711 /var/lib/munge
[ -e /etc/munge/munge.key ] || runuser -u munge -- mungekey --create || skip "munge has no key"
started_munge=
pgrep -x munged > /dev/null || { runuser -u munge -- munged && started_munge=$(pgrep -x -n munged); }
host=$(hostname)
cat > "$folder/slurm.conf" <<C
ClusterName=trammel
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=1,sched_interval=5
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
ReturnToService=2
SlurmdTimeout=20
KillWait=5
MpiDefault=none
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
C
export SLURM_CONF=$folder/slurm.conf
stop() {
  for daemon in slurmd slurmctld; do [ -s "$folder/$daemon.pid" ] && kill "$(cat "$folder/$daemon.pid")"; done
  [ -n "$started_munge" ] && kill "$started_munge"
  rm -rf "$folder"
} 2> /dev/null
trap stop EXIT
slurmctld -f "$SLURM_CONF" && slurmd -f "$SLURM_CONF" || skip "the daemons of Slurm do not start here"
for _ in $(seq 200); do sinfo -h -o %t 2> /dev/null | grep -q idle && break; sleep 0.1; done
sinfo -h -o %t | grep -q idle || skip "the node of Slurm does not come up"

cat > "$folder/study.json" <<S
{"study": 1, "scene": "$source/scenes/tour/01_pendulum.json", "set": {"simulate.until": ${UNTIL:-15}},
 "vary": {"parameters.L": {"from": 0.1, "to": 2, "count": 20, "scale": "log"}, "parameters.m": {"from": 1, "to": 2, "count": 10}},
 "reduce": {"low": {"observe": "tip_y", "as": "min"}, "down": {"observe": "tip_x", "as": "first_crossing", "direction": "down"}}}
S
cd "$folder"
"$program" study study.json --out whole --jobs 1 --quiet || fail "the study does not run in one process"
export TRAMMEL=$program
job=$(sbatch --parsable --array=1-8 --output="$folder/log/%a.txt" "$source/tools/study.sbatch" "$folder/study.json" "$folder") ||
  fail "sbatch refuses the array"
# Two tasks get SIGTERM, as at their time limit, and are queued again; a worker of a third one is killed at once.
# A requeued task waits two minutes: Slurm's own rule.
terminated= killed=0
for round in $(seq 6000); do
  for task in 1 4; do
    if [[ $terminated != *$task* ]] && [ -s "shard_$task/cases.ndjson" ]; then
      scancel --signal=TERM --batch "${job}_$task" 2> /dev/null
      terminated+=$task  # once: a task that is terminated again when it was requeued would wait once more
    fi
  done
  if [ $killed -eq 0 ] && [ -s shard_6/cases.ndjson ]; then
    worker=$(pgrep -f -n "^$program study .*--shard 6/8") && kill -KILL "$worker" && killed=1
  fi
  [ $((round % 20)) -eq 0 ] && [ -z "$(squeue -h -j "$job" 2> /dev/null)" ] && break
  sleep 0.05
done
[ -z "$(squeue -h -j "$job" 2> /dev/null)" ] || fail "the array does not end"
echo "terminated: tasks $terminated; workers killed: $killed"
"$program" study merge shard_* --out merged --quiet || fail "cases are missing: $(cat log/*.txt)"
cmp whole/study.csv merged/study.csv || fail "study.csv differs"
cmp whole/study.npz merged/study.npz || fail "study.npz differs"
lines=$(cat shard_*/cases.ndjson | wc -l)
[ "$lines" -eq 200 ] || fail "$lines cases were counted, not 200"
[ -n "$terminated" ] || fail "the tasks ended before one could be terminated"
echo "200 cases, none lost, none counted twice, equal to one process bit by bit"
