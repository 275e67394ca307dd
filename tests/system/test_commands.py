"""Commands that run nothing: engines, check, report, and the help of all."""

import json
import os
import re
import shutil
import subprocess
import unittest

from harness import (
    BAD_INPUT,
    CASES,
    COLLISION,
    COUETTE,
    FELL_SHORT,
    HELD,
    SystemTest,
    settings,
)

EFFECTS = {
    "normal_damping",
    "friction",
    "tangential_spring",
    "tangential_damping",
    "rotation",
    "bottom_friction",
    "bottom_spin_friction",
    "gravity",
    "moving_walls",
}


class Starts(SystemTest):
    """An engine is not started where nobody asks for it: YADE alone takes seconds."""

    def started(self, *arguments):
        """Whether a program called yade was."""
        programs, mark = self.folder / "bin", self.folder / "started"
        programs.mkdir(exist_ok=True)
        mark.unlink(missing_ok=True)
        fake = programs / "yade"
        fake.write_text(f"#!/bin/sh\ntouch {mark}\n", encoding="utf-8")
        fake.chmod(0o755)
        self.run_program(*arguments, env={"PATH": f"{programs}:{os.environ['PATH']}"})
        return mark.exists()

    def test_nobody_starts_what_is_not_asked_for(self):
        quick = settings(preparation__packings=1, averaging__rotations=0.01, averaging__settle_rotations=0.001)
        self.assertTrue(self.started("check", COUETTE, "--engines", "yade"))
        for engines in ("grain", "grain,box2d-penalty"):
            for command in (("check", COUETTE), ("compare", COUETTE, *quick, "--fresh", "--out", self.out)):
                with self.subTest(engines=engines, command=command[0]):
                    self.assertFalse(self.started(*command, "--engines", engines))


class Engines(SystemTest):
    def test_json(self):
        done = self.run_program("engines", "--json")
        self.assert_status(done, HELD)
        engines = {engine["name"]: engine for engine in json.loads(done.stdout)}
        self.assertLessEqual({"grain", "yade", "box2d-impulse", "box2d-penalty"}, set(engines))
        self.assertEqual("yade", engines["grain-as-yade"]["mirrors"])
        for name, engine in engines.items():
            with self.subTest(name):
                self.assertEqual(1, ("capabilities" in engine) + ("missing" in engine))
                if "missing" in engine:
                    continue
                can = engine["capabilities"]
                self.assertEqual(EFFECTS, set(can["effects"]))
                self.assertLessEqual(set(can["effects"].values()), {"optional", "always", "never"})
                for setting in can["settings"]:
                    self.assertLessEqual({"name", "unit", "default", "doc"}, set(setting))

        def effects(name):
            return engines[name]["capabilities"]["effects"]

        self.assertEqual({"optional"}, set(effects("grain").values()))
        self.assertEqual("never", effects("box2d-impulse")["bottom_friction"])

    @unittest.skipUnless(shutil.which("dpkg-query"), "only a package says what is installed")
    def test_version_of_box2d_is_the_package_s(self):
        """2.4.1 calls itself 2.4.0."""
        package = subprocess.run(
            ["dpkg-query", "-W", "-f", "${Version}", "libbox2d-dev"],
            capture_output=True, encoding="utf-8", check=True,
        ).stdout.partition("-")[0]  # fmt: skip
        readme = (CASES.parent / "docs" / "engines.md").read_text(encoding="utf-8")
        for engine in json.loads(self.run_program("engines", "--json").stdout):
            if engine["name"] not in ("box2d-impulse", "box2d-penalty"):
                continue
            version, _, says = engine["capabilities"]["version"].partition(", b2_version ")
            self.assertEqual(package, version)
            self.assertIn(f"`{engine['name']}` | Box2D {version} from Debian", readme)
            if says:
                self.assertIn(f"`b2_version` says {says}", readme)

    def test_text(self):
        done = self.run_program("engines")
        self.assert_status(done, HELD)
        for engine in ("grain", "yade", "box2d-impulse", "box2d-penalty"):
            self.assertRegex(done.stdout, rf"(?m)^{engine} ")
        for effect in EFFECTS:
            self.assertRegex(done.stdout, rf"(?m)^  {effect} +(yes|always|no)$")


class Check(SystemTest):
    def check(self, case, *arguments, engines="grain,box2d-impulse,box2d-penalty"):
        return self.run_program("check", case, "--engines", engines, *arguments)

    def test_couette(self):
        done = self.check(COUETTE)
        self.assert_status(done, HELD)
        # 246 disks; rings of 2π·30/4.8 = 39 and 2π·75/4.8 = 98 wall disks, to the nearest.
        self.assertIn("quick: 246 disks, 137 wall disks, dt 4e-05 s", done.stdout)
        # 1.25 rotations of 2π s in steps of 4e-5 s.
        self.assertRegex(done.stdout, r"per packing: 196350 steps[\s\S]*grain +can run it")
        self.assertRegex(done.stdout, r"differs: has \w+")
        self.assertRegex(done.stdout, r"(?m)^  effects called for: .*rotation.*; left out: gravity$")

    def test_a_case_that_blocks_rotation(self):
        done = self.check(COUETTE, *settings(particles__rotation="false"), engines="grain")
        self.assertRegex(
            done.stdout, r"(?m)^  effects called for: .*friction.*; left out: rotation, .*gravity$"
        )

    def test_collision_with_variants(self):
        done = self.check(COLLISION)
        self.assert_status(done, HELD)
        for law in ("coulomb", "viscous", "spring", "spring_dashpot"):
            for tension in ("tension", "cut"):
                self.assertRegex(done.stdout, rf"(?m)^{law}-{tension}: ")

    def test_refusal(self):
        done = self.check(COUETTE, *settings(run__may_differ=["rounding"]))
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"(?m)^ *grain +can run it")
        self.assertRegex(done.stdout, r"(?m)^ *box2d-impulse +cannot: .*may_differ")

    def test_prints_what_to_expect(self):
        done = self.check(COUETTE)
        self.assertRegex(done.stdout, r"volume fraction 0\.7\d+, .*39 on the wheel, 98 on the ring")
        self.assertRegex(done.stdout, r"54\.4 steps in the shortest contact; .*at most 0\.000572 s")
        self.assertRegex(done.stdout, r"expected: \d+ to \d+ contacts")
        self.assertRegex(done.stdout, r"margin of field azimuthal_velocity: 0\.0015 m/s, a share of rim_speed")
        self.assertRegex(done.stdout, r"margin of endpoint mean_spin: 0\.04 rad/s, a share of wheel_rate")
        # Of every engine that can run it, mirrors that would run along included.
        able = re.findall(r"(?m)^  \S+ +can run it", done.stdout)
        self.assertGreaterEqual(len(able), 4)
        self.assertEqual(len(able), len(re.findall(r"µs a step: .* a packing, \d+ MB", done.stdout)))
        self.assertRegex(done.stdout, r"predicted for compare: .* steps were timed on")
        self.assertNotIn("predicted for", self.check(COUETTE, "--no-timing").stdout)

    def test_json(self):
        done = self.check(COUETTE, "--json", "--no-timing")
        (checked,) = json.loads(done.stdout)
        self.assertEqual((246, 39, 98), (
            checked["disks"], checked["cell"]["wheel_disks"], checked["cell"]["ring_disks"]
        ))  # fmt: skip
        self.assertNotIn("prediction", checked)

    def test_resolved_loads_to_itself(self):
        first = self.check(COUETTE, "--resolved", "--set=cell.omega=0.5")
        self.assert_status(first, HELD)
        again = self.check(self.write("again.toml", first.stdout), "--resolved")
        self.assertEqual(first.stdout, again.stdout)
        self.assertIn("omega = 0.5", again.stdout)

    def test_cautions(self):
        thin = self.check(COUETTE, "--no-timing", "--set=particles.small=100", engines="grain")
        self.assertRegex(thin.stdout, r"caution: dilute: .*expect a gas")
        thick = self.check(COUETTE, "--no-timing", "--set=particles.small=230", engines="grain")
        self.assertRegex(thick.stdout, r"caution: over-dense: ")
        few = self.check(
            COUETTE, "--no-timing", "--set=preparation.packings=2", "--set=run.dt=2e-4",
            engines="grain",
        )  # fmt: skip
        self.assertRegex(few.stdout, r"caution: only 10\.9 steps in the shortest contact")
        self.assertRegex(few.stdout, r"caution: 2 packings: compare judges nothing")

    def test_runs_nothing(self):
        self.assert_status(self.check(COUETTE), HELD)
        self.assertEqual([], list(self.folder.iterdir()))

    def test_unknown_engine(self):
        done = self.check(COUETTE, engines="grian")
        self.assert_status(done, BAD_INPUT)
        self.assert_one_error(done, BAD_INPUT, "'grian'", "did you mean grain?")


class Report(SystemTest):
    def rebuild_gives(self, *tables):
        """`report` makes the same files again from results.json alone."""
        names = ["results.json", *tables]
        before = {name: (self.out / name).read_bytes() for name in names}
        for name in [*tables, "report.html"]:
            (self.out / name).unlink()
        done = self.run_program("report", self.out)
        self.assert_status(done, HELD)
        self.assertIn(str(self.out / "report.html"), done.stdout)
        self.assertEqual(before, {name: (self.out / name).read_bytes() for name in names})
        self.assertGreater((self.out / "report.html").stat().st_size, 1000)

    def test_of_compare(self):
        done = self.compare(
            "--quiet", *settings(averaging__rotations=0.02), engines="grain,box2d-penalty"
        )
        self.assert_status(done, HELD, FELL_SHORT)
        self.rebuild_gives("profiles.csv", "series.csv", "agreement.csv")

    def test_of_collide(self):
        done = self.run_program(
            "collide", COLLISION, "--engines", "grain", "--out", self.out, "--quiet",
            *settings(collision__steps_per_contact=50, collision__psi=[0.5, 2.0]),
        )  # fmt: skip
        self.assert_status(done, HELD, FELL_SHORT)
        self.rebuild_gives("collisions.csv")

    def test_folder_without_results(self):
        self.assert_one_line(
            self.run_program("report", self.folder), BAD_INPUT, str(self.folder), "results.json"
        )

    def test_missing_folder(self):
        self.assert_one_line(self.run_program("report", self.folder / "gone"), BAD_INPUT, "gone")

    def test_results_that_are_none(self):
        for name, text, told in (
            ("not JSON", "{", "JSON"),
            ("another schema", '{"schema": "other-1", "kind": "compare"}', '"other-1"'),
            ("no object", "[1, 2]", "schema"),
            ("another kind", '{"schema": "crossgrain-results-1", "kind": "guess"}', '"guess"'),
        ):
            with self.subTest(name):
                self.write("results.json", text)
                done = self.run_program("report", self.folder)
                self.assert_one_line(done, BAD_INPUT, "results.json", told)

    def test_all_folders_are_looked_at_before_any_is_rebuilt(self):
        self.write("results.json", '{"schema": "crossgrain-results-1", "kind": "collide"}')
        done = self.run_program("report", self.folder, self.folder / "gone")
        self.assert_one_line(done, BAD_INPUT, "gone")


if __name__ == "__main__":
    unittest.main()
