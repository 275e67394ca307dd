"""Counts what a step does, and says how far it is from what memory can give.

    python3 tests/bench/count.py [--disks 100000] [--precision float] [--effects thesis]

Runs the same benchmark twice: once for its time and the stream test, once under callgrind for
instructions and for the cache lines that a simulated cache of --cache bytes fetches and writes misses
to. Choose it small against the packing (README.md): what the cache keeps is not counted.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEP = "grain::Core<{}>::step(bool*"  # counted while this function runs
LINE = 64  # bytes


def run(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{command[0]} failed:\n{done.stderr[-2000:]}")
    return done


def benchmark(options, pattern, prefix=(), min_time="1"):
    """The benchmarks' figures by name, and what was printed on stderr."""
    command = [
        *prefix, str(options.build / "tests" / "bench" / "grain_bench"), "--benchmark_format=json",
        f"--benchmark_filter={pattern}", f"--benchmark_min_time={min_time}",
    ]  # fmt: skip
    if options.packings:
        command.append(f"--packings={options.packings}")
    done = run(command)
    entries = json.loads(done.stdout)["benchmarks"]
    return {entry["name"].split("/")[0]: entry for entry in entries}, done.stderr


def counted(options, pattern):
    """Events per step. With so short a time one iteration is all that the benchmark runs."""
    valgrind = [
        "valgrind", "--tool=callgrind", f"--toggle-collect={STEP.format(options.precision)}", "--cache-sim=yes",
        f"--LL={options.cache},16,{LINE}", f"--callgrind-out-file={os.devnull}",
    ]  # fmt: skip
    figures, log = benchmark(options, pattern, valgrind, "1e-9")
    # A child that the program forks reports first, and counted nothing.
    names = re.findall(r"Events\s*:(.*)", log)[-1].split()
    values = map(int, re.findall(r"Collected\s*:(.*)", log)[-1].split())
    steps = figures["step"]["steps_run"]
    return {name: value / steps for name, value in zip(names, values)}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--packings", help="folder of the packings")
    parser.add_argument("--disks", type=int, default=100000)
    parser.add_argument("--effects", default="thesis")
    parser.add_argument("--precision", default="double")
    parser.add_argument("--cache", type=int, default=1 << 20, help="bytes")
    options = parser.parse_args()

    pattern = f"^step/{options.disks}/{options.effects}/{options.precision}/1/"
    timed, _ = benchmark(options, f"{pattern}|^stream/1/")
    events = counted(options, pattern)

    step, stream = timed["step"], 1e9 * timed["stream"]["GB_s"]
    seconds, contacts = 1e-6 * step["us_step"], step["contacts"]
    lines = events["DLmr"] + events["DLmw"]
    rows = [
        ("instructions", events["Ir"]),
        ("loads", events["Dr"]),
        ("stores", events["Dw"]),
        ("bytes fetched, counted", LINE * lines),
        ("bytes, model", step["model_bytes"]),
    ]
    print(f"{'':<28}{'per step':>16}{'per disk':>12}{'per contact':>13}")
    for title, value in rows:
        print(f"{title:<28}{value:>16,.0f}{value / options.disks:>12.1f}{value / contacts:>13.1f}")
    print(f"\n{options.disks} disks, {contacts:.0f} contacts, {1e6 * seconds:.1f} us a step")
    print(f"instructions per ns          {events['Ir'] / (1e9 * seconds):8.2f}")
    print(f"stream, 1 thread             {1e-9 * stream:8.1f} GB/s")
    print(f"counted bytes: at the stream's rate they take {LINE * lines / stream / seconds:.0%} of the step")
    print(f"model's bytes: at the stream's rate they take {step['model_bytes'] / stream / seconds:.0%} of the step")


if __name__ == "__main__":
    main()
