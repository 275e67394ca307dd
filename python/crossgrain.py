"""Reads what crossgrain writes: results folders and files of snapshots, as numpy arrays in SI units.

    import crossgrain
    results = crossgrain.Results("out/compare")
    profile = results.profile("stress_rr", engine="grain")      # profile.r, profile.mean, profile.stderr
    with crossgrain.Snapshots("out/compare/snapshots/grain-p0.h5") as snapshots:
        for snapshot in snapshots:
            snapshot.contacts.force                               # (contacts, 2), on disk i [N]

    crossgrain.plot_profile(results, "stress_rr")             # every engine, with error bars
    crossgrain.plot_endpoints(results)                        # every verdict, in margins

Absent numbers are NaN. Needs numpy, h5py for snapshots, matplotlib for plots and pandas for frames. docs/results.md
and docs/files.md have the layouts.
"""

import csv
import dataclasses
import json
import pathlib

import numpy as np

__version__ = "1.0.0"  # that of CMakeLists.txt
SCHEMA = "crossgrain-results-1"


def _numbers(values):
    """Numbers and nulls as doubles."""
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def _column(values):
    """Doubles where all values are numbers, booleans or null; else as they are."""
    if all(value is None or isinstance(value, (int, float)) for value in values):
        return _numbers(values)
    return np.array(["" if value is None else value for value in values], dtype=object)


class Table(dict):
    """Columns by name, arrays of one length: doubles with NaN where a number is absent, else objects."""

    def frame(self):
        """The same as a pandas.DataFrame, of which notebooks draw tables."""
        import pandas

        return pandas.DataFrame(self)

    def __repr__(self):
        rows = len(next(iter(self.values()))) if self else 0
        return f"<Table of {rows} row{'' if rows == 1 else 's'}: {', '.join(self)}>"


def _table(rows):
    """Columns of dicts, in the order in which their names first come."""
    names = dict.fromkeys(name for row in rows for name in row)
    return Table({name: _column([row.get(name) for row in rows]) for name in names})


def _one(found, what, names):
    if not found:
        raise KeyError(f"there is no {what}; there are {', '.join(sorted({str(name) for name in names})) or 'none'}")
    return found[0]


@dataclasses.dataclass
class Profile:
    """One field in the bins of one engine: time means over a run, or over all of its packings."""

    engine: str  #: whose runs it is of
    packing: object  #: index of the packing, or "all": the mean over packings
    method: str  #: of weighing disks: "slicing", "centre", …
    field: str  #: as in profiles.csv: "volume_fraction", "stress_rr", …
    unit: str  #: of mean and stderr
    mean: np.ndarray  #: one number for each bin; NaN: nothing was there to measure
    stderr: np.ndarray  #: standard error: within the run, or over packings
    n_eff: np.ndarray  #: independent samples that the run is worth
    r: np.ndarray  #: mean radius of each ring [m]; empty where bins are no rings
    x: np.ndarray  #: middle of each bin [m]; empty of rings
    y: np.ndarray  #: likewise [m]


class Results:
    """A results.json, of any command."""

    def __init__(self, path):
        """path: the folder of a command, or its results.json"""
        path = pathlib.Path(path)
        self.file = path / "results.json" if path.is_dir() else path
        self.folder = self.file.parent
        self.document = json.loads(self.file.read_text(encoding="utf-8"))  #: all of it, as docs/results.md has it
        if self.document.get("schema") != SCHEMA:
            raise ValueError(f'{self.file}: its schema is {self.document.get("schema")!r}, not {SCHEMA!r}')
        self.kind = self.document["kind"]  #: "compare", "collide", "lockstep", …
        self.case = self.document.get("case", {}).get("name")
        self.engines = [engine["name"] for engine in self.document.get("engines", [])]  #: the reference first

    def __repr__(self):
        return f"<Results of {self.kind}{f', case {self.case}' if self.case else ''}: {', '.join(self.engines) or 'no engine'}>"

    def _require(self, member, what):
        if member not in self.document:
            raise KeyError(f"{self.file}: results of {self.kind} have no {what}; there are {', '.join(self.document)}")
        return self.document[member]

    def _reference(self):
        return _one(self.engines, "engine", self.engines)

    def runs(self):
        """Finished runs, as results.json has them: one for each engine and packing."""
        return [run for run in self._require("runs", "runs") if run.get("status", "finished") == "finished"]

    def _all_profiles(self):
        rings, region = self.document.get("rings", {}), self.document.get("region", {})
        places = {name: _numbers(given.get(name, [])) for name, given in (("r", rings), ("x", region), ("y", region))}
        sources = [(run, run["packing"]) for run in self.runs()]
        sources += [(ensemble, "all") for ensemble in self.document.get("ensemble", [])]
        for source, packing in sources:
            if source.get("without"):  # an effect was switched off
                continue
            for profile in source.get("profiles", []):
                columns = {name: _numbers(profile.get(name, [])) for name in ("mean", "stderr", "n_eff")}
                yield Profile(source["engine"], packing, profile["method"], profile["field"], profile["unit"], **columns, **places)

    def runs_of_verdicts(self, engine):
        """Name of the engine whose runs verdicts on this one rest on: its mirror, where it is evaluated through that."""
        carried = self.document.get("endpoints", {}).get("carried", [])
        return next((own["mirror"] for own in carried if own["engine"] == engine and own["carried"]), engine)

    def profile(self, field, engine=None, packing=None, method=None):
        """One Profile. engine: default the reference; packing: an index, which is that single run of the engine, or "all",
        the mean over packings; default: what verdicts on the engine rest on, that is the mean of its own runs or, where it
        is evaluated through its mirror, of the mirror's, whose name the Profile then has. KeyError where that would be a
        single run beside means of others. method: default the first of the case, which verdicts are of."""
        everything = list(self._all_profiles())
        engine = engine or self._reference()
        method = method or self.document.get("averaging", {}).get("method")
        if packing is None:
            engine = self.runs_of_verdicts(engine)
        of_engine = [p for p in everything if p.engine == engine]
        _one(of_engine, f"profile of {engine}", {p.engine for p in everything})
        of_field = [p for p in of_engine if p.field == field and p.method == method]
        _one(of_field, f"field {field} by {method}", {f"{p.field} by {p.method}" for p in of_engine})
        if packing is None:
            runs = sum(p.packing != "all" for p in of_field)
            packing = "all" if runs > 1 else of_field[0].packing
            engines = [run["engine"] for run in self.runs() if not run.get("without")]
            if runs == 1 and len(engines) > len(set(engines)):  # some engine has several
                raise KeyError(f"no verdict rests on the single run of {engine}: ask for it by packing={packing}")
        return _one([p for p in of_field if p.packing == packing], f"packing {packing}", {p.packing for p in of_field})

    def profiles(self):
        """All profiles as a table, a row for each bin: engine, packing, method, field, bin (from 0), r or x and y [m],
        mean, stderr, n_eff, unit."""
        rows = []
        for p in self._all_profiles():
            for k in range(len(p.mean)):
                row = {"engine": p.engine, "packing": str(p.packing), "method": p.method, "field": p.field, "bin": k}
                row |= {name: places[k] for name, places in (("r", p.r), ("x", p.x), ("y", p.y)) if len(places)}
                rows.append(row | {"mean": p.mean[k], "stderr": p.stderr[k], "n_eff": p.n_eff[k], "unit": p.unit})
        return _table(rows)

    def series(self, engine=None, packing=None):
        """Series over time of one run: {"t_s": [s], "wheel_torque": [N m], "kinetic_energy": [J], …}; docs/results.md
        has their units. packing: default the first that finished."""
        engine = engine or self._reference()
        runs = [run for run in self.runs() if run["engine"] == engine and not run.get("without")]
        found = [run for run in runs if packing in (None, run["packing"]) and "series" in run]
        run = _one(found, f"series of {engine}, packing {packing}", {(r["engine"], r["packing"]) for r in self.runs()})
        return {name: _numbers(values) for name, values in run["series"].items()}

    def endpoints(self):
        """Verdicts on scalar outcome measures, a row for each pair of engines and endpoint: a, b, endpoint, unit,
        margin (margin_relative 1: of the reference), answer, difference with low and high [unit], distance [margins], …"""
        return _table([{k: v for k, v in row.items() if not isinstance(v, (list, dict))} for row in self._require("endpoints", "endpoints")["rows"]])

    def collisions(self):
        """Every collision of every engine, a row each: case, variant, engine, dt [s], psi_i, v_n [m/s], e_n, psi_f, … with
        "…_reference" of the oracle, SI units."""
        rows = []
        for variant in self._require("variants", "collisions"):
            reference = variant["reference"]
            places = {point: k for k, point in enumerate(zip(reference["psi_i"], reference["v_n"]))}
            for curve in variant["curves"]:
                points = curve["points"]
                for k, point in enumerate(zip(points.get("psi_i", []), points.get("v_n", []))):
                    row = {"case": variant["case"], "variant": variant["variant"], "engine": curve["engine"], "dt": curve["dt"]}
                    row |= {name: values[k] for name, values in points.items()}
                    at = places.get(point)
                    for name, values in reference.items():
                        if name in points and name not in ("psi_i", "v_n", "status", "reason"):
                            row[f"{name}_reference"] = None if at is None else values[at]
                    rows.append(row)
        return _table(rows)

    def table(self, name):
        """Any of the CSV files beside results.json, "claims" or "claims.csv", with its own columns."""
        file = self.folder / (name if name.endswith(".csv") else f"{name}.csv")
        if not file.exists():
            raise KeyError(f"there is no {file}; there are {', '.join(sorted(p.name for p in self.folder.glob('*.csv')))}")

        def value(text):
            if text == "":
                return None
            try:
                return float(text)
            except ValueError:
                return text

        with open(file, encoding="utf-8", newline="") as lines:
            return _table([{key: value(text) for key, text in row.items()} for row in csv.DictReader(lines)])


def _axes():
    from matplotlib import pyplot

    return pyplot.subplots(layout="constrained")[1]


def plot_profile(results, field, engines=None, ax=None, **choice):
    """One field of engines (default: all that have it by what verdicts rest on) with standard errors, over r, or over the
    numbers of bins that are no rings. choice: packing and method, as of Results.profile. Returns matplotlib's axes."""
    having = {p.engine for p in results._all_profiles() if p.field == field}
    names = engines or [name for name in results.engines if name in having]
    _one(names, f"profile of {field}", {p.field for p in results._all_profiles()})
    profiles = {}
    for name in names:
        try:
            profiles[name] = results.profile(field, engine=name, **choice)
        except KeyError:
            if engines or (name == names[-1] and not profiles):
                raise
    ax = ax or _axes()
    for name, p in profiles.items():
        ax.errorbar(p.r if len(p.r) else np.arange(1, len(p.mean) + 1), p.mean, p.stderr, capsize=2, label=name)
    ax.set_xlabel("r [m]" if len(p.r) else "bin")
    ax.set_ylabel(field.replace("_", " ") + ("" if p.unit in ("-", "1") else f" [{p.unit}]"))
    ax.legend()
    return ax


def plot_endpoints(results, against=None, ax=None):
    """Differences of all engines from one (default: the closed form where the case has it, else the reference) in margins,
    with the intervals that verdicts rest on; the band is the margin. Returns matplotlib's axes."""
    rows = results._require("endpoints", "endpoints")
    references = [row["a"] for row in rows["rows"]]
    against = against or next((a for a in ("closed-form", rows.get("reference")) if a in references), None) or results._reference()
    _one([a for a in references if a == against], f"verdict against {against}", references)
    rows = [row for row in rows["rows"] if row["a"] == against and row["distance"] is not None]
    names, engines = (list(dict.fromkeys(row[key] for row in rows)) for key in ("endpoint", "b"))
    ax = ax or _axes()
    ax.axvspan(-1.0, 1.0, color="0.9")
    for k, engine in enumerate(engines):
        own = [row for row in rows if row["b"] == engine]
        low, middle, high = (_numbers([row[key] for row in own]) for key in ("distance_low", "distance", "distance_high"))
        places = [names.index(row["endpoint"]) + 0.6 * (k + 0.5) / len(engines) - 0.3 for row in own]
        bars = np.nan_to_num([middle - low, high - middle])
        ax.errorbar(middle, places, xerr=bars, fmt="o", capsize=2, label=engine)
    ax.set_yticks(range(len(names)), [name.replace("_", " ") for name in names])
    ax.invert_yaxis()
    ax.set_xlabel(f"difference from {against} [margins]")
    ax.legend()
    return ax


@dataclasses.dataclass
class Contacts:
    """Contacts of one time: pairs that an engine lists, i < j. Ids: disks from 0, then wall disks, then planes, then cylinders."""

    i: np.ndarray  #: id of the first, a disk
    j: np.ndarray  #: id of the second
    normal: np.ndarray  #: (contacts, 2), in space (contacts, 3): unit vector from j to i
    overlap: np.ndarray  #: > 0 where they overlap [m]
    normal_force: np.ndarray  #: on i along the normal, > 0 pushes [N]
    tangential_force: np.ndarray  #: on i along z × normal; in space the vector, (contacts, 3) [N]
    sliding: np.ndarray = None  #: whether at the Coulomb bound; None: not known
    rolling_torque: np.ndarray = None  #: of rolling resistance on i, the opposite on j [N m]; None: there is none
    dissipation: np.ndarray = None  #: power turned into heat [W]; None: not known
    point: np.ndarray = None  #: (contacts, 2 or 3): where forces act [m]; of scenes with convex bodies

    def __len__(self):
        return len(self.i)

    @property
    def tangent(self):
        """(contacts, 2): z × normal, the normal turned counter-clockwise by 90°; of the plane alone."""
        return np.stack([-self.normal[:, 1], self.normal[:, 0]], axis=1)

    @property
    def force(self):
        """(contacts, 2 or 3): on i; the opposite acts on j [N]."""
        along = self.normal_force[:, None] * self.normal
        if self.normal.shape[1] == 3:
            return along + self.tangential_force
        return along + self.tangential_force[:, None] * self.tangent

    @property
    def transmits(self):
        """Which of the pairs pass a force or torque on: contacts, as crossgrain counts them."""

        def some(values):
            return (values != 0.0).reshape(len(self), -1).any(axis=1)

        carries = some(self.normal_force) | some(self.tangential_force)
        return carries if self.rolling_torque is None else carries | some(self.rolling_torque)


@dataclasses.dataclass
class Snapshot:
    """One instant. Engines stagger their arrays in time, so each has its own."""

    time: float  #: of positions [s]
    velocity_time: float  #: [s]
    contact_time: float  #: of contacts and forces on walls [s]
    contact_interval: float  #: > 0: forces are means over so long before contact_time [s]
    position: np.ndarray  #: (disks, 2), in space (spheres, 3) [m]
    velocity: np.ndarray  #: likewise [m/s]
    spin: np.ndarray  #: counter-clockwise positive, in space (spheres, 3) [rad/s]; None: nothing spins
    wall_position: np.ndarray  #: (wall disks, 2 or 3) [m]; None: the file has none
    contacts: Contacts  #: None: the file has none
    #: centre [m], velocity [m/s], angle [rad], angular_velocity [rad/s], force [N], torque [N m] of wall bodies; None: the file has none
    bodies: dict
    energies: dict  #: kinetic and elastic [J]; None: not known
    #: of scenes with convex bodies: angles [rad], in space quaternions w, x, y, z, (bodies, 4); None: all are round
    turn: np.ndarray = None

    def centres(self):
        """(disks + wall disks, 2 or 3): centres by id [m]."""
        return self.position if self.wall_position is None else np.concatenate([self.position, self.wall_position])


SHAPES = ("polygon", "capsule", "box", "cylinder", "polyhedron")


@dataclasses.dataclass
class Shape:
    """A convex body in its own frame: all within rounding of the hull of its vertices; of a cylinder across its axis alone."""

    kind: str  #: of SHAPES
    vertices: np.ndarray  #: (vertices, 2 or 3) [m]
    rounding: float  #: [m]


class Snapshots:
    """A file of snapshots, read one by one: snapshots[k], or for snapshot in snapshots."""

    def __init__(self, path):
        import h5py  # of all that is here only snapshots need it

        self._file = h5py.File(path, "r")
        self.engine = self._file.attrs.get("engine", pathlib.Path(path).stem)  #: who made them
        if isinstance(self.engine, bytes):
            self.engine = self.engine.decode()
        self.dimension = int(self._file.attrs.get("dimension", 2))  #: 3: spheres in space
        self.radius = self._file["disks/radius"][:]  #: of the disks [m]
        self.mass = self._file["disks/mass"][:]  #: [kg]
        self.inertia = self._optional("disks/inertia")  #: moments of inertia [kg m²]; None: not in the file
        kinds = self._array("shapes/kind").astype(int)
        self.shapes = [self._shape(k, kind) for k, kind in enumerate(kinds)]  #: of convex bodies, whose radius is their reach
        self.shape = self._optional("disks/shape")  #: index of each body's, -1: it is round; None: all are
        self.moments = self._optional("disks/moments")  #: in space, about the bodies' axes [kg m²]; None: all are round, or in the plane
        self.wall_radius = self._array("walls/radius")  #: of wall disks [m]
        self.wall_body = self._array("walls/body").astype(int)  #: index of the wall body of each

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._file.close()

    def __len__(self):
        return sum(1 for name in self._file if name.startswith("snapshot-"))

    def __iter__(self):
        return (self[k] for k in range(len(self)))

    def _optional(self, path):
        return self._file[path][:] if path in self._file else None

    def _array(self, path):
        values = self._optional(path)
        return np.zeros(0) if values is None else values

    def _shape(self, k, kind):
        vertices = self._file[f"shapes/{k}/vertices"][:].reshape(-1, self.dimension)
        return Shape(SHAPES[kind], vertices, float(self._file[f"shapes/{k}/rounding"][0]))

    def __getitem__(self, k):
        if k < 0:
            k += len(self)
        at = f"snapshot-{k:03d}"
        if at not in self._file:
            raise IndexError(f"there is no snapshot {k} of {len(self)}")
        group = self._file[at]
        energies, walls = (self._optional(f"{at}/{name}") for name in ("energies", "wall_position"))
        return Snapshot(
            *(float(t) for t in group["time"][:]),
            position=group["position"][:],
            velocity=group["velocity"][:],
            spin=self._optional(f"{at}/spin"),
            wall_position=None if walls is None else walls.reshape(-1, self.dimension),
            contacts=self._contacts(f"{at}/contacts"),
            bodies={name: values[:] for name, values in group["bodies"].items()} if "bodies" in group else None,
            energies=None if energies is None else dict(zip(("kinetic", "elastic"), energies)),
            turn=self._optional(f"{at}/turn"),
        )

    def _contacts(self, at):
        if f"{at}/i" not in self._file:
            return None
        names = ("i", "j", "normal", "overlap", "normal_force", "tangential_force")
        optional = ("sliding", "rolling_torque", "dissipation", "point")
        columns = {name: self._file[f"{at}/{name}"][:] for name in names}
        columns["normal"] = columns["normal"].reshape(-1, self.dimension)
        columns |= {name: self._optional(f"{at}/{name}") for name in optional}
        if columns["sliding"] is not None:
            columns["sliding"] = columns["sliding"] != 0
        return Contacts(**columns)
