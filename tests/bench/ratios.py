"""The ratios that the benchmarks are for, from one run's figures.

    grain_bench --benchmark_out=bench.json --benchmark_out_format=json \
      --benchmark_repetitions=3 --benchmark_enable_random_interleaving=true
    python3 tests/bench/ratios.py bench.json

All are of `us_step`, the time of a step without a rebuild, the fastest repetition of each. Pairs of which one was not measured are left out.
"""

import json
import pathlib
import sys

SIZES = (1000, 10000, 100000, 1000000)


class Figures:
    def __init__(self, file):
        entries = json.loads(pathlib.Path(file).read_text())["benchmarks"]
        self.by_name = {}
        for entry in sorted(entries, key=lambda entry: entry["real_time"], reverse=True):
            if entry["run_type"] == "iteration":  # not a mean over repetitions; the fastest comes last
                self.by_name[entry["run_name"].removesuffix("/manual_time")] = entry

    def counter(self, name, counter="us_step"):
        return self.by_name.get(name, {}).get(counter)

    def ratio(self, over, under):
        a, b = self.counter(over), self.counter(under)
        return a / b if a and b else None


def row(title, values):
    cells = "".join(f"{value:>10.2f}" if value is not None else f"{'-':>10}" for value in values)
    print(f"{title:<46}{cells}")


def ratios(figures, title, over, under):
    row(title, [figures.ratio(over.format(n), under.format(n)) for n in SIZES])


def counters(figures, title, name, counter="us_step", scale=1.0):
    found = [figures.counter(name.format(n), counter) for n in SIZES]
    row(title, [value and scale * value for value in found])


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    figures = Figures(sys.argv[1])
    step, same = "step/{}/", "same_contacts/{}/"
    print(f"{'disks':<46}" + "".join(f"{n:>10}" for n in SIZES))
    for precision in ("double", "float"):
        for threads in (1, 2):
            name = f"{step}thesis/{precision}/{threads}"
            counters(figures, f"ns per disk, {precision}, threads {threads}", name, "ns_disk")
    thesis = step + "thesis/double/1"
    counters(figures, "ns per contact, double", thesis, "ns_contact")
    counters(figures, "contacts / 1000", thesis, "contacts", 1e-3)
    counters(figures, "model bytes / stream bandwidth / time", thesis, "of_stream")
    counters(figures, "  the same, threads 2", step + "thesis/double/2", "of_stream")
    counters(figures, "rebuilds in 1000 steps", thesis, "rebuilds_per_1000")
    counters(figures, "ns per disk of a rebuild", "rebuild/{}/thesis/double/1", "ns_disk")
    ratios(figures, "friction / none, same contacts",
           same + "thesis/double/1", same + "no_friction/double/1")  # fmt: skip
    ratios(figures, "  the same without bottom plate",
           same + "no_bottom/double/1", same + "no_friction_no_bottom/double/1")  # fmt: skip
    for name in ("no_bottom", "viscous", "coulomb", "cut_tension", "no_rotation"):
        ratios(figures, f"thesis / {name}, same contacts",
               same + "thesis/double/1", f"{same}{name}/double/1")  # fmt: skip
    for name in ("rolling", "cohesion", "rolling_cohesion", "materials", "rolling_cohesion_materials", "ledger"):
        ratios(figures, f"{name} / thesis, same contacts",
               f"{same}{name}/double/1", same + "thesis/double/1")  # fmt: skip
    ratios(figures, "double / float", thesis, step + "thesis/float/1")
    ratios(figures, "1 thread / 2", thesis, step + "thesis/double/2")
    ratios(figures, "1 thread / 2, float", step + "thesis/float/1", step + "thesis/float/2")
    for threads in (1, 2):
        rate = figures.counter(f"stream/{threads}", "GB_s")
        if rate:
            print(f"stream, threads {threads}: {rate:.1f} GB/s")


if __name__ == "__main__":
    main()
