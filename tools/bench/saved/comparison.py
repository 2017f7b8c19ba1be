"""What changed between two reports, told from noise.

Counts have to be equal: one that rose, or that is not counted any more, is worse; one that fell is
better; one that was not counted before is not judged.

A time, wall and device apart, changed only if all of these hold:
- by a two-sided Mann-Whitney test of the runs p < 0.01, and p is small enough beside those of all
  times that are compared, by Benjamini and Hochberg, that of the times called changed at most one
  in twenty is by chance;
- the medians differ by more than 5%;
- and by more than the distance between the quartiles of either report: two processes differ by more
  (where memory lies, how warm the processor is) than runs in one do.
Where the device's limits differ by more than 10% (another machine of the same kind, or a busy one),
it also has to hold of time x copy rate and of time x each rate of products: work that slowed down
as much as one of its limits did is the same work. Between two processors, or different numbers of
threads, no times are judged. The notes say which of these happened.
"""

import dataclasses
import enum
import functools
import math
from typing import NamedTuple

from saved.number_text import change_in_percent
from saved.report import Measurement, Report, ReportError, spread_of

PROBABILITY = 0.01
FALSE_SHARE = 0.05  # of the times that are called changed
SMALLEST_CHANGE = 0.05  # of a median: less is of no use to anyone
LIMITS_AGREE = 0.10
EXACT_UP_TO = 20  # runs on either side; beyond, the normal approximation is as good

RATES = ("copy_gb_per_s", "matmul_gflops_float32", "matmul_gflops_float64")
CLOCKS = {"wall ms": "wall_ms", "device ms": "device_ms"}


class Verdict(enum.IntEnum):
    SAME = 0
    BETTER = 1
    WORSE = 2


class Row(NamedTuple):
    """What makes a measurement of one report that of another."""

    device: str
    mesh: str
    vertices: int
    stage: str
    by: str


class Change(NamedTuple):
    """One number that is better or worse than it was."""

    row: Row
    what: str  # one of CLOCKS (medians), or a count's name
    before: float
    after: float
    verdict: Verdict


class Missing(NamedTuple):
    """A row, or a count of one, that is in one of the reports only."""

    row: Row
    count: str  # "" for the whole row
    was_there: bool  # before, and is not any more; the other way round otherwise
    fails: bool  # counts were there before and are not any more


@dataclasses.dataclass
class Comparison:
    changes: list[Change] = dataclasses.field(default_factory=list)  # worse ones first
    missing: list[Missing] = dataclasses.field(default_factory=list)
    notes: list[str] = dataclasses.field(default_factory=list)  # what was not judged, and why
    same_counts: int = 0
    same_times: int = 0

    @property
    def verdict(self) -> Verdict:
        """Worse if anything is, else better if anything is."""
        if any(missing.fails for missing in self.missing):
            return Verdict.WORSE
        return max((change.verdict for change in self.changes), default=Verdict.SAME)


def compare(
    before: Report,
    after: Report,
    times: bool = True,
    count_tolerances: dict[str, float] | None = None,
) -> Comparison:
    """Compares measurement by measurement; without `times`, counts alone. `count_tolerances` has by
    name what share of the old number a count may rise or fall and still be the same. Raises
    ReportError when a report measures a row twice."""
    comparison = Comparison()
    rows = _pair_rows(_rows_of(before), _rows_of(after), comparison)
    for row, old, new in rows:
        _compare_counts(row, old, new, count_tolerances or {}, comparison)
    if times:
        _compare_times(before, after, rows, comparison)
    comparison.changes.sort(key=lambda change: -change.verdict)
    return comparison


def _rows_of(report):
    rows = {}
    for m in report.measurements:
        row = Row(m.device, m.mesh, m.vertices, m.stage, m.by)
        if row in rows:
            raise ReportError(
                f'the report of {report.date} measures "{m.stage}" by {m.by} on {m.device}, '
                f"{m.mesh} of {m.vertices:,} vertices, twice; remove one of the two"
            )
        rows[row] = m
    return rows


def _pair_rows(before, after, comparison) -> list[tuple[Row, Measurement, Measurement]]:
    gone = sorted(before.keys() - after.keys())
    comparison.missing += [Missing(row, "", True, bool(before[row].counts)) for row in gone]
    new = sorted(after.keys() - before.keys())
    comparison.missing += [Missing(row, "", False, False) for row in new]
    return [(row, before[row], after[row]) for row in sorted(before.keys() & after.keys())]


def _compare_counts(row, old, new, tolerances, comparison):
    for name, before in sorted(old.counts.items()):
        after = new.counts.get(name)
        if after is None:
            comparison.missing.append(Missing(row, name, True, True))
        elif abs(after - before) <= tolerances.get(name, 0.0) * before:
            comparison.same_counts += 1
        else:
            verdict = Verdict.WORSE if after > before else Verdict.BETTER
            comparison.changes.append(Change(row, name, before, after, verdict))


class _Times(NamedTuple):
    row: Row
    what: str
    before: list[float]
    after: list[float]


def _compare_times(before, after, rows, comparison):
    a, b = before.host, after.host
    if (a.processor, a.threads) != (b.processor, b.threads):
        comparison.notes.append(
            f"Times are not judged: one report is of {a.processor} with {a.threads} threads, the "
            f"other of {b.processor} with {b.threads}."
        )
        return
    devices = sorted({row.device for row, _, _ in rows})
    scales = {device: _limit_scales(before, after, device) for device in devices}
    _note_limits(scales, comparison)
    compared = [
        _Times(row, what, getattr(old, clock), getattr(new, clock))
        for row, old, new in rows
        for what, clock in CLOCKS.items()
        if getattr(old, clock) and getattr(new, clock)
    ]
    judgements = [_judge(times, scales[times.row.device]) for times in compared]
    threshold = discovery_threshold([p for p, _ in judgements], FALSE_SHARE)
    for times, (p, verdict) in zip(compared, judgements):
        if verdict == Verdict.SAME or p >= PROBABILITY or p > threshold:
            comparison.same_times += 1
            continue
        medians = spread_of(times.before).median, spread_of(times.after).median
        comparison.changes.append(Change(times.row, times.what, *medians, verdict))
    _note_few_runs(compared, comparison)


def _limit_scales(before, after, device) -> list[float]:
    """Rates of after over before; empty where all of them agree or are not known."""
    old, new = before.limits_of(device), after.limits_of(device)
    if old is None or new is None:
        return []
    rates = [(getattr(old, rate), getattr(new, rate)) for rate in RATES]
    scales = [b / a for a, b in rates if a > 0 and b > 0]
    return scales if any(abs(scale - 1) > LIMITS_AGREE for scale in scales) else []


def _note_limits(scales, comparison):
    for device, of_device in scales.items():
        if not of_device:
            continue
        factor = max(of_device, key=lambda scale: abs(math.log(scale)))
        comparison.notes.append(
            f"The limits of {device} changed, one of them by {change_in_percent(1, factor)} (a "
            "busy machine, or another): only what changed by more is judged."
        )


def _judge(times, scales) -> tuple[float, Verdict]:
    """What all clocks agree on, as sure as the least sure of them."""
    judgements = [_judge_scaled(times, scale) for scale in [1.0, *scales]]
    verdicts = {verdict for _, verdict in judgements}
    agreed = verdicts.pop() if len(verdicts) == 1 else Verdict.SAME
    return max(p for p, _ in judgements), agreed


def _judge_scaled(times, scale) -> tuple[float, Verdict]:
    after = [ms * scale for ms in times.after]
    old, new = spread_of(times.before), spread_of(after)
    by = abs(new.median - old.median)
    noise = max(old.high - old.low, new.high - new.low)
    verdict = Verdict.SAME
    if by > SMALLEST_CHANGE * old.median and by > noise:
        verdict = Verdict.WORSE if new.median > old.median else Verdict.BETTER
    return rank_test(times.before, after), verdict


def _note_few_runs(compared, comparison):
    """So few runs that even the clearest change of one time alone would be put down to chance."""
    if not compared:
        return
    bound = min(PROBABILITY, FALSE_SHARE / len(compared))
    affected = sum(
        smallest_rank_test(len(times.before), len(times.after)) >= bound for times in compared
    )
    if affected == 0:
        return
    enough = 1
    while smallest_rank_test(enough, enough) >= bound:
        enough += 1
    comparison.notes.append(
        f"{affected} of {len(compared)} times have so few runs that a change of one alone cannot "
        f"be told from chance; with {enough} runs (--repeats) it can."
    )


def rank_test(a: list[float], b: list[float]) -> float:
    """How probable it is that two sets of runs of the same thing differ in their ranks by as much
    as these or by more. Nothing is assumed about how runs scatter."""
    # Only here: comparing counts takes nothing that a system with Python lacks.
    try:
        from scipy.stats import mannwhitneyu
    except ImportError as error:
        raise ReportError(
            f"times are judged by SciPy ({error}); tools/setup/install-packages --reports "
            "installs it, or compare --counts"
        ) from error
    # "exact" takes runs for different where they are equal, which few are: times have six digits.
    is_small = max(len(a), len(b)) <= EXACT_UP_TO
    return float(mannwhitneyu(a, b, method="exact" if is_small else "asymptotic").pvalue)


@functools.cache
def smallest_rank_test(a: int, b: int) -> float:
    """The smallest value that the test can give for so many runs on the two sides."""
    return rank_test(list(range(a)), list(range(a, a + b)))


def discovery_threshold(probabilities: list[float], false_share: float) -> float:
    """Benjamini and Hochberg, 1995: the largest of these that may still be called a difference when
    of all those called a share of at most `false_share` shall be chance; below 0 where none may."""
    count = len(probabilities)
    ranked = enumerate(sorted(probabilities), start=1)
    return max((p for k, p in ranked if p <= false_share * k / count), default=-1.0)
