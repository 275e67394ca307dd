"""Chipmunk, a worker that is built beside the program where libchipmunk-dev is installed."""

import csv
import json
import pathlib
import shutil
import unittest

from harness import BAD_INPUT, CASES, HARD_SPHERE, HELD, PROGRAM, SystemTest

MU, EN = 0.44, 0.9  # of cases/collision/hard-sphere.toml


class Absent(SystemTest):
    def test_it_is_refused_with_its_package(self):
        alone = self.folder / "crossgrain"  # without the worker beside it
        shutil.copy(PROGRAM, alone)
        done = self.run_program(
            "check", HARD_SPHERE, "--engines", "chipmunk", executable=str(alone), env={"CROSSGRAIN_DATA": str(CASES.parent)}
        )
        self.assert_one_line(done, BAD_INPUT, "chipmunk is not available", "libchipmunk-dev")


@unittest.skipUnless(pathlib.Path(PROGRAM).with_name("crossgrain-chipmunk").exists(), "libchipmunk-dev is not installed")
class Chipmunk(SystemTest):
    def test_it_passes_its_checks(self):
        done = self.run_program("conformance", "chipmunk", "--quiet", "--json")
        self.assert_status(done, HELD)
        checks = json.loads(done.stdout)["checks"]
        skipped = {check["check"] for check in checks if check["outcome"] == "skipped"}
        self.assertEqual({"BottomPlateBrakesADisk", "SlidingFlagsMarkTheBound", "FollowsItsMirror", "e_t0-0.5"}, skipped)
        self.assertLess(45, sum(check["outcome"] == "passed" for check in checks))

    def test_friction_is_bounded_by_the_whole_impulse(self):
        """Ψ_i − Ψ_f = 3 (1 + e_n) µ of an impact that slides, by theory; disks turn by up to 3e-4 in the overlap of a
        step."""
        done = self.run_program(
            "collide", HARD_SPHERE, "--engines", "chipmunk", "-k", "*e_t0-0", "--out", self.out, "--quiet"
        )
        self.assert_status(done, HELD)
        with open(self.out / "collisions.csv", encoding="utf-8", newline="") as file:
            last = list(csv.DictReader(file))[-1]
        self.assertEqual("4", last["psi_i"])
        self.assertAlmostEqual(EN, float(last["e_n"]), delta=1e-3)
        self.assertAlmostEqual(3 * (1 + EN) * MU, 4.0 - float(last["psi_f"]), delta=1e-3)

    def test_a_hard_case(self):
        done = self.run_program(
            "stability", CASES / "hard", "-k", "billiard-break*", "--engines", "chipmunk", "--out", self.out, "--quiet"
        )
        self.assert_status(done, HELD)


if __name__ == "__main__":
    unittest.main()
