"""What is finished in an output folder stays there, whatever ends the command: the same command goes on from it, another one
is refused in one line, and nothing is left running. Rules of the folder have their tests in tests/studies/run_store_test.cpp."""

import html
import os
import re
import resource
import signal
import subprocess
import time
import unittest

from harness import (
    BAD_INPUT,
    CASES,
    COLLISION,
    COUETTE,
    ENGINE_FAILED,
    FELL_SHORT,
    HELD,
    INTERRUPTED,
    PATIENCE,
    PROGRAM,
    Finished,
    SystemTest,
    read_proc,
    settings,
    wait_for,
)

SHORT = settings(averaging__rotations=0.02)
SLOW = "box2d-penalty"
BOTH = f"grain,{SLOW}"


def runs_kept(done):
    """Of an earlier command, which a line counts."""
    return sum(int(count) for count in re.findall(r"(?m)(\d+) runs? kept$", done.stderr))


class EveryCommand(SystemTest):
    """Commands that run engines, short, and something that changes what they run."""

    COMMANDS = {
        "compare": ([COUETTE, "--quick", *SHORT, "--set=run.mirrors=false"], "averaging.rings=5"),
        "effects": (
            [COUETTE, "--quick", *SHORT, *settings(
                law__tangential="none", law__mu=0, law__kt=0, law__gt=0, law__tension="cut", bottom__mu=0, run__precision="float"
            )], "averaging.rings=5",
        ),
        "cost": (
            [CASES / "cost/quick.toml", "--quick", *settings(cost__kinds=["collision"], cost__knobs=["time_step"])],
            "averaging.rings=5",
        ),
        "stability": ([CASES / "hard/elastic-collision.toml"], "stability.limit=0.04"),
        "collide": (
            [COLLISION, *settings(collision__steps_per_contact=50, collision__psi=[0.5, 2.0], run__mirrors="false")],
            "law.kn=400.0",
        ),
        "lockstep": ([COUETTE, "--quick", "--starts=1"], "law.mu=0.3"),
    }  # fmt: skip

    def test_same_case_goes_on_and_another_is_refused(self):
        for name, (arguments, change) in self.COMMANDS.items():
            self.out = self.folder / name
            engine = SLOW if name == "lockstep" else "grain"
            command = [name, *arguments, "--engines", engine, "--out", self.out, "--quiet"]
            with self.subTest(name):
                plan = self.run_program(*command, "--dry-run")
                self.assertRegex(plan.stdout, rf"(?m)^  {engine} +\d+ ")
                self.assertFalse(self.out.exists())
                self.assert_status(self.run_program(*command), HELD, FELL_SHORT)
                runs = self.finished_runs()
                self.assertTrue(runs)
                self.assertFalse((self.out / ".crossgrain.lock").exists())
                self.assert_status(self.run_program(*command, "--resume"), HELD, FELL_SHORT)
                self.assertEqual(runs, self.finished_runs())
                if not change:
                    continue
                key, value = change.split("=")
                for more in ([], ["--dry-run"]):
                    done = self.run_program(*command, "--set", change, *more)
                    self.assert_one_line(done, BAD_INPUT, str(self.out), f"{key}: ", f"→ {value}", "--fresh")
                self.assertEqual(runs, self.finished_runs())

    def test_fresh_sets_aside_and_another_command_is_refused(self):
        self.assert_status(self.compare(*SHORT), HELD)
        before = {file.name: file.read_bytes() for file in self.out.iterdir() if file.is_file()}
        done = self.run_program("collide", COLLISION, "--engines=grain", "--out", self.out, "--quiet")
        self.assert_one_line(done, BAD_INPUT, "'crossgrain compare', not of 'collide'")
        done = self.compare("--quiet", "--fresh", *SHORT, "--set=averaging.rings=5")
        self.assert_status(done, HELD)
        aside = self.out / "earlier/1"
        self.assertIn(f"what was there is now in {aside}\n", done.stderr)
        self.assertEqual(before, {file.name: file.read_bytes() for file in aside.iterdir() if file.is_file()})
        done = self.compare(*SHORT, out=aside)
        self.assertEqual(2, runs_kept(done), "it is a folder like any other")

    def test_more_packings_engines_and_margins_keep_what_is_there(self):
        self.assert_status(self.compare(*SHORT), HELD)
        finished = self.finished_runs()
        more = [*SHORT, *settings(preparation__packings=3), "--set=engines.box2d-penalty.length_unit=2e-4"]
        done = self.compare(*more, "--jobs=1", engines=f"{SLOW},grain")
        self.assert_status(done, HELD, FELL_SHORT)
        self.assertEqual(2, runs_kept(done), str(done))
        now = self.finished_runs()
        self.assertEqual(6, len(now))
        self.assertEqual(finished, {name: now[name] for name in finished})
        wide = "--set=averaging.margins.stress_rr={ absolute = 1e9, why = \"any\" }"
        self.assert_status(self.compare(*more, wide, engines=f"{SLOW},grain"), HELD, FELL_SHORT)
        self.assertEqual(now, self.finished_runs())
        self.assertEqual({1e9}, {row["margin"] for row in self.results()["agreement"] if row["field"] == "stress_rr"})
        done = self.compare("--quiet", *SHORT, engines=BOTH)
        self.assert_one_line(done, BAD_INPUT, "length_unit: 0.0002 → none")

    def test_damaged_run_is_run_again_to_the_same_bits(self):
        self.assert_status(self.compare(*SHORT), HELD)
        damaged = self.out / "runs/grain-p0.json.gz"
        profiles = (self.out / "profiles.csv").read_bytes()
        os.truncate(damaged, damaged.stat().st_size // 2)
        done = self.compare(*SHORT)
        self.assert_status(done, HELD)
        self.assertEqual(1, runs_kept(done), str(done))
        self.assertEqual(profiles, (self.out / "profiles.csv").read_bytes())


class OneAtATime(SystemTest):
    def test_second_process_is_refused_until_the_first_is_gone(self):
        longer = settings(averaging__rotations=0.5)
        self.assert_status(self.compare(*longer, "--set=preparation.packings=1"), HELD)
        running = self.start_compare(*longer, "--set=preparation.packings=8", "--jobs=1")
        running.worker_at_work("grain")
        first = f"crossgrain compare, process {running.process.pid}"
        self.assert_one_line(self.compare("--quiet"), BAD_INPUT, str(self.out), first, "since 20")
        self.assert_one_line(self.run_program("report", self.out), BAD_INPUT, first)
        self.assertIsNone(running.process.poll())
        running.process.kill()
        running.process.wait()
        self.assertTrue((self.out / ".crossgrain.lock").exists())
        wait_for(lambda: not running.processes(), PATIENCE, "its workers to end")
        self.assert_status(self.compare("--quiet", *longer), HELD)

    def test_of_many_at_once_one_runs(self):
        running = [self.start_compare(*SHORT) for _ in range(4)]
        ended = [self.check_no_crash(each.end()) for each in running]
        self.assertLessEqual({done.status for done in ended}, {HELD, BAD_INPUT})
        self.assertIn(HELD, [done.status for done in ended])
        for done in ended:
            if done.status == BAD_INPUT:
                self.assert_one_error(done, BAD_INPUT, "in use by")


class FailureTest(SystemTest):
    def assert_resumes(self, finished, *arguments):
        """The same command completes all four runs without touching those that were finished."""
        done = self.compare(*arguments, engines=BOTH)
        self.assert_status(done, HELD, FELL_SHORT)
        self.assertEqual([], done.error_lines())
        now = self.finished_runs()
        self.assertEqual(4, len(now))
        self.assertEqual(finished, {name: now[name] for name in finished})
        self.assertEqual(len(finished), runs_kept(done), str(done))
        self.assertEqual({"finished"}, {run["status"] for run in self.results()["runs"]})

    def assert_nothing_runs(self, running, seconds=PATIENCE):
        wait_for(lambda: not running.processes(), seconds, "all processes to end")


class WorkerDies(FailureTest):
    def test_killed_or_hanging_worker_fails_its_run_alone(self):
        for number, more, reason in (
            (signal.SIGKILL, [], "signal 9"), (signal.SIGSTOP, ["--set=run.timeout=5"], "no answer within 5 s"),
        ):  # fmt: skip
            with self.subTest(reason):
                self.out = self.folder / str(number)
                running = self.start_compare(*more, engines=BOTH)
                os.kill(running.worker_at_work(SLOW), number)
                done = self.check_no_crash(running.end())
                line = self.assert_one_error(done, ENGINE_FAILED, SLOW, "quick at t = ", reason)
                self.assertGreater(float(re.search(r"at t = (\S+) s", line)[1]), 0.0)
                finished = self.finished_runs()
                self.assertEqual(3, len(finished), finished)
                page = html.unescape((self.out / "report.html").read_text(encoding="utf-8"))
                self.assertIn(line.removeprefix("crossgrain: "), page)
                failed = [(run["engine"], run["reason"]) for run in self.results()["runs"] if run["status"] == "failed"]
                self.assertEqual([(SLOW, line.removeprefix("crossgrain: "))], failed)
                self.assert_nothing_runs(running)
                if number == signal.SIGKILL:
                    self.assert_resumes(finished)

    def test_killed_worker_of_collide(self):
        arguments = [
            "collide", COLLISION, "--engines", BOTH, "--out", self.out, "-k", "*cut", *settings(
                run__mirrors="false", collision__psi="{ from = 0.0, to = 4.0, count = 50 }", collision__steps_per_contact=1000
            ),
        ]  # fmt: skip
        running = self.start(*arguments)
        os.kill(running.worker_at_work(SLOW, 0.02, stage="collisions:"), signal.SIGKILL)
        self.assert_one_error(self.check_no_crash(running.end()), ENGINE_FAILED, SLOW)
        finished = self.finished_runs()
        self.assertEqual(7, len(finished))  # of 2 engines × 4 variants, all but the one that failed
        self.assert_status(self.run_program(*arguments), HELD, FELL_SHORT)
        now = self.finished_runs()
        self.assertEqual(8, len(now))
        self.assertEqual(finished, {name: now[name] for name in finished})


class Interrupted(FailureTest):
    def test_same_command_goes_on(self):
        """Interrupted when one engine's runs are finished and the other's are under way."""
        slow = [*settings(averaging__rotations=0.3), "--jobs=2"]
        running = self.start_compare(*slow, engines=BOTH)
        held = running.worker_at_work(SLOW)  # slow runs start first; one is held up for as long as grain's runs take
        os.kill(held, signal.SIGSTOP)
        wait_for(lambda: {"grain-p0", "grain-p1"} <= set(self.finished_runs()), PATIENCE, "runs to finish")
        os.kill(held, signal.SIGCONT)
        finished = self.finished_runs()
        os.kill(running.process.pid, signal.SIGINT)
        done = self.check_no_crash(running.end())
        self.assert_one_error(done, INTERRUPTED, "interrupted", "the same command goes on")
        self.assertEqual(finished, self.finished_runs())
        self.assert_nothing_runs(running)
        self.assert_resumes(finished, *slow)

    def test_run_goes_on_from_where_it_was_to_the_bit(self):
        one = settings(preparation__packings=1, averaging__rotations=2.0, averaging__snapshots_per_rotation=60)
        running = self.start_compare(*one)
        running.worker_at_work("grain", cpu_seconds=0.3)
        os.kill(running.process.pid, signal.SIGINT)
        self.assert_one_error(self.check_no_crash(running.end()), INTERRUPTED, "interrupted")
        self.assertEqual({}, self.finished_runs())
        left = self.out / "unfinished/grain-p0"
        self.assertTrue((left / "index.json").exists(), list(self.out.rglob("*")))
        self.assertEqual([], self.compare(*one).error_lines())
        self.assertFalse(left.exists())
        tables = ("profiles.csv", "series.csv")
        resumed = [(self.out / name).read_bytes() for name in tables]
        self.compare("--fresh", *one)
        self.assertEqual(resumed, [(self.out / name).read_bytes() for name in tables])

    def test_at_any_stage_it_ends_with_its_workers(self):
        prepare = [COUETTE, "--quick", *settings(preparation__rotations=3.0, preparation__seed=77)]
        hard = [CASES / f"hard/{name}.toml" for name in ("pile", "column", "cooling-gas", "elastic-gas")]
        for number, stage, command, *arguments in (
            (signal.SIGINT, "preparing packings", "compare", *prepare), (signal.SIGTERM, "preparing packings", "cost", *prepare),
            (signal.SIGTERM, "hard cases", "stability", *hard, "--jobs=1"),
        ):  # fmt: skip
            with self.subTest(command, signal=number):
                running = self.start(
                    command, *arguments, "--engines", SLOW, "--out", self.folder / command,
                    env={"CROSSGRAIN_CACHE": str(self.folder / "cache")},
                )  # fmt: skip
                wait_for(lambda: stage in running.stderr() or running.process.poll() is not None, PATIENCE, "the stage to begin")
                time.sleep(0.2)
                os.kill(running.process.pid, number)
                self.assert_one_error(self.check_no_crash(running.end()), INTERRUPTED, "interrupted")
                self.assert_nothing_runs(running)

    def test_at_any_moment_of_the_first_half_second(self):
        for delay in (0.0, 0.02, 0.1, 0.5):
            with self.subTest(delay=delay):
                running = self.start_compare(*settings(averaging__rotations=0.5), engines=BOTH)
                # Before main() has begun the kernel's default is to end the program.
                caught = re.compile(rb"SigCgt:\s*[0-9a-f]*[2367abef]\n")  # SIGINT is bit 1
                pid = running.process.pid
                wait_for(lambda: caught.search(read_proc(pid, "status")), PATIENCE, "main() to begin")
                time.sleep(delay)
                os.kill(pid, signal.SIGINT)
                self.assert_one_error(self.check_no_crash(running.end()), INTERRUPTED, "interrupted")
                self.assert_nothing_runs(running)

    def test_killed_it_leaves_no_worker_and_goes_on(self):
        running = self.start_compare("--jobs=1", engines=BOTH)
        wait_for(self.finished_runs, PATIENCE, "a run to finish")
        running.worker_at_work(SLOW, cpu_seconds=0.05)
        running.process.kill()
        running.process.wait()
        self.assert_nothing_runs(running, 60)
        self.assert_resumes(self.finished_runs())


class Disk(SystemTest):
    """Not written (status 2) or full (status 3): the system's own reason, and how to go on."""

    SHORT = settings(averaging__rotations=0.02, preparation__rotations=0.0, run__keep_snapshots_of=3)
    ROOM = "what is finished is kept: make room, and the same command goes on"

    def test_folder_that_cannot_be_made(self):
        below = self.write("file", "") / "out"
        for out, reason in ((below, "Not a directory"), ("/proc/crossgrain", "No such file or directory")):
            self.assert_one_line(self.compare("--quiet", *self.SHORT, out=out), BAD_INPUT, str(out), reason)
            done = self.run_program("collide", COLLISION, "--engines", "grain", "--out", out, "--quiet")
            self.assert_one_line(done, BAD_INPUT, str(out), reason)

    @unittest.skipIf(os.geteuid() == 0, "permissions do not hold for root")
    def test_folder_without_permission(self):
        self.out.mkdir(mode=0o500)
        self.assert_one_line(self.compare("--quiet", *self.SHORT), BAD_INPUT, str(self.out), "Permission denied")

    def on_small_disk(self, kib, disk):
        """A `compare` while a file system of that size lies over the folder `disk`, in a mount namespace of its own."""
        disk.mkdir(exist_ok=True)
        mount = 'mount -t tmpfs -o "size=$1k" none "$2" || exit 77; shift 2; exec "$@"'
        flags = ["--mount"] if os.geteuid() == 0 else ["--user", "--map-root-user", "--mount"]
        command = [
            "unshare", *flags, "sh", "-c", mount, "sh", kib, disk,
            PROGRAM, "compare", COUETTE, "--engines=grain", "--out", self.out, "--quick", "--quiet", *self.SHORT,
        ]  # fmt: skip
        done = subprocess.run(
            [*map(str, command)], capture_output=True, encoding="utf-8", timeout=PATIENCE, check=False,
            env=os.environ | {"CROSSGRAIN_CACHE": str(self.folder / "cache")},
        )  # fmt: skip
        if done.returncode == 77 or "unshare:" in done.stderr:
            self.skipTest(f"no file system can be mounted here: {done.stderr.strip()}")
        return self.check_no_crash(Finished(done.returncode, done.stdout, done.stderr))

    def test_full_disk(self):
        # The first to find no room: a worker's arrays, a run's file, the results of all runs.
        for kib in (16, 64, 128, 256):
            with self.subTest(kib=kib):
                done = self.on_small_disk(kib, self.out)
                self.assert_one_line(done, ENGINE_FAILED, str(self.out), "No space left on device", self.ROOM)

    def test_full_disk_under_the_packings_costs_time_and_not_the_run(self):
        self.assert_status(self.on_small_disk(12, self.folder / "cache"), HELD)

    def test_file_size_limit_as_a_quota_would(self):
        """Two packings are finished; of two more the disk takes no byte."""

        def limit():
            # The limit's signal would end the program; ignored, write() fails with EFBIG.
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))

        def limited(*arguments):
            return self.compare("--quiet", *self.SHORT, *arguments, preexec_fn=limit, restore_signals=False)

        self.assert_status(self.compare("--quiet", *self.SHORT), HELD)
        more = settings(preparation__packings=3)
        finished, report = self.finished_runs(), (self.out / "results.json").read_bytes()
        self.assert_one_line(limited(*more), ENGINE_FAILED, "grain-p2", "File too large", self.ROOM)
        self.assertEqual(finished, self.finished_runs())
        self.assertEqual(report, (self.out / "results.json").read_bytes())
        done = self.compare(*self.SHORT, *more)
        self.assertEqual(2, runs_kept(done), str(done))
        done = limited("--fresh")
        self.assert_one_error(done, ENGINE_FAILED, str(self.out), "File too large", "without --fresh goes on")
        self.assertEqual([], list(self.out.rglob("*.part*")), "nothing half written is left")
        self.assertEqual({}, self.finished_runs())


if __name__ == "__main__":
    unittest.main()
