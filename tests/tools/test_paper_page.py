#!/usr/bin/python3
"""src/PAPER.md keeps its word: each numbered equation has a file and a test that exist, each table and figure
a place, each doubt a choice."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).parents[2]
PAGE = (ROOT / "src" / "PAPER.md").read_text(encoding="utf-8")
NUMBERED = {2: 3, 3: 13, 4: 10}  # section of the paper: its last equation
DOUBTS = (r"\(3\.11\) lacks a factor R", "Units of Table 1", "Units of the viscosities",
          "Bulk modulus of the branch", "Unit of the sliding speed", "Heights and approach", "Mesh and steps")


def rows(title):
    """Cells of the first table below a heading."""
    section = PAGE.split(f"## {title}\n", 1)[1].split("\n## ", 1)[0]
    lines = [line for line in section.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def equations(text):
    """(3.8), (4.3)-(4.5) as pairs of numbers."""
    found = set()
    for first, last in re.findall(r"\((\d\.\d+)\)(?:-\((\d\.\d+)\))?", text):
        section, start = map(int, first.split("."))
        found |= {(section, k) for k in range(start, int(last.split(".")[1]) + 1 if last else start + 1)}
    return found


class Page(unittest.TestCase):
    def test_every_numbered_equation_has_its_row(self):
        here = set().union(*(equations(row[0]) for row in rows("Equations")))
        self.assertEqual({(s, k) for s, last in NUMBERED.items() for k in range(1, last + 1)} - here, set())

    def test_files_and_tests_exist(self):
        tests = {path.stem for path in (ROOT / "tests").rglob("test_*")}
        for row in rows("Equations"):
            files = re.findall(r"`([\w/]+\.(?:hpp|cpp))`", row[2])
            self.assertTrue(files, row)
            for file in files:
                self.assertTrue((ROOT / "include" / "tribogel" / file).is_file()
                                or (ROOT / "src" / file).is_file(), file)
            self.assertTrue(re.search(r"`test_\w+`", row[3]), row)
        for test in re.findall(r"`(test_\w+)`", PAGE):
            self.assertIn(test, tests)

    def test_figures_and_tables_have_their_place(self):
        names = " ".join(row[0] for row in rows("Tables and figures"))
        for name in ("Table 1", "Table 2", *(f"{k}" for k in range(1, 14))):
            self.assertRegex(names, rf"\b{name}\b")

    def test_links_lead_somewhere(self):
        for target in re.findall(r"\]\(([^)#]+)", PAGE):
            self.assertTrue((ROOT / "src" / target).exists(), target)
        for file in re.findall(r"options/[\w/]+\.opts", PAGE):
            self.assertTrue((ROOT / file).is_file(), file)
        for path in (ROOT / "options" / "paper").glob("*.opts"):
            self.assertIn(path.stem, PAGE)

    def test_every_doubt_is_there_with_a_choice(self):
        doubts = re.split(r"\n\*\*", PAGE.split("## Doubts", 1)[1])[1:]
        for wanted in DOUBTS:
            self.assertTrue(any(re.match(wanted, doubt) for doubt in doubts), wanted)
        for doubt in doubts:
            self.assertGreater(len(doubt), 60, doubt)


if __name__ == "__main__":
    unittest.main()
