"""A campaign: the runs of a sweep, and what claims and figures read of them.

A field of a run is an array over its rings, NaN where there is nothing to measure; a number of a run is a float (NaN: it has
none) or a Measured, which knows its error within the run."""

import dataclasses
import functools
import json
import lzma
import pathlib

import numpy as np

#: What claims and figures read on the case's rings, on the finer ones, and by a second weight: all that a campaign's file keeps.
FIELDS = """volume_fraction azimuthal_velocity radial_velocity spin density coordination continuum_rotation excess_rotation
fabric_trace fabric_deviator fabric_angle stress_rr stress_pp stress_rp stress_pr stress_trace stress_deviator stress_angle
dynamic_stress_rr dynamic_stress_pp dynamic_stress_rp fluctuation_stress_rr strain_trace strain_deviator strain_angle
bulk_modulus shear_modulus mean_field_modulus couple_stress_zr curvature_zr torque_resistance""".split()
FINE_FIELDS = "volume_fraction spin excess_rotation fabric_trace bulk_modulus shear_modulus".split()
BY_CENTRE = ("volume_fraction", "spin")
ROUNDING = 1e-6  # of times that were typed in [rotations]


@dataclasses.dataclass(frozen=True)
class Measured:
    """A number with its standard error within the run (None: not known); factors without an error keep it."""

    value: float
    error: float = None

    def __float__(self):
        return float(self.value)

    def __mul__(self, factor):
        return Measured(self.value * factor, None if self.error is None else abs(factor) * self.error)

    def __truediv__(self, divisor):
        return self * (1 / divisor)

    def over(self, numerator):
        """numerator over it; NaN unless it is positive"""
        if not self.value > 0:
            return Measured(np.nan)
        error = None if self.error is None else abs(numerator) * self.error / self.value**2
        return Measured(numerator / self.value, error)


# ---- Over rings.


def chosen(values, zone=None):
    """The values that there are, of the zone's rings."""
    values = values if zone is None else values[zone]
    return values[np.isfinite(values)]


def statistic(of):
    return lambda values, zone=None: float(of(kept)) if len(kept := chosen(values, zone)) else np.nan


mean, median, largest = statistic(np.mean), statistic(np.median), statistic(np.max)
rms = statistic(lambda values: np.sqrt(np.mean(values**2)))
scatter = statistic(lambda values: np.std(values) / abs(np.mean(values)) if len(values) > 1 else np.nan)
#: of axes, angles up to π: by their doubled angles
axis = statistic(lambda angles: 0.5 * np.arctan2(np.sin(2 * angles).sum(), np.cos(2 * angles).sum()))


def positive(values):
    return np.where(values > 0, values, np.nan)


@dataclasses.dataclass(frozen=True)
class Leg:
    """A case of a sweep, and in what it differs from others. SI units; cell as results.json has it."""

    name: str
    label: float  #: ν̄ as Table 3.2 has it
    families: tuple  #: of cases that differ in one thing: packings, rate, spacing, kn, mass, radius, bottom, friction, time
    cell: dict
    kn: float
    kt: float
    mu: float
    large_mass: float
    bottom_friction: bool
    settle_rotations: float
    averaged_rotations: float
    law: dict  #: of the case

    @property
    def end(self):
        return self.settle_rotations + self.averaged_rotations

    @property
    def rotations(self):
        return f"{self.settle_rotations:g} to {self.end:g}"

    @property
    def omega(self):
        return self.cell["omega"]

    @property
    def d(self):
        return self.cell["diameter"]

    @property
    def inner(self):
        return self.cell["inner_radius"]

    @property
    def gap(self):
        return self.cell["outer_radius"] - self.inner


class Rings:
    """Profiles on rings equally wide from the wheel to the outer ring."""

    def __init__(self, leg, profiles):
        """profiles: by method and field {"mean": […], "stderr": […]}, the method of verdicts first"""
        self.leg, self.profiles = leg, profiles
        first = next(iter(profiles.values()), {})
        self.count = len(next(iter(first.values()))["mean"]) if first else 0
        depth = (np.arange(self.count) + 0.5) * leg.gap / max(self.count, 1)
        self.r, self.r_tilde = leg.inner + depth, depth / leg.d

    def _numbers(self, field, method, column):
        of = self.profiles.get(method or next(iter(self.profiles), ""), {}).get(field, {}).get(column, [])
        return np.array(of if len(of) == self.count else [np.nan] * self.count, dtype=float)

    def __getitem__(self, field):
        return self._numbers(field, None, "mean")

    def by(self, method, field="volume_fraction"):
        return self._numbers(field, method, "mean")

    def errors(self, field):
        return self._numbers(field, None, "stderr")

    def ring(self, field, k):
        if not k < self.count:
            return Measured(np.nan)
        error = self.errors(field)[k]
        return Measured(self[field][k], None if np.isnan(error) else error)


class Run(Rings):
    """One engine on one packing of a leg."""

    def __init__(self, leg, data, common):
        """data: as a campaign's file has it; common: numbers of all rules"""
        super().__init__(leg, data["profiles"])
        self.data, self.common = data, common
        self.engine, self.packing, self.seed = data["engine"], data["packing"], data["seed"]
        self.history = data["history"]
        self.head = {name: np.nan if value is None else value for name, value in data["head"].items()}
        self.regime = data["regime"] or {}
        self.identity = (leg.cell["small"], leg.cell["large"], self.seed, self.packing)  # of the packing, whatever leg shows it

    def zone(self, start, end):
        return (self.r_tilde >= start) & (self.r_tilde < end)

    @property
    def band(self):
        return self.zone(0, self.common["band_to"])

    @property
    def inside_band(self):
        return self.zone(self.common["first_layer_to"], self.common["band_to"])

    @property
    def bulk(self):
        return self.zone(self.common["bulk_from"], self.common["bulk_to"])

    @property
    def off_walls(self):
        rings = np.arange(self.count)
        return (rings > 0) & (rings < self.count - 1)

    def near(self, r_tilde):
        """index of the ring about it"""
        return int(min(r_tilde * self.leg.d / (self.leg.gap / self.count), self.count - 0.5))

    def fine(self, fewest=0):
        """The finest rings that were averaged over, at least so many; None without."""
        counts = [int(count) for count in self.data["fine"] if int(count) >= fewest]
        return Rings(self.leg, self.data["fine"][str(max(counts))]) if counts else None

    def fit(self, name):
        value, error = self.data["fits"].get(name, (None, None))
        return Measured(np.nan if value is None else value, error)

    def distribution(self, quantity, ring, axes=1):
        """(middles of the bins of each axis …, densities by the last axis, then the first); None without"""
        for of in self.data["distributions"]:
            if of["quantity"] == quantity and of["ring"] == ring and len(of["axes"]) == axes:
                middles = [a["low"] + (np.arange(a["count"]) + 0.5) * a["width"] for a in of["axes"]]
                return *middles, np.reshape(of["density"], [len(m) for m in reversed(middles)])
        return None

    def span(self, rotation):
        """The part of the history in which that rotation ends; None where it does not reach so far."""
        return next((s for s in self.history if s["from"] < rotation - ROUNDING and rotation <= s["to"] + ROUNDING), None)

    def averaged(self, name):
        """mean over the averaged time of a number of the history"""
        spans = [s for s in self.history if s["from"] >= self.leg.settle_rotations - ROUNDING and s[name] is not None]
        length = sum(s["to"] - s["from"] for s in spans)
        return sum((s["to"] - s["from"]) * s[name] for s in spans) / length if length else np.nan

    @property
    def wheel_contacts(self):
        """at a time, while averaged"""
        known = self.regime.get("wheel_contacts")
        return self.head.get("wheel_contacts", np.nan) if known is None else known

    @property
    def reach(self):
        return self.history[-1]["to"] if self.history else self.leg.end


class Campaign:
    def __init__(self, document, common):
        """document: what load() reads; common: numbers of all rules, which name the zones of the cell"""
        self.document, self.collisions = document, document["collisions"]
        self.legs = [Leg(**leg | {"families": tuple(leg["families"])}) for leg in document["legs"]]
        legs = {leg.name: leg for leg in self.legs}
        self.runs = [Run(legs[data["leg"]], data, common) for data in document["runs"]]

    @functools.cached_property
    def engines(self):
        return list(dict.fromkeys(run.engine for run in self.runs))

    def family(self, name):
        return [leg for leg in self.legs if name in leg.families]

    @property
    def reference(self):
        """What all are compared with: the first of the family "packings"."""
        return (self.family("packings") or self.legs)[0]

    def packing_leg(self, label):
        return next((leg for leg in sorted(self.family("packings"), key=lambda leg: leg.label) if abs(leg.label - label) < 5e-4), None)

    def of(self, leg, engine):
        return [run for run in self.runs if run.leg is leg and run.engine == engine]


def longest_of_each_packing(runs):
    longest = {}
    for run in runs:
        if run.identity not in longest or run.reach > longest[run.identity].reach:
            longest[run.identity] = run
    return [longest[key] for key in sorted(longest)]


def load(file):
    """The document of a campaign's file, compressed or not."""
    data = pathlib.Path(file).read_bytes()
    return json.loads(lzma.decompress(data) if str(file).endswith(".xz") else data)


def save(document, file):
    data = json.dumps(document, separators=(",", ":"), ensure_ascii=False).encode()
    pathlib.Path(file).write_bytes(lzma.compress(data, preset=9) if str(file).endswith(".xz") else data)


# ---- From results.json to a campaign's file.


def profiles_of(profiles, fields, centre=True):
    """Those of results.json's that are kept, six digits of them, three of their errors."""
    first, kept = profiles[0]["method"] if profiles else None, {}
    for profile in profiles:
        method, field = profile["method"], profile["field"]
        if field in fields and (method == first or (centre and method == "centre" and field in BY_CENTRE)):
            kept.setdefault(method, {})[field] = {"mean": rounded(profile["mean"], 6), "stderr": rounded(profile["stderr"], 3)}
    return kept


def rounded(values, digits):
    return [None if value is None else float(f"{value:.{digits - 1}e}") for value in values]


def run_of(run):
    """What is kept of a run of results.json (of compare or average)."""
    return {
        "head": {row["name"]: row["value"] for row in run["head"]},
        "regime": run.get("regime"),
        "fits": {row["name"]: [row["value"], row.get("stderr")] for row in run["fits"]},
        "profiles": profiles_of(run["profiles"], FIELDS),
        "distributions": [
            {key: of[key] for key in ("quantity", "ring", "axes")} | {"density": rounded(of["density"], 4)}
            for of in run.get("distributions", [])
        ],
    }


def collisions_of(variants):
    """Ψ_f and e_n over Ψ_i of results.json of `collide`: by continuous time ("law") and of every engine at every time step."""

    def columns(table):
        return {name: table[name] for name in ("psi_i", "psi_f", "e_n")}

    return [
        {
            "tangential": variant["law"]["tangential"],
            "tension": variant["law"]["tension"],
            "mu": variant["law"]["mu"],
            "law": columns(variant["oracle"]) | {"e_n_closed": variant["e_n_closed"]},
            "engines": [
                {"engine": curve["engine"], "steps": curve["steps_per_contact"], **columns(curve["points"])}
                for curve in variant["curves"]
                if curve["status"] in ("ran", "finished")
            ],
        }
        for variant in variants
    ]
