"""What is finished in an output folder stays there: the same command goes on, another one is refused in
one line, --fresh sets aside, and one process at a time writes."""

import json
import os
import signal
import unittest
import xml.etree.ElementTree as ElementTree

from harness import (
    BAD_INPUT,
    CASES,
    COLLISION,
    COUETTE,
    FELL_SHORT,
    HELD,
    PATIENCE,
    SystemTest,
    settings,
    wait_for,
)

SHORT = settings(averaging__rotations=0.02)
FEW = settings(collision__steps_per_contact=50, collision__psi=[0.5, 2.0], run__mirrors="false")
PILE = CASES / "hard/elastic-collision.toml"
COST = CASES / "cost/quick.toml"
CHEAP = settings(cost__kinds=["collision"], cost__knobs=["time_step"])


class FolderTest(SystemTest):
    def setUp(self):
        super().setUp()
        # Commands that run engines, short, and something that changes what they run.
        self.commands = {
            "compare": (COUETTE, "--quick", *SHORT, "--set=run.mirrors=false"),
            "effects": (COUETTE, "--quick", *SHORT, "--set=run.precision=float"),
            "cost": (COST, "--quick", *CHEAP),
            "stability": (PILE,),
            "collide": (COLLISION, *FEW),
        }
        self.change = {"stability": "stability.limit=0.04", "collide": "law.kn=400.0"}

    def command(self, name, *arguments, out=None, engines="grain", **options):
        return self.run_program(
            name, *self.commands[name], "--engines", engines, "--out", out or self.out, *arguments,
            **options,
        )  # fmt: skip

    def everything(self, folder=None):
        """Every file with its content, but for the workers' logs."""
        folder = folder or self.out
        files = (file for file in sorted(folder.rglob("*")) if file.is_file())
        content = {str(file.relative_to(folder)): file.read_bytes() for file in files}
        return {name: bits for name, bits in content.items() if not name.startswith("scratch/")}

    def in_each(self, check):
        for name in self.commands:
            with self.subTest(name):
                check(name, self.folder / name)


class TheSameCase(FolderTest):
    def test_goes_on_whatever_the_command(self):
        def check(name, out):
            self.assert_status(self.command(name, out=out), HELD, FELL_SHORT)
            runs = {file.name: file.stat().st_mtime_ns for file in (out / "runs").iterdir()}
            self.assertTrue(runs)
            self.assertFalse((out / ".crossgrain.lock").exists())
            for flag in ([], ["--resume"]):
                self.assert_status(self.command(name, *flag, out=out), HELD, FELL_SHORT)
                now = {file.name: file.stat().st_mtime_ns for file in (out / "runs").iterdir()}
                self.assertEqual(runs, now)

        self.in_each(check)

    def test_more_packings_and_engines_keep_what_is_there(self):
        self.assert_status(self.command("compare"), HELD)
        finished = self.finished_runs()
        done = self.command(
            "compare", "--set=preparation.packings=3", "--jobs=1", engines="box2d-penalty,grain"
        )
        self.assert_status(done, HELD, FELL_SHORT)
        self.assertEqual(2, done.stderr.count("finished in an earlier run"), str(done))
        now = self.finished_runs()
        self.assertEqual(6, len(now))
        self.assertEqual(finished, {name: now[name] for name in finished})

    def test_another_margin_is_another_verdict_on_the_same_runs(self):
        both = {"engines": "grain,box2d-penalty"}
        self.assert_status(self.command("compare", **both), HELD, FELL_SHORT)
        finished = self.finished_runs()
        done = self.command(
            "compare", "--set=averaging.margins.stress_rr={ absolute = 1e9, why = \"any\" }", **both
        )
        self.assert_status(done, HELD, FELL_SHORT)
        self.assertEqual(finished, self.finished_runs())
        margins = [row["margin"] for row in self.results()["agreement"] if row["field"] == "stress_rr"]
        self.assertEqual({1e9}, set(margins))

    def test_settings_of_one_engine_are_its_own(self):
        self.assert_status(self.command("compare"), HELD)
        finished = self.finished_runs()
        threads = "--set=engines.box2d-penalty.length_unit=2e-4"
        done = self.command("compare", threads, engines="grain,box2d-penalty")
        self.assert_status(done, HELD, FELL_SHORT)
        now = self.finished_runs()
        self.assertEqual(finished, {name: now[name] for name in finished})
        done = self.command("compare", "--quiet", engines="grain,box2d-penalty")
        self.assert_one_line(done, BAD_INPUT, "length_unit: 0.0002 → none")


class AnotherCase(FolderTest):
    def test_is_refused_with_what_has_changed(self):
        def check(name, out):
            self.assert_status(self.command(name, out=out), HELD, FELL_SHORT)
            before = self.everything(out)
            change = self.change.get(name, "averaging.rings=5")
            key, value = change.split("=")
            for flag in ([], ["--resume"]):
                done = self.command(name, "--quiet", "--set", change, *flag, out=out)
                self.assert_one_line(
                    done, BAD_INPUT, str(out), f"{key}: ", f"→ {value}", "--fresh"
                )
            self.assertEqual(before, self.everything(out))

        self.in_each(check)

    def test_fresh_sets_aside(self):
        def check(name, out):
            self.assert_status(self.command(name, out=out), HELD, FELL_SHORT)
            before = self.everything(out)
            change = self.change.get(name, "averaging.rings=5")
            done = self.command(name, "--quiet", "--fresh", "--set", change, out=out)
            self.assert_status(done, HELD, FELL_SHORT)
            self.assertIn(f"what was there is now in {out / 'earlier/1'}\n", done.stderr)
            self.assertEqual(before, self.everything(out / "earlier/1"))
            # What was set aside is a folder like any other.
            done = self.command(name, out=out / "earlier/1")
            self.assert_status(done, HELD, FELL_SHORT)

        self.in_each(check)


class AnotherCommand(FolderTest):
    def test_is_refused(self):
        self.assert_status(
            self.command("compare", *settings(run__keep_snapshots=2)), HELD
        )
        before = self.everything()
        for name in ("collide", "effects", "cost", "stability"):
            done = self.command(name, "--quiet")
            self.assert_one_line(done, BAD_INPUT, f"'crossgrain compare', not of '{name}'")
        for name in ("average", "rev"):
            done = self.run_program(
                name, self.out / "snapshots/grain-p0.h5", COUETTE, "--out", self.out
            )
            self.assert_one_line(done, BAD_INPUT, f"'crossgrain compare', not of '{name}'")
        self.assertEqual(before, self.everything())
        self.assert_status(self.run_program("report", self.out), HELD)


class OneAtATime(FolderTest):
    def under_way(self):
        running = self.start_compare(*settings(averaging__rotations=2.0))
        running.worker_at_work("grain")
        return running

    def test_a_second_process_is_told_who_is_there(self):
        running = self.under_way()
        before = self.finished_runs()
        done = self.compare("--quiet")
        self.assert_one_line(
            done, BAD_INPUT, str(self.out), f"crossgrain compare, process {running.process.pid}",
            "since 20",
        )  # fmt: skip
        done = self.command("collide", "--quiet")
        self.assert_status(done, BAD_INPUT)
        self.assertEqual(before, self.finished_runs())
        self.assertIsNone(running.process.poll())

    def test_a_report_is_not_rebuilt_meanwhile(self):
        short = settings(averaging__rotations=1.0)
        done = self.compare("--quiet", *short, *settings(preparation__packings=1))
        self.assert_status(done, HELD)
        report = (self.out / "results.json").read_bytes()
        running = self.start_compare(*short, *settings(preparation__packings=4), "--jobs=1")
        running.worker_at_work("grain")
        done = self.run_program("report", self.out)
        self.assert_one_line(done, BAD_INPUT, "crossgrain compare, process")
        self.assertEqual(report, (self.out / "results.json").read_bytes())

    def test_one_that_was_killed_holds_nothing(self):
        running = self.under_way()
        running.process.kill()
        running.process.wait()
        self.assertTrue((self.out / ".crossgrain.lock").exists())
        wait_for(lambda: not running.processes(), PATIENCE, "its workers to end")
        self.assert_status(self.compare("--quiet", *SHORT), HELD)

    def test_of_many_at_once_one_runs(self):
        out = self.folder / "contested"
        arguments = ["compare", COUETTE, "--quick", *SHORT, "--engines=grain", "--out", out]
        running = [self.start(*arguments) for _ in range(4)]
        ended = [self.check_no_crash(each.end()) for each in running]
        self.assertLessEqual({done.status for done in ended}, {HELD, BAD_INPUT})
        self.assertIn(HELD, [done.status for done in ended])
        for done in ended:
            self.assertNotIn("Success", done.stderr)
            if done.status == BAD_INPUT:
                self.assert_one_error(done, BAD_INPUT, "in use by")


class DryRun(FolderTest):
    def test_tells_and_leaves_nothing(self):
        def check(name, out):
            cache, temporary = self.folder / "cache", self.folder / "temporary"
            temporary.mkdir(exist_ok=True)
            env = {"CROSSGRAIN_CACHE": str(cache), "TMPDIR": str(temporary)}
            done = self.command(name, "--dry-run", out=out, env=env)
            self.assert_status(done, HELD)
            self.assertRegex(done.stdout, r"(?m)^  grain .*\d+ .*: 0 finished, \d+ to do")
            self.assertFalse(out.exists())
            self.assertFalse(cache.exists())
            self.assertEqual([], list(temporary.iterdir()))

        self.in_each(check)

    def test_knows_what_is_finished(self):
        def check(name, out):
            self.assert_status(self.command(name, out=out), HELD, FELL_SHORT)
            before = self.everything(out)
            done = self.command(name, "--dry-run", out=out)
            self.assert_status(done, HELD)
            self.assertRegex(done.stdout, r"(?m)^  grain .*: [1-9]\d* finished, 0 to do$")
            done = self.command(name, "--dry-run", "--fresh", out=out)
            self.assertRegex(done.stdout, r"(?m)^  grain .*: 0 finished, [1-9]\d* to do")
            change = self.change.get(name, "averaging.rings=5")
            done = self.command(name, "--dry-run", "--set", change, out=out)
            self.assert_one_line(done, BAD_INPUT, change.split("=")[0])
            self.assertEqual(before, self.everything(out))

        self.in_each(check)


class JUnit(FolderTest):
    def suite(self):
        root = ElementTree.parse(self.out / "junit.xml").getroot()
        (suite,) = root.findall("testsuite")
        cases = suite.findall("testcase")
        for tag, attribute in (("failure", "failures"), ("error", "errors"), ("skipped", "skipped")):
            self.assertEqual(
                sum(case.find(tag) is not None for case in cases), int(suite.get(attribute))
            )
        self.assertEqual(len(cases), int(suite.get("tests")))
        names = [(case.get("classname"), case.get("name")) for case in cases]
        self.assertEqual(len(names), len(set(names)))
        return cases

    def of(self, case, tag):
        found = case.find(tag)
        self.assertIsNotNone(found, ElementTree.tostring(case))
        return found.get("message")

    def test_of_stability(self):
        self.assert_status(self.command("stability"), HELD)
        (case,) = self.suite()
        self.assertEqual([], list(case))
        self.assertTrue(case.get("classname").startswith("elastic-collision"))
        self.assertTrue(case.get("name").startswith("grain: "))
        none = settings(stability__limit=0, stability__degraded=0)
        self.assert_status(self.command("stability", "--fresh", *none), FELL_SHORT)
        (case,) = self.suite()
        self.assertRegex(self.of(case, "failure"), r"unstable: \S+.* against a limit of 0 \(.+\)")

    def test_of_stability_with_a_refusal(self):
        restart = CASES / "hard/restart.toml"
        self.run_program(
            "stability", restart, "--engines", "grain,box2d-penalty", "--out", self.out
        )
        skipped = [case for case in self.suite() if case.find("skipped") is not None]
        self.assertTrue(skipped)
        for case in skipped:
            self.assertTrue(self.of(case, "skipped"))

    def test_of_collide(self):
        tight = "--set=collision.margins.psi_f={ absolute = 1e-12, why = \"none is so good\" }"
        done = self.command("collide", tight, engines="grain,box2d-impulse")
        self.assert_status(done, FELL_SHORT)
        cases = self.suite()
        self.assertLessEqual(
            {"figure-4-3 coulomb-cut", "figure-4-3 viscous-cut"},
            {case.get("classname") for case in cases},
        )
        failed = [case for case in cases if case.find("failure") is not None]
        self.assertTrue(failed)
        for case in failed:
            self.assertRegex(case.get("name"), r"^(grain|box2d-impulse), dt \S+ s: ")
        messages = [self.of(case, "failure") for case in failed if case.get("name").endswith("psi_f")]
        self.assertTrue(messages)
        for message in messages:
            self.assertRegex(message, r"largest error \S+ of the \w+ against .* \(none is so good\)")
        before = (self.out / "junit.xml").read_bytes()
        (self.out / "junit.xml").unlink()
        self.assert_status(self.run_program("report", self.out), HELD)
        self.assertEqual(before, (self.out / "junit.xml").read_bytes())

    def test_an_engine_that_fails_is_an_error(self):
        running = self.start(
            "collide", COLLISION, "--engines=grain", "--out", self.out,
            *settings(
                run__mirrors="false",
                collision__psi="{ from = 0.0, to = 4.0, count = 100 }",
                collision__steps_per_contact=2000,
            ),
        )  # fmt: skip
        os.kill(running.worker_at_work("grain", stage="collisions:"), signal.SIGKILL)
        self.check_no_crash(running.end())
        errors = [case for case in self.suite() if case.find("error") is not None]
        self.assertEqual(1, len(errors))
        self.assertIn("signal 9", self.of(errors[0], "error"))


if __name__ == "__main__":
    unittest.main()
