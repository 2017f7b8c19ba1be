"""A comparison as text of at most 100 columns."""

import textwrap

from saved.comparison import CLOCKS, Comparison, Verdict
from saved.number_text import change_in_percent, short_number
from saved.report import OURSELVES

COLUMNS = 100


def text_of(comparison: Comparison) -> str:
    """A table of what changed, how much did not, what could not be judged, and the verdict as the
    last line."""
    changes = [(change.row, _change_line(change)) for change in comparison.changes]
    missing = [(missing.row, _missing_line(missing)) for missing in comparison.missing]
    lines = _blocks(changes) + _blocks(missing)
    if lines:
        lines.append("")
    for note in comparison.notes:
        lines += textwrap.wrap(note, COLUMNS, subsequent_indent="  ", break_on_hyphens=False)
    lines.append(f"Unchanged: {comparison.same_counts:,} counts, {comparison.same_times:,} times.")
    lines.append(_verdict_line(comparison))
    return "\n".join(lines) + "\n"


def _blocks(rows_and_lines):
    lines = []
    block = None
    for row, line in rows_and_lines:
        if row[:3] != block:
            heading = f"{row.mesh}, {row.vertices:,} vertices, on {row.device}"
            lines.append(_clipped(heading, COLUMNS))
        block = row[:3]
        lines.append(line)
    return lines


def _word(change):
    is_time = change.what in CLOCKS
    if change.verdict == Verdict.BETTER:
        return "faster" if is_time else "better"
    return "slower" if is_time else "worse"


def _change_line(change):
    number = short_number if change.what in CLOCKS else "{:,}".format
    numbers = f"{number(change.before)} -> {number(change.after)}"
    by = change_in_percent(change.before, change.after)
    return _line(_word(change), change.row, f"{change.what:14}{numbers:36}{by:>8}")


def _missing_line(missing):
    what = missing.count
    if missing.fails:
        what += " (worse)" if what else "with its counts (worse)"
    return _line("gone" if missing.was_there else "new", missing.row, what)


def _line(word, row, rest):
    name = row.stage if row.by == OURSELVES else f"{row.stage}, {row.by}"
    return f"  {word:8}{_clipped(name, 29):31}{rest}".rstrip()


def _clipped(text, width):
    return text if len(text) <= width else text[: width - 3] + "..."


def _verdict_line(comparison):
    words = [_word(change) for change in comparison.changes]
    gone = sum(missing.fails for missing in comparison.missing)
    return (
        f"Verdict: {comparison.verdict.name.lower()} (counts: {words.count('worse')} rose, {gone} "
        f"gone, {words.count('better')} fell; times: {words.count('slower')} slower, "
        f"{words.count('faster')} faster)"
    )
