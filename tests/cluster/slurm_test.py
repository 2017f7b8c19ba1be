#!/usr/bin/python3
"""Shards of a file of edits as jobs of Slurm."""

import os
import re
import signal
import subprocess
import unittest

import apart
import edits
import slurm


def setUpModule():
    edits.make()
    slurm.start()


def submit(folder):
    """Numbers of the array and of the job that merges."""
    command = [
        edits.TOOLS / "batch/slurm-shards",
        str(edits.SHARDS),
        f"--output={folder}-%j.log",
    ]
    command += ["--", edits.JOBS, "-o", folder]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return re.match(r"Job (\d+): .*Job (\d+): ", said).groups()


def wait_for_end(job):
    edits.wait_for(lambda: slurm.state(job) in ("COMPLETED", "FAILED", "CANCELLED"), f"job {job}")


def requeued(job):
    return slurm.state(job) == "PENDING" and slurm.field(job, "Restarts") == "1"


class SlurmShards(unittest.TestCase):
    def test_those_that_are_killed_go_on_and_the_result_is_one_process_s(self):
        array, merging = submit("killed")
        shards = [1, 2, 3]
        frozen = edits.freeze("killed", shards)
        taken, out_of_memory, out_of_time = jobs = [f"{array}_{shard}" for shard in shards]
        slurm.command("scontrol", "requeue", taken)
        os.kill(frozen[2], signal.SIGKILL)
        os.kill(edits.parent_of(frozen[3]), signal.SIGUSR1)  # by Slurm, when the time is nearly up
        os.kill(frozen[3], signal.SIGCONT)

        for job in jobs:
            edits.wait_for(lambda: requeued(job), f"job {job} in the queue once more")
            # By itself it would wait for two minutes.
            slurm.command("scontrol", "update", f"JobId={job}", "StartTime=now")
        wait_for_end(merging)
        self.assertEqual(slurm.field(merging, "ExitCode"), f"{edits.SOME_FAILED}:0")
        self.assertEqual(edits.differences("killed"), [])

    def test_of_a_cancelled_one_nothing_is_merged_and_the_same_command_goes_on(self):
        array, merging = submit("cancelled")
        edits.freeze("cancelled", [2])
        slurm.command("scancel", "--signal=KILL", f"{array}_2")
        wait_for_end(merging)
        self.assertEqual(slurm.state(merging), "CANCELLED")
        kept = edits.written("cancelled", 2)

        array, merging = submit("cancelled")
        wait_for_end(merging)
        self.assertEqual(edits.differences("cancelled"), [])
        self.assertLessEqual(kept, edits.written("cancelled"), "nothing was done twice")


if __name__ == "__main__":
    apart.main(slurm.PACKAGES)
