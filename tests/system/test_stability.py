"""crossgrain stability: the quick suite on every engine, its verdicts, files and exit status."""

import csv
import json
import os
import pathlib
import unittest

from harness import BAD_INPUT, CASES, FELL_SHORT, HELD, SystemTest

HARD = CASES / "hard"
COLUMNS = (
    "engine,case,verdict,measure,value,limit,unit,step,reason,degraded_limit,variant,time_s".split(",")
)


class Stability(SystemTest):
    def table(self):
        with open(self.out / "stability.csv", encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_the_quick_suite(self):
        """On two engines; one case of it on all, as engines of other programs take a second to start."""
        done = self.run_program(
            "stability", HARD, "--engines", "grain,box2d-impulse", "--quick", "--out", self.out
        )
        rows = self.table()
        self.assertEqual(COLUMNS, list(rows[0]))
        unstable = [row for row in rows if row["verdict"] == "unstable"]
        self.assert_status(done, FELL_SHORT if unstable else HELD)
        # What this project's own engine does not hold is a defect of it.
        ours = [row for row in rows if row["engine"] == "grain"]
        self.assertGreaterEqual(len(ours), 25)
        self.assertEqual([], [row for row in ours if row["verdict"] not in ("stable", "refused")])
        for row in rows:
            if row["verdict"] == "refused":
                self.assertNotEqual("", row["reason"])
            elif row["verdict"] == "stable":
                self.assertLessEqual(float(row["value"]), float(row["limit"]))
        page = (self.out / "report.html").read_text(encoding="utf-8")
        for row in rows:
            self.assertIn(row["case"].replace("_", " "), page)
        self.assertEqual("stability", self.results()["kind"])

    def test_one_kind_of_case_on_all_engines(self):
        done = self.run_program(
            "stability", HARD, "--engines", "all", "--quick", "-k", "grazing", "--out", self.out
        )
        verdicts = {row["engine"]: row["verdict"] for row in self.table()}
        ours = ("grain", "box2d-penalty", "box2d-impulse", "yade", "lammps")  # others are as they are
        self.assertEqual({"stable"}, {verdicts[engine] for engine in ours})
        self.assert_status(done, FELL_SHORT if "unstable" in verdicts.values() else HELD)

    def test_cases_after_public_threads_catch_what_they_are_named_after(self):
        """A slipping contact that keeps its anchor, friction of velocity alone, a bounce in seven steps."""
        planted = pathlib.Path(os.environ["CROSSGRAIN_BUILD"]) / "tests/faults/planted_engine"
        engine = self.folder / "keeps.toml"
        engine.write_text(f'name = "keeps"\nsummary = "a test"\ncommand = [{json.dumps(str(planted))}, "keep_spring=1"]\n')

        def verdict(case, *arguments):
            done = self.run_program("stability", HARD / f"{case}.toml", *arguments, "--fresh", "--out", self.out)
            self.assertIn(done.status, (HELD, FELL_SHORT), done)
            return {row["verdict"] for row in self.table()}

        self.assertEqual({"unstable"}, verdict("pushed-and-let-go", "--engines", engine))
        self.assertEqual({"unstable"}, verdict("pinched", "--engines", "grain", "--set", "law.tangential=viscous"))
        self.assertEqual({"degraded"}, verdict("bouncing-ball", "-k", "*/soft", "--engines", "grain", "--set", "run.dt=4e-4"))

    def test_where_all_is_refused_nothing_was_judged(self):
        # The impulse solver has no checkpoints, so no restart of it can be held against anything.
        done = self.run_program(
            "stability", HARD / "restart.toml", "--engines", "box2d-impulse", "--out", self.out
        )
        self.assertEqual({"refused"}, {row["verdict"] for row in self.table()})
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"(?m)^nothing was judged: .*refused.*checkpoints")

    def test_where_no_packing_can_be_prepared_the_other_cases_go_on(self):
        """The guard of the engine that prepares them ends it at a rim of 3 m/s; the others never ran there."""
        done = self.run_program(
            "stability", HARD / "couette-rates.toml", "--engines", "grain,box2d-penalty", "--out", self.out,
            "--set", "engines.grain.max_overlap=1.0", env={"CROSSGRAIN_CACHE": str(self.folder / "cache")},
        )
        self.assert_status(done, HELD)
        rows = {(row["engine"], row["variant"]): row for row in self.table()}
        for engine in ("grain", "box2d-penalty"):
            self.assertEqual("stable", rows[engine, "1"]["verdict"])
            self.assertEqual("refused", rows[engine, "1e2"]["verdict"])
            self.assertRegex(rows[engine, "1e2"]["reason"], "no packing was prepared: .*overlap by")

    def test_a_case_that_is_no_hard_one_is_bad_input(self):
        done = self.run_program(
            "stability", CASES / "couette/quick.toml", "--engines", "grain", "--out",
            self.out,
        )
        self.assert_status(done, BAD_INPUT)
        self.assertIn("has no [stability]", done.stderr)


if __name__ == "__main__":
    unittest.main()
