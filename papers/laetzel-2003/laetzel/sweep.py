"""Makes the runs of a sweep by crossgrain's commands: `compare` runs a packing from the closing of the ring to the end and keeps
snapshots of it, `average` makes numbers of those of the averaged rotations, on two widths of rings, and of every rotation."""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time
import tomllib

import h5py
import numpy as np

from laetzel.campaign import FINE_FIELDS, collisions_of, profiles_of, rounded, run_of
from laetzel.tables import SPAN_NUMBERS

PAPER = pathlib.Path(__file__).resolve().parents[1]
PROJECT = PAPER.parents[1]
sys.path.insert(0, str(PROJECT / "python"))
import crossgrain  # noqa: E402

FIGURE_4_3 = PROJECT / "cases/collision/figure-4-3.toml"
ALL = 1000  # packings whose snapshots are kept


class Sweep:
    """The file of a sweep: README.md has its keys."""

    def __init__(self, file):
        self.file = pathlib.Path(file)
        document = tomllib.loads(self.file.read_text(encoding="utf-8"))
        shared = {key: document.pop(key, value) for key, value in (("rotations", [5, 8]), ("snapshots", 200), ("fine_rings", 60))}
        base, common = self.file.parent / document.pop("base"), document.pop("set", [])
        self.legs = {}
        for leg in document.pop("legs"):
            self.legs[leg["name"]] = {**shared, **leg, "case": base, "set": common + leg.get("set", [])}
        self.rungs = document.pop("rungs")
        if document:
            raise ValueError(f"{file}: unknown keys {', '.join(document)}")

    def wanted(self):
        """(leg, packing) of all runs, each once: rung by rung, in a rung packing by packing, then leg by leg."""
        runs = {}
        for rung in self.rungs:
            for packing in range(rung.get("packings", 1)):
                for leg in self.legs.values():
                    if leg["name"] in rung.get("legs", []) or set(leg["families"]) & set(rung.get("families", [])):
                        runs[leg["name"], packing] = leg
        return [(leg, packing) for (_, packing), leg in runs.items()]


class Maker:
    """Makes runs; what is finished stays in the folder `out`."""

    def __init__(self, program, engine, out):
        self.program, self.engine, self.out = program, engine, pathlib.Path(out)

    def call(self, command, *arguments, out, settings=()):
        sets = [word for setting in settings for word in ("--set", setting)]
        words = [self.program, command, *map(str, arguments), *sets, "--quiet", "--out", str(out)]
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode not in (0, 1):  # 1: a finding, no failure
            raise SystemExit(f"{' '.join(words)}\n{done.stderr.strip()}")
        return crossgrain.Results(out)

    def collisions(self):
        results = self.call("collide", FIGURE_4_3, "--engines", self.engine, out=self.out / "collisions")
        return collisions_of(results.document["variants"])

    def run(self, leg, packing):
        """(leg, run) as a campaign's file has them"""
        file = self.out / "runs" / f"{leg['name']}-p{packing}.json"
        if not file.exists():
            made = self._made(leg, packing)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(json.dumps(made), encoding="utf-8")
        return json.loads(file.read_text(encoding="utf-8"))

    def _made(self, leg, packing):
        folder, (settle, end), per_rotation = self.out / "work" / leg["name"], leg["rotations"], leg["snapshots"]
        times = ["settle_rotations=0", f"rotations={end}", f"snapshots_per_rotation={per_rotation}"]
        keep = [f"run.keep_snapshots={math.ceil(per_rotation * end)}", f"run.keep_snapshots_of={ALL}"]
        settings = leg["set"] + [f"averaging.{each}" for each in times] + keep + [f"preparation.packings={packing + 1}"]
        results = self.call("compare", leg["case"], "--engines", self.engine, out=folder, settings=settings)
        of_leg = leg_of(leg, results.document)
        [run] = [run for run in results.runs() if run["packing"] == packing]
        file = folder / "snapshots" / f"{self.engine}-p{packing}.h5"
        averaged = self._average(leg, of_leg, file, settle, end)
        fine = self._average(leg, of_leg, file, settle, end, [f"averaging.rings={leg['fine_rings']}"])
        edges = [*np.arange(0, settle), *np.arange(settle, end), end]
        history = [span_of(self._average(leg, of_leg, file, a, b), of_leg, a, b) for a, b in zip(edges, edges[1:])]
        file.unlink()  # gigabytes in a sweep
        seed = tomllib.loads(results.document["case"]["toml"])["preparation"]["seed"]
        made = {"leg": leg["name"], "engine": self.engine, "packing": packing, "seed": seed, **run_of(averaged)}
        made["head"] = {row["name"]: row["value"] for row in run["head"]} | {k: v for k, v in made["head"].items() if v is not None}
        made |= {"cpu_s": run["stats"]["cpu_s"], "steps": run["stats"]["steps"], "dt": run["realised"]["dt"]}
        made |= {"fine": {str(leg["fine_rings"]): profiles_of(fine["profiles"], FINE_FIELDS)}, "history": history}
        return of_leg, made

    def _average(self, leg, of_leg, file, start, end, settings=()):
        """A run of results.json: of the snapshots from a rotation to another alone."""
        rotation = 2 * math.pi / abs(of_leg["cell"]["omega"])
        with tempfile.TemporaryDirectory(dir=self.out) as scratch:
            window = pathlib.Path(scratch) / "window.h5"
            with h5py.File(file) as all_of_them, h5py.File(window, "w") as some:
                some.attrs.update(all_of_them.attrs)
                half, count = 0.5 / leg["snapshots"], 0  # snapshots come at the end of what they stand for
                for name in sorted(all_of_them, key=lambda name: (len(name), name)):
                    if not name.startswith("snapshot-"):
                        all_of_them.copy(name, some)
                    elif start <= all_of_them[name]["time"][0] / rotation - half < end:
                        all_of_them.copy(name, some, f"snapshot-{count:03d}")
                        count += 1
            out = pathlib.Path(scratch) / "averaged"
            return self.call("average", window, leg["case"], out=out, settings=[*leg["set"], *settings]).runs()[0]


def leg_of(leg, document):
    """What a campaign's file says of a leg, from the results of its case."""
    case = tomllib.loads(document["case"]["toml"])
    law, particles = case["law"], case["particles"]
    settle, end = leg["rotations"]
    return {
        "name": leg["name"],
        "label": leg["nu"],
        "families": leg["families"],
        "cell": document["cell"],
        "kn": law["kn"],
        "kt": law.get("kt", 0.0),
        "mu": law.get("mu", 0.0),
        "large_mass": particles["large_mass"],
        "bottom_friction": case.get("bottom", {}).get("mu", 0.0) > 0,
        "settle_rotations": settle,
        "averaged_rotations": end - settle,
        "law": {"kn": law["kn"], "gn": law["gn"], "small_mass": particles["small_mass"]},
    }


def span_of(run, leg, start, end):
    """The history's numbers of a part of a run: means over its snapshots, the largest overlap of all of them."""
    series = {name: np.array(values, float) for name, values in run["series"].items()}
    profiles = {p["field"]: np.array(p["mean"], float) for p in reversed(run["profiles"])}
    nu, cell = profiles["volume_fraction"], leg["cell"]
    radius = cell["inner_radius"] + (np.arange(len(nu)) + 0.5) * (cell["outer_radius"] - cell["inner_radius"]) / len(nu)  # of rings' middles, as which volumes go
    half = len(nu) // 2
    numbers = {name: np.mean(values) for name, values in series.items()} | {
        "max_overlap": np.max(series["max_overlap"]),
        "wheel_touched": np.mean(series["wheel_contacts"] > 0),
        "volume_fraction_at_wheel": nu[0],
        "volume_fraction_outside": np.sum((nu * radius)[half:]) / np.sum(radius[half:]),
        "velocity_at_wheel": profiles["azimuthal_velocity"][0] / (cell["omega"] * cell["inner_radius"]),
    }
    values = [float(numbers[name]) if np.isfinite(numbers[name]) else None for name in SPAN_NUMBERS]
    return {"from": float(start), "to": float(end)} | dict(zip(SPAN_NUMBERS, rounded(values, 6)))


def climb(sweep, maker, earlier, budget, say):
    """A campaign's document of all runs that the budget [s] has room for: none begins after it. Runs of an earlier document are
    taken where their leg is the same."""
    begun = time.monotonic()
    taken = {(run["leg"], run["packing"]): run for run in earlier["runs"] if run["engine"] == maker.engine}
    before = {leg["name"]: leg for leg in earlier["legs"]}
    legs, runs, left = {}, [], 0
    collisions = earlier["collisions"] or maker.collisions()
    for leg, packing in sweep.wanted():
        name, key = leg["name"], (leg["name"], packing)
        if key in taken and [before[name]["settle_rotations"], before[name]["averaged_rotations"]] == list(of_rotations(leg)):
            legs.setdefault(name, before[name])
            runs.append(taken[key])
        elif time.monotonic() - begun > budget:
            left += 1
        else:
            say(f"{name}, packing {packing}")
            legs[name], run = maker.run(leg, packing)
            runs.append(run)
    if left:
        say(f"{left} runs were left out: the budget is spent")
    ordered = [legs[name] for name in sweep.legs if name in legs]
    return {"made_by": [maker.program], "collisions": collisions, "legs": ordered, "runs": runs}


def of_rotations(leg):
    settle, end = leg["rotations"]
    return settle, end - settle
