"""LAMMPS does what the scene says: run by ctest where `lmp` is installed."""

import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "engines" / "lammps"))
import lammps_input  # noqa: E402

# Lätzel 2003, table 4.1: two small disks.
RADIUS, MASS = 3.7e-3, 0.275e-3
LAW = {"kn": 352.1, "gn": 0.19, "kt": 267.1, "gt": 0.15, "mu": 0.44}
DT = 2e-6


def disk(x, v, spin=0.0):
    return {"radius": RADIUS, "mass": MASS, "position": [x, 0.0], "velocity": [v, 0.0], "spin": spin}


@unittest.skipUnless(shutil.which("lmp"), "lmp is not installed (Debian: package lammps)")
class Lammps(unittest.TestCase):
    def state(self, disks, walls=(), steps=2000):
        """The rows of all disks after some steps."""
        scene = {"disks": disks, "walls": list(walls), "dt": DT, "law": LAW}
        with tempfile.TemporaryDirectory() as folder:
            lammps_input.write(scene, folder)
            done = subprocess.run(
                ["lmp", "-in", "in.scene", "-log", "none", "-var", "check", str(steps), "-var", "steps", "0"],
                cwd=folder, capture_output=True, text=True, timeout=60,
            )  # fmt: skip
            self.assertEqual(0, done.returncode, done.stdout[-1500:] + done.stderr)
            return lammps_input.read_dump(pathlib.Path(folder) / "check.dump")

    def collision(self, v, spin):
        """Two disks that approach with v/2 each, touching after a step, and part again."""
        start = RADIUS + 0.25 * v * DT
        return self.state([disk(start, -0.5 * v, spin), disk(-start, 0.5 * v, spin)])

    def test_restitution_is_that_of_the_law_with_tension(self):
        # e_n = exp(−η π/ω), η = γ_n/(2 m₁₂), ω² = k_n/m₁₂ − η² (Lätzel 2003, section 4.1): 0.2223;
        # 0.3408 if tension were cut. The velocity in LAMMPS's dashpot is half a step old: η dt/2 = 0.07 %.
        reduced = 0.5 * MASS
        eta = LAW["gn"] / (2.0 * reduced)
        expected = math.exp(-eta * math.pi / math.sqrt(LAW["kn"] / reduced - eta**2))
        right, left = self.collision(0.1, 0.0)
        self.assertAlmostEqual(expected, (right["vx"] - left["vx"]) / 0.1, delta=0.01 * expected)

    def test_disks_are_disks(self):
        # m a Δv_t = J Δω with J = m a²/2; a sphere's 2/5 would give 2.5. The arm is shorter than a by
        # at most the overlap, δ/a < v √(m₁₂/k_n)/a = 0.2 %, and while they touch the normal turns by
        # at most v_t t_c/a < 1 %.
        right, left = self.collision(0.01, 1.0)
        self.assertGreater(abs(right["vy"]), 1e-4)
        self.assertAlmostEqual(right["vy"], -left["vy"], delta=1e-9)
        spun = RADIUS * (right["omegaz"] - 1.0)
        self.assertAlmostEqual(2.0, abs(spun / right["vy"]), delta=0.02)

    def test_wheel_turns_and_touches_no_other_wall(self):
        omega, steps = 3.0, 2000
        wheel = {"radius": 1.25e-3, "omega": omega, "position": [[0.05, 0.0], [0.0, 0.05]]}
        ring = {"radius": 1.25e-3, "omega": 0.0, "position": [[0.051, 0.0]]}  # would be pushed off
        far, first, second, still = self.state([disk(-0.1, 0.0)], [wheel, ring], steps)
        angle = omega * steps * DT
        self.assertAlmostEqual(0.05 * math.cos(angle), first["x"], delta=1e-12)
        self.assertAlmostEqual(0.05 * math.sin(angle), first["y"], delta=1e-12)
        self.assertAlmostEqual(0.05 * math.cos(angle), second["y"], delta=1e-12)
        self.assertAlmostEqual(omega, second["omegaz"], delta=1e-12)
        self.assertEqual((0.051, 0.0), (still["x"], still["y"]))
        self.assertEqual((-0.1, 0.0), (far["x"], far["y"]))


if __name__ == "__main__":
    unittest.main()
