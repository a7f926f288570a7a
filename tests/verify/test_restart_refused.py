#!/usr/bin/python3
"""-restart of what is no checkpoint, of another scene or of another mesh is refused in one line and nothing
is changed; the same scene is taken, and the same mesh from wherever it lies.

  test_restart_refused.py TRIBOGEL --mpirun MPIRUN [unittest's arguments]
"""
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
import restarts  # noqa: E402
from restarts import REPOSITORY, SHORT, Folder, contents, run  # noqa: E402


class Refused(Folder):
    def setUp(self):
        super().setUp()
        run(1, SHORT + ["-output_directory", "run", "-wall_time", "1e-6"], self.folder, 4)

    def refuses(self, words, *parts, ranks=1):
        before = contents(self.folder / "run")
        done = run(ranks, words, self.folder, 2)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("tribogel: error: "), done.stderr)
        for part in parts + ("allowed: ",):
            self.assertIn(part, done.stderr)
        self.assertEqual(contents(self.folder / "run"), before)

    def test_what_is_no_checkpoint(self):
        self.refuses(["-restart", "nowhere"], "-restart = nowhere", "does not exist")
        self.refuses(["-restart"], "-restart", "value missing")
        path = self.folder / "run" / "checkpoint.h5"
        whole = path.read_bytes()
        path.write_bytes(whole[:len(whole) // 2])
        for ranks in (1, 2):
            self.refuses(["-restart", "run"], "-restart = run", "no whole HDF5 file", ranks=ranks)
        path.write_text("not HDF5\n")
        self.refuses(["-restart", "run"], "no whole HDF5 file")
        import h5py
        with h5py.File(path, "w") as file:
            file["U"] = [1.0, 2.0]
        self.refuses(["-restart", "run"], "is no checkpoint of tribogel")

    def test_another_scene(self):
        for name, value, stored in (("-top_height", "4.5", "4.4"),
                                    ("-friction_coefficients", "0,1e-3", "0,8e-4"),
                                    ("-element_order", "2", "1"), ("-schedule_rates", "0,0.2", "0,0.1"),
                                    ("-plate_contact", "false", "true")):
            self.refuses(["-restart", "run", name, value], f"{name} = {value}", f"run has {stored}")
        self.refuses(["-restart", "run", "-schedule_twists", "0,2"],
                     "-schedule_twists = 0,2: the run in run has none")
        self.refuses(["-restart", "run", "-overwrite"], "-overwrite")
        self.refuses(["-restart", "run", "-output_directory", "other"], "-output_directory = other")
        self.refuses(SHORT + ["-output_directory", "run"], "-output_directory = run", "holds a run")

    def test_files_that_have_lost_rows(self):
        path = self.folder / "run" / "history.csv"
        path.write_bytes(path.read_bytes()[:-10])
        self.refuses(["-restart", "run"], "history.csv is shorter")

    def test_files_of_other_columns(self):
        path = self.folder / "run" / "profile.csv"
        path.write_text(path.read_text().replace("mu,status", "status,mu", 1))
        self.refuses(["-restart", "run"], "profile.csv has other columns")

    def test_but_not_the_same_scene_again_nor_another_solver(self):
        words = SHORT + ["-top_height", "4.40", "-output_directory", "run/", "-snes_rtol", "1e-9",
                         "-wall_time", "1e3"]
        run(1, words + ["-restart", "run"], self.folder)
        self.assertIn('"snes_rtol": "1e-9"', (self.folder / "run" / "summary.json").read_text())


class MeshFile(Folder):
    """The mesh of the file goes with the run, under whatever path."""
    BRIEF = ["-model", "solid", "-element_order", "1", "-plate_contact", "false", "-top_material",
             "hyperelastic", "-bottom_material", "hyperelastic", "-friction_coefficients", "0.1",
             "-friction_exponents", "0", "-schedule_end_times", "1", "-schedule_approach", "0.1",
             "-schedule_rates", "0", "-ts_adapt_type", "none", "-ts_dt", "0.5"]

    def setUp(self):
        super().setUp()
        made = subprocess.run([REPOSITORY / "tools" / "specimen-mesh", "square", "--elements", "1",
                               "--bottom-radius", "14"],
                              capture_output=True, text=True, check=True)
        self.first = made.stdout
        for name in ("start", "elsewhere"):
            (self.folder / name).mkdir()
        (self.folder / "start" / "mesh.msh").write_text(self.first)
        run(1, self.BRIEF + ["-mesh_file", "mesh.msh", "-output_directory", "../run", "-wall_time", "1e-6"],
            self.folder / "start", 4)

    def moved(self, node, z):
        """The mesh with a node at another height."""
        head, tail = self.first.split("$Nodes\n")
        old = next(line for line in tail.splitlines() if line.startswith(f"{node} "))
        return head + "$Nodes\n" + tail.replace(old, " ".join(old.split()[:3] + [z]), 1)

    def reversed(self):
        """The mesh with its elements in the opposite order."""
        head, tail = self.first.split("$Elements\n")
        count, *elements, end = tail.splitlines()
        return "\n".join([head + "$Elements", count] + elements[::-1] + [end]) + "\n"

    def refuses(self, ranks, words, *parts):
        before = contents(self.folder / "run")
        done = run(ranks, words, self.folder, 2)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("tribogel: error: -mesh_file = "), done.stderr)
        for part in parts + ("allowed: ",):
            self.assertIn(part, done.stderr)
        self.assertEqual(contents(self.folder / "run"), before)

    def test_another_mesh_is_refused(self):
        path = self.folder / "start" / "mesh.msh"
        for ranks, text in ((1, self.moved(14, "-1.9")), (2, self.reversed()), (1, self.moved(19, "-0.5"))):
            path.write_text(text)
            self.refuses(ranks, ["-restart", "run"], "mesh.msh: the mesh is not that of the run in run",
                         "the same mesh")
        path.unlink()
        self.refuses(1, ["-restart", "run"], "mesh.msh: does not exist", "-mesh_file with the path")
        self.refuses(1, ["-restart", "run", "-mesh_file", "mesh.msh"],
                     "-mesh_file = mesh.msh: does not exist")

    def test_the_same_mesh_is_taken(self):
        run(2, ["-restart", "../run", "-wall_time", "1e3"], self.folder / "elsewhere")
        shutil.rmtree(self.folder / "run")
        run(1, self.BRIEF
            + ["-mesh_file", "start/mesh.msh", "-output_directory", "run", "-wall_time", "1e-6"],
            self.folder, 4)
        (self.folder / "start" / "mesh.msh").rename(self.folder / "elsewhere" / "gel.msh")
        run(1, ["-restart", "../run", "-mesh_file", "gel.msh", "-wall_time", "1e3"],
            self.folder / "elsewhere")


if __name__ == "__main__":
    restarts.main(__doc__)
