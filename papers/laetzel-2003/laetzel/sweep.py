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

from laetzel.campaign import FINE_FIELDS, by_volume, collisions_of, profiles_of, rounded, run_of
from laetzel.tables import SPAN_NUMBERS

PROJECT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(PROJECT / "python"))
import crossgrain  # noqa: E402

FIGURE_4_3 = PROJECT / "cases/collision/figure-4-3.toml"
ALL = 1000  # packings whose snapshots are kept


class Sweep:
    """The file of a sweep: README.md has its keys."""

    def __init__(self, file):
        try:
            given = {"rotations": [5, 8], "snapshots": 200, "fine_rings": 60, "set": []} | tomllib.loads(file.read_text(encoding="utf-8"))
        except tomllib.TOMLDecodeError as error:
            raise ValueError(f"{file}: {error}") from error
        if missing := [key for key in ("base", "legs", "rungs") if key not in given]:
            raise ValueError(f"{file}: has no {missing[0]}")
        legs, self.rungs, common = given.pop("legs"), given.pop("rungs"), given.pop("set")
        case = file.parent / given.pop("base")
        lacks = [f"a leg without {key}: {leg}" for leg in legs for key in ("name", "nu", "families") if key not in leg]
        lacks += [f"unknown key {key}" for key in given if key not in ("rotations", "snapshots", "fine_rings")]
        lacks += [f"a rung of no leg: {name}" for rung in self.rungs for name in rung.get("legs", []) if name not in {leg["name"] for leg in legs}]
        families = {family for leg in legs for family in leg.get("families", [])}
        lacks += [f"a rung of no family: {name}" for rung in self.rungs for name in rung.get("families", []) if name not in families]
        if lacks:
            raise ValueError(f"{file}: {lacks[0]}")
        self.legs = {leg["name"]: {**given, **leg, "case": case, "set": common + leg.get("set", [])} for leg in legs}

    def wanted(self):
        """(leg, packing) of all runs, each once: rung by rung, in a rung packing by packing, then leg by leg."""
        runs = {}
        for rung in self.rungs:
            of_rung = lambda leg: leg["name"] in rung.get("legs", []) or set(leg["families"]) & set(rung.get("families", []))
            for packing in range(rung.get("packings", 1)):
                runs |= {(leg["name"], packing): (leg, packing) for leg in filter(of_rung, self.legs.values())}
        return list(runs.values())


class Maker:
    """Makes runs; what is finished stays in the folder `out`."""

    def __init__(self, program, engine, out):
        self.program, self.engine, self.out = program, engine, out

    def call(self, command, *arguments, out, settings=()):
        sets = [word for setting in settings for word in ("--set", setting)]
        words = [self.program, command, *map(str, arguments), *sets, "--quiet", "--out", str(out)]
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode not in (0, 1):  # 1: a finding, no failure
            print(f"{' '.join(words)}\n{done.stderr.strip()}", file=sys.stderr)
            raise SystemExit(done.returncode)
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
        settings = ["averaging.settle_rotations=0", f"averaging.rotations={end}", f"averaging.snapshots_per_rotation={per_rotation}"]
        settings += [f"run.keep_snapshots={math.ceil(per_rotation * end)}", f"run.keep_snapshots_of={ALL}"]
        settings = [*leg["set"], *settings, f"preparation.packings={packing + 1}"]
        results = self.call("compare", leg["case"], "--engines", self.engine, out=folder, settings=settings)
        [run] = [run for run in results.runs() if run["packing"] == packing]
        case, cell = tomllib.loads(results.document["case"]["toml"]), results.document["cell"]
        file = folder / "snapshots" / f"{self.engine}-p{packing}.h5"
        average = lambda start, stop, *more: self._average(leg, 2 * math.pi / abs(cell["omega"]), file, start, stop, *more)
        averaged, fine = run_of(average(settle, end)), average(settle, end, f"averaging.rings={leg['fine_rings']}")
        edges = [*np.arange(0, settle), *np.arange(settle, end), end]
        history = [span_of(average(a, b), cell, a, b) for a, b in zip(edges, edges[1:])]
        file.unlink()  # gigabytes in a sweep
        head = {row["name"]: row["value"] for row in run["head"]} | {k: v for k, v in averaged["head"].items() if v is not None}
        cost = {"cpu_s": run["stats"]["cpu_s"], "steps": run["stats"]["steps"], "dt": run["realised"]["dt"]}
        rings = {str(leg["fine_rings"]): profiles_of(fine["profiles"], FINE_FIELDS)}
        made = {"leg": leg["name"], "engine": self.engine, "packing": packing, "seed": case["preparation"]["seed"]}
        return leg_of(leg, case, cell), made | averaged | cost | {"head": head, "fine": rings, "history": history}

    def _average(self, leg, rotation, file, start, end, *settings):
        """A run of results.json: of the snapshots from a rotation [s] to another alone."""
        with tempfile.TemporaryDirectory(dir=self.out) as scratch:
            window = pathlib.Path(scratch) / "window.h5"
            with h5py.File(file) as everything, h5py.File(window, "w") as some:
                some.attrs.update(everything.attrs)
                half, count = 0.5 / leg["snapshots"], 0  # snapshots come at the end of what they stand for
                for name in sorted(everything, key=lambda name: (len(name), name)):
                    if not name.startswith("snapshot-"):
                        everything.copy(name, some)
                    elif start <= everything[name]["time"][0] / rotation - half < end:
                        everything.copy(name, some, f"snapshot-{count:03d}")
                        count += 1
            out = pathlib.Path(scratch) / "averaged"
            return self.call("average", window, leg["case"], out=out, settings=[*leg["set"], *settings]).runs()[0]


def leg_of(leg, case, cell):
    """What a campaign's file says of a leg; case: as it was resolved"""
    law, particles, (settle, end) = case["law"], case["particles"], leg["rotations"]
    return {
        **{"name": leg["name"], "label": leg["nu"], "families": leg["families"], "cell": cell},
        **{"kn": law["kn"], "kt": law.get("kt", 0.0), "mu": law.get("mu", 0.0), "large_mass": particles["large_mass"]},
        "bottom_friction": case.get("bottom", {}).get("mu", 0.0) > 0,
        **{"settle_rotations": settle, "averaged_rotations": end - settle},
        "law": {"kn": law["kn"], "gn": law["gn"], "small_mass": particles["small_mass"]},
    }


def span_of(run, cell, start, end):
    """The history's numbers of a part of a run: means over its snapshots, the largest overlap of all of them."""
    series = {name: np.array(values, float) for name, values in run["series"].items()}
    profiles = {p["field"]: np.array(p["mean"], float) for p in reversed(by_volume(run["profiles"]))}
    nu, rim, half = profiles["volume_fraction"], cell["omega"] * cell["inner_radius"], len(profiles["volume_fraction"]) // 2
    width = (cell["outer_radius"] - cell["inner_radius"]) / len(nu)
    volumes = cell["inner_radius"] + (np.arange(len(nu)) + 0.5) * width  # go as rings' middles
    numbers = {name: np.mean(values) for name, values in series.items()}
    numbers |= {"max_overlap": np.max(series["max_overlap"]), "wheel_touched": np.mean(series["wheel_contacts"] > 0)}
    numbers |= {"volume_fraction_at_wheel": nu[0], "velocity_at_wheel": profiles["azimuthal_velocity"][0] / rim}
    numbers["volume_fraction_outside"] = np.sum((nu * volumes)[half:]) / np.sum(volumes[half:])
    values = [float(numbers[name]) if np.isfinite(numbers[name]) else None for name in SPAN_NUMBERS]
    return {"from": float(start), "to": float(end)} | dict(zip(SPAN_NUMBERS, rounded(values, 6)))


def climb(sweep, maker, earlier, budget, say):
    """A campaign's document of all runs that the budget [s] has room for: none begins after it. Runs of an earlier document are
    taken where their leg has the same rotations."""
    begun, legs, runs, left = time.monotonic(), {}, [], 0
    taken = {(run["leg"], run["packing"]): run for run in earlier["runs"] if run["engine"] == maker.engine}
    before = {leg["name"]: leg for leg in earlier["legs"]}
    collisions = earlier["collisions"] or maker.collisions()
    for leg, packing in sweep.wanted():
        name, (settle, end), known = leg["name"], leg["rotations"], before.get(leg["name"], {})
        as_before = math.isclose(known.get("settle_rotations", -1), settle) and math.isclose(known["averaged_rotations"], end - settle)
        if as_before and (name, packing) in taken:
            legs[name] = known
            runs.append(taken[name, packing])
        elif time.monotonic() - begun > budget:
            left += 1
        else:
            say(f"{name}, packing {packing}")
            legs[name], run = maker.run(leg, packing)
            runs.append(run)
    if left:
        say(f"{left} runs were left out: the budget is spent")
    return {"made_by": [maker.program], "collisions": collisions, "legs": [legs[n] for n in sweep.legs if n in legs], "runs": runs}
