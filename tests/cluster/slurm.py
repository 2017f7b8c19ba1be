"""Slurm on one node of its own: slurmctld, slurmd and munged, as root and without systemd."""

import os
import secrets
import subprocess

import apart
import edits

PACKAGES = {
    "munged": "munge",
    "slurmctld": "slurmctld",
    "slurmd": "slurmd",
    "sbatch": "slurm-client",
}
PROCESSORS = 4

services = []


def configuration(folder):
    return f"""
ClusterName=test
SlurmctldHost=lapwing-test(127.0.0.1)
NodeName=lapwing-test NodeAddr=127.0.0.1 CPUs={PROCESSORS}
PartitionName=all Nodes=ALL Default=YES
# As many processors as we say, not as there are: shards run side by side on the smallest machine.
SlurmdParameters=config_overrides
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
# Root's, in a folder of its own; by default user slurm's, in /var.
SlurmUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
AuthInfo=socket={folder}/munge.socket
# No control groups, which the default takes: they are systemd's to hand out.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
# Seconds between SIGTERM and SIGKILL to what is cancelled; 30 by default.
KillWait=1
"""


def start():
    folder = apart.folder() / "slurm"
    folder.mkdir(mode=0o755)
    for name in ("state", "spool"):
        (folder / name).mkdir()
    (folder / "slurm.conf").write_text(configuration(folder))
    os.environ["SLURM_CONF"] = str(folder / "slurm.conf")

    key = folder / "munge.key"
    key.touch(mode=0o600)
    key.write_bytes(secrets.token_bytes(128))
    run_service(
        *("munged", "--foreground", f"--key-file={key}", f"--socket={folder}/munge.socket"),
        *(f"--pid-file={folder}/munged.pid", f"--seed-file={folder}/munge.seed"),
    )
    edits.wait_for((folder / "munge.socket").exists, "munged")
    run_service("slurmctld", "-D")
    run_service("slurmd", "-D")
    edits.wait_for(lambda: "idle" in ask("sinfo", "--noheader", "--format=%T"), "Slurm's node")


def run_service(program, *arguments):
    """Until the test ends."""
    with open(apart.folder() / f"{program}.log", "wb") as log:
        services.append(subprocess.Popen([program, *arguments], stdout=log, stderr=log))


def ask(*command):
    """What a command prints, or nothing where it fails."""
    return subprocess.run(command, capture_output=True, text=True).stdout


def command(*words):
    subprocess.run(words, check=True)


def state(job):
    """PENDING, RUNNING, COMPLETED, CANCELLED, FAILED, ..."""
    return field(job, "JobState")


def field(job, name):
    words = ask("scontrol", "show", "job", job).split()
    return next(
        (word.removeprefix(f"{name}=") for word in words if word.startswith(f"{name}=")), ""
    )
