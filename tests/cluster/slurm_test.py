#!/usr/bin/python3
"""Runs shards of a file of edits as Slurm jobs."""

import os
import re
import secrets
import signal
import subprocess
import unittest

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
# Use the CPUs above, not those that exist: shards run side by side even on a small machine.
SlurmdParameters=config_overrides
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
# Run as root in our folder; the default is user slurm in /var.
SlurmUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
AuthInfo=socket={folder}/munge.socket
# The default needs control groups, which only systemd provides.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
# Seconds between SIGTERM and SIGKILL for a cancelled job; the default is 30.
KillWait=1
"""


def start_slurm():
    """Starts slurmctld, slurmd and munged on one node, as root and without systemd."""
    folder = apart.folder() / "slurm"
    folder.mkdir(mode=0o755)
    for name in ("state", "spool"):
        (folder / name).mkdir()
    (folder / "conf").write_text(configuration(folder))
    os.environ["SLURM_CONF"] = str(folder / "conf")

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
    """Starts a program that runs until the tests end."""
    with open(apart.folder() / f"{program}.log", "wb") as log:
        services.append(subprocess.Popen([program, *arguments], stdout=log, stderr=log))


def ask(*command):
    """Returns the output of a command, empty if it fails."""
    return subprocess.run(command, capture_output=True, text=True).stdout


def command(*words):
    subprocess.run(words, check=True)


def state(job):
    """Returns PENDING, RUNNING, COMPLETED, CANCELLED, FAILED, ..."""
    return field(job, "JobState")


def field(job, name):
    words = ask("scontrol", "show", "job", job).split()
    return next(
        (word.removeprefix(f"{name}=") for word in words if word.startswith(f"{name}=")), ""
    )


def setUpModule():
    edits.make()
    start_slurm()


def submit(folder):
    """Submits the shards. Returns the numbers of the array and of the merging job."""
    command = [
        edits.TOOLS / "batch/slurm-shards",
        str(edits.SHARDS),
        f"--output={folder}-%j.log",
    ]
    command += ["--", edits.JOBS, "-o", folder]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return re.match(r"Job (\d+): .*Job (\d+): ", said).groups()


def wait_for_end(job):
    edits.wait_for(lambda: state(job) in ("COMPLETED", "FAILED", "CANCELLED"), f"job {job}")


def requeued(job):
    return state(job) == "PENDING" and field(job, "Restarts") == "1"


class SlurmShards(unittest.TestCase):
    def test_killed_shards_continue_and_the_result_is_that_of_one_process(self):
        array, merging = submit("killed")
        shards = [1, 2, 3]
        frozen = edits.freeze("killed", shards)
        taken, out_of_memory, out_of_time = jobs = [f"{array}_{shard}" for shard in shards]
        command("scontrol", "requeue", taken)
        os.kill(frozen[2], signal.SIGKILL)
        os.kill(edits.parent_of(frozen[3]), signal.SIGUSR1)  # as Slurm does when the time is nearly up
        os.kill(frozen[3], signal.SIGCONT)

        for job in jobs:
            edits.wait_for(lambda: requeued(job), f"job {job} in the queue once more")
            # Without this, Slurm would restart the job only after two minutes.
            command("scontrol", "update", f"JobId={job}", "StartTime=now")
        wait_for_end(merging)
        self.assertEqual(field(merging, "ExitCode"), f"{edits.SOME_FAILED}:0")
        self.assertEqual(edits.differences("killed"), [])

    def test_nothing_is_merged_after_a_cancellation_and_the_same_command_continues(self):
        array, merging = submit("cancelled")
        edits.freeze("cancelled", [2])
        command("scancel", "--signal=KILL", f"{array}_2")
        wait_for_end(merging)
        self.assertEqual(state(merging), "CANCELLED")
        kept = edits.written("cancelled", 2)

        array, merging = submit("cancelled")
        wait_for_end(merging)
        self.assertEqual(edits.differences("cancelled"), [])
        self.assertLessEqual(kept, edits.written("cancelled"), "nothing was done twice")


if __name__ == "__main__":
    apart.main(PACKAGES)
