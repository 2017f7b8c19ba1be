"""Many motions of one edit on a Dask cluster of two worker processes, over TCP."""

import json
import os
import subprocess
import sys
import time

import numpy as np
import pytest

import lapwing
from conftest import run, turned


@pytest.fixture
def scheduler(tmp_path):
    """The address of a scheduler with two workers, each a process of its own."""
    file = tmp_path / "scheduler.json"
    common = ["--scheduler-file", file]
    log = open(tmp_path / "dask.log", "w")

    def start(name, *arguments):
        return subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.{name}", *map(str, [*common, *arguments])],
            stdin=subprocess.DEVNULL, stdout=log, stderr=log,
        )

    processes = [start("dask_scheduler", "--port", 0, "--no-dashboard", "--host", "127.0.0.1")]
    processes += [
        start("dask_worker", "--nthreads", 1, "--no-dashboard", "--no-nanny", "--name", f"w{k}",
              "--local-directory", tmp_path / f"w{k}")
        for k in range(2)
    ]
    try:
        deadline = time.monotonic() + 60
        while not file.exists():
            assert time.monotonic() < deadline, (tmp_path / "dask.log").read_text()
            time.sleep(0.1)
        yield json.loads(file.read_text())["address"], processes
    finally:
        for process in processes[::-1]:
            process.terminate()
        for process in processes:
            try:
                process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                process.kill()
        log.close()


def test_motions_on_two_workers_are_those_of_one_process(source, scheduler, tube, ends, tmp_path):
    from distributed import Client

    address, processes = scheduler
    with Client(address) as client:
        client.wait_for_workers(2, timeout=60)
        pids = set(client.run(os.getpid).values())
    assert pids == {process.pid for process in processes[1:]}

    motions = np.array([[turned(0.5 * k)] for k in range(50)])
    edit = {"belt": {"vertices": ends[0].tolist()},
            "handles": [{"region": {"vertices": ends[1].tolist()}}]}
    lapwing.write(tmp_path / "tube.ply", tube)
    np.save(tmp_path / "motions.npy", motions)
    (tmp_path / "edit.json").write_text(json.dumps(edit))
    run([sys.executable, source / "tools" / "batch" / "dask-motions", "tube.ply", "edit.json",
         "motions.npy", "out.npy", "--scheduler", address, "--dtype", "float64"],
        cwd=tmp_path, timeout=120)

    alone = lapwing.Deformer(tube, belt=ends[0], handles=[ends[1]]).solve_many(motions).vertices
    assert (np.load(tmp_path / "out.npy") == alone - tube.vertices).all()


def test_a_worker_that_is_lost_loses_nothing(source, scheduler, tube, ends, tmp_path):
    from distributed import Client

    address, processes = scheduler
    motions = np.array([[turned(0.2 * k)] for k in range(200)])
    deformer = lapwing.Deformer(tube, belt=ends[0], handles=[ends[1]])
    with Client(address) as client:
        client.wait_for_workers(2, timeout=60)
        prepared = client.scatter(deformer, broadcast=True)
        futures = client.map(
            lambda d, m: d.solve(m).vertices, [prepared] * 200, list(motions), pure=False
        )
        futures[3].result()
        processes[1].kill()
        found = [future.result(timeout=120) for future in futures]
    for one, vertices in zip(deformer.solve_many(motions).vertices, found):
        assert (one == vertices).all()
