#!/usr/bin/python3
"""Prints the tables of README.md as Markdown, from all reports (*.json) in this folder.

A report of `lapwing-bench --json` has tables of a scan, of the largest sheet, and of other targets. Numbers are
medians; "ratio" is our time over that of "beside"; targets are those in the report, and a missed one is bold.
A report of `lapwing-bench real --json` has one table. To show another stage, add it to ROWS.
"""

import argparse
import json
import pathlib
import statistics
import sys

BEGIN, END = "<!-- tables -->", "<!-- end of tables -->"
ARAP, OURS, CPU = "CGAL ARAP", "Lapwing", "CPU"
AGAIN = ["again, other handle", "again, other belt", "again, other weight", "again, other Laplacians"]
ROWS = [  # a peer, its stage, and the stages of ours that are compared with it
    ("", "", ["read OBJ", "read PLY"]),
    (ARAP, "preparation", ["first drag", "settled preparation", "preparation"]),
    (OURS, "preparation", AGAIN),
    (OURS, "settled preparation", ["settled " + stage for stage in AGAIN]),
    (ARAP, "settle iteration", ["drag frame", "settle frame in time", "settle frame", "settle iteration"]),
    *(("CHOLMOD", stage, [stage]) for stage in ("factor", "response")),
    ("", "", ["coat", "mix", "transplant", "render"]),
]


def number(x):
    return f"{x:,.0f}" if x >= 100 else f"{x:.1f}" if x >= 10 else f"{x:.2f}" if x >= 0.1 else f"{x:.2g}"


def bound(target):
    return f"≤ {target['at_most']:g}" if "at_most" in target else f"≥ {target['at_least']:g}"


def judged(value, target):
    met = target is None or target.get("at_least", 0) <= value <= target.get("at_most", value)
    return number(value) if met else f"**{number(value)}**"


def table(head, rows, text_columns):
    columns = zip(head, ["---"] * text_columns + ["--:"] * len(head), *rows)
    lines = zip(*(column for column in columns if any(column[2:])))  # without empty columns
    return ["| " + " | ".join(cells) + " |" for cells in lines] + [""]


def stage_table(report, size, devices, targets):
    """A table of one mesh. Removes the targets that it shows."""
    median_ms = {(m["stage"], m["by"], m["device"]): statistics.median(m["wall_ms"])
                 for m in report["measurements"] if (m["vertices"], m["mesh"]) == size and m["wall_ms"]}
    rows = []
    for by, beside, stage in ((by, beside, stage) for by, beside, stages in ROWS for stage in stages):
        row = [stage, "", ""]
        for device in devices:
            ms = median_ms.get((stage, OURS, device), 0)
            other = median_ms.get((beside, by, device if by == OURS else CPU), 0)
            target = targets.pop((f"{stage} / {by} {beside}", f"{size[1]}, {device}"), None)
            if ms and other:
                row[1] = f"{by.replace(OURS, 'our')} {beside}"
                row[2] = bound(target) if target else row[2]
            row += [number(ms) if ms else "", judged(ms / other, target) if ms and other else ""]
        rows += [row] if any(row[3:]) else []
    columns = [text for device in devices for text in (f"{device.split(' (')[0]}, ms", "ratio")]
    return table([f"{size[1]}, {size[0]:,} vertices", "beside", "target", *columns], rows, 3)


def bench_tables(report):
    devices = [limits["device"] for limits in report["limits"]]
    targets = {(target["name"], target["on"]): target for target in report["targets"]}
    sizes = sorted({(m["vertices"], m["mesh"]) for m in report["measurements"]})
    shown = [size for size in sizes if size[1] == "armadillo"] + [s for s in sizes if s[1] == "hills"][-1:]
    lines = [line for size in shown for line in stage_table(report, size, devices, targets)]
    rows = {}
    for (name, on), target in targets.items():
        device = next((d for d in devices if on.endswith(", " + d)), CPU)
        key = name, on.removesuffix(", " + device), bound(target)
        row = rows.setdefault(key, [*key, *[""] * len(devices)])
        row[3 + devices.index(device)] = judged(target["measured"], target)
    head = ["other targets", "on", "target", *(device.split(" (")[0] for device in devices)]
    return lines + (table(head, rows.values(), 3) if rows else [])


def real_table(report):
    rows = [[f["name"], f["target"], f"{f['count']} of {f['of']}", "yes" if f["met"] else "**no**"]
            for f in report["summary"]["figures"]]
    for peer, name in (("arap", "ARAP"), ("smooth_arap", "Smooth ARAP")):
        both = [(run["ours"], run[peer]) for run in report["runs"]
                if "detail_error" in run["ours"] and run.get(peer, {}).get("detail_error", 0) > 0]
        for key in ("detail_error", "largest_edge", "edge_stretch") if both else ():
            ratio = statistics.median(ours[key] / theirs[key] for ours, theirs in both)
            rows.append([f"{key.replace('_', ' ')} over {name}'s, median", "", number(ratio), ""])
    summary = report["summary"]
    return table([f"{summary['runs']} edits of {summary['meshes']} meshes", "target", "result", "met"], rows, 2)


def tables(folder):
    lines = [BEGIN]
    for path in sorted(folder.glob("*.json")):
        report = json.loads(path.read_text(encoding="utf-8"))
        host = report.get("host", report)
        lines += [f"### {path.stem}", "", f"{host['processor']}, {host['threads']} threads, "
                  f"{report['date'][:10]}, commit {report['commit']}", ""]
        lines += real_table(report) if "runs" in report else bench_tables(report)
    return [*lines, END]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", metavar="PAGE", type=pathlib.Path, help="exit with 1 if it is stale")
    page = parser.parse_args().check
    lines = tables(pathlib.Path(__file__).parent)
    if page is None:
        print("\n".join(lines))
        sys.exit()
    found = page.read_text(encoding="utf-8").splitlines()
    begin = found.index(BEGIN) if BEGIN in found else len(found)
    for at, line in enumerate(lines, begin):
        if found[at : at + 1] != [line]:
            sys.exit(f"{page}:{at + 1}: expected {line!r}; replace the tables of the page")
