"""A report as one HTML file that needs nothing else: its plots, and its numbers in tables."""

import base64
import io
from html import escape

from saved.number_text import percent, short_number
from saved.plots import all_plots, growth_of, lines_of
from saved.report import Report, spread_of

STYLE = """
body { margin: 0 auto; max-width: 1000px; padding: 16px; font: 15px/1.45 sans-serif; }
img { max-width: 100%; }
div { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13px; }
th { text-align: left; vertical-align: bottom; }
th, td { padding: 3px 10px 3px 0; border-bottom: 1px solid #8884; white-space: nowrap; }
"""

# By the first word of a plot's name.
EXPLANATIONS = {
    "scaling": "Medians of wall times (of kernels, of the device's own), with error bars from one "
    "quartile to the other. Lines join the sizes of one mesh where there are three or more; marks "
    "beside them are other meshes. n^1.5: over all meshes of 5,000 vertices and more, time grows "
    "as the 1.5th power of the number of vertices.",
    "stages": "Each stage alone, as a share of their sum. What a device does not do itself is "
    "shown as the processor does it.",
    "peers": "The same work by others, on the processor whatever ours runs on.",
    "ratios": "Below 1 we are faster.",
    "limits": "Operations over the rate of float64 products of large matrices, or bytes that must "
    "be moved over the rate of large copies, whichever is the larger share. What stays in caches "
    "can be faster than large copies: more than 100%.",
}


def page_of(report: Report) -> str:
    plots = {name: _image(name, figure) for name, figure in all_plots(report).items()}
    sections = [f"<h1>lapwing-bench, {escape(report.date)}</h1>", _host_table(report)]
    sections += [_limits_table(report), _targets_table(report)]
    for kind, explanation in EXPLANATIONS.items():
        images = [image for name, image in plots.items() if name.split("-")[0] == kind]
        if images:
            sections += [f"<p>{escape(explanation)}</p>", *images]
    sections += [_growth_table(report), _measurements_table(report)]
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f"<title>lapwing-bench, {escape(report.date)}</title>\n<style>{STYLE}</style>\n</head>\n"
        "<body>\n" + "\n".join(filter(None, sections)) + "\n</body>\n</html>\n"
    )


def _image(name, figure):
    # As a picture of its own: names inside one SVG are not those of another.
    svg = io.BytesIO()
    figure.savefig(svg, format="svg", metadata={"Date": None})
    data = base64.b64encode(svg.getvalue()).decode()
    return f'<p><img alt="{escape(name)}" src="data:image/svg+xml;base64,{data}"></p>'


def _table(heading, columns, rows):
    if not rows:
        return ""
    head = "".join(f"<th>{escape(column)}</th>" for column in columns)
    lines = ["".join(f"<td>{escape(str(cell))}</td>" for cell in row) for row in rows]
    body = "\n".join(f"<tr>{line}</tr>" for line in lines)
    return (
        f"<h2>{escape(heading)}</h2>\n<div><table><thead><tr>{head}</tr></thead>\n"
        f"<tbody>\n{body}\n</tbody></table></div>"
    )


def _host_table(report):
    host = report.host
    return _table(
        "Where it was measured",
        ["", ""],
        [
            ("Commit", report.commit),
            ("Command", report.command),
            ("Processor", f"{host.processor}, {host.threads} threads"),
            ("Memory", f"{short_number(host.memory_bytes / 1e9)} GB"),
            ("System", host.system),
            ("Compiler", host.compiler),
        ],
    )


def _limits_table(report):
    rates = "copies, GB/s", "float32 products, GFLOP/s", "float64 products, GFLOP/s"
    rows = [
        (limits.device, limits.type, limits.driver)
        + tuple(
            short_number(rate) if rate > 0 else "-"
            for rate in (
                limits.copy_gb_per_s,
                limits.matmul_gflops_float32,
                limits.matmul_gflops_float64,
            )
        )
        for limits in report.limits
    ]
    return _table("Devices", ["Device", "Kind", "Driver", *rates], rows)


def _targets_table(report):
    rows = [
        (
            "met" if target.is_met else "NOT met",
            target.name,
            target.on,
            short_number(target.measured),
            ("at least " if target.is_floor else "at most ") + short_number(target.bound),
        )
        for target in report.targets
    ]
    return _table("Targets", ["", "Target", "On", "Measured", "Asked for"], rows)


def _growth_table(report):
    growths = {key: growth_of(rows) for key, rows in lines_of(report).items()}
    rows = [
        (device, stage, by, growth, growth.sizes)
        for (stage, by, device), growth in growths.items()
        if growth
    ]
    return _table(
        "How times grow with the number of vertices n",
        ["Device", "Stage", "By", "Growth", "Sizes"],
        rows,
    )


def _measurements_table(report):
    rows = [_measurement_cells(report, m) for m in report.measurements]
    return _table(
        "All measurements, in milliseconds",
        "Mesh,Vertices,Device,Stage,By,Runs,Median,Quartiles,Extremes,CPU,On the device,Peak MB,"
        "Of limit,Counts".split(","),
        rows,
    )


def _measurement_cells(report, m):
    spread = spread_of(m.clock_ms)
    share = report.share_of_limit(m)
    extremes = (min(m.clock_ms), max(m.clock_ms)) if m.clock_ms else (0, 0)
    return (
        m.mesh,
        f"{m.vertices:,}",
        m.device,
        m.stage,
        m.by,
        len(m.clock_ms),
        _median(m.wall_ms),
        f"{short_number(spread.low)} to {short_number(spread.high)}",
        f"{short_number(extremes[0])} to {short_number(extremes[1])}",
        _median(m.cpu_ms),
        _median(m.device_ms),
        f"{m.peak_bytes / 1e6:,.0f}" if m.peak_bytes else "-",
        percent(share) if share else "-",
        ", ".join(f"{name} {count:,}" for name, count in sorted(m.counts.items())),
    )


def _median(ms):
    return short_number(spread_of(ms).median) if ms else "-"
