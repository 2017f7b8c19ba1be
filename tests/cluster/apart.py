"""Runs the tests of a file in separate namespaces for processes, mounts, network and host name. The
tests can start services on their usual ports, and nothing is visible outside or left behind: when
the first process ends, the system ends all others."""

import fcntl
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 77  # by tests/cluster/CMakeLists.txt
FOLDER = "LAPWING_TEST_FOLDER"
LOG_LINES = 60


def folder():
    """Returns the folder of the tests' files, which is removed after them. Files *.log are shown when
    a test fails. The path is short enough for sockets."""
    return pathlib.Path(os.environ[FOLDER])


def main(packages):
    """Runs the tests of the calling file. `packages` maps each program that they need to its Debian
    package. Tests that cannot run are skipped, but in CI a missing package is an error."""
    if FOLDER in os.environ:
        enter()
        unittest.main()
    if missing := missing_packages(packages):
        print(f"These tests need {missing}, which tools/setup/install-packages --cluster installs")
        sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)
    if obstacle := what_is_not_allowed():
        print(f"These tests cannot run: {obstacle}")
        sys.exit(SKIPPED)
    sys.exit(run_apart())


def missing_packages(packages):
    missing = {packages[program] for program in packages if not shutil.which(program, path=path())}
    return ", ".join(sorted(missing))


def what_is_not_allowed():
    if os.geteuid() != 0:
        return "only root can start Slurm's services"
    trial = subprocess.run([*NAMESPACES, "true"], capture_output=True, text=True)
    return f"no namespaces here: {trial.stderr.strip()}" if trial.returncode else ""


# When this process ends, even by SIGKILL, the kernel kills unshare and the first process of the
# namespace.
NAMESPACES = ["setpriv", "--pdeathsig", "KILL", "unshare", "--pid", "--fork", "--kill-child"]
NAMESPACES += ["--mount", "--mount-proc", "--net", "--uts"]


def path():
    return os.environ["PATH"] + ":/usr/sbin:/sbin"


def run_apart():
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    made = tempfile.mkdtemp(prefix="lapwing-cluster-")
    try:
        os.chmod(made, 0o755)  # munged requires that everyone can reach its socket
        os.mkdir(os.path.join(made, "home"), 0o700)
        kept = {k: v for k, v in os.environ.items() if not re.match("SLURM_|SBATCH_|PARALLEL", k)}
        environment = kept | {FOLDER: made, "PATH": path(), "HOME": os.path.join(made, "home")}
        # The first process of the namespace is a shell, which reaps orphaned service processes.
        command = ["sh", "-c", '"$@"; exit $?', "sh", sys.executable, *sys.argv]
        result = subprocess.run([*NAMESPACES, *command], env=environment).returncode
        if result != 0:
            show_logs(pathlib.Path(made))
        return result
    finally:
        shutil.rmtree(made, ignore_errors=True)


def show_logs(made):
    for log in sorted(made.rglob("*.log")):
        lines = log.read_text(errors="replace").splitlines()
        print(f"== {log.relative_to(made)}, the last of {len(lines)} lines")
        print("\n".join(lines[-LOG_LINES:]))


def enter():
    """Sets up the host name and the network. A new network has only a loopback device, which is down.
    With 127.0.0.1 as the only address, the C library would resolve no names for Slurm."""
    socket.sethostname("lapwing-test")
    set_address, set_flags, up = 0x8916, 0x8914, 1
    second_address = (socket.AF_INET, socket.inet_aton("127.0.0.2"))
    with socket.socket() as any_socket:
        fcntl.ioctl(any_socket, set_flags, struct.pack("16sh14x", b"lo", up))
        fcntl.ioctl(any_socket, set_address, struct.pack("16sh2x4s8x", b"lo:1", *second_address))
