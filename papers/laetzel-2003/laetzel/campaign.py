"""A campaign: the runs of a sweep, and what claims and figures read of them.

A field of a run is an array over its rings, NaN where there is nothing to measure; a number of a run is a float (NaN: it has
none) or a Measured, which knows its error within the run."""

import dataclasses
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

    def over(self, numerator):
        """numerator over it; NaN unless it is positive"""
        if not self.value > 0:
            return Measured(np.nan)
        return Measured(numerator / self.value, None if self.error is None else abs(numerator) * self.error / self.value**2)


def chosen(values, zone=None):
    """The values that there are, of the zone's rings."""
    values = values if zone is None else values[zone]
    return values[np.isfinite(values)]


def over_rings(of):
    """A statistic of (values, zone=None), NaN of none."""
    return lambda values, zone=None: float(of(kept)) if len(kept := chosen(values, zone)) else np.nan


mean, median, largest = over_rings(np.mean), over_rings(np.median), over_rings(np.max)
rms = over_rings(lambda values: np.sqrt(np.mean(values**2)))
scatter = over_rings(lambda values: np.std(values) / abs(np.mean(values)) if len(values) > 1 else np.nan)
#: of axes, angles up to π: by their doubled angles
axis = over_rings(lambda angles: 0.5 * np.arctan2(np.sin(2 * angles).sum(), np.cos(2 * angles).sum()))


def positive(values):
    return np.where(values > 0, values, np.nan)


@dataclasses.dataclass(frozen=True)
class Leg:
    """A case of a sweep, and in what it differs from others. SI units; cell as results.json has it."""

    name: str
    label: float  #: ν̄ as Table 3.2 has it
    families: list  #: of cases that differ in one thing: packings, rate, spacing, kn, mass, radius, bottom, friction, time
    cell: dict
    kn: float
    kt: float
    mu: float
    large_mass: float
    bottom_friction: bool
    settle_rotations: float  #: since the ring had closed
    averaged_rotations: float  #: after them
    law: dict  #: kn, gn and small_mass, which C2 is calculated with

    end = property(lambda self: self.settle_rotations + self.averaged_rotations)
    rotations = property(lambda self: f"{self.settle_rotations:g} to {self.end:g}")
    omega = property(lambda self: self.cell["omega"])
    d = property(lambda self: self.cell["diameter"])
    inner = property(lambda self: self.cell["inner_radius"])
    gap = property(lambda self: self.cell["outer_radius"] - self.inner)


class Rings:
    """Profiles on rings equally wide from the wheel to the outer ring."""

    def __init__(self, leg, profiles):
        """profiles: by method and field {"mean": […], "stderr": […]}, the method of verdicts first"""
        self.leg, self.profiles = leg, profiles
        self.count = max((len(of["mean"]) for fields in profiles.values() for of in fields.values()), default=0)
        depth = (np.arange(self.count) + 0.5) * leg.gap / max(self.count, 1)
        self.r, self.r_tilde = leg.inner + depth, depth / leg.d

    def by(self, method, field="volume_fraction", column="mean"):
        of = self.profiles.get(method, {}).get(field, {}).get(column, [])
        return np.array(of if len(of) == self.count else [np.nan] * self.count, dtype=float)

    def __getitem__(self, field):
        return self.by(next(iter(self.profiles), ""), field)

    def errors(self, field):
        return self.by(next(iter(self.profiles), ""), field, "stderr")

    def ring(self, field, k):
        error = self.errors(field)[k]
        return Measured(self[field][k], None if np.isnan(error) else error)

    def near(self, r_tilde):
        """index of the ring about it"""
        return int(min(r_tilde * self.leg.d / (self.leg.gap / self.count), self.count - 0.5))

    def zone(self, start, end):
        return (self.r_tilde >= start) & (self.r_tilde < end)


class Run(Rings):
    """One engine on one packing of a leg."""

    def __init__(self, leg, data, common):
        """data: as a campaign's file has it; common: numbers of all rules, which name the zones of the cell"""
        super().__init__(leg, data["profiles"])
        self.data, self.common, self.history, self.regime = data, common, data["history"], data["regime"] or {}
        self.engine, self.packing = data["engine"], data["packing"]
        self.head = {name: np.nan if value is None else value for name, value in data["head"].items()}
        self.identity = (leg.cell["small"], leg.cell["large"], data["seed"], self.packing)  # of the packing, whatever leg shows it
        self.band, self.inside_band = self.zone(0, common["band_to"]), self.zone(common["first_layer_to"], common["band_to"])
        self.bulk, rings = self.zone(common["bulk_from"], common["bulk_to"]), np.arange(self.count)
        self.off_walls = (rings > 0) & (rings < self.count - 1)
        self.reach = self.history[-1]["to"] if self.history else leg.end
        known = self.regime.get("wheel_contacts")
        self.wheel_contacts = self.head.get("wheel_contacts", np.nan) if known is None else known  # at a time, while averaged

    def fine(self, fewest=0):
        """The finest rings that were averaged over, at least so many; None without."""
        counts = [int(count) for count in self.data["fine"] if int(count) >= fewest]
        return Rings(self.leg, self.data["fine"][str(max(counts))]) if counts else None

    def fit(self, name):
        value, error = self.data["fits"].get(name, (None, None))
        return Measured(np.nan if value is None else value, error)

    def distribution(self, quantity, ring):
        """(middles of the bins of each axis …, densities by the last axis, then the first); None without"""
        for of in self.data["distributions"]:
            if (of["quantity"], of["ring"]) == (quantity, ring):
                middles = [a["low"] + (np.arange(a["count"]) + 0.5) * a["width"] for a in of["axes"]]
                return *middles, np.reshape(of["density"], [len(m) for m in reversed(middles)])
        return None

    def span(self, rotation):
        """The part of the history in which that rotation ends; None where it does not reach so far."""
        return next((s for s in self.history if s["from"] < rotation - ROUNDING and rotation <= s["to"] + ROUNDING), None)

    def contacts_in(self, rotation):
        """of the wheel, in that rotation; None where the history does not reach so far"""
        span = self.span(rotation)
        return span and span["wheel_contacts"]

    def averaged(self, name):
        """mean over the averaged time of a number of the history"""
        spans = [s for s in self.history if s["from"] >= self.leg.settle_rotations - ROUNDING and s[name] is not None]
        length = sum(s["to"] - s["from"] for s in spans)
        return sum((s["to"] - s["from"]) * s[name] for s in spans) / length if length else np.nan


class Campaign:
    def __init__(self, document, common):
        """document: what load() reads; common: numbers of all rules"""
        legs = {leg["name"]: Leg(**leg) for leg in document["legs"]}
        self.legs, self.collisions = list(legs.values()), document["collisions"]
        self.runs = [Run(legs[data["leg"]], data, common) for data in document["runs"]]
        self.engines = list(dict.fromkeys(run.engine for run in self.runs))

    def family(self, name):
        return [leg for leg in self.legs if name in leg.families]

    @property
    def reference(self):
        """What all are compared with: the first of the family "packings"."""
        return (self.family("packings") or self.legs)[0]

    def packing_leg(self, label):
        return next((leg for leg in self.family("packings") if abs(leg.label - label) < 5e-4), None)

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
    try:
        return json.loads(lzma.decompress(data) if str(file).endswith(".xz") else data)
    except (ValueError, lzma.LZMAError) as error:
        raise ValueError(f"{file}: no campaign: {error}") from error


def save(document, file):
    pathlib.Path(file).write_bytes(lzma.compress(json.dumps(document, separators=(",", ":")).encode(), preset=9))


# ---- From results.json to a campaign's file: six digits of means, three of errors, four of densities.


def rounded(values, digits):
    return [None if value is None else float(f"{value:.{digits - 1}e}") for value in values]


def by_volume(profiles):
    """The profiles with the thesis' velocities, means by volume; results without such have no others."""
    named = {p["field"].removesuffix("_by_volume") for p in profiles if p["field"].endswith("_by_volume")}
    return [p | {"field": p["field"].removesuffix("_by_volume")} for p in profiles if p["field"] not in named]


def profiles_of(profiles, fields):
    first, kept = profiles[0]["method"] if profiles else None, {}
    profiles = by_volume(profiles)
    for p in profiles:
        if p["field"] in fields and (p["method"] == first or (p["method"] == "centre" and p["field"] in BY_CENTRE)):
            kept.setdefault(p["method"], {})[p["field"]] = {"mean": rounded(p["mean"], 6), "stderr": rounded(p["stderr"], 3)}
    return kept


def run_of(run):
    """What is kept of a run of results.json (of compare or average)."""
    distributions = [{key: of[key] for key in ("quantity", "ring", "axes")} | {"density": rounded(of["density"], 4)} for of in run["distributions"]]
    return {
        "head": {row["name"]: row["value"] for row in run["head"]},
        "regime": run.get("regime"),
        "fits": {row["name"]: [row["value"], row.get("stderr")] for row in run["fits"]},
        "profiles": profiles_of(run["profiles"], FIELDS),
        "distributions": distributions,
    }


def collisions_of(variants):
    """Ψ_f and e_n over Ψ_i of results.json of `collide`: in continuous time ("law") and of every engine at every time step."""
    columns = lambda table: {name: table[name] for name in ("psi_i", "psi_f", "e_n")}
    curve_of = lambda curve: {"engine": curve["engine"], "steps": curve["steps_per_contact"], **columns(curve["points"])}
    return [
        {
            **{key: variant["law"][key] for key in ("tangential", "tension", "mu")},
            "law": columns(variant["oracle"]) | {"e_n_closed": variant["e_n_closed"]},
            "engines": [curve_of(curve) for curve in variant["curves"] if curve["status"] == "finished"],
        }
        for variant in variants
    ]
