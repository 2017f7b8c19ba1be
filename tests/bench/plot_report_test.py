#!/usr/bin/python3
"""What plot-report draws, and what its page says."""

import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from made_up_report import BENCH, as_json, growing_report, report_of, row, small_report

from saved.page import page_of
from saved.plots import (
    all_plots,
    growth_of,
    limits_plot,
    lines_of,
    peers_plot,
    ratios_plot,
    scaling_plot,
    stages_plot,
)
from saved.report import read_report

from matplotlib.text import Text

MEASURED = BENCH / "measured" / "2026-11-22-two-threads.json"


def shown_texts(figure):
    """Each text that is seen in a figure, and where."""
    figure.draw_without_rendering()
    seen = set(figure.findobj(Text)) - set(labels_beyond_axes(figure))
    return [(t.get_text(), t.get_window_extent()) for t in seen if t.get_text() and t.get_visible()]


def labels_beyond_axes(figure):
    """Ticks that are there and not drawn."""
    for axes in figure.axes:
        for axis in axes.xaxis, axes.yaxis:
            least, most = sorted(axis.get_view_interval())
            for tick in axis.get_major_ticks() + axis.get_minor_ticks():
                if not least <= tick.get_loc() <= most:
                    yield tick.label1


def texts_of(figure):
    """From the top to the bottom and from left to right."""
    places = sorted(shown_texts(figure), key=lambda shown: (-shown[1].y0, shown[1].x0))
    return [text for text, _ in places]


def markers_of(figure, shape):
    (axes,) = figure.axes
    lines = [line for line in axes.lines if line.get_marker() == shape and len(line.get_xdata())]
    return [len(line.get_xdata()) for line in lines]


class ScalingPlot(unittest.TestCase):
    def test_labels_a_line_with_its_growth(self):
        texts = texts_of(scaling_plot(growing_report(), "CPU", "preparation"))
        self.assertIn("order  ~ n^1.00", texts)
        self.assertNotIn("drag frame", " ".join(texts), "which is no preparation")
        self.assertNotIn("CHOLMOD", " ".join(texts))

    def test_joins_the_sizes_of_one_mesh(self):
        figure = scaling_plot(growing_report(), "CPU", "preparation")
        (axes,) = figure.axes
        joined = [len(line.get_xdata()) for line in axes.lines if line.get_marker() == "None"]
        marked = [len(line.get_xdata()) for line in axes.lines if line.get_linestyle() == "None"]
        self.assertEqual([n for n in joined if n], [3, 3], "factor and order")
        self.assertEqual(sorted(n for n in marked if n), [3, 4], "one more factor, of another mesh")

    def test_is_not_drawn_of_one_size(self):
        for device in "CPU", "Some GPU":
            self.assertIsNone(scaling_plot(small_report(), device, "preparation"))


class Growth(unittest.TestCase):
    def powers(self, exponent, sizes, off=0.0):
        signs = [(-1) ** k for k in range(len(sizes))]
        return [
            row("factor", [2e-5 * n**exponent * (1 + sign * off)], vertices=n)
            for n, sign in zip(sizes, signs)
        ]

    def test_of_an_exact_power_is_that_power(self):
        growth = growth_of(self.powers(1.5, [10_000, 20_000, 70_000, 300_000]))
        self.assertAlmostEqual(growth.exponent, 1.5)
        self.assertAlmostEqual(growth.standard_error, 0.0)

    def test_off_the_power_has_a_standard_error_that_covers_it(self):
        growth = growth_of(self.powers(1.0, [10_000, 20_000, 40_000, 80_000, 160_000], 0.05))
        self.assertGreater(growth.standard_error, 0.005)
        self.assertLess(abs(growth.exponent - 1), 3 * growth.standard_error)

    def test_is_not_fitted_to_two_sizes_nor_to_small_meshes(self):
        for sizes in [10_000, 20_000], [10_000, 20_000, 20_000], [1_000, 10_000, 20_000]:
            self.assertIsNone(growth_of(self.powers(1.0, sizes)))

    def test_is_that_of_the_table_of_lapwing_bench(self):
        table = subprocess.run(
            [os.environ["LAPWING_BENCH"], "--show", MEASURED],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        in_table = re.findall(r"n\^(\S+) \+-(\S+) +(\d+) sizes", table)
        drawn = [growth_of(rows) for rows in lines_of(read_report(MEASURED)).values()]
        self.assertCountEqual(
            in_table,
            [(f"{g.exponent:.2f}", f"{g.standard_error:.2f}", str(g.sizes)) for g in drawn if g],
        )


class StagesPlot(unittest.TestCase):
    def test_takes_from_the_processor_what_the_device_does_not(self):
        texts = texts_of(stages_plot(small_report(), "Some GPU"))
        for text in "102", "106 ms", "assemble", "factor", "armadillo 26k":
            self.assertIn(text, texts)
        self.assertNotIn("order", texts)

    def test_is_not_drawn_for_a_device_that_prepares_nothing(self):
        self.assertIsNone(stages_plot(report_of(row("drag frame", [1.0])), "CPU"))


class PeersPlot(unittest.TestCase):
    def test_has_everyone_who_did_a_stage(self):
        texts = texts_of(peers_plot(growing_report(), "CPU"))
        for text in "factor", "Lapwing", "CHOLMOD":
            self.assertIn(text, texts)
        self.assertNotIn("order", texts)
        self.assertIsNone(peers_plot(small_report(), "CPU"), "of one size")


class RatiosPlot(unittest.TestCase):
    def test_has_a_bar_for_the_largest_mesh_and_marks_for_the_others(self):
        figure = ratios_plot(growing_report())
        texts = texts_of(figure)
        self.assertIn("factor / CHOLMOD", texts)
        self.assertIn("0.200  hills <&> 40k", texts)
        self.assertEqual(markers_of(figure, "|"), [3])
        self.assertIsNone(ratios_plot(report_of(row("factor", [1.0]))))


class LimitsPlot(unittest.TestCase):
    def test_cuts_off_what_is_far_beyond_the_limit(self):
        # Ten times the rate of copies.
        figure = limits_plot(report_of(row("in cache", [1.0], counts={"bytes": 100_000_000})))
        self.assertEqual(figure.axes[0].get_xlim(), (0, 1.5))
        self.assertIn("1000%  armadillo 26k", texts_of(figure))

    def test_shows_the_highest_share_first(self):
        texts = texts_of(limits_plot(growing_report()))
        self.assertLess(texts.index("drag frame"), texts.index("factor, CHOLMOD"))
        self.assertIsNone(limits_plot(report_of(row("factor", [1.0]))))


class Pictures(unittest.TestCase):
    def test_of_a_measured_report_have_all_their_text_inside_and_no_two_on_each_other(self):
        for name, figure in all_plots(read_report(MEASURED)).items():
            boxes = shown_texts(figure)
            for k, (text, box) in enumerate(boxes):
                self.assertGreaterEqual(min(box.x0, box.y0), -1, f"{name}: {text}")
                self.assertLessEqual(box.x1, figure.bbox.x1 + 1, f"{name}: {text}")
                self.assertLessEqual(box.y1, figure.bbox.y1 + 1, f"{name}: {text}")
                for other, other_box in boxes[:k]:
                    self.assertFalse(box.overlaps(other_box), f"{name}: {text}, {other}")


class Page(unittest.TestCase):
    def test_needs_nothing_else(self):
        page = page_of(growing_report())
        self.assertTrue(page.startswith("<!DOCTYPE html>"))
        sources = re.findall(r'src="([^"]{9})', page)
        self.assertEqual(set(sources), {"data:imag"})
        for link in "href=", "url(", "<script":
            self.assertNotIn(link, page)

    def test_says_where_it_was_made_and_which_targets_are_met(self):
        page = page_of(small_report())
        for text in (
            "0123abcd+",
            "Some Processor 3 GHz, 2 threads",
            "<td>met</td><td>factor / CHOLMOD</td>",
            "<td>NOT met</td><td>frames a second</td>",
            "<td>allocations 12, flops 4,000,000,000</td>",
            "<td>102</td><td>101 to 103</td><td>100 to 104</td><td>200</td>",
        ):
            self.assertIn(text, page)

    def test_names_a_mesh_as_it_is_called(self):
        page = page_of(growing_report())
        self.assertIn("hills &lt;&amp;&gt;", page)
        self.assertNotIn("hills <", page)

    def test_of_an_empty_report_has_no_plots_and_no_measurements(self):
        page = page_of(report_of())
        self.assertNotIn("<img", page)
        self.assertNotIn("All measurements", page)


class Script(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.report = self.folder / "new.json"
        self.report.write_text(json.dumps(as_json(growing_report())))

    def run_script(self, *arguments, **environment):
        return subprocess.run(
            [BENCH / "plot-report", *arguments],
            capture_output=True,
            text=True,
            env=os.environ | environment,
            check=False,
        )

    def test_draws_the_same_files_of_the_same_report(self):
        files = []
        for folder in self.folder / "a", self.folder / "b":
            page = self.folder / f"{folder.name}.html"
            result = self.run_script(self.report, "--page", page, "--pictures", folder)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            files.append([page.read_bytes(), *(p.read_bytes() for p in sorted(folder.iterdir()))])
        names = sorted(path.name for path in (self.folder / "a").iterdir())
        self.assertIn("scaling-preparation-CPU.svg", names)
        self.assertIn("ratios.svg", names)
        self.assertEqual(files[0], files[1])

    def test_draws_png_where_asked_to(self):
        self.run_script(self.report, "--pictures", self.folder, "--format", "png")
        self.assertTrue((self.folder / "limits.png").read_bytes().startswith(b"\x89PNG"))

    def test_names_what_is_wrong_and_what_to_do(self):
        nowhere = self.folder / "none" / "new.html"
        (self.folder / "matplotlib.py").write_text("raise ImportError('none here')")
        page = self.report, "--page", nowhere
        without = self.run_script(*page, PYTHONPATH=str(self.folder))
        for result, said in (
            (self.run_script(self.report), "--page FILE or --pictures FOLDER"),
            (self.run_script(nowhere, "--page", self.folder / "x.html"), str(nowhere)),
            (self.run_script(*page), f"cannot write {nowhere}"),
            (without, "install-packages --reports"),
        ):
            self.assertEqual(result.returncode, 2)
            self.assertIn(said, result.stderr)
            self.assertNotIn("Traceback", result.stderr)


if __name__ == "__main__":
    unittest.main()
