"""Chipmunk and Siconos, rigid disks as theory has them, where their packages are installed."""

import csv
import importlib.util
import json
import pathlib
import shutil
import subprocess
import unittest

from harness import BAD_INPUT, CASES, FELL_SHORT, HARD_SPHERE, HELD, PROGRAM, SystemTest

ENGINES = CASES.parent / "engines"
MU, EN = 0.44, 0.9  # of cases/collision/hard-sphere.toml

# Four kinds of disks, and one that is light enough for the law to be overdamped, γ_n² (1/m₁ + 1/m₂) ≥ 4 k_n = 1408 N/m:
# 4592 with the next lighter one, and 180 of that with its like.
LIGHT = """
[case]
name = "light"
kind = "assembly"
extends = "{laws}/hard.toml"
[law]
gn = 0.3
[assembly]
duration = 0.1
""" + "".join(
    f"""
[[assembly.disks]]
position = [{0.01 * k}, 0.0]
radius = 0.0037
mass = {mass}
"""
    for k, mass in enumerate([1e-3, 1.1e-3, 1.2e-3, 1.3e-3, 2e-5])
)


CHIPMUNK = pathlib.Path(PROGRAM).with_name("crossgrain-chipmunk")


def is_installed(package):
    """Whether dpkg has it; without dpkg nobody knows."""
    if not shutil.which("dpkg-query"):
        return False
    command = ["dpkg-query", "--show", "--showformat=${Status}", package]
    return subprocess.run(command, capture_output=True, check=False).stdout == b"install ok installed"


class Absent(SystemTest):
    def test_chipmunk_is_refused_with_its_package(self):
        alone = self.folder / "crossgrain"  # without the worker beside it, or an installed one in PATH
        shutil.copy(PROGRAM, alone)
        done = self.run_program(
            "check", HARD_SPHERE, "--engines", "chipmunk", executable=str(alone),
            env={"CROSSGRAIN_DATA": str(CASES.parent), "PATH": str(self.folder)},
        )  # fmt: skip
        self.assert_one_line(done, BAD_INPUT, "chipmunk is not available", "libchipmunk-dev")

    def test_siconos_is_refused_with_its_package(self):
        data = self.folder / "data"
        shutil.copytree(ENGINES / "siconos", data / "engines/siconos")
        (data / "cases").symlink_to(CASES)
        file = data / "engines/siconos/siconos.toml"
        file.write_text(file.read_text(encoding="utf-8").replace("/usr/lib/", "/usr/no/"), encoding="utf-8")
        done = self.run_program("check", HARD_SPHERE, "--engines", "siconos", env={"CROSSGRAIN_DATA": str(data)})
        self.assert_one_line(done, BAD_INPUT, "siconos is not available", "python3-siconos")


class RigidEngine:
    skipped = {
        "BottomPlateBrakesADisk", "SlidingFlagsMarkTheBound", "FollowsItsMirror", "e_t0-0.5",
        "CheckpointsGoOnToTheBit", "ConventionsAreThoseDeclared", "EnergyLedgerIsClosed", "SpringsHoldWhileAnotherFalls",
    }  # fmt: skip

    def test_it_passes_its_checks(self):
        done = self.run_program("conformance", self.engine, "--quiet", "--json")
        self.assert_status(done, HELD)
        checks = json.loads(done.stdout)["checks"]
        skipped = {check["check"] for check in checks if check["outcome"] == "skipped"}
        self.assertEqual(self.skipped, skipped)
        self.assertLess(44, sum(check["outcome"] == "passed" for check in checks))

    def test_friction_is_bounded_by_the_whole_impulse(self):
        """Ψ_i − Ψ_f = 3 (1 + e_n) µ of an impact that slides, by theory; the normal turns by up to 5e-4 in a step."""
        done = self.run_program(
            "collide", HARD_SPHERE, "--engines", self.engine, "-k", "*e_t0-0", "--out", self.out, "--quiet"
        )
        self.assert_status(done, HELD)
        with open(self.out / "collisions.csv", encoding="utf-8", newline="") as file:
            last = list(csv.DictReader(file))[-1]
        self.assertEqual("4", last["psi_i"])
        self.assertAlmostEqual(EN, float(last["e_n"]), delta=1e-3)
        self.assertAlmostEqual(3 * (1 + EN) * MU, 4.0 - float(last["psi_f"]), delta=1e-3)

    def test_disks_that_fall_on_planes(self):
        """It keeps no ledger, but every snapshot is audited: an impact worked out from the velocities before the last one
        was a force across a gap."""
        self.run_program(
            "stability", CASES / "hard", "--quick", "-k", "ledger*", "--engines", self.engine, "--out", self.out,
            "--quiet", f"--set=engines.{self.engine}.dt=5e-4",
        )  # fmt: skip
        (run,) = self.results()["runs"]
        self.assertEqual(("refused", "does not show what the measure takes"), (run["verdict"], run["reason"]))


@unittest.skipUnless(CHIPMUNK.exists() or is_installed("libchipmunk-dev"), "libchipmunk-dev is not installed")
class Chipmunk(RigidEngine, SystemTest):
    engine = "chipmunk"

    def test_it_was_built(self):
        self.assertTrue(CHIPMUNK.exists(), "libchipmunk-dev is installed, and the build did not find it")

    def test_an_overdamped_pair_is_refused_before_the_first_step(self):
        """Not by an exception through Chipmunk's C, when two such disks meet. The table of pairs ends before the fifth."""
        case = self.write("light.toml", LIGHT.replace("{laws}", str(CASES / "laws")))
        done = self.run_program("check", case, "--engines", "chipmunk", "--set=run.may_differ=['normal']")
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, "chipmunk +cannot: .*overdamped")


@unittest.skipUnless(importlib.util.find_spec("siconos"), "python3-siconos is not installed")
class Siconos(RigidEngine, SystemTest):
    engine = "siconos"
    skipped = RigidEngine.skipped | {"TurningPlanePushes"}


if __name__ == "__main__":
    unittest.main()
