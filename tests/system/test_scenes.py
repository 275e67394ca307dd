"""crossgrain compare on assemblies: scenes that a case or a file of disks makes up, from the command line to the report."""

import csv
import pathlib
import shutil
import subprocess
import sys
import unittest

from harness import BAD_INPUT, CASES, HELD, SystemTest, settings

SHEAR = CASES / "assembly/plane-shear.toml"
EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / "examples/starts"
SHORT = settings(assembly__duration=0.06, average__from=0.03, average__snapshots=10, preparation__packings=4, looks__count=1, run__mirrors="false")

# A disk that falls on a fixed one, without run.dt.
FILES = """
[case]
kind = "assembly"
extends = "LAWS/rough.toml"
[assembly]
duration = 0.02
gravity = [0.0, -9.81]
[assembly.start]
file = ["start-0.csv", "start-1.csv", "start-2.csv", "start-3.csv"]
density = 6.4
[looks]
count = 2
[average]
bins = "whole"
low = [-0.01, 0.0]
high = [0.01, 0.02]
from = 0.01
snapshots = 5
[[endpoints]]
name = "height"
quantity = "top"
absolute = 0.001
why = "a test"
[run]
mirrors = false
"""


class Scenes(SystemTest):
    def compare(self, case, *arguments, engines="grain,box2d-penalty"):
        return self.run_program("compare", case, "--engines", engines, "--out", self.out, "--quiet", *arguments)

    def rows(self, name):
        with open(self.out / name, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_plane_shear(self):
        """Slabs, endpoints of the case's own and a page; taken up again, nothing is run."""
        done = self.compare(SHEAR, *SHORT)
        self.assertIn(done.status, (0, 1), done)
        profiles = self.rows("profiles.csv")
        self.assertEqual(["x_m", "y_m", "from_s", "to_s"], list(profiles[0])[-4:])
        top = [row for row in profiles if row["field"] == "velocity_x" and row["ring"] == "6" and row["packing"] == "all"]
        self.assertAlmostEqual(0.0604 * 11 / 12, float(top[0]["r_m"]))
        self.assertGreater(float(top[0]["mean"]), 0.0)  # the top wall pulls to the right
        endpoints = {row["endpoint"]: row["unit"] for row in self.rows("endpoints.csv")}
        expected = {"normal_stress": "N/m²", "shear_ratio": "-", "coordination": "-", "shear_rate": "1/s", "velocity_at_top": "m/s"}
        self.assertEqual(expected, endpoints)
        page = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertIn("6 slabs of width", page)
        self.assertIn("ratio of the means of stress_xy and stress_yy over the averaged part", page)
        first = self.results()["runs"]
        again = self.compare(SHEAR, *SHORT)
        self.assertEqual(done.status, again.status)
        self.assertEqual(first, self.results()["runs"])

    def test_lockstep_begins_where_the_walls_are(self):
        """With walls elsewhere than the mirror's, or disks, the first steps would part them by far more than rounding."""
        done = self.run_program(
            "lockstep", SHEAR, "--engines", "box2d-penalty", "--starts=2", "--out", self.out, "--quiet",
            *settings(assembly__duration=0.2, average__from=0.1),
        )  # fmt: skip
        self.assert_status(done, HELD)
        last = self.rows("lockstep.csv")[-1]
        self.assertIn(last["verdict"], ("same_to_rounding", "same_law"))
        self.assertLess(float(last["largest_d"]), 1e-8)

    def test_a_start_of_the_users_own(self):
        for file in ("make_start.py", "from-file.toml"):
            shutil.copy(EXAMPLE / file, self.folder)
        case = self.folder / "from-file.toml"
        case.write_text(case.read_text(encoding="utf-8").replace("../../cases", str(CASES)), encoding="utf-8")
        subprocess.run([sys.executable, "make_start.py"], cwd=self.folder, check=True)
        short = settings(assembly__duration=0.05, average__from=0.02, preparation__packings=2)
        done = self.compare(case, *short, engines="grain")
        self.assert_status(done, HELD)
        self.assertEqual(60, self.results()["region"]["disks"])
        start = self.folder / "start.csv"
        lines = start.read_text(encoding="utf-8").splitlines()
        lines[4] = lines[4].replace("0.00", "O.00", 1)
        start.write_text("\n".join(lines), encoding="utf-8")
        bad = self.compare(case)
        self.assert_status(bad, BAD_INPUT)
        self.assertRegex(bad.error_lines()[0], r"start\.csv:5: \w+ = .*: must be a number")

    def test_files_are_counted_once_and_told_apart(self):
        """Four files are four packings however many looks, need no run.dt, and are not taken up where a fixed disk changed."""
        for k in range(4):
            self.write(f"start-{k}.csv", f"x,y,radius,fixed\n0,{0.0077 + 0.0001 * k},0.0037,0\n0,0,0.0037,1\n")
        case = self.write("case.toml", FILES.replace("LAWS", str(CASES / "laws")))
        self.assert_status(self.compare(case, engines="grain"), HELD)
        self.assertEqual(4, len(self.results()["packings"]))
        before = self.finished_runs()
        self.assert_status(self.compare(case, engines="grain"), HELD)
        self.assertEqual(before, self.finished_runs())
        for k in range(4):
            start = self.folder / f"start-{k}.csv"
            start.write_text(start.read_text(encoding="utf-8").replace("0,0,0.0037", "0.001,0,0.0037"), encoding="utf-8")
        done = self.compare(case, engines="grain")
        self.assert_one_line(done, BAD_INPUT, "depends on what has changed: packing:", "--fresh")

    def test_check_and_compare_refuse_the_same_step(self):
        for command in (["check"], ["compare", "--out", self.out, "--quiet"]):
            done = self.run_program(*command, SHEAR, "--engines", "grain", "--set=run.dt=2e-3")
            self.assert_one_line(done, BAD_INPUT, "run.dt = 0.002 s is beyond ")

    def test_an_assembly_that_does_not_say_what_is_averaged(self):
        done = self.compare(CASES / "hard/pile.toml")
        self.assert_status(done, BAD_INPUT)
        self.assertIn("give it [average] and [[endpoints]]", done.stderr)


if __name__ == "__main__":
    unittest.main()
