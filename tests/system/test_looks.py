"""crossgrain compare adds packings look by look, within a budget, and goes on where it stopped."""

import csv
import unittest

from harness import COUETTE, FELL_SHORT, HELD, SystemTest, settings

# Binding: columns that other programs read, in this order; further ones come after.
COLUMNS = (
    "a,b,kind,endpoint,unit,margin,answer,difference,low,high,distance,distance_low,distance_high,"
    "look,packings,lost,needs,needs_at_most,carrier_a,carrier_b,bound,regimes_differ,reference,reason,reach"
).split(",")

SHORT = settings(
    preparation__packings=4, preparation__shrink_time=0.3, preparation__rotations=0.05,
    averaging__settle_rotations=0.02, averaging__rotations=0.05, looks__count=3,
)  # fmt: skip


class Looks(SystemTest):
    def compare_short(self, *arguments, engines="grain,box2d-penalty"):
        return self.run_program(
            "compare", COUETTE, "--engines", engines, "--out", self.out,
            *SHORT, *arguments,
        )  # fmt: skip

    def endpoints(self):
        with open(self.out / "endpoints.csv", encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_a_mirror_carries_the_packings_and_the_engine_runs_one(self):
        done = self.compare_short()
        self.assert_status(done, HELD)
        rows = self.endpoints()
        self.assertEqual(COLUMNS, list(rows[0])[: len(COLUMNS)])
        self.assertEqual(9, len(rows))
        for row in rows:
            self.assertEqual("grain-as-box2d-penalty", row["carrier_b"])
            self.assertLess(float(row["bound"]), 1e-6)
        runs = [run["engine"] for run in self.results()["runs"]]
        self.assertEqual(1, runs.count("box2d-penalty"))
        self.assertIn("box2d-penalty: evaluated through its mirror grain-as-box2d-penalty", done.stdout)
        self.assertIn("16 equal windows leave at most 19 % of states different", done.stdout)

    def test_the_next_look_is_taken_up_where_the_budget_ended(self):
        engines = "grain,box2d-impulse"
        stiff = ["--set=averaging.endpoints.mean_spin={ absolute = 1e-9, why = \"never\" }"]
        first = self.compare_short("--budget=0.1s", *stiff, engines=engines)
        self.assert_status(first, FELL_SHORT)
        self.assertRegex(first.stdout, r"Analysed after 4 packings \(1 of 3 interim analyses\), agree tested at 2\.3\d % in each; 1\.25 of 5 %")
        self.assertIn("after the budget of 0.1 s", first.stdout)
        self.assertRegex(first.stderr, r"the first analysis, at 4 packings, is likely to end after \S+ s, .* beyond the budget of 0\.1 s")
        decided = {
            row["endpoint"]: row for row in self.endpoints() if row["answer"] not in OPEN
        }
        runs = self.finished_runs()
        second = self.compare_short("--budget=10m", *stiff, engines=engines)
        self.assert_status(second, FELL_SHORT)
        self.assertNotIn("the first analysis", second.stderr)
        self.assertRegex(second.stdout, r"Analysed after 4, 8, 12 packings \(3 of 3 interim analyses\), .*; 5 of 5 %")
        now = self.finished_runs()
        self.assertEqual(runs, {name: now[name] for name in runs})
        for row in self.endpoints():
            if row["endpoint"] in decided:
                self.assertEqual(decided[row["endpoint"]]["answer"], row["answer"])
                self.assertEqual("1", row["look"])


OPEN = ("undecided", "borderline")

if __name__ == "__main__":
    unittest.main()
