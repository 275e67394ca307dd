"""A worker dies or hangs, the user interrupts, or crossgrain itself is killed: what was finished stays,
nothing is left running, and the same command goes on from there."""

import html
import os
import re
import signal
import time
import unittest

from harness import (
    CASES,
    COLLISION,
    COUETTE,
    ENGINE_FAILED,
    FELL_SHORT,
    HELD,
    INTERRUPTED,
    PATIENCE,
    SystemTest,
    read_proc,
    settings,
    wait_for,
)

HARD = CASES / "hard"
SLOW = "box2d-penalty"
BOTH = f"grain,{SLOW}"


class FailureTest(SystemTest):
    def assert_resumes(self, finished, *arguments):
        """The same command completes all four runs without touching those that were finished."""
        done = self.compare(*arguments, engines=BOTH)
        self.assert_status(done, HELD, FELL_SHORT)
        self.assertEqual([], done.error_lines())
        now = self.finished_runs()
        self.assertEqual(4, len(now))
        self.assertEqual(finished, {name: now[name] for name in finished})
        self.assertEqual(
            len(finished), done.stderr.count("finished in an earlier run"), str(done)
        )
        self.assertEqual({"finished"}, {run["status"] for run in self.results()["runs"]})

    def assert_others_finished(self):
        """One of the slow engine's runs failed, the other three are on disk. Returns them."""
        finished = self.finished_runs()
        self.assertEqual(3, len(finished), finished)
        self.assertLessEqual({"grain-p0", "grain-p1"}, set(finished))
        return finished

    def assert_report_tells(self, line):
        """report.html shows the failure with its reason."""
        reason = line.removeprefix("crossgrain: ")
        page = html.unescape((self.out / "report.html").read_text(encoding="utf-8"))
        self.assertIn(reason, page)
        failed = [run for run in self.results()["runs"] if run["status"] == "failed"]
        self.assertEqual([(SLOW, reason)], [(run["engine"], run["reason"]) for run in failed])

    def assert_nothing_runs(self, running, seconds=PATIENCE):
        wait_for(lambda: not running.processes(), seconds, "all processes to end")


class WorkerDies(FailureTest):
    def test_killed_half_way(self):
        running = self.start_compare(engines=BOTH)
        os.kill(running.worker_at_work(SLOW), signal.SIGKILL)
        done = self.check_no_crash(running.end())
        line = self.assert_one_error(done, ENGINE_FAILED, SLOW, "quick at t = ", "signal 9")
        self.assertGreater(float(re.search(r"at t = (\S+) s", line)[1]), 0.0)
        finished = self.assert_others_finished()
        self.assert_report_tells(line)
        self.assert_nothing_runs(running)
        self.assert_resumes(finished)

    def test_hangs(self):
        running = self.start_compare("--set", "run.timeout=5", engines=BOTH)
        os.kill(running.worker_at_work(SLOW), signal.SIGSTOP)
        done = self.check_no_crash(running.end())
        line = self.assert_one_error(
            done, ENGINE_FAILED, SLOW, "quick at t = ", "no answer within 5 s"
        )
        finished = self.assert_others_finished()
        self.assert_report_tells(line)
        self.assert_nothing_runs(running)
        self.assert_resumes(finished, "--set", "run.timeout=5")


class CollideWorkerDies(FailureTest):
    def collide(self):
        self.arguments = [
            "collide", COLLISION, "--engines", BOTH, "--out", self.out,
            *settings(
                run__mirrors="false",
                collision__psi="{ from = 0.0, to = 4.0, count = 400 }",
                collision__steps_per_contact=400,
            ),
        ]  # fmt: skip
        running = self.start(*self.arguments)
        return running, running.worker_at_work(SLOW, 0.05, stage="collisions:")

    def test_the_same_command_goes_on(self):
        running, worker = self.collide()
        wait_for(lambda: any(SLOW in name for name in self.finished_runs()), PATIENCE, "a case of it")
        os.kill(worker, signal.SIGKILL)
        self.assert_one_error(self.check_no_crash(running.end()), ENGINE_FAILED, SLOW)
        finished = self.finished_runs()
        self.assertEqual(15, len(finished))  # of 2 engines × 8 variants, all but the one that failed
        done = self.run_program(*self.arguments)
        self.assert_status(done, HELD, FELL_SHORT)
        now = self.finished_runs()
        self.assertEqual(16, len(now))
        self.assertEqual(finished, {name: now[name] for name in finished})
        curves = [c for variant in self.results()["variants"] for c in variant["curves"]]
        self.assertEqual({"finished"}, {curve["status"] for curve in curves})
        once = (self.out / "collisions.csv").read_bytes()
        self.run_program(*self.arguments, "--fresh")
        self.assertEqual(once, (self.out / "collisions.csv").read_bytes())


class UserInterrupts(FailureTest):
    def interrupted(self, signal_number):
        """Interrupted when one engine's runs are finished and the other's are under way."""
        slow = [*settings(averaging__rotations=0.3), "--jobs=2"]
        # Slow runs start first; one of them is held up for as long as grain's runs take.
        running = self.start_compare(*slow, engines=BOTH)
        held = running.worker_at_work(SLOW)
        os.kill(held, signal.SIGSTOP)
        wait_for(
            lambda: {"grain-p0", "grain-p1"} <= set(self.finished_runs()), PATIENCE, "runs to finish"
        )
        os.kill(held, signal.SIGCONT)
        finished = self.finished_runs()
        os.kill(running.process.pid, signal_number)
        done = self.check_no_crash(running.end())
        self.assert_one_error(done, INTERRUPTED, "interrupted", "the same command goes on")
        self.assertEqual(finished, self.finished_runs())
        self.assert_nothing_runs(running)
        return finished, slow

    def test_interrupt(self):
        finished, arguments = self.interrupted(signal.SIGINT)
        self.assert_resumes(finished, *arguments)

    def test_terminate(self):
        self.interrupted(signal.SIGTERM)

    def test_a_run_goes_on_from_where_it_was(self):
        """Interrupted in the middle of its only run, then resumed: to the bit what it would have been."""
        one = settings(
            preparation__packings=1, averaging__rotations=5.0, averaging__snapshots_per_rotation=60
        )
        running = self.start_compare(*one, engines="grain")
        running.worker_at_work("grain", cpu_seconds=0.5)
        os.kill(running.process.pid, signal.SIGINT)
        self.assert_one_error(self.check_no_crash(running.end()), INTERRUPTED, "interrupted")
        self.assertEqual({}, self.finished_runs())
        left = self.out / "unfinished" / "grain-p0"
        self.assertTrue((left / "index.json").exists(), list(self.out.rglob("*")))
        done = self.compare(*one, engines="grain")
        self.assertEqual([], done.error_lines())
        self.assertFalse(left.exists())
        tables = ("profiles.csv", "series.csv")
        resumed = [(self.out / name).read_bytes() for name in tables]
        self.compare("--fresh", *one, engines="grain")
        self.assertEqual(resumed, [(self.out / name).read_bytes() for name in tables])

    def test_while_packings_are_prepared(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            for command in ("compare", "effects", "cost"):
                with self.subTest(command, signal=number):
                    self.ends(
                        number, "preparing packings", command, COUETTE, "--quick",
                        *settings(preparation__rotations=3.0, preparation__seed=77),
                    )  # fmt: skip

    def test_while_hard_cases_are_run(self):
        cases = [HARD / f"{name}.toml" for name in ("pile", "column", "cooling-gas", "elastic-gas")]
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number):
                self.ends(number, "hard cases", "stability", *cases, "--jobs=1")

    def ends(self, number, stage, command, *arguments):
        """A command that is at some stage ends by that signal, with its workers, and says so."""
        out = self.folder / f"{command}-{number}"
        running = self.start(
            command, *arguments, "--engines", SLOW, "--out", out,
            env={"CROSSGRAIN_CACHE": str(self.folder / "cache")},
        )  # fmt: skip
        wait_for(
            lambda: stage in running.stderr() or running.process.poll() is not None, PATIENCE,
            "the stage to begin",
        )  # fmt: skip
        time.sleep(0.2)
        os.kill(running.process.pid, number)
        done = self.check_no_crash(running.end())
        self.assert_one_error(done, INTERRUPTED, "interrupted")
        self.assert_nothing_runs(running)

    def test_interrupt_at_once(self):
        """Ctrl-C at any moment of the first half second."""
        for delay in (0.0, 0.02, 0.1, 0.5):
            with self.subTest(delay=delay):
                running = self.start_compare(*settings(averaging__rotations=0.5), engines=BOTH)
                # Before main() has begun the kernel's default is to end the program.
                caught = re.compile(rb"SigCgt:\s*[0-9a-f]*[2367abef]\n")  # SIGINT is bit 1
                pid = running.process.pid
                wait_for(lambda: caught.search(read_proc(pid, "status")), PATIENCE, "main() to begin")
                time.sleep(delay)
                os.kill(pid, signal.SIGINT)
                done = self.check_no_crash(running.end())
                self.assert_one_error(done, INTERRUPTED, "interrupted")
                self.assert_nothing_runs(running)


class Resume(FailureTest):
    def test_damaged_run_file_is_run_again(self):
        short = settings(averaging__rotations=0.02)
        self.assert_status(self.compare(*short), HELD)
        damaged = self.out / "runs/grain-p0.json"
        profiles = (self.out / "profiles.csv").read_bytes()
        os.truncate(damaged, damaged.stat().st_size // 2)
        done = self.compare(*short)
        self.assert_status(done, HELD)
        self.assertEqual(1, done.stderr.count("finished in an earlier run"), str(done))
        self.assertEqual(profiles, (self.out / "profiles.csv").read_bytes())


class CrossgrainDies(FailureTest):
    def test_no_worker_outlives_it(self):
        running = self.start_compare(engines=BOTH)
        running.worker_at_work(SLOW)
        self.assertGreater(len(running.processes()), 0)
        running.process.kill()
        running.process.wait()
        self.assert_nothing_runs(running, 3)

    def test_resume_after_that(self):
        running = self.start_compare("--jobs=1", engines=BOTH)
        wait_for(self.finished_runs, PATIENCE, "a run to finish")
        running.worker_at_work(SLOW, cpu_seconds=0.05)
        running.process.kill()
        running.process.wait()
        self.assert_resumes(self.finished_runs())


if __name__ == "__main__":
    unittest.main()
