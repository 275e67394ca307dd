"""LAMMPS, where it is installed: what its worker makes of scenes, held against its mirror."""

import csv
import shutil
import unittest

from harness import BAD_INPUT, COUETTE, HELD, SystemTest

CASES = COUETTE.parents[1]


@unittest.skipUnless(shutil.which("lmp"), "LAMMPS is not installed (Debian: package lammps)")
class Lammps(SystemTest):
    def test_it_is_the_law_that_it_declares(self):
        """Same to rounding: the law, its conventions, the wheel's motion, and forces read back from pairs."""
        done = self.run_program(
            "lockstep", COUETTE, "--engines", "lammps", "--out", self.out, "--quick", "--quiet", "--starts=2"
        )
        self.assert_status(done, HELD)
        row = self.results()["lockstep"]["rows"][0]
        self.assertEqual("same_to_rounding", row["verdict"])
        self.assertGreater(row["kinds"]["wall"], 0)
        self.assertLess(row["forces"]["normal"], 1e-12)
        self.assertLess(row["forces"]["tangential"], 1e-12)

    def test_its_conventions_are_found_from_outside(self):
        """Arms of f_t and of v_t that differ: neither alone brings a mirror nearer, the two together do."""
        done = self.run_program("identify", COUETTE, "--engines", "lammps", "--quiet")
        self.assert_status(done, HELD)
        for option, value in (
            ("lever_arm", "overlap_middle"), ("velocity_arm", "radius"), ("coulomb_bound", "magnitude"),
            ("spring_reset", "spring_only"), ("spring_update", "before"), ("damping_velocity", "lagged"),
        ):  # fmt: skip
            self.assertRegex(done.stdout, rf"(?m)^{option} +{value} +declares {value}$")
        self.assertIn("does not simulate bottom_friction", done.stdout)

    def test_collisions(self):
        """What it lacks of the scene's law is a model difference; to its own law it holds."""
        done = self.run_program(
            "collide", CASES / "collision" / "figure-4-3.toml", "--engines", "lammps", "--out", self.out, "--quiet",
            "--set=collision.psi=[0.1, 1.0, 4.0]",
        )  # fmt: skip
        with open(self.out / "collisions.csv", encoding="utf-8", newline="") as file:
            own = [row for row in csv.DictReader(file) if row["engine"] == "lammps"]
        judged = {row["verdict_declared"] for row in own if row["outcome"] != "refused"}
        self.assertEqual({"held"}, judged)
        refused = {row["variant"] for row in own if row["outcome"] == "refused"}
        self.assertIn("coulomb", " ".join(refused))
        self.assertEqual("", done.stderr)

    def test_planes_and_gravity(self):
        """A pile on planes: forces of disks and planes come from two parts of LAMMPS."""
        done = self.run_program(
            "stability", CASES / "hard" / "pile.toml", "--engines", "lammps", "--out", self.out, "--quick", "--quiet"
        )
        self.assert_status(done, HELD)

    def test_what_it_cannot_do_is_refused_by_name(self):
        done = self.run_program(
            "collide", CASES / "collision" / "chung-ooi-1.toml", "--engines", "lammps", "--out", self.out, "--quiet"
        )
        self.assert_status(done, BAD_INPUT)
        self.assertIn("has normal = linear, not hertz", done.stderr)


if __name__ == "__main__":
    unittest.main()
