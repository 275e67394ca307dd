"""crossgrain baseline and diff: what an engine did is kept, and compared with what it does now."""

import json
import unittest

from harness import (
    BAD_INPUT,
    CASES,
    COLLISION,
    COUETTE,
    ENGINE_FAILED,
    FELL_SHORT,
    HELD,
    SystemTest,
)


class Baseline(SystemTest):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "before.baseline"

    def keep(self, engines, *arguments, case=COUETTE, file=None, **options):
        return self.run_program(
            "baseline", case, "--engines", engines, "--out", file or self.file, "--quiet", *arguments, **options
        )  # fmt: skip

    def diff(self, engines, *arguments, **options):
        return self.run_program("diff", self.file, "--engines", engines, "--quiet", *arguments, **options)

    def test_engines_against_themselves(self):
        engines = "grain,yade,box2d-penalty,box2d-impulse"
        done = self.keep(engines, "--starts=2")
        self.assert_status(done, HELD)
        self.assertRegex(done.stdout, r"before.baseline: kept of grain \S+, yade 2023")
        # No packing is needed any more, nor a place to keep one.
        done = self.diff(engines, env={"CROSSGRAIN_CACHE": str(self.folder / "empty")})
        self.assert_status(done, HELD)
        for engine in engines.split(","):
            self.assertRegex(done.stdout, rf"(?m)^{engine} \(.*\) against {engine} \(.*\): same bits$")
        self.assertFalse((self.folder / "empty").exists())

    def test_changed_case_is_found_and_named(self):
        self.assert_status(self.keep("grain", "--starts=3"), HELD)
        done = self.diff("grain", "--set=law.integrator=semi_implicit_euler")
        self.assert_status(done, FELL_SHORT)
        self.assertIn('case changed: law.integrator: "position_verlet" → "semi_implicit_euler"', done.stdout)
        self.assertIn(": differs", done.stdout)
        self.assertIn("deviation found: integrator = semi_implicit_euler", done.stdout)
        self.assertRegex(done.stdout, r"first beyond \S+ d: between 0 and 0.0400 ms after start")
        self.assertRegex(done.stdout, r"(?m)^    e_n +41 of 41 changed, most by")

        done = self.diff("grain", "--set=law.mu=0.441", "--json")
        self.assert_status(done, FELL_SHORT)
        found = json.loads(done.stdout)
        self.assertEqual("diff", found["kind"])
        row = found["engines"][0]
        self.assertEqual("differs", row["verdict"])
        self.assertEqual("mu", row["windows"]["term"]["name"])
        self.assertAlmostEqual(1.0 / 440.0, row["windows"]["term"]["amount"], delta=1e-5)
        self.assertEqual([0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1], [round(at["time_s"], 9) for at in row["windows"]["separations"]])

        # A little is the same law.
        done = self.diff("grain", "--set=law.kn=352.1001")
        self.assert_status(done, HELD)
        self.assertIn("same law", done.stdout)

    def test_an_engine_that_refuses_the_case_is_left_out_and_reported(self):
        done = self.keep("grain,yade", "--starts=1", "--set=run.may_differ=[]")
        self.assert_status(done, HELD)
        self.assertRegex(done.stdout, r"before.baseline: kept of grain \S+$")
        self.assertRegex(done.error_lines()[0], "^crossgrain: yade cannot run .*bottom_friction")
        self.assert_status(self.diff("grain"), HELD)
        done = self.keep("yade", "--starts=1", "--set=run.may_differ=[]", file=self.folder / "none.h5")
        self.assert_status(done, BAD_INPUT)
        self.assertFalse((self.folder / "none.h5").exists())

    def test_averages_are_kept_where_they_are_asked_for(self):
        short = [
            "--set=averaging.settle_rotations=0.02", "--set=averaging.rotations=0.05", "--starts=4", "--endpoints"
        ]  # fmt: skip
        self.assert_status(self.keep("grain", *short), HELD)
        done = self.diff("grain")
        self.assert_status(done, HELD)
        self.assertNotIn("averages from", done.stdout)  # the same bits need no runs
        done = self.diff("grain", "--set=law.kn=3521", "--set=run.dt=1e-5")
        self.assert_status(done, FELL_SHORT)
        self.assertIn("averages from 4 starts:", done.stdout)
        self.assertRegex(done.stdout, r"(?m)^    pressure +disagree: [0-9.]+ margins")
        done = self.diff("grain", "--set=law.kn=352.1001", "--json")
        self.assert_status(done, HELD)
        rows = {row["endpoint"]: row for row in json.loads(done.stdout)["engines"][0]["endpoints"]}
        self.assertEqual(9, len(rows))
        self.assertIn(rows["coordination"]["answer"], ("no_difference_seen", "small_difference"))

    def test_endpoints_of_a_case_without_any(self):
        done = self.keep("grain", "--endpoints", case=COLLISION)
        self.assert_one_line(done, BAD_INPUT, "--endpoints", "no [averaging.endpoints]")

    def test_another_engine(self):
        self.assert_status(self.keep("grain", "--starts=2"), HELD)
        done = self.diff("grain-as-box2d-penalty")
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"grain-as-box2d-penalty \(.*\) against grain \(.*\): differs")
        self.assertIn("deviation found: integrator = semi_implicit_euler", done.stdout)

    def test_collisions(self):
        self.assert_status(self.keep("grain", case=COLLISION), HELD)
        done = self.diff("grain")
        self.assert_status(done, HELD)
        self.assertIn("figure-4-3, 0 starts", done.stdout)
        self.assertIn("same bits", done.stdout)
        done = self.diff("grain", "--set=law.gn=0.2")
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"(?m)^    e_n +\d+ of \d+ changed, most by −")

    def test_the_same_run_is_the_same_file(self):
        again = self.folder / "again.baseline"
        self.assert_status(self.keep("grain", "--starts=1"), HELD)
        self.assert_status(self.keep("grain", "--starts=1", file=again), HELD)
        self.assertEqual(self.file.read_bytes(), again.read_bytes())

    def test_bad_input(self):
        self.assert_one_line(self.diff("grain"), BAD_INPUT, "before.baseline: no such file")
        self.file.write_text("{}")
        self.assert_one_line(self.diff("grain"), BAD_INPUT, "before.baseline", "`crossgrain baseline CASE --out FILE` makes one")
        self.assert_one_line(self.keep("grain"), BAD_INPUT, "is there already, and a baseline is not replaced")
        self.file.unlink()
        for value in ("0", "2.5", "1001"):
            self.assert_one_line(self.keep("grain", f"--starts={value}"), BAD_INPUT, "--starts")
        pile = CASES / "hard/pile.toml"
        self.assert_one_line(self.keep("grain", case=pile), BAD_INPUT, "baseline cannot run a case of this kind; crossgrain stability can")
        self.assertFalse(self.file.exists())

        self.assert_status(self.keep("grain", "--starts=1"), HELD)
        self.assert_one_line(self.diff("grane"), BAD_INPUT, "did you mean grain?")
        self.assert_one_line(self.diff("grain", "--set=law.mu=a"), BAD_INPUT, "its case", "must be a number")
        self.assert_one_line(self.diff("grain", "--set=law.nu=1"), BAD_INPUT, "law.nu")
        self.assert_one_line(
            self.diff("grain", "--set=cost.psi_count=11"), BAD_INPUT, "are other ones than the baseline has"
        )

    def test_nothing_is_judged_where_no_time_is_met(self):
        """A step that never comes by the times that were kept; collisions that do not differ do not make a flow the same."""
        self.assert_status(self.keep("box2d-impulse", "--starts=1"), HELD)
        done = self.diff("box2d-impulse", "--set=engines.box2d-impulse.dt=1.4142e-3")
        self.assertIn("meets the times that were kept", done.stdout)
        self.assert_status(done, FELL_SHORT)

    def test_an_engine_that_fails(self):
        self.assert_status(self.keep("yade", "--starts=1"), HELD)
        done = self.diff("yade", "--set=run.timeout=0.001")
        self.assert_status(done, ENGINE_FAILED)


if __name__ == "__main__":
    unittest.main()
