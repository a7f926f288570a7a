#!/usr/bin/python3
"""tools/plot draws whole runs and runs that died early, and says in one line what it cannot draw."""
import pathlib
import subprocess
import tempfile
import unittest

PLOT = pathlib.Path(__file__).parents[2] / "tools" / "plot"
HISTORY = ("time_s,phase,approach_mm,rotation_rad,rate_rad_per_s,normal_force_N,torque_Nmm,contact_radius_mm,"
           "mu_apparent,mu_gong,mu_mean,mu_area_weighted,mu_pressure_weighted,newton_iterations,"
           "linear_iterations,step_s,contact_force_N,contact_torque_Nmm,force_mismatch_N,"
           "torque_mismatch_Nmm\n")
PROFILE = ("time_s,phase,surface,reference_r_mm,reference_theta_rad,reference_z_mm,r_mm,theta_rad,z_mm,"
           "pressure_MPa,traction_radial_MPa,traction_circumferential_MPa,sliding_velocity_mm_per_s,mu,"
           "status,part\n")
NO_MU = "nan,nan,nan,nan,nan"
FIRST = f"0,1,0,0,0,0,0,0,{NO_MU},0,0,0,0,0,0,0\n"
PRESSED = f"2.5,1,0.3,0,0,11.5,0,9.5,{NO_MU},3,3,2.5,11.5,0,1e-9,0\n"
TURNED = "7.5,2,0.3,0.15,0.03,10.7,0.2,9.5,3e-3,2.5e-3,2.7e-3,2.6e-3,2.9e-3,4,4,5,10.7,0.2,1e-9,1e-9\n"
LAW = ('{"friction_law": {"name": "power", "pressure_MPa": 0.03, "speed_mm_per_s": [0.01, 0.1, 1],'
       ' "mu": [null, 2e-3, 9e-2]}}')
SURFACES = "".join(f"{time},{phase},{surface},{r},0,0,{1.02 * r},{turn},{-0.2 + r / 90},{rest}\n"
                   for time, phase, turn in ((2.5, 1, 0), (7.5, 2, 0.15))
                   for surface, rest in (("top", "0.04,0,2e-4,0.03,3e-3,slip,face"),
                                         ("bottom", "nan,nan,nan,nan,nan,nan,face"))
                   for r in (0, 3.5, 9.3))


class Plot(unittest.TestCase):
    def plot(self, files, *options):
        """Runs tools/plot on a run directory with these files: status, stderr, names of what it wrote."""
        with tempfile.TemporaryDirectory() as folder:
            run = pathlib.Path(folder, "run")
            run.mkdir()
            for name, text in files.items():
                (run / name).write_text(text, encoding="utf-8")
            done = subprocess.run([PLOT, run, *options], capture_output=True, text=True, cwd=folder,
                                  check=False)
            drawn = {p.name: p.read_bytes() for p in pathlib.Path(folder).rglob("*")
                     if p.suffix in (".png", ".pdf")}
        return done.returncode, done.stderr, drawn

    def draws(self, files, *options, name="picture"):
        status, complaint, drawn = self.plot(files, *options)
        self.assertEqual((status, complaint), (0, ""))
        self.assertEqual(set(drawn), {f"{name}.png", f"{name}.pdf"})
        self.assertTrue(drawn[f"{name}.png"].startswith(b"\x89PNG")
                        and drawn[f"{name}.pdf"].startswith(b"%PDF"))
        return drawn

    def refuses(self, files, *words):
        status, complaint, drawn = self.plot(files)
        self.assertEqual((status, drawn), (2, {}))
        self.assertEqual(complaint.count("\n"), 1, complaint)
        for word in words:
            self.assertIn(word, complaint)

    def test_whole_run(self):
        whole = {"history.csv": HISTORY + FIRST + PRESSED + TURNED, "profile.csv": PROFILE + SURFACES}
        with_surfaces = self.draws(whole)["picture.png"]
        with_law = whole | {"summary.json": LAW}
        self.assertNotEqual(self.draws(with_law)["picture.png"], with_surfaces)
        for torn in ("", LAW[:40], LAW.replace('"mu"', '"nu"')):
            self.assertEqual(self.draws(whole | {"summary.json": torn})["picture.png"], with_surfaces)
        del whole["profile.csv"]
        self.assertNotEqual(self.draws(whole)["picture.png"], with_surfaces)
        del with_law["profile.csv"]
        self.draws(with_law)

    def test_output_path(self):
        self.draws({"history.csv": HISTORY + FIRST + PRESSED}, "--output", "fig.06.png", name="fig.06")

    def test_run_that_died(self):
        self.draws({"history.csv": HISTORY + FIRST})
        self.draws({"history.csv": HISTORY + FIRST + PRESSED + TURNED[:30], "profile.csv": PROFILE})
        self.draws({"history.csv": HISTORY + FIRST + PRESSED, "profile.csv": PROFILE + SURFACES[:140]})

    def test_one_gel_without_contact(self):
        twisted = f"7.5,2,0.3,0.15,0.03,10.7,0.2,nan,{NO_MU},4,4,5,nan,nan,nan,nan\n"
        self.draws({"history.csv": HISTORY + FIRST + PRESSED.replace("9.5", "nan") + twisted,
                    "profile.csv": PROFILE})

    def test_what_cannot_be_drawn(self):
        self.refuses({}, "history.csv")
        self.refuses({"history.csv": ""}, "empty")
        self.refuses({"history.csv": HISTORY}, "no step")
        self.refuses({"history.csv": (HISTORY + FIRST).replace("torque_Nmm", "torque", 1)}, "torque_Nmm")
        self.refuses({"history.csv": HISTORY + FIRST.replace("0,1,0,0", "0,1,zero,0")}, "approach_mm")


if __name__ == "__main__":
    unittest.main()
