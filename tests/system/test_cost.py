"""crossgrain cost: error against time, planned, measured, resumed."""

import csv
import os
import signal
import unittest

from harness import (
    BAD_INPUT,
    CASES,
    COLLISION,
    HELD,
    INTERRUPTED,
    PATIENCE,
    SystemTest,
    settings,
    wait_for,
)

COST = CASES / "cost/quick.toml"

# Binding: columns that other programs read, in this order; further ones come after.
COLUMNS = (
    "engine,setting,dt_s,error,error_kind,wall_s,cpu_s,steps,contact_evaluations,status,reason"
).split(",")

DECIDED = ("reached", "not reached")

COLLISIONS = settings(cost__kinds=["collision"])
FEW = settings(cost__knobs=["time_step"])


class CostTest(SystemTest):
    def arguments(self, *arguments, case=COST, engines="grain"):
        return ["cost", case, "--engines", engines, "--out", self.out, "--quick", *arguments]

    def cost(self, *arguments, **options):
        return self.run_program(*self.arguments(*arguments, **options))

    def rows(self):
        with open(self.out / "cost.csv", encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def points(self, kind=None):
        return [p for p in self.results()["points"] if kind in (None, p["error_kind"])]


class Results(CostTest):
    def test_three_kinds_of_error(self):
        done = self.cost(*FEW)
        self.assert_status(done, HELD)
        self.assertRegex(done.stdout, r"\d+ ran, \d+ failed, \d+ refused, \d+ not measured")
        rows = self.rows()
        self.assertEqual(COLUMNS, list(rows[0])[: len(COLUMNS)])
        self.assertEqual(len(self.points()), len(rows))
        self.assertEqual(
            {"collision", "trajectory", "averages"}, {row["error_kind"] for row in rows}
        )
        for point in self.points():
            if point["status"] != "ran":
                self.assertTrue(point["reason"])
                continue
            self.assertGreater(point["wall_s"], 0.0)
            self.assertGreater(point["steps"], 0)
            if point["error"] is not None:
                self.assertGreaterEqual(point["error"], 0.0)
        for point in self.points("averages"):
            if point["measure"] == "stress_rr" and point["error"] is not None:
                self.assertGreater(point["statistical"], 0.0)
        results = self.results()
        cells = results["cells"]
        self.assertEqual((2 * 2 + 1) * 3, len(cells))  # kinds, bases, accuracies
        decided = [c for c in cells if c["basis"] == "own" and c["verdict"] in DECIDED]
        self.assertIn(f"is decided for {len(decided)} of 6 against engines' own", done.stdout)
        for cell in cells:
            if cell["verdict"] == "reached":
                self.assertGreater(cell["wall_s"], 0.0)
                self.assertIsNotNone(cell["point"])
        self.assertGreater(results["window_s"], 0.0)
        self.assertEqual(["grain"], [row["engine"] for row in results["startup"]])
        self.assertEqual({"trajectory", "averages", "collision"},
                         {row["error_kind"] for row in results["references"]})  # fmt: skip

    def test_beyond_the_limit_is_a_result_not_a_failure(self):
        self.assert_status(self.cost("--quiet", *COLLISIONS), HELD)
        past = [point for point in self.points() if point["setting"] == "t_c/1.2"]
        self.assertEqual({"failed"}, {point["status"] for point in past})
        for row in self.rows():
            if row["setting"] == "t_c/1.2":
                self.assertIn("beyond its stability limit", row["reason"])
                self.assertEqual("", row["error"])

    def test_a_printed_fragment_is_a_case(self):
        done = self.cost("--quiet", *COLLISIONS, "--want", "10%")
        self.assert_status(done, HELD)
        case = self.write("pasted.toml", f'[case]\nextends = "{COST}"\n\n{done.stdout}')
        self.assert_status(self.run_program("check", case, "--engines", "grain"), HELD)

    def test_json_prints_only_the_path(self):
        done = self.cost("--quiet", "--json", *COLLISIONS)
        self.assertEqual(f"{self.out / 'results.json'}\n", done.stdout)


class Budget(CostTest):
    def test_what_does_not_fit_is_not_measured(self):
        done = self.cost(*FEW, "--budget", "0.2s")
        self.assert_status(done, HELD)
        self.assertIn("are left of the budget of 0.2 s", done.stderr)
        # "undecided" is what files call it; it is neither that of a target nor not reached.
        left_out = [point for point in self.points() if point["status"] == "undecided"]
        self.assertTrue(left_out)
        self.assertRegex(done.stdout, rf"\b{len(left_out)} not measured\n")
        for point in left_out:
            self.assertIn("would take about", point["reason"])
            self.assertIsNone(point["error"])


class Resume(CostTest):
    def test_finished_points_are_not_measured_again(self):
        self.assert_status(self.cost("--quiet", *FEW), HELD)
        runs, points = self.finished_runs(), self.points()
        done = self.cost("--quiet", *FEW)
        self.assert_status(done, HELD)
        self.assertEqual(runs, self.finished_runs())
        self.assertEqual(points, self.points())

    def test_interrupted_it_keeps_what_it_has(self):
        running = self.start(*self.arguments(*settings(cost__timed=0.2, cost__repeats=3)))
        wait_for(self.has_collision_of_grain, PATIENCE, "a point that is measured")
        os.kill(running.process.pid, signal.SIGINT)
        done = self.check_no_crash(running.end())
        self.assert_one_error(done, INTERRUPTED, "the same command goes on")
        self.assertTrue(self.has_collision_of_grain())

    def has_collision_of_grain(self):
        return any(name.startswith("collision-grain") for name in self.finished_runs())


class BadInput(CostTest):
    def test_one_line_each(self):
        for name, arguments, told in (
            ("engine", ([], {"engines": "grian"}), "did you mean grain?"),
            ("case", ([], {"case": COLLISION}), "cost cannot run a case of this kind; crossgrain collide can"),
            ("budget", (["--budget=soon"], {}), "must be like 90s"),
            ("want", (["--want=-1%"], {}), "must be like 1%"),
            ("setting", (["--set=cost.settings.grain.skim=[1]"], {}), "did you mean skin?"),
            ("key", (["--set=cost.stepz=[1]"], {}), "cost.stepz"),
            ("removed key", (["--set=cost.omega=[2]"], {}), "is a key no more"),
            ("removed knob", (['--set=cost.knobs=["omega"]'], {}), "time_step"),
        ):
            with self.subTest(name):
                done = self.cost("--quiet", *arguments[0], **arguments[1])
                self.assert_one_line(done, BAD_INPUT, told)


if __name__ == "__main__":
    unittest.main()
