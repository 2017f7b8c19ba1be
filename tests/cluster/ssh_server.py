"""Machines to reach by ssh: this one, by some of its loopback addresses."""

import pathlib
import subprocess

import apart
import edits

PACKAGES = {"ssh": "openssh-client", "dropbear": "dropbear-bin", "dropbearkey": "dropbear-bin"}

server = []


def start(addresses):
    """Dropbear, the small ssh server, which looks for keys nowhere but in the folder that the user
    database calls home: so that is another one in this namespace of mounts."""
    home = apart.folder() / "home"
    users = pathlib.Path("/etc/passwd").read_text().splitlines()
    users = [of_home(user, home) if user.startswith("root:") else user for user in users]
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
        server.append(subprocess.Popen(command, stderr=log))
    edits.wait_for(lambda: all(answers(address) for address in addresses), "dropbear")


def of_home(user, home):
    words = user.split(":")
    words[5] = str(home)
    return ":".join(words)


def answers(address):
    return subprocess.run(["ssh", address, "true"], stderr=subprocess.DEVNULL).returncode == 0
