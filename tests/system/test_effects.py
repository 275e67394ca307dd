"""crossgrain effects: what a case costs and says with each of its effects switched off."""

import csv
import os
import signal
import unittest

from harness import (
    BAD_INPUT,
    COLLISION,
    COUETTE,
    HELD,
    INTERRUPTED,
    SystemTest,
    settings,
)

# Binding: columns that other programs read, in this order; further ones come after.
COLUMNS = "engine,effect,time_ratio,field,ring,change,stderr".split(",")

SHORT = settings(averaging__rotations=0.02)
# The case with one effect only that can be switched, so that there is little to wait for.
ONE_EFFECT = settings(
    law__tangential="none", law__mu=0, law__kt=0, law__gt=0, law__tension="cut",
    bottom__mu=0, run__precision="float",
)  # fmt: skip


class EffectsTest(SystemTest):
    def arguments(self, *arguments, case=COUETTE, engines="grain"):
        return ["effects", case, "--engines", engines, "--out", self.out, "--quick", *arguments]

    def effects(self, *arguments, **options):
        return self.run_program(*self.arguments(*arguments, **options))

    def rows(self):
        with open(self.out / "effects.csv", encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def legs(self):
        return {(leg["engine"], leg["effect"]): leg for leg in self.results()["legs"]}


class Results(EffectsTest):
    def test_every_effect_of_the_case(self):
        done = self.effects("--quiet", *SHORT)
        self.assert_status(done, HELD)
        self.assertEqual("", done.stderr)
        effects = [
            "normal_damping", "friction", "tangential_spring", "tangential_damping", "rotation",
            "bottom_friction", "bottom_spin_friction", "tension_cut", "double_precision",
        ]  # fmt: skip
        rows = self.rows()
        self.assertEqual(COLUMNS, list(rows[0])[: len(COLUMNS)])
        self.assertEqual(effects, list(dict.fromkeys(row["effect"] for row in rows)))
        self.assertIn("left out: gravity", done.stdout)
        for effect in effects:
            with self.subTest(effect):
                self.assertRegex(done.stdout, rf"(?m)^grain +without {effect} +\d\.\d+ of the time")
                leg = self.legs()["grain", effect]
                self.assertGreater(leg["time_ratio"], 0.0)
                self.assertGreater(leg["contacts_per_step"], 0.0)
                self.assertNotIn(effect, leg["effects"])
        self.assertEqual("float", self.legs()["grain", "double_precision"]["precision"])
        self.assertEqual("double", self.legs()["grain", ""]["precision"])

    def test_without_friction_goes_what_it_brings(self):
        self.assert_status(self.effects("--quiet", *SHORT), HELD)
        leg = self.legs()["grain", "friction"]
        self.assertEqual({"normal_damping", "bottom_friction", "moving_walls"}, set(leg["effects"]))
        self.assertLess(leg["time_ratio"], 1.0)
        spins = [row for row in self.rows() if row["effect"] == "friction" and row["field"] == "spin"]
        self.assertEqual([], spins)
        # Blocked, not absent: the change is the whole spin, with the sign turned.
        for row in self.rows():
            if row["effect"] == "rotation" and row["field"] == "spin":
                self.assertAlmostEqual(-float(row["reference"]), float(row["change"]), delta=1e-9)

    def test_one_packing_has_the_bars_of_its_runs(self):
        self.assert_status(
            self.effects("--quiet", *SHORT, *ONE_EFFECT, "--set=preparation.packings=1"), HELD
        )
        rows = self.rows()
        self.assertEqual({"within_run"}, {row["stderr_kind"] for row in rows})
        self.assertEqual({""}, {row["resolved"] for row in rows})
        self.assertTrue(any(float(row["stderr"] or 0) > 0 for row in rows))

    def test_four_packings_decide(self):
        self.assert_status(
            self.effects("--quiet", *SHORT, *ONE_EFFECT, "--set=preparation.packings=4"), HELD
        )
        self.assertEqual({"normal_damping"}, {row["effect"] for row in self.rows()})
        judged = [row for row in self.rows() if row["field"] == "volume_fraction"]
        self.assertLessEqual({row["resolved"] for row in judged}, {"yes", "no"})
        self.assertEqual({"0.05"}, {row["family_level"] for row in judged})


class Refusals(EffectsTest):
    def test_a_switch_that_an_engine_lacks_is_noted(self):
        done = self.effects("--quiet", *SHORT, engines="box2d-impulse")
        self.assert_status(done, HELD)
        for effect, why in (
            ("bottom_friction", "has no bottom_friction"),
            ("double_precision", "runs in float only"),
        ):
            leg = self.legs()["box2d-impulse", effect]
            self.assertEqual(("refused", why), (leg["status"], leg["reason"]))
            self.assertIn(why, done.stdout)
            row = next(row for row in self.rows() if row["effect"] == effect)
            self.assertEqual(("refused", why, ""), (row["status"], row["reason"], row["change"]))
        self.assertEqual("ran", self.legs()["box2d-impulse", "friction"]["status"])

    def test_an_engine_that_cannot_run_the_case_is_refused_for_itself(self):
        lacking = settings(run__may_differ=["rounding"])
        done = self.effects("--quiet", *lacking, engines="grain,box2d-impulse")
        self.assert_one_error(done, HELD, "box2d-impulse cannot run", "may_differ")
        engines = {row["name"]: row["status"] for row in self.results()["engines"]}
        self.assertEqual({"grain": "ran", "box2d-impulse": "refused"}, engines)
        alone = self.effects("--fresh", *lacking, engines="box2d-impulse")
        self.assert_one_error(alone, BAD_INPUT, "box2d-impulse", "may_differ")


class BadInput(EffectsTest):
    def test_one_line_each(self):
        for name, arguments, told in (
            ("engine", {"engines": "grian"}, "did you mean grain?"),
            ("case", {"case": COLLISION}, "effects cannot run a case of this kind"),
            ("file", {"case": "missing.toml"}, "missing.toml"),
        ):
            with self.subTest(name):
                self.assert_one_line(self.effects(**arguments), BAD_INPUT, told)


class Interruption(EffectsTest):
    def test_resume_takes_up_runs_and_timing(self):
        running = self.start(*self.arguments("--jobs=1", *settings(averaging__rotations=0.3)))
        running.worker_at_work("grain", cpu_seconds=0.05)
        os.kill(running.process.pid, signal.SIGINT)
        done = self.check_no_crash(running.end())
        self.assert_one_error(done, INTERRUPTED, "the same command goes on")
        finished = self.finished_runs()
        self.assertIn("timing-grain", finished)
        done = self.effects("--jobs=1", *settings(averaging__rotations=0.3))
        self.assert_status(done, HELD)
        now = self.finished_runs()
        self.assertEqual(1 + 2 * 10, len(now))  # the timing; 2 packings of the case and 9 switches
        self.assertEqual(finished, {name: now[name] for name in finished})


if __name__ == "__main__":
    unittest.main()
