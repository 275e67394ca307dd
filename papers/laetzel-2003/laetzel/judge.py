"""Rules, the runs that a claim is judged by, and the verdict that follows.

claims.toml has the rules: of each claim its figures with the band that the thesis' words mean. A figure is reproduced where its
interval at the common confidence lies within its band; refuted where that at 1 − (1 − confidence)/k lies outside, k being the
claim's figures that have a band, so that a claim of many figures is refuted by chance no more often than one figure is; else
undecided. A claim is refuted if a figure is, cannot be tested if a figure says so, else is as undecided as its figures are."""

import dataclasses
import math
import tomllib

from laetzel.campaign import longest_of_each_packing
from laetzel.statistics import mean_over, rank_trend, common_slope
from laetzel.text import readable, setting

#: from the most severe on
VERDICTS = ("refuted", "undecided", "reproduced", "cannot be tested")
MOST_RUNS = 1000


# ---- Rules.


@dataclasses.dataclass
class Band:
    name: str
    label: str
    why: str
    unit: str = ""
    low: float = None
    high: float = None
    testable: bool = True

    @property
    def judged(self):
        return self.low is not None or self.high is not None

    def text(self):
        if self.low is not None and self.high is not None:
            return f"within {setting(self.low)} to {setting(self.high)}"
        return f"above {setting(self.low)}" if self.low is not None else f"below {setting(self.high)}"


@dataclasses.dataclass
class Rule:
    id: str
    claim: str
    rule: str
    figure: str
    readings: list  #: under which the claim is judged beside the default
    numbers: dict
    figures: dict  #: by name; the first stands for the claim

    @property
    def judged_figures(self):
        return sum(band.judged for band in self.figures.values())


@dataclasses.dataclass
class Rules:
    common: dict
    claims: dict  #: by id


def values_of(numbers):
    return {name: number["value"] for name, number in numbers.items()}


def load_rules(file):
    with open(file, "rb") as text:
        document = tomllib.load(text)
    claims = {}
    for claim in document["claims"]:
        figures = {name: Band(name, **band) for name, band in claim["figures"].items()}
        claims[claim["id"]] = Rule(**claim | {"numbers": values_of(claim.get("numbers", {})), "figures": figures})
    return Rules(values_of(document["common"]), claims)


def load_reasons(file):
    with open(file, "rb") as text:
        return tomllib.load(text)["reasons"]


# ---- Readings of what the thesis leaves open.

#: family, label, of a leg, its unit
OPEN = (
    ("spacing", "wall spacing", lambda leg: leg.cell["wall_spacing"], 1e-3, "mm"),
    ("mass", "large mass", lambda leg: leg.large_mass, 1e-3, "g"),
    ("radius", "small radius", lambda leg: leg.cell["small_radius"], 1e-3, "mm"),
)


def same(a, b):
    """Of settings that were typed in."""
    return math.isclose(a, b, rel_tol=1e-9)


def describe(choice, leg):
    _, label, of, unit, name = choice
    return f"{label} {of(leg) / unit:.4g} {name}"


def describe_rate(leg):
    return f"Ω = {leg.omega:.4g} /s"


def same_law(a, b):
    return same(a.kn, b.kn) and same(a.mu, b.mu) and a.bottom_friction == b.bottom_friction


def same_but(choice, any_rate, a, b):
    """Whether two legs are the same but for that choice, the numbers of disks and, if it may differ, the rate."""
    others = all(each is choice or same(each[2](a), each[2](b)) for each in OPEN)
    return others and same_law(a, b) and (any_rate or same(a.omega, b.omega))


@dataclasses.dataclass
class Reading:
    key: str  #: "spacing", "mass", "radius"; empty: the default
    label: str
    judged: list = dataclasses.field(default_factory=list)  #: legs that claims are judged by
    timed: list = dataclasses.field(default_factory=list)  #: legs whose history shows how states change


def readings_of(campaign):
    """The default first: what the reference leg has; then the values that differ."""
    reference = campaign.reference
    default = Reading("", "default: " + ", ".join([describe(choice, reference) for choice in OPEN] + [describe_rate(reference)]))
    for leg in campaign.legs:
        if same_but(None, False, leg, reference):
            if "packings" in leg.families:
                default.judged.append(leg)
            if "packings" in leg.families or "time" in leg.families:
                default.timed.append(leg)
    readings = [default]
    for choice in OPEN:
        others = {}
        for leg in campaign.family(choice[0]):
            if same(choice[2](leg), choice[2](reference)) or not same_but(choice, True, leg, reference):
                continue
            label = describe(choice, leg) + ("" if same(leg.omega, reference.omega) else ", " + describe_rate(leg))
            own = others.setdefault((choice[2](leg), leg.omega), Reading(choice[0], label))
            own.judged.append(leg)
            own.timed.append(leg)
        readings += [others[key] for key in sorted(others)]
    return readings


# ---- The runs of a claim, and evidence of figures.


@dataclasses.dataclass
class RunSet:
    runs: list
    label: str  #: "runs of shear flow"
    without: list = dataclasses.field(default_factory=list)  #: names of legs that should have had one

    def where(self, condition, label):
        return RunSet([run for run in self.runs if condition(run)], self.label + label, self.without)

    def missing(self):
        """Why they give nothing."""
        if self.runs:
            return f"none of {self.label} has the data ({', '.join(sorted({run.leg.name for run in self.runs}))})"
        if not self.without:
            return f"there are no {self.label}: no case of theirs"
        return f"there are no {self.label}: none of {', '.join(self.without)}"


@dataclasses.dataclass
class Evidence:
    """What a figure comes to."""

    estimate: object = None
    missing: str = ""  #: why there is none
    runs: list = dataclasses.field(default_factory=list)  #: that it rests on
    of: int = 0  #: runs that were asked, where some may not have the number


def is_number(value):
    return value is not None and math.isfinite(float(value))


@dataclasses.dataclass
class Scope:
    """One claim for one engine under one reading."""

    campaign: object
    rules: Rules
    rule: Rule
    engine: str
    reading: Reading

    def __getitem__(self, name):
        """A number of the claim's rule, or one common to all."""
        return self.rule.numbers[name] if name in self.rule.numbers else self.rules.common[name]

    # Sets of runs.

    def runs_of(self, legs, label):
        runs = {leg.name: self.campaign.of(leg, self.engine) for leg in legs}
        return RunSet([run for own in runs.values() for run in own], label, [name for name, own in runs.items() if not own])

    def densities(self, start, end, label):
        legs = [leg for leg in self.reading.judged if start <= leg.label < end]
        upto = "" if math.isinf(end) else f" to {end:g}"
        return self.runs_of(legs, f"runs {label} (ν̄ from {start:g}{upto})")

    def flow(self):
        """of shear flow by table 3.2"""
        return self.densities(self["flow_from"], self["flow_to"], "of shear flow")

    def upward(self):
        return self.densities(self["flow_from"], math.inf, "of shear flow and above")

    def blocked(self):
        return self.densities(self["blocked_from"], math.inf, "of blocked labels")

    def at_label(self):
        half = self["same_label"]
        runs = self.densities(self["label"] - half, self["label"] + half, "")
        return RunSet(runs.runs, f"runs at ν̄ = {self['label']:g}", runs.without)

    def family(self, name):
        return self.runs_of(self.campaign.family(name), f'runs of the family "{name}"')

    def timed(self):
        """for each packing its longest run of all legs that show it"""
        runs = self.runs_of(self.reading.timed, 'runs of the families "packings" and "time"')
        return RunSet(longest_of_each_packing(runs.runs), runs.label, runs.without)

    def carrying(self, runs):
        """Those whose wheel has the common number of contacts while they are averaged."""
        fewest = self["wheel_contacts"]
        those = runs.where(lambda run: run.wheel_contacts >= fewest, "")
        return RunSet(those.runs, f"{runs.label} that carry ({len(those.runs)} of {len(runs.runs)})", runs.without)

    # What they say together. `number` is of a run.

    def _collected(self, runs, number):
        found = [(run, number(run)) for run in runs.runs]
        found = [(run, value) for run, value in found if is_number(value)]
        return [run for run, _ in found], [value for _, value in found]

    def mean(self, runs, number):
        used, values = self._collected(runs, number)
        return Evidence(mean_over(values), runs.missing(), used, len(runs.runs))

    def trend(self, runs, number):
        """Kendall's τ with ν̄"""
        used, values = self._collected(runs, number)
        tau = rank_trend([run.leg.label for run in used], [float(value) for value in values], self["fewest_for_trend"])
        few = f"{runs.label}: {len(used)} with the data, of different ν̄, are too few for a trend"
        return Evidence(tau, few if used else runs.missing(), used, len(runs.runs))

    def slope_in_rate(self, runs, number):
        """in lg Ω, with a level for each ν̄"""
        used, values = self._collected(runs, number)
        levels = [round(run.leg.label / self["same_label"]) for run in used]
        slope = common_slope([math.log10(abs(run.leg.omega)) for run in used], [float(v) for v in values], levels) if used else None
        few = f"{runs.label}: {len(used)} with the data, no two rates at one ν̄ or none left for the error"
        return Evidence(slope, few if used else runs.missing(), used)

    def slope_in_density(self, runs, number, span=1.0):
        """times a span of ν̄"""
        used, values = self._collected(runs, number)
        slope = common_slope([run.leg.label for run in used], [float(v) for v in values], [0] * len(used)) if used else None
        if slope:
            slope.value, slope.error = slope.value * span, slope.error * span
        return Evidence(slope, f"{runs.label}: too few, or of one ν̄" if used else runs.missing(), used, len(runs.runs))


# ---- Verdicts.


def place(band, estimate, confidence, figures):
    half = estimate.half(confidence)
    if half is None:
        return "undecided"
    x, low, high = estimate.value, band.low, band.high
    if (low is None or x - half >= low) and (high is None or x + half <= high):
        return "reproduced"
    wide = estimate.half(1 - (1 - confidence) / max(figures, 1))
    outside = (low is not None and x + wide < low) or (high is not None and x - wide > high)
    return "refuted" if outside else "undecided"


def runs_to_decide(band, estimate, confidence):
    """Runs that it would take for the interval to leave the edge that it lies across, if their scatter stays as it is."""
    if estimate.basis != "runs" or estimate.error is None or estimate.runs < 2:
        return None
    room = min(abs(estimate.value - edge) for edge in (band.low, band.high) if edge is not None)
    for n in range(estimate.runs + 1, MOST_RUNS + 1):
        more = dataclasses.replace(estimate, error=estimate.error * math.sqrt(estimate.runs / n), dof=estimate.dof + n - estimate.runs)
        if more.half(confidence) < room:
            return n
    return None


def value_text(band, estimate, asked):
    """"0.41 ± 0.03 d (12 runs)" """
    differ = estimate.error is not None and estimate.error > 1e-12 * abs(estimate.value)
    text = readable(estimate.value, estimate.error if differ else None) + (f" {band.unit}" if band.unit else "")
    if estimate.basis == "within":
        return text + (" (one run, which has no error)" if estimate.error is None else " (one run, the error is within it)")
    if estimate.basis == "runs":
        text += f" ({estimate.runs} of {asked} runs)" if asked > estimate.runs else f" ({estimate.runs} runs)"
    return text


def sentence(band, evidence, verdict, confidence):
    if evidence.estimate is None:
        return f"{band.label}: {band.why if verdict == 'cannot be tested' else evidence.missing}"
    text = f"{band.label} is {value_text(band, evidence.estimate, evidence.of)}"
    if verdict == "cannot be tested":
        return f"{text}, and {band.why}"
    if verdict == "reproduced":
        return f"{text}, {band.text()}"
    if verdict == "refuted":
        return f"{text}, not {band.text()}"
    n = runs_to_decide(band, evidence.estimate, confidence)
    return f"{text}, which does not show whether it is {band.text()}" + (f"; about {n} runs would" if n else "")


@dataclasses.dataclass
class Figure:
    band: Band
    estimate: object  #: None: there is none
    verdict: str  #: empty: reported, not judged


@dataclasses.dataclass
class Row:
    """One claim for one engine under one reading."""

    id: str
    engine: str
    reading: str
    figures: dict
    verdict: str
    why: str
    legs: set
    reasons: list = dataclasses.field(default_factory=list)


def row_of(scope, found):
    """found: Evidence of each figure of the rule, by name"""
    rule, confidence = scope.rule, scope.rules.common["confidence"]
    if set(found) != set(rule.figures):
        raise ValueError(f"{rule.id}: rules and judgement differ in {sorted(set(found) ^ set(rule.figures))}")
    figures, sentences, runs = {}, {}, []
    for name, evidence in found.items():
        band, verdict = rule.figures[name], ""
        runs += evidence.runs
        if not band.testable:
            verdict = "cannot be tested"
        elif band.judged:
            placed = evidence.estimate and place(band, evidence.estimate, confidence, rule.judged_figures)
            verdict = placed or "undecided"
        figures[name] = Figure(band, evidence.estimate, verdict)
        if verdict:
            sentences.setdefault(verdict, []).append(sentence(band, evidence, verdict, confidence))
    verdict = next(each for each in VERDICTS if each in sentences)
    if verdict != "refuted" and "cannot be tested" in sentences:
        verdict = "cannot be tested"  # what holds as far as it goes is not reproduced while a part of it cannot be tested
    why = " ".join(f"{each}: {'; '.join(sentences[each])}." for each in VERDICTS if each in sentences)
    if runs:
        windows = sorted({(run.leg.settle_rotations, run.leg.end) for run in runs})
        why += f" Averaged over rotations {', '.join(f'{a:g} to {b:g}' for a, b in windows)} since the ring had closed."
    return Row(rule.id, scope.engine, scope.reading.label, figures, verdict, why, {run.leg.name for run in runs})
