#!/usr/bin/python3
"""Shards of a file of edits by GNU parallel, on this machine and by ssh."""

import os
import signal
import subprocess
import unittest

import apart
import edits
import ssh_server

OUTPUT = ["--displacements", "float32"]
MACHINES = ["127.0.0.2", "127.0.0.3"]
DEAD_MACHINE = "127.0.0.4"


def setUpModule():
    edits.make(*OUTPUT)


def start(folder, *options):
    command = [edits.TOOLS / "batch/parallel-shards", str(edits.SHARDS), *options]
    command += ["--jobs", "2", "--", edits.JOBS, "-o", folder, "--threads", "1", *OUTPUT]
    with open(f"{folder}.log", "ab") as log:
        return subprocess.Popen(command, stdout=log, stderr=log, start_new_session=True)


class ParallelShards(unittest.TestCase):
    def test_one_that_is_killed_goes_on_and_the_result_is_one_process_s(self):
        shards = start("killed")
        os.kill(edits.freeze("killed", [3])[3], signal.SIGKILL)
        self.assertEqual(shards.wait(), edits.SOME_FAILED)
        self.assertEqual(edits.differences("killed"), [])

    def test_when_all_is_killed_the_same_command_goes_on(self):
        shards = start("all-killed")
        frozen = edits.freeze("all-killed", [1, 2])
        os.killpg(shards.pid, signal.SIGKILL)
        for process in frozen.values():  # parallel gives each a group of its own
            os.kill(process, signal.SIGKILL)
        shards.wait()

        self.assertEqual(start("all-killed").wait(), edits.SOME_FAILED)
        self.assertEqual(edits.differences("all-killed"), [])

    def test_a_shard_that_fails_each_time_stops_them_and_nothing_is_merged(self):
        os.mkdir("no-room")
        os.mkdir(f"no-room/results-1-of-{edits.SHARDS}.jsonl")
        self.assertEqual(start("no-room").wait(), 1)
        self.assertNotIn("results.jsonl", os.listdir("no-room"))

        os.rmdir(f"no-room/results-1-of-{edits.SHARDS}.jsonl")
        self.assertEqual(start("no-room").wait(), edits.SOME_FAILED)
        self.assertEqual(edits.differences("no-room"), [])

    def test_by_ssh_what_a_dead_machine_was_given_is_done_by_the_others(self):
        ssh_server.start(MACHINES)
        machines = ",".join([*MACHINES, DEAD_MACHINE])
        self.assertEqual(start("by-ssh", "--sshlogin", machines).wait(), edits.SOME_FAILED)
        self.assertEqual(edits.differences("by-ssh"), [])


if __name__ == "__main__":
    apart.main({"parallel": "parallel"} | ssh_server.PACKAGES)
