"""crossgrain stability --transforms: a case told otherwise does the same, and engines are found for which it does not."""

import csv
import json
import os
import pathlib
import sys
import unittest

from harness import BAD_INPUT, CASES, COUETTE, FELL_SHORT, HELD, PROGRAM, SystemTest

PLANTED = pathlib.Path(os.environ["CROSSGRAIN_BUILD"]) / "tests/faults/planted_engine"
TRANSFORMS = [
    "turned by 90°", "turned by 1 rad", "mirrored", "lengths by 2⁻¹⁰", "masses by 2⁻¹⁰", "times by 2¹⁰",
    "renumbered", "restarted", "in one go",
]
# Four layers of disks on a floor that slides under them against a stop: gravity, walls that move, stick and slip.
SLIDING = CASES / "hard/restart.toml"


class Transforms(SystemTest):
    def planted(self, name, **patch):
        """An engine with those numbers planted."""
        words = [str(PLANTED), *(f"{fault}={value}" for fault, value in patch.items())]
        path = self.folder / f"{name}.toml"
        path.write_text(f'name = "{name}"\nsummary = "a test"\ncommand = {json.dumps(words)}\n')
        return path

    def slow(self):
        """The right engine, asked through a pipe that keeps every request to advance for a while."""
        pipe = self.folder / "pipe.py"
        pipe.write_text(
            "import os, subprocess, sys, time\n"
            "requests = os.fdopen(os.dup(3))  # workers read from 3 and answer on 4\n"
            "own, engines = os.pipe()[::-1]\n"
            "os.dup2(engines, 3)\n"
            "subprocess.Popen(sys.argv[1:], pass_fds=(3, 4))\n"
            "for line in requests:\n"
            "    if '\"advance\"' in line: time.sleep(0.3)\n"
            "    os.write(own, line.encode())\n"
        )
        path = self.folder / "slow.toml"
        path.write_text(f'name = "slow"\nsummary = "a test"\ncommand = {json.dumps([sys.executable, str(pipe), str(PLANTED)])}\n')
        return path

    def transform(self, engines, *cases, status, budget=()):
        done = self.run_program("stability", "--transforms", *cases, *budget, "--engines", engines, "--out", self.out)
        self.assert_status(done, status)
        with open(self.out / "stability.csv", encoding="utf-8", newline="") as file:
            self.rows = list(csv.DictReader(file))
        return done

    def of(self, verdict, engine):
        return [row["variant"] for row in self.rows if (row["verdict"], row["engine"]) == (verdict, engine)]

    def test_everything_holds_of_the_in_house_engine_on_every_kind_of_case(self):
        cases = [SLIDING, COUETTE, CASES / "collision/figure-4-3.toml"]
        self.transform("grain", *cases, status=HELD)
        names = {row["case"] for row in self.rows}
        self.assertEqual(3, len(names))
        for name in names:
            rows = [row for row in self.rows if row["case"] == name]
            variants = {row["variant"].split(", ")[-1] for row in rows}
            self.assertEqual(set(TRANSFORMS), variants)
            for row in rows:
                self.assertEqual("stable", row["verdict"], row)
                self.assertLessEqual(float(row["value"]), float(row["limit"]))
                # Powers of two are not rounded, and the same scene once more is the same run.
                if row["measure"] in ("rescaled", "restarted", "split"):
                    self.assertEqual(0.0, float(row["value"]), row)
        page = (self.out / "report.html").read_text(encoding="utf-8")
        for variant in TRANSFORMS:
            self.assertIn(variant, page)

    def test_faults_show_in_the_telling_that_they_break(self):
        engines = {
            "right": self.planted("right"),
            "gravity-x": self.planted("gravity-x", gravity_x=0),
            "wall-y": self.planted("wall-y", wall_velocity_y=0),
            "odd": self.planted("odd", mu_odd=0.9),
            "handed": self.planted("handed", mu_anticlockwise=0.9),
            "absolute": self.planted("absolute", least_overlap=1e-9),
            "forgetful": self.planted("forgetful", look_forgets=1),
        }
        done = self.transform(",".join(map(str, engines.values())), SLIDING, status=FELL_SHORT)
        self.assertEqual([], self.of("unstable", "right"))
        self.assertEqual(["restarted"], self.of("refused", "right"))
        for engine in ("gravity-x", "wall-y"):
            self.assertEqual(["turned by 90°", "turned by 1 rad"], self.of("unstable", engine))
        self.assertEqual(["renumbered"], self.of("unstable", "odd"))
        self.assertEqual(["mirrored"], self.of("unstable", "handed"))
        self.assertIn("lengths by 2⁻¹⁰", self.of("unstable", "absolute"))
        self.assertEqual(["in one go"], self.of("unstable", "forgetful"))
        for row in self.rows:
            if row["verdict"] == "unstable":
                self.assertGreater(float(row["value"]), float(row["limit"]))
                self.assertRegex(row["reason"], r"^disk \d+ is where it should not be")
                self.assertRegex(done.stdout, f"unstable  {row['engine']} .*{row['measure']}")

    def test_what_is_wrong_in_every_telling_alike_is_none_of_its_business(self):
        self.transform(str(self.planted("stiff", kn=1.05)), SLIDING, status=HELD)

    def test_a_worker_gets_absolute_paths_from_a_relative_output_folder(self):
        """It may work in a folder of its own."""
        worker = self.folder / "elsewhere.sh"
        worker.write_text(f'#!/bin/sh\ncd /\nexec "{PROGRAM}" __serve grain\n')
        worker.chmod(0o755)
        engine = self.write("elsewhere.toml", f'name = "elsewhere"\nsummary = "a test"\ncommand = ["{worker}"]\n')
        done = self.run_program(
            "stability", "--transforms", SLIDING, "--engines", engine, "--out", "o",
        )  # fmt: skip
        self.assert_status(done, HELD)
        with open(self.folder / "o/stability.csv", encoding="utf-8", newline="") as file:
            verdicts = {row["variant"]: row["verdict"] for row in csv.DictReader(file)}
        self.assertEqual("stable", verdicts["restarted"])

    def test_what_the_budget_has_no_time_for_is_not_run_and_holds_nothing(self):
        # Some forty looks at a third of a second: the run that the others are held against is given up.
        done = self.transform(str(self.slow()), SLIDING, status=FELL_SHORT, budget=["--budget=1s"])
        self.assertEqual(["not_run"] * len(TRANSFORMS), [row["verdict"] for row in self.rows])
        for row in self.rows:
            self.assertEqual("", row["value"])
            self.assertRegex(row["reason"], "its part of the budget, [0-9.e-]+ s, leaves no time for it")
        self.assertRegex(done.stdout, r"not run +slow +9 runs: its part of the budget")
        self.assertIn("0 stable, 0 degraded, 0 unstable, 0 refused, 9 not run", done.stdout)
        self.assertIn("nothing was judged: the budget ended", done.stdout)
        page = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertIn("not run", page)
        self.assertNotIn("no more than rounding came of it", page)

    def test_what_was_not_run_is_run_by_a_command_with_more_time(self):
        right = str(self.planted("right"))
        self.transform(right, SLIDING, status=FELL_SHORT, budget=["--budget=0.001s"])
        self.assertEqual({"not_run"}, {row["verdict"] for row in self.rows})
        done = self.transform(right, SLIDING, status=HELD, budget=["--budget=1h"])
        self.assertNotIn("not run", done.stdout)
        self.assertEqual(["restarted"], self.of("refused", "right"))
        self.assertEqual(len(TRANSFORMS) - 1, len(self.of("stable", "right")))

    def test_bad_input(self):
        for words, says in ((["--transforms", "--budget=soon"], "must be like 90s"), (["--budget=1m"], "goes with --transforms")):
            done = self.run_program("stability", *words, SLIDING, "--engines", "grain", "--out", self.out)
            self.assert_one_line(done, BAD_INPUT, says)
        for words in (["--transforms", "--quick"], ["--transforms", "--long"]):
            done = self.run_program("stability", *words, SLIDING, "--engines", "grain", "--out", self.out)
            self.assert_status(done, BAD_INPUT)


if __name__ == "__main__":
    unittest.main()
