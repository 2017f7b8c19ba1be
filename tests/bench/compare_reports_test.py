#!/usr/bin/python3
"""What compare-reports calls changed."""

import contextlib
import copy
import importlib.machinery
import importlib.util
import io
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools" / "bench" / "compare-reports"
loader = importlib.machinery.SourceFileLoader("compare_reports", str(SCRIPT))
compare_reports = importlib.util.module_from_spec(importlib.util.spec_from_loader("compare_reports", loader))
loader.exec_module(compare_reports)

BEFORE = [100.0, 101.0, 102.0, 103.0, 104.0, 105.0, 106.0]


def times(ms, factor):
    return [factor * value for value in ms]


def row(stage, wall_ms, device_ms=(), **counts):
    return {"stage": stage, "by": "Lapwing", "device": "CPU", "mesh": "armadillo", "vertices": 26_002,
            "wall_ms": list(wall_ms), "cpu_ms": [], "device_ms": list(device_ms), "peak_bytes": 0, "counts": counts}


def report_of(*rows):
    limits = {"device": "CPU", "copy_gb_per_s": 10.0, "matmul_gflops_float32": 200.0, "matmul_gflops_float64": 100.0}
    return {"format": "lapwing-bench 1", "host": {"processor": "Some Processor", "threads": 2},
            "limits": [limits], "measurements": list(rows)}


def noisy_report(rows, chance, slow_rows=0, slowdown=0.0):
    """Rows "stage 0" and on, of 100 ms and 5% noise, but for the first ones, which take `slowdown` more."""
    medians = [100 * (1 + slowdown) if r < slow_rows else 100 for r in range(rows)]
    return report_of(*(row(f"stage {r}", [chance.gauss(median, 0.05 * median) for _ in range(7)])
                       for r, median in enumerate(medians)))


class CompareReports(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, report):
        path = self.folder / name
        path.write_text(json.dumps(report))
        return path

    def compare(self, before, after, counts_only=False):
        """Returns whether anything is worse, and what was printed."""
        read = [compare_reports.read_report(self.write("report.json", report)) for report in (before, after)]
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            is_worse = compare_reports.compare(*read, counts_only)
        return is_worse, printed.getvalue()

    def run_script(self, *arguments, **environment):
        return subprocess.run([SCRIPT, *arguments], capture_output=True, text=True, env=os.environ | environment,
                              check=False)

    def test_noise_is_taken_for_a_change_in_at_most_one_report_of_twenty(self):
        chance = random.Random(3)
        outputs = [self.compare(noisy_report(30, chance), noisy_report(30, chance))[1] for _ in range(100)]
        self.assertLessEqual(sum("0 slower, 0 better, 0 faster" not in output for output in outputs), 5)

    def test_a_slowdown_of_a_fifth_is_found_under_noise(self):
        chance = random.Random(4)
        found = 0
        for _ in range(100):
            before = noisy_report(10, chance)
            is_worse, output = self.compare(before, noisy_report(10, chance, 1, 0.2))
            found += is_worse and "slower  stage 0" in output and "1 slower" in output
        self.assertGreaterEqual(found, 90)

    def test_a_time_must_change_by_a_twentieth_and_by_the_quartiles(self):
        steady = [100.0, 100.1, 100.2, 100.3, 100.4, 100.5, 100.6]
        for factor, changed in (1.04, False), (1.06, True):
            after = report_of(row("factor", times(steady, factor)))
            self.assertEqual(self.compare(report_of(row("factor", steady)), after)[0], changed)
        wide = report_of(row("factor", [80.0, 81.0, 82.0, 100.0, 118.0, 119.0, 120.0]))
        above = report_of(row("factor", [121.0, 121.5, 122.0, 123.0, 124.0, 125.0, 126.0]))
        self.assertFalse(self.compare(wide, above)[0])

    def test_the_devices_own_time_is_judged_too(self):
        before = report_of(row("drag frame", BEFORE, BEFORE))
        after = report_of(row("drag frame", BEFORE, times(BEFORE, 1.5)))
        self.assertIn("device_ms 103 -> 154.5 (+50.0%)", self.compare(before, after)[1])

    def test_the_code_is_not_blamed_for_a_busy_machine(self):
        before = report_of(row("factor", BEFORE), row("order", BEFORE))
        after = report_of(row("factor", times(BEFORE, 1.25)), row("order", times(BEFORE, 2.0)))
        for limit in compare_reports.LIMITS:
            after["limits"][0][limit] /= 1.25
        output = self.compare(before, after)[1]
        self.assertIn("The limits of CPU changed", output)
        self.assertIn("slower  order", output)
        self.assertNotIn("factor,", output)

    def test_between_two_processors_counts_alone_are_judged(self):
        before = report_of(row("factor", BEFORE, flops=10))
        for flops, is_worse in (10, False), (11, True):
            after = report_of(row("factor", times(BEFORE, 3.0), flops=flops))
            after["host"]["processor"] = "Another Processor"
            found, output = self.compare(before, after)
            self.assertEqual(found, is_worse)
            self.assertIn("Times are not judged", output)

    def test_a_count_that_rose_or_is_gone_is_worse(self):
        before = report_of(row("factor", [], allocations=12))
        for counts, word in ({"allocations": 13}, "worse "), ({"allocations": 11}, "better "), ({}, "is gone"):
            found, output = self.compare(before, report_of(row("factor", [], **counts)))
            self.assertEqual(found, word != "better ")
            self.assertIn(word, output)
        self.assertTrue(self.compare(before, report_of())[0])

    def test_a_count_may_vary_by_its_tolerance(self):
        for name, count, is_worse in ("bytes", 1005, False), ("bytes", 1006, True), ("flops", 1001, True):
            before, after = (report_of(row("factor", [], **{name: n})) for n in (1000, count))
            self.assertEqual(self.compare(before, after, True)[0], is_worse)

    def test_rows_of_one_report_only_are_listed(self):
        found, output = self.compare(report_of(row("old", BEFORE)), report_of(row("fresh", BEFORE)))
        self.assertFalse(found)
        self.assertIn("gone    old", output)
        self.assertIn("new     fresh", output)

    def test_unusable_reports_are_named(self):
        good = report_of(row("factor", BEFORE))
        other, twice, cut = (copy.deepcopy(good) for _ in range(3))
        other["format"] = "lapwing-bench 2"
        twice["measurements"] *= 2
        del cut["measurements"]
        for report, said in (other, "lapwing-bench 2"), (twice, "twice"), (cut, "measurements"):
            with self.assertRaisesRegex(compare_reports.ReportError, f"bad.json.*{said}"):
                compare_reports.read_report(self.write("bad.json", report))

    def test_the_exit_status_is_the_verdict(self):
        old = self.write("old.json", report_of(row("factor", BEFORE)))
        new = self.write("new.json", report_of(row("factor", times(BEFORE, 2.0))))
        self.assertEqual([self.run_script(old, new).returncode, self.run_script(new, old).returncode], [1, 0])
        missing = self.run_script(old, self.folder / "none.json")
        self.assertEqual(missing.returncode, 2)
        self.assertIn("none.json", missing.stderr)

    def test_counts_need_no_scipy_and_times_say_that_it_is_missing(self):
        (self.folder / "scipy.py").write_text("raise ImportError('none here')")
        old = self.write("old.json", report_of(row("settle", BEFORE, iterations=10)))
        new = self.write("new.json", report_of(row("settle", times(BEFORE, 2.0), iterations=15)))
        hidden = {"PYTHONPATH": str(self.folder)}
        counts = self.run_script("--counts", old, new, **hidden)
        self.assertEqual((counts.returncode, counts.stderr), (0, ""))
        both = self.run_script(old, new, **hidden)
        self.assertEqual(both.returncode, 2)
        self.assertIn("install-packages --reports", both.stderr)


if __name__ == "__main__":
    unittest.main()
