"""Siconos, where its package is installed (./setup --engines all)."""

import csv
import importlib.util
import json
import shutil
import unittest

from harness import BAD_INPUT, CASES, HARD_SPHERE, HELD, SystemTest

ENGINES = CASES.parent / "engines"
MU, EN = 0.44, 0.9  # of cases/collision/hard-sphere.toml


class Absent(SystemTest):
    def test_it_is_refused_with_its_package(self):
        data = self.folder / "data"
        shutil.copytree(ENGINES / "siconos", data / "engines/siconos")
        (data / "cases").symlink_to(CASES)
        file = data / "engines/siconos/siconos.toml"
        file.write_text(file.read_text(encoding="utf-8").replace("/usr/lib/", "/usr/no/"), encoding="utf-8")
        done = self.run_program("check", HARD_SPHERE, "--engines", "siconos", env={"CROSSGRAIN_DATA": str(data)})
        self.assert_one_line(done, BAD_INPUT, "siconos is not available", "python3-siconos")


@unittest.skipUnless(importlib.util.find_spec("siconos"), "python3-siconos is not installed")
class Siconos(SystemTest):
    def test_it_passes_its_checks(self):
        done = self.run_program("conformance", "siconos", "--quiet", "--json")
        self.assert_status(done, HELD)
        checks = json.loads(done.stdout)["checks"]
        skipped = {check["check"] for check in checks if check["outcome"] == "skipped"}
        self.assertEqual(
            {"BottomPlateBrakesADisk", "TurningPlanePushes", "SlidingFlagsMarkTheBound", "FollowsItsMirror", "e_t0-0.5"},
            skipped,
        )
        self.assertLess(44, sum(check["outcome"] == "passed" for check in checks))

    def test_an_impact_that_slides(self):
        """Ψ_i − Ψ_f = 3 (1 + e_n) µ by theory."""
        done = self.run_program(
            "collide", HARD_SPHERE, "--engines", "siconos", "-k", "*e_t0-0", "--out", self.out, "--quiet"
        )
        self.assert_status(done, HELD)
        with open(self.out / "collisions.csv", encoding="utf-8", newline="") as file:
            last = list(csv.DictReader(file))[-1]
        self.assertEqual("4", last["psi_i"])
        self.assertAlmostEqual(EN, float(last["e_n"]), delta=1e-3)
        self.assertAlmostEqual(3 * (1 + EN) * MU, 4.0 - float(last["psi_f"]), delta=1e-3)


if __name__ == "__main__":
    unittest.main()
