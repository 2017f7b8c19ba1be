"""A file of edits, its results by one process, and the processes of its shards."""

import json
import os
import pathlib
import re
import signal
import subprocess
import time

import apart

LAPWING = os.environ.get("LAPWING", "lapwing")
TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
SHARDS = 8
LINES = 64
FAILING_LINE = 30
SOME_FAILED = 3

JOBS = "jobs.jsonl"
WHOLE = "whole"


def make(*options):
    """Writes a tube, the recipe that bends it, and 64 ways to bend it, of which one fails, into the
    folder of the tests. WHOLE gets the results of one process with these options of lapwing batch."""
    os.chdir(apart.folder())
    subprocess.run([LAPWING, "shape", "tube", "-o", "tube.obj"], check=True)
    recipe = json.loads((TOOLS / "recipes/bend-tube.json").read_text())
    pathlib.Path("bend.json").write_text(
        json.dumps(recipe | {"mesh": "tube.obj", "save": "bent.ply"})
    )
    pathlib.Path(JOBS).write_text("".join(json.dumps(line(k)) + "\n" for k in range(1, LINES + 1)))
    done = subprocess.run([LAPWING, "batch", JOBS, "-o", WHOLE, "--quiet", *options])
    assert done.returncode == SOME_FAILED, f"lapwing batch ended with {done.returncode}"


def line(k):
    move = "/steps/0/handles/0/move/" + ("translate" if k != FAILING_LINE else "nowhere/else")
    return {"id": f"bent-{k:02}", "recipe": "bend.json", "set": {move: [1.5, 0.02 * k, -0.6]}}


def differences(folder):
    """Returns the names of the files that differ between `folder` and WHOLE."""
    folder, whole = pathlib.Path(folder), pathlib.Path(WHOLE)
    names = {file.name for place in (folder, whole) for file in place.iterdir()}
    return [name for name in sorted(names) if content(folder / name) != content(whole / name)]


def content(file):
    return file.read_bytes() if file.exists() else None


def results_of_shard(folder, shard):
    """Returns the number of lines in the shard's results."""
    results = content(pathlib.Path(folder) / f"results-{shard}-of-{SHARDS}.jsonl")
    return results.count(b"\n") if results else 0


def written(folder, shard=None):
    """Returns the files in the results of a shard, or of the whole, each with its time of writing."""
    ending = f"-{shard}-of-{SHARDS}" if shard else ""
    lines = (pathlib.Path(folder) / f"results{ending}.jsonl").read_text().splitlines()
    files = [json.loads(line)["file"] for line in lines]
    return {(file, (pathlib.Path(folder) / file).stat().st_mtime_ns) for file in files}


def process_of_shard(folder, shard):
    """Returns the process that runs the shard, or None."""
    wanted = rf"{re.escape(LAPWING)} batch .*-o {folder}\b.* --shard[ =]{shard}/{SHARDS}\b"
    for place in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (place / "cmdline").read_bytes().rstrip(b"\0").split(b"\0")
        except OSError:
            continue  # it has ended
        if re.search(wanted, b" ".join(words).decode()):
            return int(place.name)
    return None


def parent_of(process):
    status = pathlib.Path(f"/proc/{process}/status").read_text()
    return int(re.search(r"^PPid:\s*(\d+)$", status, re.MULTILINE).group(1))


def freeze(folder, shards):
    """Stops the processes of these shards as soon as each has some results, but not all. Returns the
    processes by shard."""
    frozen = {}

    def try_to_freeze():
        for shard in set(shards) - set(frozen):
            if results_of_shard(folder, shard) > 0:
                process = process_of_shard(folder, shard)
                assert process, f"shard {shard} was done before it could be stopped"
                os.kill(process, signal.SIGSTOP)
                frozen[shard] = process
        return len(frozen) == len(shards)

    wait_for(try_to_freeze, f"results of shards {shards}", pause=0.002)
    for shard in shards:
        assert results_of_shard(folder, shard) < LINES / SHARDS, f"shard {shard} was already done"
    return frozen


def wait_for(condition, what, pause=0.05):
    seconds = 120
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"waited {seconds} s for {what}"
        time.sleep(pause)
