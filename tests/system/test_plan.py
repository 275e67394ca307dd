"""`plan`: an array of jobs for Slurm, run here by hand, and what is merged of them."""

import json
import os
import shutil
import subprocess
import unittest

from harness import BAD_INPUT, COUETTE, FELL_SHORT, HELD, PATIENCE, SystemTest

AWKWARD = "my jobs $(touch pwned) 'x'"


class Plan(SystemTest):
    def setUp(self):
        super().setUp()
        self.slurm = self.folder / AWKWARD

    def plan(self, *arguments, engines="grain,box2d-penalty"):
        return self.run_program(
            "plan", COUETTE, "--engines", engines, "--slurm", self.slurm, "--quick", "--set=run.mirrors=false", *arguments
        )

    def jobs(self):
        return [job["name"] for job in json.loads((self.slurm / "plan.json").read_text(encoding="utf-8"))["jobs"]]

    def bash(self, script, **variables):
        """As Slurm runs it: elsewhere, with the folder that it was submitted from in the environment."""
        return subprocess.run(
            ["bash", self.slurm / script], cwd="/", env=os.environ | {"SLURM_SUBMIT_DIR": str(self.slurm)} | variables,
            capture_output=True, encoding="utf-8", timeout=PATIENCE, check=False,
        )  # fmt: skip

    def test_jobs_run_and_are_merged_and_what_is_not_as_planned_is_told(self):
        done = self.plan("--seeds=1,2,3", "--set=averaging.rotations=0.02")
        self.assert_status(done, HELD)
        names = self.jobs()
        self.assertEqual([*names, f"3 jobs in {self.slurm}; submit with {self.slurm}/submit"], done.stdout.splitlines())
        for number in ("1", "2"):
            job = self.bash("array.sh", SLURM_ARRAY_TASK_ID=number)
            self.assertEqual("", job.stderr)
            self.assertIn(job.returncode, (HELD, FELL_SHORT), job.stdout)
        # The third has not run; the second is then made the first's.
        merged = self.bash("merge.sh")
        self.assertEqual(FELL_SHORT, merged.returncode)
        self.assertEqual(f"crossgrain: {names[2]}: missing: it has not begun\n", merged.stderr)
        site = (self.slurm / "site" / "index.html").read_text(encoding="utf-8")
        for name, there in zip(names, (True, True, False)):
            self.assertEqual(there, name in site, name)
        shutil.rmtree(self.slurm / "results" / names[1])
        shutil.copytree(self.slurm / "results" / names[0], self.slurm / "results" / names[1])
        shutil.copytree(self.slurm / "results" / names[0], self.slurm / "results" / names[2])
        kept = self.slurm / "results" / names[2] / "results.json"
        kept.write_bytes(kept.read_bytes()[:-100])
        again = self.run_program("report", self.slurm, "--out", self.folder / "site")
        self.assert_status(again, FELL_SHORT)
        doubled, broken = again.stderr.splitlines()
        self.assertEqual(f"crossgrain: {names[1]}: doubled: its folder holds the results of {names[0]}", doubled)
        self.assertTrue(broken.startswith(f"crossgrain: {names[2]}: broken: "), broken)
        self.assertFalse(list(self.folder.rglob("pwned")))

        # A job that is run again goes on from what is there.
        before = (self.slurm / "results" / names[0] / "runs" / "grain-p0.json").stat().st_mtime_ns
        self.bash("array.sh", SLURM_ARRAY_TASK_ID="1")
        self.assertEqual(before, (self.slurm / "results" / names[0] / "runs" / "grain-p0.json").stat().st_mtime_ns)

    def test_nothing_to_merge(self):
        self.assert_status(self.plan(), HELD)
        done = self.run_program("report", self.slurm, "--out", self.folder / "site")
        self.assert_status(done, BAD_INPUT)
        missing, last = done.stderr.splitlines()
        self.assertIn("missing: it has not begun", missing)
        self.assertIn("none of its 1 jobs has results", last)
        self.assertFalse((self.folder / "site").exists())
        self.assert_one_line(self.run_program("report", self.slurm), BAD_INPUT, "holds a plan", "--out")

    def test_submits_the_array_and_then_the_merging(self):
        self.assert_status(self.plan("--seeds=1,2"), HELD)
        tools = self.folder / "bin"
        tools.mkdir()
        sbatch = tools / "sbatch"
        sbatch.write_text('#!/bin/sh\nprintf "%s|" "$PWD" "$@" >> "$LOG"; echo >> "$LOG"; echo "17;cluster"\n')
        sbatch.chmod(0o755)
        log = self.folder / "log"
        done = subprocess.run(
            [self.slurm / "submit", "--comment=a b"], cwd="/", capture_output=True, encoding="utf-8", check=False,
            env=os.environ | {"PATH": f"{tools}:{os.environ['PATH']}", "LOG": str(log)},
        )  # fmt: skip
        self.assertEqual((0, ""), (done.returncode, done.stderr))
        self.assertEqual(
            [
                f"{self.slurm}|--parsable|--comment=a b|array.sh|",
                f"{self.slurm}|--parsable|--dependency=afterany:17|--comment=a b|merge.sh|",
            ],
            log.read_text(encoding="utf-8").splitlines(),
        )
        self.assertIn("#SBATCH --array=1-2\n", (self.slurm / "array.sh").read_text(encoding="utf-8"))

    def test_bad_input(self):
        for arguments, told in (
            (("--sweep=law.mu",), "must be KEY=VALUE"),
            (("--sweep=law.my=0.2",), "law.my"),
            (("--sweep=law.mu=0.2", "--sweep=law.mu=0.2"), "stands twice"),
            (("--seeds=1,x",), "'x' must be a whole number"),
            (("--seeds=1,1",), "stands twice"),
            (("--budget=10x",), "--budget 10x"),
        ):
            with self.subTest(arguments):
                self.assert_one_line(self.plan(*arguments), BAD_INPUT, told)
                self.assertFalse(self.slurm.exists())
        for engines, told in (("grain,yad", "yad"), ("all", "one by one"), ("grain,,yade", "empty"), ("grain,grain", "twice")):
            with self.subTest(engines):
                self.assert_one_line(self.plan(engines=engines), BAD_INPUT, told)
        self.slurm.mkdir()
        (self.slurm / "mine").touch()
        self.assert_one_line(self.plan(), BAD_INPUT, "is there already")


if __name__ == "__main__":
    unittest.main()
