#!/usr/bin/python3
"""Runs shards of a file of edits with GNU parallel, on this machine and by ssh."""

import os
import pathlib
import signal
import subprocess
import unittest

import apart
import edits

PACKAGES = {
    "parallel": "parallel",
    "ssh": "openssh-client",
    "dropbear": "dropbear-bin",
    "dropbearkey": "dropbear-bin",
}
OUTPUT = ["--displacements", "float32"]
MACHINES = ["127.0.0.2", "127.0.0.3"]
DEAD_MACHINE = "127.0.0.4"

services = []


def setUpModule():
    edits.make(*OUTPUT)


def start(folder, *options):
    command = [edits.TOOLS / "batch/parallel-shards", str(edits.SHARDS), *options]
    command += ["--jobs", "2", "--", edits.JOBS, "-o", folder, "--threads", "1", *OUTPUT]
    with open(f"{folder}.log", "ab") as log:
        return subprocess.Popen(command, stdout=log, stderr=log, start_new_session=True)


def start_ssh_server(addresses):
    """Starts dropbear, a small ssh server, on loopback addresses of this machine. It takes keys only
    from the home folder in the user database, so this namespace gets its own database."""
    home = apart.folder() / "home"
    users = pathlib.Path("/etc/passwd").read_text().splitlines()
    users = [with_home(user, home) if user.startswith("root:") else user for user in users]
    (apart.folder() / "passwd").write_text("\n".join(users) + "\n")
    subprocess.run(["mount", "--bind", apart.folder() / "passwd", "/etc/passwd"], check=True)

    keys = home / ".ssh"
    keys.mkdir(mode=0o700)
    subprocess.run(
        ["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", keys / "id_ed25519"], check=True
    )
    (keys / "authorized_keys").write_text((keys / "id_ed25519.pub").read_text())
    (keys / "config").write_text("StrictHostKeyChecking no\nLogLevel ERROR\n")

    host_key = apart.folder() / "host-key"
    subprocess.run(
        ["dropbearkey", "-t", "ed25519", "-f", host_key], check=True, capture_output=True
    )
    places = [word for address in addresses for word in ("-p", f"{address}:22")]
    command = ["dropbear", "-F", "-E", "-s", "-r", host_key, *places]
    with open(apart.folder() / "dropbear.log", "wb") as log:
        services.append(subprocess.Popen(command, stderr=log))
    edits.wait_for(lambda: all(answers(address) for address in addresses), "dropbear")


def with_home(user, home):
    words = user.split(":")
    words[5] = str(home)
    return ":".join(words)


def answers(address):
    return subprocess.run(["ssh", address, "true"], stderr=subprocess.DEVNULL).returncode == 0


class ParallelShards(unittest.TestCase):
    def test_a_killed_shard_continues_and_the_result_is_that_of_one_process(self):
        shards = start("killed")
        os.kill(edits.freeze("killed", [3])[3], signal.SIGKILL)
        self.assertEqual(shards.wait(), edits.SOME_FAILED)
        self.assertEqual(edits.differences("killed"), [])

    def test_the_same_command_continues_after_all_were_killed(self):
        shards = start("all-killed")
        frozen = edits.freeze("all-killed", [1, 2])
        os.killpg(shards.pid, signal.SIGKILL)
        for process in frozen.values():  # parallel puts each in its own process group
            os.kill(process, signal.SIGKILL)
        shards.wait()

        self.assertEqual(start("all-killed").wait(), edits.SOME_FAILED)
        self.assertEqual(edits.differences("all-killed"), [])

    def test_a_shard_that_always_fails_stops_the_others_and_nothing_is_merged(self):
        os.mkdir("no-room")
        os.mkdir(f"no-room/results-1-of-{edits.SHARDS}.jsonl")
        self.assertEqual(start("no-room").wait(), 1)
        self.assertNotIn("results.jsonl", os.listdir("no-room"))

        os.rmdir(f"no-room/results-1-of-{edits.SHARDS}.jsonl")
        self.assertEqual(start("no-room").wait(), edits.SOME_FAILED)
        self.assertEqual(edits.differences("no-room"), [])

    def test_the_other_machines_do_the_shards_of_a_dead_one(self):
        start_ssh_server(MACHINES)
        machines = ",".join([*MACHINES, DEAD_MACHINE])
        self.assertEqual(start("by-ssh", "--sshlogin", machines).wait(), edits.SOME_FAILED)
        self.assertEqual(edits.differences("by-ssh"), [])


if __name__ == "__main__":
    apart.main(PACKAGES)
