"""Reports that lapwing-bench wrote with --json."""

import dataclasses
import json
import math
import statistics

FORMAT = "lapwing-bench 1"
OURSELVES = "Lapwing"  # everyone else in a report is a peer
PROCESSOR = "CPU"  # what the processor is called among the devices


class ReportError(Exception):
    """A report that cannot be used; the message names the file and the next step."""


@dataclasses.dataclass(frozen=True)
class Host:
    processor: str
    threads: int
    memory_bytes: int
    system: str
    compiler: str


@dataclasses.dataclass(frozen=True)
class Limits:
    """What a device can do at best, in 1e9 bytes or operations a second; 0 where it cannot."""

    device: str
    type: str
    driver: str
    copy_gb_per_s: float
    matmul_gflops_float32: float
    matmul_gflops_float64: float


@dataclasses.dataclass(frozen=True)
class Measurement:
    """One piece of work, with a time for each of its runs."""

    stage: str
    by: str
    device: str
    mesh: str
    vertices: int
    wall_ms: list[float]
    cpu_ms: list[float]
    device_ms: list[float]
    peak_bytes: int
    counts: dict[str, int]

    @property
    def is_ours(self) -> bool:
        return self.by == OURSELVES

    @property
    def is_kernel(self) -> bool:
        """Only a device has those, and only its own clock timed them."""
        return self.stage.startswith("kernel ")

    @property
    def clock_ms(self) -> list[float]:
        return self.wall_ms or self.device_ms

    @property
    def median_ms(self) -> float:
        return spread_of(self.clock_ms).median

    @property
    def subject(self) -> tuple[str, int]:
        return self.mesh, self.vertices


@dataclasses.dataclass(frozen=True)
class Target:
    name: str
    on: str
    bound: float
    is_floor: bool
    measured: float

    @property
    def is_met(self) -> bool:
        return self.measured >= self.bound if self.is_floor else self.measured <= self.bound


@dataclasses.dataclass(frozen=True)
class Report:
    date: str
    commit: str
    command: str
    host: Host
    limits: list[Limits]
    measurements: list[Measurement]
    targets: list[Target]

    @property
    def devices(self) -> list[str]:
        return list(dict.fromkeys(m.device for m in self.measurements))

    @property
    def subjects(self) -> list[tuple[str, int]]:
        return list(dict.fromkeys(m.subject for m in self.measurements))

    def limits_of(self, device: str) -> Limits | None:
        return next((limits for limits in self.limits if limits.device == device), None)

    def peers_of(self, ours: Measurement) -> list[Measurement]:
        """Who else did this, on whichever device; none for a peer's own."""
        return [
            m
            for m in self.measurements
            if ours.is_ours
            and not m.is_ours
            and (m.stage, m.subject) == (ours.stage, ours.subject)
        ]

    def share_of_limit(self, m: Measurement) -> float:
        """What share of its device's limit the work reaches: operations over the rate of float64
        products or bytes over the rate of copies, whichever is larger. 0 where it is not known."""
        limits = self.limits_of(m.device)
        if limits is None or m.median_ms <= 0:
            return 0.0
        rates = {"flops": limits.matmul_gflops_float64, "bytes": limits.copy_gb_per_s}
        return max(
            m.counts.get(count, 0) / (m.median_ms * 1e6) / rate if rate > 0 else 0.0
            for count, rate in rates.items()
        )


@dataclasses.dataclass(frozen=True)
class Spread:
    median: float
    low: float  # the lower quartile, by linear interpolation
    high: float


def spread_of(numbers: list[float]) -> Spread:
    """All 0 for no numbers."""
    if len(numbers) < 2:
        value = numbers[0] if numbers else 0.0
        return Spread(value, value, value)
    low, median, high = statistics.quantiles(numbers, n=4, method="inclusive")
    return Spread(median, low, high)


def ratio_to(ours: Measurement, peer: Measurement) -> float:
    """Our median wall time over a peer's; 0 where either has none."""
    peer_ms = spread_of(peer.wall_ms).median
    return spread_of(ours.wall_ms).median / peer_ms if peer_ms > 0 else 0.0


def read_report(path: str) -> Report:
    try:
        with open(path, encoding="utf-8") as file:
            return parse_report(file.read(), path)
    except OSError as error:
        raise ReportError(f"cannot read {path}: {error.strerror}") from error


def parse_report(text: str, name: str) -> Report:
    """`name` is what messages call the file."""
    try:
        root = json.loads(text)
    except ValueError as error:
        raise ReportError(f"{name}: {error}; was it written to its end?") from error
    found = root.get("format") if isinstance(root, dict) else None
    if found != FORMAT:
        raise ReportError(
            f'{name}: this is {json.dumps(found)}, and what is read here is "{FORMAT}"; '
            "measure again, or use the scripts of the version that wrote it"
        )
    del root["format"]
    try:
        _require_keys(Report, root, name, "")
        return _report_of(root, name)
    except (AttributeError, TypeError) as error:
        raise ReportError(f"{name}: {error}; lapwing-bench --json did not write this") from error


def _report_of(root, name):
    root["targets"] = [_with_bound(target) for target in root["targets"]]
    lists = {"limits": Limits, "measurements": Measurement, "targets": Target}
    parts = {
        key: [_made(kind, values, name, f"/{key}/{k}") for k, values in enumerate(root[key])]
        for key, kind in lists.items()
    }
    return Report(**root | parts | {"host": _made(Host, root["host"], name, "/host")})


def _with_bound(target):
    bound = "at_least" if "at_least" in target else "at_most"
    is_floor = bound == "at_least"
    renamed = {"bound" if key == bound else key: value for key, value in target.items()}
    return renamed | {"is_floor": is_floor}


def _require_keys(kind, values, name, where):
    keys = {field.name for field in dataclasses.fields(kind)}
    for key in sorted(keys - values.keys()):
        raise ReportError(f'{name}: {where}: the key "{key}" is missing')
    for key in sorted(values.keys() - keys):
        raise ReportError(f'{name}: {where}: the key "{key}" is not one of a report')


def _made(kind, values, name, where):
    _require_keys(kind, values, name, where)
    for field in dataclasses.fields(kind):
        value = values[field.name]
        place = f"{name}: {where}/{field.name}"
        if field.type is str and not isinstance(value, str):
            raise ReportError(f"{place}: expected text, and this is {json.dumps(value)}")
        if field.type in (int, float):
            _require_number(value, place)
        elif field.type == list[float]:
            for k, number in enumerate(value):
                _require_number(number, f"{place}/{k}")
        elif field.type == dict[str, int]:
            for count, number in value.items():
                _require_number(number, f"{place}/{count}")
    return kind(**values)


def _require_number(value, place):
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not is_number or not 0 <= value < math.inf:
        raise ReportError(f"{place}: expected a number from 0, and this is {json.dumps(value)}")
