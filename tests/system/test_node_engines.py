"""Engines of engines/ that are an engine file: known by name, refused where Node or its packages are missing."""

import csv
import json
import shutil
import subprocess
import unittest

from harness import BAD_INPUT, CASES, FELL_SHORT, HELD, HARD_SPHERE, PROGRAM, SystemTest

ENGINES = CASES.parent / "engines"
MU, EN = 0.44, 0.9  # of cases/collision/hard-sphere.toml


def installed():
    there = subprocess.run([PROGRAM, "check", HARD_SPHERE, "--engines", "rapier"], capture_output=True, check=False)
    return b"not available" not in there.stdout + there.stderr


class Shelf(SystemTest):
    def test_without_its_packages_it_is_refused_with_what_to_do(self):
        data = self.folder / "data"
        (data / "engines").mkdir(parents=True)
        (data / "cases").symlink_to(CASES)
        for name in ("rapier", "node"):
            shutil.copytree(ENGINES / name, data / "engines" / name, ignore=shutil.ignore_patterns("node_modules"))
        done = self.run_program("check", HARD_SPHERE, "--engines", "rapier", env={"CROSSGRAIN_DATA": str(data)})
        self.assert_one_line(done, BAD_INPUT, "rapier is not available", "npm ci")

    def test_a_file_on_the_shelf_that_is_wrong_is_named(self):
        broken = self.folder / "engines/mine/mine.toml"
        broken.parent.mkdir(parents=True)
        broken.write_text('name = "mine"\n', encoding="utf-8")
        done = self.run_program("engines", env={"CROSSGRAIN_DATA": str(self.folder)})
        self.assert_one_line(done, BAD_INPUT, "mine.toml", "command")


@unittest.skipUnless(installed(), "node, or what engines/node needs, is not installed")
class NodeEngines(SystemTest):
    def collide(self, engines, *arguments):
        done = self.run_program(
            "collide", HARD_SPHERE, "--engines", engines, "-k", "*e_t0-0", "--out", self.out, "--quiet", *arguments
        )
        with open(self.out / "collisions.csv", encoding="utf-8", newline="") as file:
            return done, list(csv.DictReader(file))

    def test_contacts_are_told(self):
        """Of every version: what reads them is called by the engine, which is silent about what goes wrong there."""
        for engine in ("rapier", "rapier-before", "box2d-v3"):
            with self.subTest(engine):
                self.assert_status(self.run_program("conformance", engine, "-k", "ContactsSayWhereTheyAre", "--quiet"), HELD)

    def test_what_a_sliding_impact_takes(self):
        """Ψ_i − Ψ_f = 3 (1 + e_n) µ by theory. The two of today bound friction by the impulse before its restitution, so
        3 µ; the older Rapier by all of it, yet it gives back less than it is told."""
        done, rows = self.collide("rapier,box2d-v3,rapier-before")
        self.assert_status(done, FELL_SHORT)
        last = {row["engine"]: row for row in rows if float(row["psi_i"]) == 4.0}
        taken = {name: 4.0 - float(row["psi_f"]) for name, row in last.items()}
        self.assertAlmostEqual(3 * MU, taken["rapier"], delta=1e-3)
        self.assertAlmostEqual(3 * MU, taken["box2d-v3"], delta=0.02 * 3 * MU)
        for name in ("rapier", "box2d-v3"):
            self.assertAlmostEqual(EN, float(last[name]["e_n"]), delta=1e-3)
        before = float(last["rapier-before"]["e_n"])
        self.assertLess(before, 0.75)
        self.assertAlmostEqual(3 * (1 + before) * MU, taken["rapier-before"], delta=1e-3)

    def test_tangential_restitution_is_refused_unless_it_may_differ(self):
        variant = ("check", HARD_SPHERE, "--engines", "rapier", "--set=law.e_t0=0.5")
        self.assertIn("has no tangential restitution", self.run_program(*variant).stdout)
        allowed = self.run_program(*variant, '--set=run.may_differ=["integrator", "rounding", "tangential_restitution"]')
        self.assert_status(allowed, HELD)
        self.assertIn("can run it", allowed.stdout)

    def test_diff_tells_one_version_from_another(self):
        kept = self.folder / "before.h5"
        baseline = self.run_program(
            "baseline", HARD_SPHERE, "--engines", "rapier-before", "--out", kept, "--quiet", "--set=collision.psi=[0.5, 4.0]"
        )
        self.assert_status(baseline, HELD)
        done = self.run_program("diff", kept, "--engines", "rapier", "--quiet", "--json")
        self.assert_status(done, FELL_SHORT)
        self.assertIn("psi_f", json.dumps(json.loads(done.stdout)))

    def test_the_cell_runs_and_its_contacts_are_what_acts(self):
        """Means over the time between two looks: what the ring's disks bear is what its contacts add up to."""
        for engine in ("rapier", "box2d-v3"):
            done = self.run_program("conformance", engine, "--quiet", "--json")
            rows = {row["check"]: row["outcome"] for row in json.loads(done.stdout)["checks"]}
            for check in (
                "ContactForcesAreThoseThatAct", "WallLoadsAreThoseOfTheirContacts", "PlaneLoadsAreThoseOfTheirContacts",
                "HeadOnCollision", "RotatingWallPushes", "ForcesPointWhereTheySay", "WorkersAgreeBitForBit",
            ):  # fmt: skip
                self.assertEqual("passed", rows[check], f"{engine}: {check}")


if __name__ == "__main__":
    unittest.main()
