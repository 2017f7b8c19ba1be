"""Numbers as people read them; the text table of lapwing-bench writes them alike."""


def short_number(value: float) -> str:
    """Three digits that count, never an exponent, thousands apart: "0.0123", "12.3", "1,230"."""
    if value == 0:
        return "0"
    if value >= 999.5:
        return f"{value:,.0f}"
    if value < 1e-4:
        return f"{value:.6f}"  # of a millisecond: nothing here is known below a nanosecond
    return f"{value:#.3g}".rstrip(".")


def brief_count(value: float) -> str:
    """ "26k", "1.25M": three digits at most, for labels."""
    value = float(f"{value:.3g}")
    for unit, name in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if value >= unit:
            return f"{value / unit:.3g}{name}"
    return f"{value:.3g}"


def percent(share: float) -> str:
    """ "12%", "0.3%" """
    value = 100 * share
    return f"{value:.1f}%" if value != 0 and abs(value) < 9.95 else f"{value:.0f}%"


def change_in_percent(before: float, after: float) -> str:
    """ "+17%", "-3.2%"; empty from 0, and for what would be printed as 0.0%."""
    if before == 0 or abs(after - before) < 0.0005 * before:
        return ""
    return ("+" if after >= before else "") + percent((after - before) / before)
