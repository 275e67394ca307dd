"""An engine that is a program of its own, in another language: YADE, where it is installed."""

import os
import shutil
import signal
import unittest

from harness import (
    COLLISION,
    COUETTE,
    ENGINE_FAILED,
    FELL_SHORT,
    HELD,
    INTERRUPTED,
    PATIENCE,
    SystemTest,
    settings,
    wait_for,
)


@unittest.skipUnless(shutil.which("yade"), "yade is not installed (Debian: package yade)")
class Yade(SystemTest):
    def test_compare(self):
        short = settings(
            run__mirrors="true",
            preparation__packings=1,
            averaging__settle_rotations=0.0,
            averaging__rotations=0.01,
            averaging__snapshots_per_rotation=400,
        )
        done = self.compare(*short, engines="grain,yade")
        self.assert_status(done, HELD)
        results = self.results()
        self.assertEqual(
            {("grain", "finished"), ("yade", "finished"), ("grain-as-yade", "finished")},
            {(run["engine"], run["status"]) for run in results["runs"]},
        )
        self.assertEqual(
            {"peer", "mirror_model", "mirror_implementation"},
            {row["kind"] for row in results["agreement"]},
        )
        runs = {run["engine"]: run for run in results["runs"]}
        # The case allows these; they are noted with the figures of the engine that makes use of it.
        noted = {deviation["name"] for deviation in runs["yade"]["realised"]["deviations"]}
        self.assertLessEqual({"tension", "bottom_friction"}, noted)
        # The first steps of one packing: the mirror does what YADE does.
        first = {name: run["series"]["kinetic_energy"][0] for name, run in runs.items()}
        self.assertAlmostEqual(1.0, first["yade"] / first["grain-as-yade"], delta=0.02)

    def test_it_prepares_packings(self):
        """preparation.engine: other packings than the in-house engine's, kept under the engine's name and version."""
        cache = self.folder / "packings"
        short = settings(
            preparation__packings=1, preparation__shrink_time=0.2, preparation__rotations=0.01,
            averaging__settle_rotations=0.0, averaging__rotations=0.01,
        )  # fmt: skip
        kept = {}
        for engine in ("grain", "yade"):
            done = self.compare(
                "--fresh", "--quiet", *short, f"--set=preparation.engine={engine}",
                env={"CROSSGRAIN_CACHE": str(cache)},
            )  # fmt: skip
            self.assert_status(done, HELD)
            kept[engine] = self.results()["packings"][0]["hash"]
        self.assertEqual(2, len(list(cache.iterdir())))
        self.assertNotEqual(kept["grain"], kept["yade"])
        again = self.compare(
            "--fresh", *short, "--set=preparation.engine=yade", env={"CROSSGRAIN_CACHE": str(cache)}
        )
        self.assertIn("packing 0: from the cache", again.stderr)

    def test_without_a_home(self):
        """It looks for its settings there and would not start."""
        for home in (None, "/nonexistent"):
            with self.subTest(home=home):
                done = self.run_program("check", COUETTE, "--engines", "yade", env={"HOME": home})
                self.assert_status(done, HELD)
                self.assertRegex(done.stdout, r"(?m)^ *yade +can run it")

    def test_that_dies_with_a_traceback(self):
        """A yade that ends like a script with a mistake: the last line says which."""
        fake = self.write("yade", "#!/usr/bin/env python3\nprint('Welcome')\nimport no_such_module\n")
        fake.chmod(0o755)
        env = {"PATH": f"{self.folder}:{os.environ['PATH']}"}
        done = self.run_program("check", COUETTE, "--engines", "yade", env=env)
        self.assert_one_line(
            done, ENGINE_FAILED, "yade: ended (exit status 1) during hello",
            "its error: ModuleNotFoundError: No module named 'no_such_module'",
        )  # fmt: skip

    def test_collide(self):
        done = self.run_program(
            "collide", COLLISION, "--engines", "yade", "--out", self.out, "--quiet",
            *settings(
                law__tangential="spring_dashpot",
                collision__psi=[0.5, 2.0],
                collision__steps_per_contact=1000,
            ),
            "-k", "*-cut",
        )  # fmt: skip
        self.assert_status(done, HELD)  # its dashpot is outside the Coulomb test: a model difference
        self.assertEqual("", done.stderr)
        for variant in self.results()["variants"]:
            if not variant["variant"].endswith("-cut"):  # YADE always cuts tension
                continue
            by_engine = {curve["engine"]: curve for curve in variant["curves"]}
            # In double precision, step by step, it is the leapfrog of its law to rounding.
            own = by_engine["yade"]["own_scheme"]
            self.assertTrue(own["held"], own)
            # No limit of small steps: the in-house engine with its conventions is the reference.
            declared = by_engine["yade"]["declared"]
            self.assertEqual(("mirror", "held"), (declared["reference"], declared["score"]["verdict"]))
            curves = {name: curve["points"] for name, curve in by_engine.items()}
            self.assertEqual([0.5, 2.0], curves["yade"]["psi_i"])
            for en in curves["yade"]["e_n"]:
                self.assertAlmostEqual(0.3408, en, delta=0.002)
            # The mirror, looked at step by step, has the same end and the same work of its forces.
            for column in ("psi_f", "max_overlap", "lost_normal_damping", "lost_tangential"):
                both = curves["yade"][column], curves["grain-as-yade"][column]
                for found, mirrored in zip(*both, strict=True):
                    self.assertAlmostEqual(mirrored, found, delta=1e-6 * abs(mirrored) + 1e-12)

    def at_work(self):
        running = self.start_compare(*settings(averaging__rotations=0.5), engines="yade")
        wait_for(lambda: "running engines" in running.stderr(), PATIENCE, "the runs to begin")
        wait_for(lambda: len(running.processes()) >= 2, PATIENCE, "YADE to start")
        return running

    def test_interrupt(self):
        running = self.at_work()
        os.kill(running.process.pid, signal.SIGINT)
        done = self.check_no_crash(running.end(30))
        self.assert_one_error(done, INTERRUPTED, "interrupted")
        wait_for(lambda: not running.processes(), PATIENCE, "YADE to end")

    def test_crossgrain_killed(self):
        running = self.at_work()
        running.process.kill()
        running.process.wait()
        wait_for(lambda: not running.processes(), PATIENCE, "YADE to end")


if __name__ == "__main__":
    unittest.main()
