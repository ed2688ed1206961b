# A Slurm cluster of this machine alone, without systemd; to be sourced. All its files are in a separate folder, also the socket and
# the key of munge, so it does not disturb another cluster.

# start_slurm FOLDER: starts munged, slurmctld and slurmd, and returns when the node accepts jobs. The folder's name must be short, because the path
# of a socket must be.
start_slurm() {
  slurm_folder=$(realpath "$1")
  mkdir -p "$slurm_folder"/{state,spool,log}
  chmod 700 "$slurm_folder"
  (umask 077 && head -c 1024 /dev/urandom >"$slurm_folder/munge.key")
  munged --force --key-file="$slurm_folder/munge.key" --socket="$slurm_folder/munge.socket" --pid-file="$slurm_folder/munged.pid" \
    --log-file="$slurm_folder/log/munged.log" --seed-file="$slurm_folder/munge.seed"
  local ports
  # The system returns two unused ports.
  read -ra ports < <(python3 -c 'import socket
sockets = [socket.socket() for _ in range(2)]
for each in sockets: each.bind(("127.0.0.1", 0))
print(*(each.getsockname()[1] for each in sockets))')
  cat >"$slurm_folder/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$slurm_folder/munge.socket
CredType=cred/munge
SlurmctldPort=${ports[0]}
SlurmdPort=${ports[1]}
StateSaveLocation=$slurm_folder/state
SlurmdSpoolDir=$slurm_folder/spool
SlurmctldPidFile=$slurm_folder/slurmctld.pid
SlurmdPidFile=$slurm_folder/slurmd.pid
SlurmctldLogFile=$slurm_folder/log/slurmctld.log
SlurmdLogFile=$slurm_folder/log/slurmd.log
# A container has neither cgroups nor a mail program.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MailProg=/bin/true
MpiDefault=none
SwitchType=switch/none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
KillWait=2
MinJobAge=10
NodeName=localhost NodeAddr=127.0.0.1 CPUs=$(nproc)
PartitionName=all Nodes=localhost Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$slurm_folder/slurm.conf
  slurmctld
  slurmd -N localhost
  local tries
  for ((tries = 0; tries < 300; ++tries)); do
    [[ $(sinfo --noheader --format=%t 2>/dev/null) == idle ]] && return
    sleep 0.2
  done
  tail "$slurm_folder"/log/*.log >&2
  echo "the node of Slurm takes no jobs" >&2
  return 1
}

# Ends the jobs and the daemons that start_slurm has started.
stop_slurm() {
  [[ -n ${slurm_folder:-} ]] || return 0
  scancel --user="$(id -un)" 2>/dev/null || true
  local daemon pid
  for daemon in slurmd slurmctld munged; do
    pid=$(cat "$slurm_folder/$daemon.pid" 2>/dev/null) || continue
    kill "$pid" 2>/dev/null || continue
    while kill -0 "$pid" 2>/dev/null; do sleep 0.1; done
  done
  slurm_folder=
}
