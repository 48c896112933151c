"""A Slurm cluster of one node, this machine: three daemons with files, ports and a key of their own, while it is needed."""

import os
import socket
import subprocess
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "sinfo")
PATH = f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin"
STARTS_IN = 30  # seconds

CONFIGURATION = """
ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


class CannotStart(Exception):
    """Why there is no cluster here."""


def free_ports(count):
    """Ports that nobody listens on."""
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """As a context. environment: what Slurm's commands need to find it."""

    def __enter__(self):
        self.keep = tempfile.TemporaryDirectory(prefix="slurm-")
        self.folder, self.daemons = self.keep.name, []
        self.environment = {"SLURM_CONF": os.path.join(self.folder, "slurm.conf"), "PATH": PATH}
        try:
            self.start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        self.keep.cleanup()

    def write(self, name, content, mode):
        path = os.path.join(self.folder, name)
        with open(os.open(path, os.O_CREAT | os.O_WRONLY, mode), "wb") as file:
            file.write(content)

    def run_daemon(self, *command):
        with open(os.path.join(self.folder, command[0] + ".out"), "wb") as out:
            self.daemons.append(subprocess.Popen(command, env={**os.environ, **self.environment}, stdout=out,
                                                 stderr=subprocess.STDOUT))

    def start(self):
        os.chmod(self.folder, 0o755)
        for name in ("state", "spool"):
            os.mkdir(os.path.join(self.folder, name), 0o755)
        self.write("munge.key", os.urandom(128), 0o400)
        host, user = socket.gethostname().split(".")[0], os.environ.get("USER") or "root"
        configuration = CONFIGURATION.format(host=host, user="root" if not os.getuid() else user, ports=free_ports(2),
                                             folder=self.folder, processors=os.cpu_count())
        self.write("slurm.conf", configuration.encode(), 0o644)
        self.write("cgroup.conf", b"CgroupPlugin=autodetect\n", 0o644)
        names = {"socket": "munge.socket", "key-file": "munge.key", "log-file": "munge.log", "pid-file": "munge.pid",
                 "seed-file": "munge.seed"}
        options = (f"--{option}={self.folder}/{name}" for option, name in names.items())
        self.run_daemon("munged", "--foreground", "--force", *options)
        self.wait_until(lambda: os.path.exists(os.path.join(self.folder, "munge.socket")))
        for daemon in ("slurmctld", "slurmd"):
            self.run_daemon(daemon, "-D", "-f", self.environment["SLURM_CONF"])
        self.wait_until(lambda: self.ask("sinfo", "--noheader", "--format=%T").strip() == "idle")

    def wait_until(self, is_so):
        end = time.monotonic() + STARTS_IN
        while not is_so():
            ended = [daemon.args[0] for daemon in self.daemons if daemon.poll() is not None]
            if ended or time.monotonic() > end:
                raise CannotStart(f"{', '.join(ended) or 'the node'} did not start: {self.last_words()}")
            time.sleep(0.1)

    def last_words(self):
        """The last lines that each daemon has written."""
        words = []
        for name in sorted(os.listdir(self.folder)):
            if name.endswith((".out", ".log")):
                with open(os.path.join(self.folder, name), errors="replace") as file:
                    words += [f"{name}: {line.strip()}" for line in file.readlines()[-2:]]
        return "; ".join(words)

    def ask(self, *command):
        """What a command prints."""
        return subprocess.run(command, env={**os.environ, **self.environment}, capture_output=True, text=True, timeout=60).stdout

    def jobs(self):
        """How many jobs there are that have not ended."""
        return len(self.ask("squeue", "--noheader", "--array").splitlines())
