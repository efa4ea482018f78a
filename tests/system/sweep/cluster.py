"""A Slurm cluster of two nodes on this machine, in a folder of its own and on free ports.

in     Cluster(): starts munged, slurmctld and a slurmd for each node; stop() ends them
out    environment() for sbatch, squeue; kill_node(): the node and all that runs on it are gone
errors a daemon that does not come up is an AssertionError with the end of its log
SPDX-License-Identifier: Apache-2.0
"""
import getpass
import os
import pathlib
import signal
import socket
import subprocess
import tempfile
import time

NODES = ("car1", "car2")

CONFIGURATION = """
ClusterName=bench
SlurmctldHost={host}(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket={folder}/munge.sock
CredType=cred/munge
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={ports[0]}
SlurmctldPidFile={folder}/slurmctld.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdPidFile={folder}/%n.pid
SlurmdLogFile={folder}/%n.log
SlurmdSpoolDir={folder}/spool-%n
StateSaveLocation={folder}/state
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=3
SchedulerParameters=sched_interval=1,sched_min_interval=0
SlurmdParameters=config_overrides
NodeName=car1 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1 State=UNKNOWN
NodeName=car2 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    def __init__(self):
        self.temporary = tempfile.TemporaryDirectory(prefix="slurm-", dir="/tmp")  # short: sockets
        self.folder = pathlib.Path(self.temporary.name)
        self.daemons = {}
        (self.folder / "state").mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        configuration = CONFIGURATION.format(
            host=socket.gethostname(), folder=self.folder, user=getpass.getuser(),
            ports=free_ports(3),
        )  # fmt: skip
        (self.folder / "slurm.conf").write_text(configuration)
        self.start("munged", "munged", "--foreground", "--force",
                   f"--socket={self.folder}/munge.sock", f"--key-file={key}",
                   f"--pid-file={self.folder}/munged.pid", f"--log-file={self.folder}/munged.log",
                   f"--seed-file={self.folder}/munge.seed")  # fmt: skip
        self.until("munged", lambda: (self.folder / "munge.sock").exists())
        self.start("slurmctld", "slurmctld", "-D")
        for node in NODES:
            self.start(node, "slurmd", "-D", "-N", node)
        self.until("slurmctld", lambda: self.said("sinfo", "-h", "-t", "idle", "-o", "%D") == "2")

    def start(self, name, *command):
        with open(self.folder / f"{name}.out", "w") as log:
            self.daemons[name] = subprocess.Popen(
                command, stdout=log, stderr=log, env=self.environment(), start_new_session=True
            )

    def environment(self):
        return {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}

    def said(self, *command):
        return subprocess.run(command, env=self.environment(), text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT).stdout.strip()  # fmt: skip

    def until(self, name, is_so):
        for _ in range(600):
            if is_so():
                return
            assert self.daemons[name].poll() is None, (self.folder / f"{name}.out").read_text()
            time.sleep(0.1)
        raise AssertionError(f"{name} did not come up: {(self.folder / f'{name}.out').read_text()}")

    def kill_node(self, node):
        """As if its power went: slurmd, its steps and their jobs."""
        self.daemons[node].kill()
        self.daemons[node].wait()
        # A step's daemon and its job are in sessions of their own; both know their node.
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                own = (process / "environ").read_bytes() + (process / "cmdline").read_bytes()
            except OSError:
                continue
            name = f"SLURMD_NODENAME={node}".encode()
            if str(self.folder).encode() in own and (name in own or f"[{node}".encode() in own):
                os.kill(int(process.name), signal.SIGKILL)

    def stop(self):
        self.said("scancel", "--user", getpass.getuser())
        for name in reversed(list(self.daemons)):
            daemon = self.daemons[name]
            if daemon.poll() is None:
                daemon.terminate()
                try:
                    daemon.wait(5)
                except subprocess.TimeoutExpired:
                    daemon.kill()
                    daemon.wait()
        self.temporary.cleanup()
