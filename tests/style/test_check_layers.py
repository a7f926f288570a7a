#!/usr/bin/python3
"""The layer check finds each kind of broken rule, and only those."""
import pathlib
import tempfile
import unittest

import check_layers


class CheckLayers(unittest.TestCase):
    def broken(self, files):
        """The rules that a repository with these files (name: text) breaks."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return check_layers.check(folder)[0]

    base = {"include/tribogel/math/a.hpp": "#include <cmath>\n#include <Eigen/Dense>\n",
            "include/tribogel/friction/f.hpp": '#include "tribogel/math/a.hpp"\n',
            "src/mesh/m.hpp": '#include "tribogel/friction/f.hpp"\n#include <petscdm.h>\n'}

    def only(self, name, text):
        lines = self.broken({**self.base, name: text})
        self.assertEqual(len(lines), 1, lines)
        return lines[0]

    def test_the_right_way_passes(self):
        self.assertEqual(self.broken(self.base), [])

    def test_right_neighbour(self):
        line = self.only("include/tribogel/math/b.hpp", '\n#include "tribogel/friction/f.hpp"\n')
        self.assertTrue(line.startswith("include/tribogel/math/b.hpp:2: "), line)
        self.assertIn("to its right", line)

    def test_physics_may_not_include_machine(self):
        self.assertIn("to its right",
                      self.only("include/tribogel/contact/node/c.hpp", '#include "mesh/m.hpp"\n'))

    def test_siblings(self):
        self.assertIn("siblings",
                      self.only("include/tribogel/material/o.hpp", '#include "tribogel/friction/f.hpp"\n'))

    def test_physics_without_machine(self):
        self.assertIn("physics", self.only("include/tribogel/math/b.hpp", "#include <petscvec.h>\n"))
        self.assertIn("physics", self.only("include/tribogel/math/b.hpp", "#include <mpi.h>\n"))
        self.assertIn("PetscReal", self.only("include/tribogel/math/b.hpp", "inline PetscReal f();\n"))

    def test_comments_are_not_code(self):
        self.assertEqual(self.broken({**self.base,
                                      "include/tribogel/math/b.hpp": "// a PetscReal\n/* MPI_Comm */\n"}), [])

    def test_unknown_folder_and_file(self):
        self.assertIn("in no layer", self.only("src/misc/x.cpp", "int x;\n"))
        self.assertIn("no file", self.only("src/mesh/x.cpp", '#include "petscdm.h"\n'))


if __name__ == "__main__":
    unittest.main()
