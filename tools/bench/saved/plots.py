"""The plots of a report. Each function returns figures, none where there is nothing to draw."""

import dataclasses
import itertools
import math
import re

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update(
    {
        "axes.axisbelow": True,
        "axes.edgecolor": "#59616b",
        "axes.grid": True,
        "axes.spines.right": False,
        "axes.spines.top": False,
        "axes.titlelocation": "left",
        "axes.titleweight": "bold",
        "figure.constrained_layout.use": True,
        "font.size": 9,
        "grid.color": "#e3e6ea",
        "legend.frameon": False,
        "savefig.dpi": 120,
        "svg.fonttype": "none",  # text stays text, which is a fifth of the size
        "svg.hashsalt": "lapwing-bench",  # the same report gives the same file
    }
)

import numpy
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter, PercentFormatter

from saved.number_text import brief_count, percent, short_number
from saved.report import PROCESSOR, Measurement, Report, ratio_to, spread_of

# Told apart with all kinds of color vision: Paul Tol's muted colors, and a gray.
COLORS = (
    "#332288 #55a9d6 #44aa99 #117733 #8f8f2c #d0aa3a #cc6677 #882255 #aa4499 #8a8f96".split()
)
MARKERS = "osD^vP*X"
FASTER, SLOWER, OTHERS = COLORS[1], COLORS[6], COLORS[9]
REACHED = COLORS[2]
INK = "#1b1f24"

MESH_STAGES = ("read OBJ", "read PLY", "topology", "check")
PREPARATION_STAGES = (
    "pattern",
    "order",
    "laplacian weights",
    "laplacian",
    "assemble",
    "normal matrix",
    "analyze",
    "factor",
    "response",
    "upload",
)
SCALING_PLOTS = {
    "waits": "What a user waits for",
    "preparation": "Reading and preparing, by stages",
    "kernels": "Kernels",
}

INCHES_PER_BAR = 0.24


@dataclasses.dataclass(frozen=True)
class Growth:
    """How the time of a stage grows with the mesh: median ms ~ vertices^exponent."""

    exponent: float
    standard_error: float
    sizes: int

    def __str__(self):
        return f"n^{self.exponent:.2f} \N{PLUS-MINUS SIGN}{self.standard_error:.2f}"


def growth_of(rows: list[Measurement]) -> Growth | None:
    """Fitted as lapwing-bench does for its table (report/growth.h): to meshes that are large enough
    to measure more than overheads, of three sizes or more, as two are always on a line."""
    rows = [m for m in rows if m.vertices >= 5000 and m.median_ms > 0]
    sizes = len({m.vertices for m in rows})
    if sizes < 3:
        return None
    x = numpy.log([m.vertices for m in rows])
    y = numpy.log([m.median_ms for m in rows])
    (exponent, _), residual, *_ = numpy.polyfit(x, y, 1, full=True)
    variance = residual[0] / (len(rows) - 2) if len(residual) else 0.0
    error = numpy.sqrt(variance / numpy.sum((x - x.mean()) ** 2))
    return Growth(float(exponent), float(error), sizes)


def lines_of(report: Report) -> dict[tuple[str, str, str], list[Measurement]]:
    """Everything that has times, by stage, who did it and on what, the smallest mesh first."""
    lines = {}
    for m in sorted(report.measurements, key=lambda m: m.vertices):
        if m.median_ms > 0:
            lines.setdefault((m.stage, m.by, m.device), []).append(m)
    order = list(dict.fromkeys((m.stage, m.by, m.device) for m in report.measurements))
    return dict(sorted(lines.items(), key=lambda line: order.index(line[0])))


def all_plots(report: Report) -> dict[str, Figure]:
    """Every plot, by a name that files can have."""
    plots = {}
    for device in report.devices:
        name = re.sub(r"\W+", "-", device).strip("-")
        for group in SCALING_PLOTS:
            plots[f"scaling-{group}-{name}"] = scaling_plot(report, device, group)
        plots[f"stages-{name}"] = stages_plot(report, device)
        plots[f"peers-{name}"] = peers_plot(report, device)
    plots["ratios"] = ratios_plot(report)
    plots["limits"] = limits_plot(report)
    return {name: figure for name, figure in plots.items() if figure is not None}


def scaling_plot(report: Report, device: str, group: str) -> Figure | None:
    """Median times over numbers of vertices, a line for every stage of ours in `group` (of
    SCALING_PLOTS) on `device`; error bars reach from one quartile to the other."""
    lines = [
        rows
        for (stage, _, on), rows in lines_of(report).items()
        if rows[0].is_ours and on == device and _group_of(stage) == group
    ]
    if not any(_has_two_sizes(rows) for rows in lines):
        return None
    figure = Figure(figsize=(9, 4.5))
    axes = figure.subplots()
    places = _places(report)[group]
    for rows in lines:
        stage = rows[0].stage
        growth = growth_of(rows)
        label = stage.removeprefix("kernel ") + (f"  ~ n^{growth.exponent:.2f}" if growth else "")
        _draw_line(axes, rows, label, places[stage])
    axes.set_title(f"{SCALING_PLOTS[group]}, on {device}")
    _log_axes(axes)
    if note := _note_on_lines(lines):
        axes.set_xlabel(f"vertices ({note})")
    # In the order in which the lines end.
    handles, labels = axes.get_legend_handles_labels()
    order = sorted(range(len(lines)), key=lambda k: -_joined(lines[k])[-1].median_ms)
    axes.legend(
        [handles[k] for k in order],
        [labels[k] for k in order],
        loc="upper left",
        bbox_to_anchor=(1, 1),
    )
    return figure


def peers_plot(report: Report, device: str) -> Figure | None:
    """The same for each stage that others did too: our line, and theirs, dashed, whatever they ran
    on."""
    lines = lines_of(report)
    stages = {}
    for (stage, _, on), rows in lines.items():
        theirs = [r for (s, _, _), r in lines.items() if s == stage and not r[0].is_ours]
        if rows[0].is_ours and on == device and theirs:
            if any(_has_two_sizes(line) for line in [rows, *theirs]):
                stages[stage] = [rows, *theirs]
    if not stages:
        return None
    columns = 3
    count = math.ceil(len(stages) / columns)
    figure = Figure(figsize=(3.2 * columns, 2.7 * count + 0.3))
    figure.suptitle(f"Our times and others', on {device}", x=0.01, ha="left", weight="bold")
    grid = figure.subplots(count, columns, squeeze=False).flat
    # Whoever did something has the same color on every device.
    who = list(dict.fromkeys(m.by for m in report.measurements))
    if note := _note_on_lines([rows for of_stage in stages.values() for rows in of_stage]):
        figure.supxlabel(note[0].upper() + note[1:], x=0.01, ha="left", fontsize="medium")
    handles = {}
    for axes, (stage, of_stage) in itertools.zip_longest(grid, stages.items(), fillvalue=("", [])):
        if not of_stage:
            axes.set_axis_off()
            continue
        for rows in of_stage:
            place = 2 * who.index(rows[0].by)
            _draw_line(axes, rows, rows[0].by, place, dashed=not rows[0].is_ours)
        handles |= dict(zip(*reversed(axes.get_legend_handles_labels())))
        axes.set_title(stage, fontsize="medium")
        _log_axes(axes)
    # Beside the title, where no line runs.
    figure.legend(handles.values(), handles.keys(), loc="upper right", ncol=len(handles))
    return figure


def stages_plot(report: Report, device: str) -> Figure | None:
    """What share of the preparation each stage is, a bar for every mesh and size, with times
    inside. Stages that were not measured on `device` are those of the processor."""
    ours = [m for m in report.measurements if m.is_ours]
    medians = {(m.stage, m.device, m.subject): m.median_ms for m in ours}
    preparations = {}
    for subject in report.subjects:
        own = {s: medians.get((s, device, subject)) for s in PREPARATION_STAGES}
        if any(own.values()):
            preparations[subject] = [
                own[s] or medians.get((s, PROCESSOR, subject)) or 0.0 for s in PREPARATION_STAGES
            ]
    if not preparations:
        return None
    figure = Figure(figsize=(9, max(INCHES_PER_BAR * len(preparations) + 0.6, 2.3)))
    axes = figure.subplots()
    sums = [sum(ms) for ms in preparations.values()]
    rows = range(len(preparations))
    left = numpy.zeros(len(preparations))
    for k, stage in enumerate(PREPARATION_STAGES):
        ms = [preparation[k] for preparation in preparations.values()]
        if not any(ms):
            continue
        shares = numpy.divide(ms, sums)
        bars = axes.barh(rows, shares, left=left, color=COLORS[k], edgecolor="white", label=stage)
        texts = [short_number(t) if share > 0.055 else "" for t, share in zip(ms, shares)]
        axes.bar_label(bars, texts, label_type="center", color=_ink_on(COLORS[k]), fontsize=8)
        left += shares
    for row, total in zip(rows, sums):
        axes.text(1.01, row, f"{short_number(total)} ms", va="center")
    axes.set_yticks(rows, [f"{mesh} {brief_count(n)}" for mesh, n in preparations])
    axes.invert_yaxis()
    axes.set_xlim(0, 1.15)
    axes.set_xticks([0, 0.25, 0.5, 0.75, 1])
    axes.xaxis.set_major_formatter(PercentFormatter(1))
    axes.grid(False)
    axes.tick_params(axis="y", length=0)
    axes.set_title(f"What a preparation consists of, on {device} (ms, and as a share)")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
    return figure


def ratios_plot(report: Report) -> Figure | None:
    """Our times over our peers': a bar for the largest mesh that both did, marks for the others."""
    groups = {}
    for m in report.measurements:
        for peer in report.peers_of(m):
            ratio = ratio_to(m, peer)
            if ratio > 0:
                group = groups.setdefault(m.device, {})
                group.setdefault(f"{m.stage} / {peer.by}", []).append((m, ratio))
    figure = _bars(
        groups,
        "Our time over others' (bar: largest mesh; marks: the others)",
        text=short_number,
        color=lambda m, ratio: FASTER if ratio <= 1 else SLOWER,
        start=1,
    )
    if figure is None:
        return None
    for axes in figure.axes:
        axes.set_xscale("log")
        least, most = axes.get_xlim()
        axes.set_xlim(min(least, 0.5), max(most, 2))
        axes.axvline(1, color=INK, linewidth=1)
        _label_log(axes.xaxis)
    figure.axes[-1].set_xlabel("below 1: faster than the peer")
    return figure


def limits_plot(report: Report) -> Figure | None:
    """What share of its device's limit each stage reaches, the highest first: a bar for the largest
    mesh, marks for the others."""
    groups = {}
    for m in report.measurements:
        share = report.share_of_limit(m)
        if share > 0:
            label = m.stage if m.is_ours else f"{m.stage}, {m.by}"
            groups.setdefault(m.device, {}).setdefault(label, []).append((m, share))
    sorted_groups = {
        device: dict(sorted(bars.items(), key=lambda bar: -_of_largest(bar[1])[1]))
        for device, bars in groups.items()
    }
    figure = _bars(
        sorted_groups,
        "Share of what the device can do (bar: largest mesh; marks: the others)",
        text=percent,
        color=lambda m, share: REACHED if m.is_ours else OTHERS,
        start=0,
    )
    if figure is None:
        return None
    for axes in figure.axes:
        axes.axvline(1, color=INK, linewidth=1)
        # Small meshes live in caches, and would squeeze the others.
        axes.set_xlim(0, min(axes.get_xlim()[1], 1.5))
        axes.xaxis.set_major_formatter(PercentFormatter(1))
    figure.axes[-1].set_xlabel("of the device's rate of copies or products")
    return figure


def _group_of(stage):
    if stage in MESH_STAGES + PREPARATION_STAGES:
        return "preparation"
    return "kernels" if stage.startswith("kernel ") else "waits"


def _places(report):
    """By group. A stage has one color and marker in all plots, in bars too."""
    places = {}
    for stage in [*PREPARATION_STAGES, *(m.stage for m in report.measurements)]:
        of_group = places.setdefault(_group_of(stage), {})
        of_group.setdefault(stage, len(of_group))
    return places


def _has_two_sizes(rows):
    return rows[0].vertices < rows[-1].vertices


def _ink_on(color):
    red, green, blue = matplotlib.colors.to_rgb(color)
    return "black" if 0.299 * red + 0.587 * green + 0.114 * blue > 0.42 else "white"


def _joined(rows):
    """Those that a line joins: different meshes of about one size would make it jump up and down,
    so it is that of the mesh with the most sizes; the others are marks beside it."""
    meshes = [m.mesh for m in rows]
    longest = max(meshes, key=meshes.count)
    return [m for m in rows if m.mesh == longest] if meshes.count(longest) > 1 else rows


def _draw_line(axes, rows, label, place, dashed=False):
    color = COLORS[place % len(COLORS)]
    # Another marker when colors come round.
    marker = MARKERS[(place + place // len(COLORS)) % len(MARKERS)]
    style = "--" if dashed else "-"
    sizes = [m.vertices for m in rows]
    spreads = [spread_of(m.clock_ms) for m in rows]
    medians = [s.median for s in spreads]
    errors = [[s.median - s.low for s in spreads], [s.high - s.median for s in spreads]]
    axes.errorbar(sizes, medians, errors, fmt="none", ecolor=color, elinewidth=1)
    joined = [(m.vertices, m.median_ms) for m in _joined(rows)]
    axes.plot(*zip(*joined), style, color=color, linewidth=1.4)
    axes.plot(sizes, medians, color=color, marker=marker, markersize=4.5, linestyle="none")
    # The legend's entry: line and marker in one.
    axes.plot([], [], style, color=color, marker=marker, markersize=4.5, label=label)


def _note_on_lines(lines):
    """What the lines leave out, empty where that is nothing."""
    meshes = {_joined(rows)[0].mesh for rows in lines if len(_joined(rows)) < len(rows)}
    if not meshes:
        return ""
    return f"lines join {' or '.join(sorted(meshes))}; single marks are other meshes"


def _log_axes(axes):
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis, name in ((axes.xaxis, "vertices"), (axes.yaxis, "ms")):
        _label_log(axis)
        axis.set_label_text(name)


def _label_log(axis):
    least, most = axis.get_view_interval()
    if most < 200 * least:  # powers of ten alone would be two labels or fewer
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: brief_count(value)))
    axis.set_minor_formatter(NullFormatter())


def _of_largest(values):
    return max(values, key=lambda value: value[0].vertices)


def _bars(groups, title, text, color, start):
    """Bars on their sides, a group for every device that has any; `groups` has lists of
    (measurement, value) by device and label. Bars begin at `start`."""
    if not groups:
        return None
    counts = [len(bars) for bars in groups.values()]
    figure = Figure(figsize=(9, INCHES_PER_BAR * sum(counts) + 0.6 * len(counts) + 0.6))
    figure.suptitle(title, x=0.01, ha="left", weight="bold")
    heights = {"height_ratios": [count + 1 for count in counts]}
    grid = figure.subplots(len(groups), sharex=True, squeeze=False, gridspec_kw=heights)
    for axes, (device, bars) in zip(grid.flat, groups.items()):
        for row, values in enumerate(bars.values()):
            m, value = _of_largest(values)
            axes.barh(row, value - start, left=start, height=0.75, color=color(m, value))
            others = [v for _, v in values if v != value]
            axes.plot(others, [row] * len(others), "|", color=INK, markersize=9)
            note = f"{text(value)}  {m.mesh} {brief_count(m.vertices)}"
            axes.text(1.01, row, note, va="center", transform=axes.get_yaxis_transform())
        axes.set_yticks(range(len(bars)), list(bars))
        axes.set_ylim(len(bars) - 0.4, -0.6)
        axes.set_title(f"on {device}", fontsize="medium", weight="normal")
        axes.tick_params(axis="y", length=0)
        axes.grid(axis="y", visible=False)
    return figure
