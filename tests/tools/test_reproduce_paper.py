#!/usr/bin/python3
"""tools/reproduce-paper: one command leaves a report that needs nothing else, with every figure of the paper;
its formulas are the program's.

  test_reproduce_paper.py TRIBOGEL [unittest's own arguments]
"""
import base64
import html.parser
import io
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import matplotlib.image
import numpy as np

TOOLS = pathlib.Path(__file__).parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
from tribogel_tools.paper import rheometer, runs  # noqa: E402
from tribogel_tools.paper.values import Results, Value  # noqa: E402

PROGRAM = None
FIGURES = ("fig05", "fig06", "fig07", "fig08", "fig09", "fig10", "fig12", "findings", "doubts", "errors",
           "energy", "profiles", "fits", "readings")


class Page(html.parser.HTMLParser):
    """What a page refers to, and whether its elements are closed."""

    EMPTY = {"img", "meta", "link", "br", "hr"}

    def __init__(self, text):
        super().__init__()
        self.pictures, self.links, self.anchors, self.others, self.open, self.text = [], [], set(), [], [], []
        self.unmatched = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        if tag not in self.EMPTY:
            self.open.append(tag)
        if tag == "img":
            self.pictures.append(attributes)
        self.anchors |= {attributes["id"]} if "id" in attributes else set()
        for name in ("src", "href", "action", "srcset", "data", "poster"):
            if name in attributes and not (tag == "img" and name == "src"):
                (self.links if tag == "a" else self.others).append(attributes[name])

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.unmatched.append(tag)

    def handle_data(self, data):
        self.text.append(data)


class Report(unittest.TestCase):
    """One coarse run of everything, looked at from several sides."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.output = pathlib.Path(cls.folder.name, "report")
        cls.done = cls.command()
        cls.source = (cls.output
                      / "report.html").read_text(encoding="utf-8") if not cls.done.returncode else ""
        cls.page = Page(cls.source)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def command(cls, *more):
        return subprocess.run([TOOLS / "reproduce-paper", "--quick", "--program", PROGRAM, "--output",
                               cls.output, *more],
                              capture_output=True, text=True, check=False)

    def test_one_command_says_where_how_long_and_what_it_cost(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertRegex(self.done.stdout, r"report: .*report\.html \(and \.pdf\)\n\d+ s, \d+ CPU seconds\n$")

    def test_every_picture_is_in_the_page(self):
        drawn = sorted((self.output / "figures").glob("*.png"))
        self.assertGreaterEqual(len(drawn), 14)
        self.assertEqual(len(self.page.pictures), len(drawn))
        inside = set()
        for picture in self.page.pictures:
            self.assertTrue(picture["alt"])
            kind, _, data = picture["src"].partition(",")
            self.assertEqual(kind, "data:image/png;base64")
            content = base64.b64decode(data, validate=True)
            image = matplotlib.image.imread(io.BytesIO(content))
            self.assertGreater(min(image.shape[:2]), 300)
            self.assertGreater(image[..., :3].std(), 0.02)  # not empty
            inside.add(content)
        self.assertEqual(inside, {path.read_bytes() for path in drawn})

    def test_the_page_needs_nothing_else(self):
        self.assertEqual(self.page.others, ["data:,"])
        for link in self.page.links:
            self.assertTrue(link.startswith("#") and link[1:] in self.page.anchors, link)
        for word in ("<script", "@import", "url(", "http:", "https:"):
            self.assertNotIn(word, self.source)
        self.assertEqual((self.page.open, self.page.unmatched), ([], []))

    def test_nothing_is_left_out(self):
        self.assertLessEqual(set(FIGURES), self.page.anchors)
        text = " ".join(self.page.text)
        for number in range(5, 14):
            self.assertRegex(text, rf"Figs?\. {number}\b|and {number}\b")
        self.assertIsNone(re.search(r"\bnan\b|\binf\b|None", text))

    def test_pdf(self):
        content = (self.output / "report.pdf").read_bytes()
        self.assertTrue(content.startswith(b"%PDF") and content.rstrip().endswith(b"%%EOF"))
        self.assertGreaterEqual(content.count(b"/Type /Page "), 8)

    def test_a_report_is_replaced_only_when_told_to(self):
        refused = self.command()
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--overwrite", refused.stderr)
        again = self.command("--redraw")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual((self.output / "report.html").read_text(encoding="utf-8"), self.source)

    def test_formulas_are_the_programs(self):
        results = Results(self.output, runs.QUICK)
        for case in ("fig06", "table2_case2", "table2_case3", "fig12_ve_ve"):
            run = results.shown(case)
            for phase in (3, 4, 5):
                rate, T, N = run.rates()[phase - 1], run.torque(phase), run.force(phase)
                expected = run.end(phase, "mu_apparent")
                self.assertAlmostEqual(rheometer.apparent(*run.law, run.radius, rate, T, N) / expected, 1,
                                       places=12)
                self.assertAlmostEqual(rheometer.gong(run.radius, T, N) / run.end(phase, "mu_gong"), 1,
                                       places=12)

    def test_the_simulated_contact_gives_nearly_the_planar_torque(self):
        run = Results(self.output, runs.QUICK).shown("fig06")
        planar = rheometer.torque_ratio(*run.law, run.radius, run.rates()[-1])
        self.assertAlmostEqual(run.torque_over_force() / planar, 0.99, delta=0.03)


class Fit(unittest.TestCase):
    rates = np.array([0.02, 0.3, 0.9, 4.0])

    def test_gives_back_a_law_of_its_form(self):
        b, m, radius = (2.2e-4, 3.26e-5, 7e-6), (0, 1, 2.5), 9.3
        ratios = rheometer.torque_ratio(b, m, radius, self.rates)
        np.testing.assert_allclose(rheometer.fit(m, radius, self.rates, ratios), b, rtol=1e-9)

    def test_integrals(self):
        """F/N and T/N against sums over rings."""
        b, m, radius, rate = (0.31, 0.047, 0.0021), (0, 1, 2.5), 9.3, 0.21
        r = (np.arange(20000) + 0.5) / 20000 * radius
        mu, ring = rheometer.coefficient(b, m, rate * r), 2 * r / radius**2 * radius / 20000
        self.assertAlmostEqual(rheometer.force_ratio(b, m, radius, rate) / np.sum(mu * ring), 1, places=7)
        self.assertAlmostEqual(rheometer.torque_ratio(b, m, radius, rate) / np.sum(mu * ring * r), 1,
                               places=7)

    def test_no_coefficient_is_negative(self):
        linear, square = (rheometer.torque_basis(m, 10, self.rates) for m in (1, 2))
        ratios = linear - 0.3 * square / 40
        b = rheometer.fit((0, 1, 2), 10, self.rates, ratios)
        self.assertTrue((b >= 0).all() and b[1] > 0, b)
        free = np.linalg.norm(rheometer.torque_ratio(b, (0, 1, 2), 10, self.rates) - ratios)
        for k in range(3):  # no better neighbour
            for change in (1e-4, -1e-4):
                moved = b.copy()
                moved[k] = max(0, moved[k] + change * b.max())
                self.assertGreaterEqual(np.linalg.norm(rheometer.torque_ratio(moved, (0, 1, 2), 10,
                                                                              self.rates) - ratios), free)


class Text(unittest.TestCase):
    def test_numbers_show_as_many_digits_as_their_errors_allow(self):
        self.assertEqual(Value(290.53841, 0.3, 0.012).text("N"), "290.54 ± 0.30 (mesh) ± 0.01 (time) N")
        self.assertEqual(Value(0.0052521, 2e-6).text(scale=1e3), "5.2521 ± 0.0020 (mesh)")
        self.assertEqual(Value(10.0, 0.0, 0.0).text(), "10.000 ± 0.000 (mesh) ± 0.000 (time)")


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
