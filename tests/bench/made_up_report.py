"""Reports that nobody measured, and the way to what is made of them."""

import dataclasses
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BENCH = ROOT / "tools" / "bench"
sys.path.insert(0, str(BENCH))

from saved.report import Host, Limits, Measurement, Report, Target  # noqa: E402


def row(stage, wall_ms, **others):
    """A row of ours on the processor about a scan of 26,002 vertices."""
    values = {
        "by": "Lapwing",
        "device": "CPU",
        "mesh": "armadillo",
        "vertices": 26_002,
        "cpu_ms": [],
        "device_ms": [],
        "peak_bytes": 0,
        "counts": {},
    }
    return Measurement(stage=stage, wall_ms=wall_ms, **values | others)


def report_of(*measurements, targets=()):
    return Report(
        date="2023-05-06T07:08:09Z",
        commit="0123abcd+",
        command="lapwing-bench --repeats 3",
        host=Host("Some Processor 3 GHz", 2, 8_000_000_000, "Some System 1", "GCC 12.2.0"),
        limits=[
            Limits("CPU", "cpu", "", 10.0, 200.0, 100.0),
            Limits("Some GPU", "discrete GPU", "driver 1.2", 400.0, 20_000.0, 500.0),
        ],
        measurements=list(measurements),
        targets=list(targets),
    )


def small_report():
    """A little of everything: a stage with a peer, one with device times, counts and targets."""
    return report_of(
        row(
            "factor",
            [102.0, 100.0, 104.0],
            cpu_ms=[200.0, 190.0, 210.0],
            peak_bytes=512_000_000,
            counts={"flops": 4_000_000_000, "allocations": 12},
        ),
        row("factor", [400.0, 404.0, 408.0], by="CHOLMOD"),
        row(
            "assemble",
            [4.0, 4.2, 4.1],
            device="Some GPU",
            cpu_ms=[0.5, 0.6, 0.7],
            device_ms=[1.5, 1.25, 1.0],
            counts={"bytes": 250_000_000},
        ),
        targets=[
            Target("factor / CHOLMOD", "armadillo, CPU", 0.5, False, 0.252),
            Target("frames a second", "armadillo, Some GPU", 60.0, True, 31.0),
        ],
    )


def growing_report():
    """ "order", "drag frame" and "factor" of ours and "factor" of a peer's, at three sizes."""
    rows = []
    for n in (10_000, 20_000, 40_000):
        same = {"mesh": "hills <&>", "vertices": n, "counts": {"flops": 1000 * n}}
        rows += [
            row("order", [1e-3 * n], **same),
            row("drag frame", [1e-4 * n], **same),
            row("factor", [1e-5 * n**1.5], **same),
            row("factor", [0.01 * n], by="CHOLMOD", **same),
        ]
    small = small_report()
    return dataclasses.replace(small, measurements=small.measurements + rows)


def as_json(report):
    """What lapwing-bench writes."""
    values = dataclasses.asdict(report)
    for target in values["targets"]:
        target["at_least" if target.pop("is_floor") else "at_most"] = target.pop("bound")
    return {"format": "lapwing-bench 1"} | values
