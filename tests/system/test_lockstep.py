"""crossgrain lockstep: engines against their mirrors, from the command line to the report."""

import csv
import pathlib
import unittest

from harness import BAD_INPUT, COLLISION, COUETTE, FELL_SHORT, HELD, SystemTest

# Binding: columns that other programs read, in this order; further ones come after.
COLUMNS = "engine,verdict,equivalent,time_s,median_d,largest_d,yardstick_d,equivalent_then".split(",")


class Lockstep(SystemTest):
    def lockstep(self, *arguments, engines="box2d-penalty", case=COUETTE):
        return self.run_program(
            "lockstep", case, "--engines", engines, "--out", self.out, "--quick", "--quiet",
            "--starts=3", *arguments,
        )  # fmt: skip

    def rows(self):
        with open(self.out / "lockstep.csv", encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_engines_that_are_what_they_declare(self):
        done = self.lockstep(engines="yade,box2d-penalty,box2d-impulse")
        self.assert_status(done, HELD)
        rows = self.rows()
        self.assertEqual(COLUMNS, list(rows[0])[: len(COLUMNS)])
        last = {row["engine"]: row for row in rows}
        self.assertEqual("same_law", last["yade"]["verdict"])
        self.assertLess(float(last["yade"]["equivalent"]), 1e-3)
        self.assertEqual("same_to_rounding", last["box2d-penalty"]["verdict"])
        self.assertLess(float(last["box2d-penalty"]["largest_d"]), 1e-10)
        self.assertEqual("not_measured", last["box2d-impulse"]["verdict"])
        self.assertEqual("", last["box2d-impulse"]["largest_d"])
        self.assertIn("another normal law", last["box2d-impulse"]["reason"])
        self.assertIn("box2d-penalty: identical to rounding over 3 starts", done.stdout)
        page = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertIn("are the laws that they declare; box2d-impulse was not measured", page)
        self.assertIn("Difference of each engine from its mirror", page)

    def test_rigid_disks(self):
        """Single precision is told as such, and by rule; where disks meet several at once the law leaves the order open."""
        case = pathlib.Path(__file__).resolve().parents[1] / "studies/rigid.toml"
        lockstep = ["lockstep", case, "--engines", "box2d-impulse", "--out", self.out, "--quiet"]
        done = self.run_program(*lockstep)
        self.assert_status(done, HELD)
        row = self.results()["lockstep"]["rows"][0]
        self.assertEqual("same_to_its_precision", row["verdict"])
        for at in row["separations"]:
            self.assertGreater(at["largest"], 1e-7)  # rounding is there
            self.assertLess(at["median"], at["rounding"])
        self.assertIn("box2d-impulse: identical to its precision over 16 starts", done.stdout)
        self.assertEqual(16, row["same_to_its_precision"])
        self.assertIsNone(row["forces"])

        done = self.run_program(*lockstep, "--fresh", "--set=particles.small=180")
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, "box2d-impulse: differs")
        self.assertRegex(done.stdout, "a disk touches several at once, and the law of rigid disks leaves the order of these collisions open")

    def test_it_goes_on_and_its_report_can_be_made_again(self):
        self.assert_status(self.lockstep(), HELD)
        runs = self.finished_runs()
        self.assertEqual(["lockstep-box2d-penalty"], list(runs))
        self.assert_status(self.lockstep(), HELD)
        self.assertEqual(runs, self.finished_runs())
        page = (self.out / "report.html").read_text(encoding="utf-8")
        self.assert_status(self.run_program("report", self.out), HELD)
        self.assertEqual(page, (self.out / "report.html").read_text(encoding="utf-8"))

    def test_dry_run(self):
        done = self.lockstep("--dry-run", engines="grain,box2d-penalty")
        self.assert_status(done, HELD)
        self.assertRegex(done.stdout, r"box2d-penalty +3 windows")
        self.assertIn("mirrors are made of this engine", done.stdout)
        self.assertFalse(self.out.exists())

    def test_bad_input(self):
        for value in ("0", "2.5", "-1"):
            done = self.lockstep(f"--starts={value}")
            self.assert_one_line(done, BAD_INPUT, "--starts")
        self.assert_one_line(self.lockstep(case=COLLISION), BAD_INPUT, "lockstep cannot run")


class Identify(SystemTest):
    def identify(self, engine):
        return self.run_program("identify", COUETTE, "--engines", engine, "--quiet")

    def test_an_engine_that_is_what_it_declares(self):
        done = self.identify("yade")
        self.assert_status(done, HELD)
        self.assertRegex(done.stdout, r"(?m)^tension +cut +declares cut$")
        self.assertRegex(done.stdout, r"(?m)^dashpot +outside +declares outside$")
        self.assertRegex(done.stdout, r"(?m)^does not simulate bottom_friction, bottom_spin")
        self.assertNotIn("<-", done.stdout)

    def test_an_engine_that_has_no_mirror(self):
        done = self.identify("grain-stiff")
        self.assert_status(done, FELL_SHORT)
        self.assertIn("nearest mirror tried, which is none", done.stdout)
        self.assert_one_line(self.identify("box2d-impulse"), BAD_INPUT, "another normal law")

    def test_takes_one_engine(self):
        self.assert_one_line(self.identify("grain,yade"), BAD_INPUT, "identify takes one engine")


if __name__ == "__main__":
    unittest.main()
