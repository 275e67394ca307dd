"""`scale`: what a step takes as the cell grows and workers share it."""

import csv
import unittest

from harness import BAD_INPUT, ENGINE_FAILED, HELD, SystemTest

SMALL = ("--disks=1000", "--steps=40", "--repetitions=2")

# An engine that ends by itself as soon as it is to step.
DIES = """
import json, os
for line in os.fdopen(3):
    request = json.loads(line)["request"]
    if request == "advance":
        os._exit(7)
    answer = {"hello": {"protocol": 1, "capabilities": CAN}, "load": {"realised": REAL}}.get(request, {})
    os.write(4, (json.dumps({"ok": True, **answer}) + "\\n").encode())
"""


class Scale(SystemTest):
    def scale(self, *arguments, engines="grain", **options):
        return self.run_program("scale", "--engines", engines, "--out", self.out, *arguments, **options)

    def rows(self):
        with open(self.out / "scale.csv", encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_a_small_cell(self):
        done = self.scale(*SMALL, "--threads=1,2", "--quiet")
        self.assert_status(done, HELD)
        self.assertEqual("", done.stderr)
        one, two = self.rows()
        self.assertEqual(("1", "2"), (one["workers"], two["workers"]))
        for row in (one, two):
            self.assertEqual(("grain", "1000", "threads", "ran", "40", "2"), tuple(
                row[name] for name in ("engine", "disks", "workers_are", "status", "steps", "repetitions")
            ))  # fmt: skip
            step = float(row["step_s"])
            self.assertAlmostEqual(float(row["ns_per_disk"]), step / 1000 * 1e9)
            self.assertGreaterEqual(float(row["spread"]), 0)
            # The in-house engine alone is some MB, and no more than some tens.
            self.assertTrue(2e6 < float(row["memory_bytes"]) < 2e8, row["memory_bytes"])
            self.assertAlmostEqual(float(row["bytes_per_disk"]), float(row["memory_bytes"]) / 1000)
            # Threads do the same steps to the same bits.
            self.assertEqual(one["contacts_per_step"], row["contacts_per_step"])
        self.assertEqual(("", ""), (one["strong"], one["weak"]))
        self.assertAlmostEqual(float(two["strong"]), float(one["step_s"]) / (2 * float(two["step_s"])))
        self.assertEqual("", two["weak"], "nobody ran 500 disks")
        self.assertRegex(done.stdout, r"(?m)^engine +disks +workers +step +ns/disk +spread +strong +weak +× first +bytes/disk$")
        self.assertRegex(done.stdout, r"(?m)^grain +1000 +1 thread .* – +– ")
        self.assertIn("report: ", done.stdout)
        self.assertIn("All timings", (self.out / "report.html").read_text(encoding="utf-8"))
        self.assertEqual("scale", self.results()["kind"])

    def test_weak_scaling_is_of_a_cell_as_much_larger(self):
        done = self.scale("--disks=1000,2000", "--steps=20", "--repetitions=1", "--threads=2", "--quiet")
        self.assert_status(done, HELD)
        rows = {(row["disks"], row["workers"]): row for row in self.rows()}
        self.assertEqual({("1000", "1"), ("1000", "2"), ("2000", "1"), ("2000", "2")}, set(rows))
        weak = float(rows["1000", "1"]["step_s"]) / float(rows["2000", "2"]["step_s"])
        self.assertAlmostEqual(weak, float(rows["2000", "2"]["weak"]))
        self.assertEqual("", rows["1000", "1"]["spread"], "of one repetition there is none")

    def test_what_is_timed_is_taken_up(self):
        self.assert_status(self.scale(*SMALL, "--threads=1"), HELD)
        before = self.finished_runs()
        done = self.scale(*SMALL, "--threads=1,2")
        self.assert_status(done, HELD)
        self.assertRegex(done.stderr, r"grain, 1000 disks, 1 thread: finished in an earlier run")
        after = self.finished_runs()
        self.assertEqual(2, len(after))
        self.assertEqual(before, {name: after[name] for name in before})
        self.assert_one_error(self.scale("--disks=1000", "--steps=41", "--repetitions=2"), BAD_INPUT, "steps")
        anew = self.scale(*SMALL, "--threads=1", "--fresh")
        self.assert_status(anew, HELD)
        self.assertNotIn("finished in an earlier run", anew.stderr)
        self.assertEqual(1, len(self.finished_runs()))

    def test_bad_options(self):
        for option, told in (
            ("--disks=10", "from 1000 to 20000000"),
            ("--disks=1000,", "'' must be a whole number"),
            ("--disks=1e4", "'1e4' must be a whole number"),
            ("--disks=1000,1000", "1000 stands twice"),
            ("--threads=0", "from 1 to 1024"),
            ("--steps=0", "--steps '0'"),
            ("--repetitions=2,3", "one number is wanted"),
            ("--set=cell.omega=2", "a cell of its own"),
            ("--set=engines.grain.threads=2", "--threads says"),
            ("--set=engines.grain.treads=2", "did you mean threads"),
            ("--engine=", "--engine"),
        ):
            with self.subTest(option):
                self.assert_one_line(self.scale(option), BAD_INPUT, told)
                self.assertFalse(self.out.exists())

    def test_an_engine_that_dies_leaves_the_others_timings(self):
        """A worker that ends while it steps: one line, status 3, and what was timed is there."""
        engine = self.write("dies.py", self.dying_engine())
        done = self.run_program(
            "scale", f"--engine=dies=python3 {engine}", "--engines=grain,dies", "--out", self.out, *SMALL,
            "--threads=1", "--quiet",
        )  # fmt: skip
        self.assert_one_line(done, ENGINE_FAILED, "dies", "exit status 7", "advance")
        self.assertEqual(["ran", "failed"], [row["status"] for row in self.rows()])
        self.assertEqual(1, len(self.finished_runs()))
        self.assertRegex(done.stdout, r"(?m)^dies +1000 +one process +– +– ")

    def dying_engine(self):
        """Says that it can all that `grain` can."""
        import json

        engines = json.loads(self.run_program("engines", "--json").stdout)
        can = next(engine["capabilities"] for engine in engines if engine["name"] == "grain")
        can["settings"] = []
        real = {
            "engine": "dies", "version": "1", "dt": 4e-5, "precision": "double", "integrator": "none",
            "effects": [name for name, has in can["effects"].items() if has != "never"], "pairs": [],
            "deviations": [],
        }  # fmt: skip
        return f"CAN = {can!r}\nREAL = {real!r}\n{DIES}"


if __name__ == "__main__":
    unittest.main()
