#!/usr/bin/python3
"""What compare-reports calls changed."""

import dataclasses
import itertools
import json
import os
import pathlib
import random
import subprocess
import tempfile
import unittest

from made_up_report import BENCH, as_json, report_of, row, small_report

from saved.comparison import (
    Verdict,
    compare,
    discovery_threshold,
    rank_test,
    smallest_rank_test,
)
from saved.comparison_text import text_of
from saved.number_text import brief_count, change_in_percent, percent, short_number
from saved.report import ReportError, parse_report, spread_of

BEFORE = [100.0, 101.0, 102.0, 103.0, 104.0, 105.0, 106.0]


def times(ms, factor):
    return [factor * value for value in ms]


def noisy_report(rows, runs, chance, slow_rows=0, slowdown=0.0):
    """Rows "stage 0" and on, of 100 ms and 5% noise, but for the first ones, which take `slowdown`
    more."""
    medians = [100 * (1 + slowdown) if r < slow_rows else 100 for r in range(rows)]
    return report_of(
        *(
            row(f"stage {r}", [chance.gauss(median, 0.05 * median) for _ in range(runs)])
            for r, median in enumerate(medians)
        )
    )


def with_count(name, count):
    return report_of(row("factor", [1.0], counts={name: count}))


class Times(unittest.TestCase):
    def test_nothing_changed_between_a_report_and_itself(self):
        comparison = compare(small_report(), small_report())
        self.assertEqual(comparison.verdict, Verdict.SAME)
        self.assertEqual((comparison.changes, comparison.missing), ([], []))
        self.assertEqual(comparison.same_counts, 3)
        self.assertEqual(comparison.same_times, 4, "three by the wall and one by the device")

    def test_noise_is_taken_for_a_change_in_at_most_one_report_of_twenty(self):
        chance = random.Random(3)
        verdicts = [
            compare(noisy_report(30, 7, chance), noisy_report(30, 7, chance)).verdict
            for _ in range(200)
        ]
        self.assertLessEqual(200 - verdicts.count(Verdict.SAME), 10)

    def test_a_slowdown_of_a_fifth_is_found_under_noise(self):
        chance = random.Random(4)
        found = 0
        for _ in range(100):
            before = noisy_report(10, 7, chance)
            comparison = compare(before, noisy_report(10, 7, chance, 1, 0.2))
            slower = [change.row.stage for change in comparison.changes]
            found += comparison.verdict == Verdict.WORSE and slower == ["stage 0"]
        self.assertGreaterEqual(found, 90)

    def test_what_got_faster_is_better(self):
        after = report_of(row("factor", times(BEFORE, 0.8)))
        comparison = compare(report_of(row("factor", BEFORE)), after)
        self.assertEqual(comparison.verdict, Verdict.BETTER)
        self.assertEqual([change.what for change in comparison.changes], ["wall ms"])
        self.assertIn("103 -> 82.4", text_of(comparison))

    def test_what_differs_by_less_than_a_twentieth_did_not_change(self):
        steady = [100.0, 100.1, 100.2, 100.3, 100.4, 100.5, 100.6]
        for factor, verdict in (1.04, Verdict.SAME), (1.06, Verdict.WORSE):
            after = report_of(row("factor", times(steady, factor)))
            self.assertEqual(compare(report_of(row("factor", steady)), after).verdict, verdict)

    def test_what_differs_by_less_than_the_quartiles_did_not_change(self):
        wide = report_of(row("factor", [80.0, 81.0, 82.0, 100.0, 118.0, 119.0, 120.0]))
        above = report_of(row("factor", [121.0, 121.5, 122.0, 123.0, 124.0, 125.0, 126.0]))
        self.assertEqual(compare(wide, above).verdict, Verdict.SAME)

    def test_too_few_runs_to_see_one_change_are_noted(self):
        chance = random.Random(5)
        before, after = noisy_report(300, 7, chance), noisy_report(300, 7, chance, 1, 0.5)
        (note,) = compare(before, after).notes
        self.assertIn("300 of 300 times", note)
        self.assertIn("with 8 runs", note)
        before, after = noisy_report(10, 7, chance), noisy_report(10, 7, chance)
        self.assertEqual(compare(before, after).notes, [])

    def test_the_devices_own_time_is_judged_too(self):
        before = row("drag frame", BEFORE, device_ms=BEFORE)
        after = row("drag frame", BEFORE, device_ms=times(BEFORE, 1.5))
        comparison = compare(report_of(before), report_of(after))
        self.assertEqual([change.what for change in comparison.changes], ["device ms"])

    def test_the_code_is_not_blamed_for_a_busy_machine(self):
        before = report_of(row("factor", BEFORE), row("order", BEFORE))
        after = report_of(row("factor", times(BEFORE, 1.25)), row("order", times(BEFORE, 2.0)))
        rates = "copy_gb_per_s", "matmul_gflops_float32", "matmul_gflops_float64"
        of_processor = after.limits[0]
        slower = {rate: getattr(of_processor, rate) / 1.25 for rate in rates}
        after.limits[0] = dataclasses.replace(of_processor, **slower)
        comparison = compare(before, after)
        (note,) = comparison.notes
        self.assertIn("The limits of CPU changed", note)
        slowed_more = [change.row.stage for change in comparison.changes]
        self.assertEqual(slowed_more, ["order"])

    def test_the_code_is_not_praised_for_a_faster_machine(self):
        before = report_of(row("factor", BEFORE))
        after = report_of(row("factor", times(BEFORE, 0.7)))
        self.assertEqual(compare(before, after).verdict, Verdict.BETTER)
        # Copies are as fast as they were.
        after.limits[0] = dataclasses.replace(after.limits[0], matmul_gflops_float64=150.0)
        self.assertEqual(compare(before, after).verdict, Verdict.SAME)

    def test_between_two_processors_counts_alone_are_judged(self):
        before = report_of(row("factor", BEFORE, counts={"flops": 10}))
        for flops, verdict in (10, Verdict.SAME), (11, Verdict.WORSE):
            after = report_of(row("factor", times(BEFORE, 3.0), counts={"flops": flops}))
            host = dataclasses.replace(after.host, processor="Another Processor")
            comparison = compare(before, dataclasses.replace(after, host=host))
            self.assertEqual(comparison.verdict, verdict)
            self.assertIn("Times are not judged", comparison.notes[0])

    def test_are_left_alone_when_only_counts_are_asked_for(self):
        after = report_of(row("factor", times(BEFORE, 3.0)))
        comparison = compare(report_of(row("factor", BEFORE)), after, times=False)
        self.assertEqual(comparison.verdict, Verdict.SAME)


class CountsOf(unittest.TestCase):
    def test_what_rose_is_worse_and_what_fell_better(self):
        rose = compare(with_count("allocations", 12), with_count("allocations", 13))
        self.assertEqual(rose.verdict, Verdict.WORSE)
        self.assertIn("12 -> 13", text_of(rose))
        self.assertIn("Verdict: worse (counts: 1 rose", text_of(rose))
        fell = compare(with_count("allocations", 13), with_count("allocations", 12))
        self.assertEqual(fell.verdict, Verdict.BETTER)

    def test_a_count_may_vary_by_its_tolerance(self):
        def verdict(name, count):
            before, after = with_count(name, 1000), with_count(name, count)
            return compare(before, after, count_tolerances={"nonzeros": 0.01}).verdict

        self.assertEqual(verdict("nonzeros", 1010), Verdict.SAME)
        self.assertEqual(verdict("nonzeros", 1011), Verdict.WORSE)
        self.assertEqual(verdict("flops", 1001), Verdict.WORSE)

    def test_what_was_counted_and_is_gone_is_worse(self):
        self.assertEqual(compare(with_count("flops", 10), report_of()).verdict, Verdict.WORSE)
        renamed = compare(with_count("flops", 10), with_count("bytes", 10))
        self.assertEqual(renamed.verdict, Verdict.WORSE)
        self.assertIn("flops (worse)", text_of(renamed))


class Rows(unittest.TestCase):
    def test_of_one_report_only_are_listed_and_not_judged(self):
        comparison = compare(report_of(row("old", BEFORE)), report_of(row("fresh", BEFORE)))
        self.assertEqual(comparison.verdict, Verdict.SAME)
        self.assertIn("gone    old", text_of(comparison))
        self.assertIn("new     fresh", text_of(comparison))

    def test_measured_twice_are_refused(self):
        twice = report_of(row("factor", BEFORE), row("factor", BEFORE))
        with self.assertRaisesRegex(ReportError, '"factor".* twice'):
            compare(twice, twice)

    def test_that_changed_are_told_in_a_table(self):
        before = report_of(
            row("drag frame", BEFORE),
            row("factor", BEFORE, counts={"allocations": 0, "flops": 123_456_789_012}),
            row("old", []),
        )
        after = report_of(
            row("drag frame", times(BEFORE, 2.0)),
            row("factor", BEFORE, counts={"allocations": 3, "flops": 123_456_789_000}),
        )
        self.assertEqual(
            text_of(compare(before, after)),
            """\
armadillo, 26,002 vertices, on CPU
  worse   factor                         allocations   0 -> 3
  slower  drag frame                     wall ms       103 -> 206                             +100%
  better  factor                         flops         123,456,789,012 -> 123,456,789,000
armadillo, 26,002 vertices, on CPU
  gone    old

Unchanged: 0 counts, 1 times.
Verdict: worse (counts: 1 rose, 0 gone, 1 fell; times: 1 slower, 0 faster)
""",
        )


class RankTest(unittest.TestCase):
    def test_counts_every_way_to_deal_the_ranks(self):
        # Of the 20 ways to choose 3 of 6, one lies all below and one all above.
        self.assertAlmostEqual(rank_test([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]), 2 / 20)
        self.assertAlmostEqual(rank_test([1.0, 2.0, 4.0], [3.0, 5.0, 6.0]), 4 / 20)
        self.assertAlmostEqual(smallest_rank_test(7, 7), 2 / 3432)
        self.assertAlmostEqual(smallest_rank_test(2, 5), 2 / 21)
        self.assertAlmostEqual(smallest_rank_test(20, 20) * 137_846_528_820, 2)

    def test_is_near_the_exact_one_where_numbers_are_equal(self):
        chance = random.Random(6)
        for _ in range(200):
            a = [chance.randint(0, 9) for _ in range(6)]
            b = [chance.randint(5, 14) for _ in range(6)]
            exact = share_of_deals_as_far(a, b)
            if exact < 0.05:
                self.assertLess(exact / 2, rank_test(a, b))
                self.assertLess(rank_test(a, b), exact * 3)
        self.assertEqual(rank_test([1.0, 1.0, 1.0], [1.0, 1.0]), 1.0)
        self.assertEqual(rank_test([1.0] * 30, [1.0] * 30), 1.0)

    def test_discoveries_are_the_largest_that_stay_below_their_share(self):
        # Bounds 0.0125, 0.025, 0.0375, 0.05: the third holds, whatever the second does.
        self.assertEqual(discovery_threshold([0.9, 0.03, 0.001, 0.028], 0.05), 0.03)
        self.assertLess(discovery_threshold([0.9, 0.04, 0.02, 0.5], 0.05), 0)
        self.assertLess(discovery_threshold([], 0.05), 0)


def share_of_deals_as_far(a, b):
    """The exact probability, with middle ranks: of all ways to deal these numbers to two sides."""
    values = sorted([*a, *b])
    middle_rank = {v: 2 * values.index(v) + values.count(v) for v in values}
    mean = len(a) * len(values)

    def distance(side):
        return abs(sum(middle_rank[v] for v in side) - mean)

    deals = [distance(deal) for deal in itertools.combinations([*a, *b], len(a))]
    return sum(deal >= distance(a) for deal in deals) / len(deals)


class Numbers(unittest.TestCase):
    def test_have_three_digits_that_count(self):
        numbers = 0, 0.001234, 1, 12.345, 123.45, 999.7, 1234567.8, 9.999, 0.00000149
        texts = "0 0.00123 1.00 12.3 123 1,000 1,234,568 10.0 0.000001".split()
        self.assertEqual([short_number(number) for number in numbers], texts)

    def test_are_brief_in_labels(self):
        numbers = 500, 26_002, 172_974, 999_950, 1_250_000, 0.05
        texts = "500 26k 173k 1M 1.25M 0.05".split()
        self.assertEqual([brief_count(number) for number in numbers], texts)

    def test_as_shares_keep_a_decimal_where_it_counts(self):
        self.assertEqual([percent(share) for share in (0.123, 0.0312, 1)], ["12%", "3.1%", "100%"])
        self.assertEqual(change_in_percent(100, 120), "+20%")
        self.assertEqual(change_in_percent(12, 11), "-8.3%")
        self.assertEqual(change_in_percent(0, 5), "")
        self.assertEqual(change_in_percent(1e9, 1e9 - 1), "")

    def test_between_runs_are_interpolated_for_quartiles(self):
        spread = spread_of([4.0, 1.0, 3.0, 2.0])
        self.assertEqual((spread.median, spread.low, spread.high), (2.5, 1.75, 3.25))
        self.assertEqual(spread_of([7.0]).low, 7.0)
        self.assertEqual(spread_of([]).high, 0.0)


class Reading(unittest.TestCase):
    def complaint(self, change):
        values = as_json(small_report())
        change(values)
        with self.assertRaises(ReportError) as raised:
            parse_report(json.dumps(values), "a.json")
        return str(raised.exception)

    def test_loses_nothing(self):
        report = small_report()
        self.assertEqual(parse_report(json.dumps(as_json(report)), "a.json"), report)

    def test_refuses_another_format_by_name(self):
        said = self.complaint(lambda values: values.update(format="lapwing-bench 2"))
        self.assertIn('a.json: this is "lapwing-bench 2"', said)

    def test_names_what_is_missing(self):
        said = self.complaint(lambda values: values["measurements"][1].pop("by"))
        self.assertIn('a.json: /measurements/1: the key "by" is missing', said)

    def test_names_the_run_that_is_no_time(self):
        for value in -404.0, "404", None, float("nan"):
            said = self.complaint(
                lambda values: values["measurements"][1].update(wall_ms=[400.0, value])
            )
            self.assertIn("a.json: /measurements/1/wall_ms/1: expected a number from 0", said)

    def test_refuses_what_is_cut_off_or_of_another_shape(self):
        with self.assertRaisesRegex(ReportError, "a.json: .*line 1"):
            parse_report(json.dumps(as_json(small_report()))[:500], "a.json")
        for value in 5, [5], [None]:
            said = self.complaint(lambda values: values.update(measurements=value))
            self.assertTrue(said.startswith("a.json: "), said)


class Script(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, report):
        path = self.folder / name
        path.write_text(json.dumps(as_json(report)))
        return str(path)

    def run_script(self, *arguments, **environment):
        command = [BENCH / "compare-reports", *arguments]
        return subprocess.run(
            command, capture_output=True, text=True, env=os.environ | environment, check=False
        )

    def test_ends_with_1_when_anything_is_worse(self):
        old = self.write("old.json", report_of(row("factor", BEFORE)))
        new = self.write("new.json", report_of(row("factor", times(BEFORE, 2.0))))
        worse, better = self.run_script(old, new), self.run_script(new, old)
        self.assertEqual((worse.returncode, better.returncode), (1, 0))
        self.assertTrue(worse.stdout.endswith("times: 1 slower, 0 faster)\n"), worse.stdout)
        self.assertEqual(self.run_script(old, new).stdout, worse.stdout)

    def test_counts_need_no_scipy_and_times_say_that_it_is_missing(self):
        (self.folder / "scipy.py").write_text("raise ImportError('none here')")
        old = self.write("old.json", report_of(row("settle", BEFORE, counts={"iterations": 10})))
        new = self.write("new.json", report_of(row("settle", BEFORE, counts={"iterations": 15})))
        self.assertEqual(self.run_script(old, new).returncode, 1)
        hidden = {"PYTHONPATH": str(self.folder)}
        counts = self.run_script("--counts", old, new, **hidden)
        self.assertEqual((counts.returncode, counts.stderr), (0, ""))
        alike = self.run_script(old, new, **hidden)
        self.assertEqual(alike.returncode, 2)
        self.assertIn("install-packages --reports", alike.stderr)

    def test_ends_with_2_and_names_a_file_that_it_cannot_read(self):
        path = self.write("old.json", small_report())
        result = self.run_script(path, str(self.folder / "none.json"))
        self.assertEqual(result.returncode, 2)
        self.assertIn("none.json", result.stderr)
        self.assertEqual(self.run_script(path).returncode, 2)


if __name__ == "__main__":
    unittest.main()
