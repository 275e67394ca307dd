"""A campaign that is killed, that finds the disk full, that sees the clock set back: whatever happens to it, the same
command goes on and ends with the results of one that nothing happened to.

    endurance.py --crossgrain PROGRAM --mishaps LIBRARY --out FOLDER [--kills 100] [--full 50] [--clocks 5] [--seed 1]

Instants and writes are drawn from the seed. One line for each that went wrong, a summary at the end; exit status 1 if any
did.
"""

import argparse
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "golden"))
from golden import TRANSIENT  # noqa: E402

PACKINGS = 2
CASE = [
    "compare", "cases/couette/quick.toml", "--engines", "grain,box2d-penalty", f"--set=preparation.packings={PACKINGS}",
    "--set=preparation.rotations=0", "--set=averaging.rotations=0.02", "--quiet",
]  # fmt: skip
HELD, FELL_SHORT, ENGINE_FAILED = 0, 1, 3


def lasting(value):
    """Without what depends on the machine, the time of day or how long anything took."""
    if isinstance(value, dict):
        return {key: lasting(item) for key, item in value.items() if key not in TRANSIENT}
    return [lasting(item) for item in value] if isinstance(value, list) else value


class Campaign:
    def __init__(self, options):
        self.program = str(options.crossgrain.resolve())
        self.folder = options.out.resolve()
        self.mishaps = str(options.mishaps.resolve())
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def begin(self, out, **environment):
        """In a process group of its own. Packings are prepared anew in each trial: they are part of what is interrupted."""
        return subprocess.Popen(
            [self.program, *CASE, "--out", str(out)], cwd=ROOT, start_new_session=True, encoding="utf-8",
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
            env=os.environ | {"CROSSGRAIN_CACHE": str(out) + "-cache", "TMPDIR": str(self.scratch(out))} | environment,
        )  # fmt: skip

    def scratch(self, out):
        folder = pathlib.Path(str(out) + "-tmp")
        folder.mkdir(exist_ok=True)
        return folder

    def finish(self, out, **environment):
        process = self.begin(out, **environment)
        said = process.communicate()[1]
        return process.returncode, said

    def results(self, out):
        return lasting(json.loads((out / "results.json").read_text(encoding="utf-8")))

    def clear(self, out):
        for folder in (out, f"{out}-cache", f"{out}-tmp"):
            shutil.rmtree(folder, ignore_errors=True)

    def goes_on(self, out, expected):
        """What is wrong with the results of the same command once more; absent: nothing."""
        status, said = self.finish(out)
        if status not in (HELD, FELL_SHORT):
            return f"does not go on: status {status}, {said.strip()[-300:]}"
        if self.results(out) != expected:
            return "other results than an undisturbed run"
        return None

    def killed(self, out, after):
        """kill -9 of the program and all its workers."""
        process = self.begin(out)
        try:
            process.communicate(timeout=after)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
        return None

    def full(self, out, at):
        status, said = self.finish(out, LD_PRELOAD=self.mishaps, FULL_DISK_AT=str(at))
        if status in (HELD, FELL_SHORT):
            return None  # a packing that cannot be kept costs time, not the run
        lines = [line for line in said.splitlines() if line.startswith("crossgrain: ")]
        if status != ENGINE_FAILED or not lines:
            return f"status {status} and no line of its own: {said.strip()[-300:]}"
        if not any("No space left on device" in line for line in lines):
            return f"does not say that the disk is full: {lines}"
        return None

    def clock(self, out, after):
        status, said = self.finish(out, LD_PRELOAD=self.mishaps, CLOCK_BACK_AFTER=str(after))
        return None if status in (HELD, FELL_SHORT) else f"status {status}, {said.strip()[-300:]}"

    def trials(self, name, happen, draws, expected):
        failures = 0
        for trial, draw in enumerate(draws):
            out = self.folder / f"{name}-{trial}"
            wrong = happen(out, draw) or self.goes_on(out, expected)
            if wrong:
                failures += 1
                print(f"{name} {trial} ({draw:.6g}): {wrong}", flush=True)
            else:
                self.clear(out)
        print(f"{name}: {len(draws) - failures} of {len(draws)} went on to the same results", flush=True)
        return failures


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--crossgrain", type=pathlib.Path, required=True)
    parser.add_argument("--mishaps", type=pathlib.Path, required=True, help="library for LD_PRELOAD")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--full", type=int, default=50)
    parser.add_argument("--clocks", type=int, default=5)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    campaign = Campaign(options)
    draw = random.Random(options.seed)

    clean, count = campaign.folder / "undisturbed", campaign.folder / "writes"
    began = time.monotonic()
    status, said = campaign.finish(clean, LD_PRELOAD=campaign.mishaps, FULL_DISK_COUNT=str(count))
    seconds = time.monotonic() - began
    if status not in (HELD, FELL_SHORT):
        sys.exit(f"the undisturbed campaign fails: status {status}, {said}")
    expected = campaign.results(clean)
    runs = [run for run in expected["runs"] if run.get("status") == "finished"]
    if len(runs) < PACKINGS:
        sys.exit(f"the undisturbed campaign has {len(runs)} runs")
    writes = max(int(line) for line in count.read_text().splitlines())
    print(f"undisturbed: {seconds:.1f} s, {len(runs)} runs, {writes} writes of the program", flush=True)

    failures = campaign.trials("killed", campaign.killed, [draw.uniform(0.0, seconds) for _ in range(options.kills)], expected)
    failures += campaign.trials("full", campaign.full, [draw.randint(1, writes) for _ in range(options.full)], expected)
    failures += campaign.trials("clock", campaign.clock, [draw.randint(0, 20) for _ in range(options.clocks)], expected)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
