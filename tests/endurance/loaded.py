"""Tests on a machine that is busy with ten times what it can do: none may fail by time alone.

    loaded.py --build build/release [--times 10] [-- what else ctest is told, e.g. -R 'system.(effects|yade|failures)']

So many programs that only count run for each core meanwhile, at the tests' own priority. Exit status of ctest.
"""

import argparse
import os
import pathlib
import signal
import subprocess
import sys

COUNTING = "while True: pass"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--times", type=int, default=10, help="programs for each core")
    parser.add_argument("ctest", nargs="*", metavar="-- ARGUMENT", help="of ctest")
    options = parser.parse_args()
    # Whoever ends this ends the counting, too.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    count = options.times * len(os.sched_getaffinity(0))
    others = [subprocess.Popen([sys.executable, "-c", COUNTING]) for _ in range(count)]
    try:
        return subprocess.run(["ctest", "--test-dir", options.build, "--output-on-failure", *options.ctest]).returncode
    finally:
        for other in others:
            other.kill()
            other.wait()


if __name__ == "__main__":
    sys.exit(main())
