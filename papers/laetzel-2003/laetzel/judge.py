"""Rules, the runs that a claim is judged by, and the verdict that follows.

claims.toml has the rules: of each claim its figures with the band that the thesis' words mean. A figure is reproduced where its
interval at the common confidence lies within its band; refuted where that at 1 − (1 − confidence)/k lies outside, k being the
claim's figures that have a band, so that a claim of many figures is refuted by chance no more often than one figure is; else
undecided. A claim is refuted if a figure is, cannot be tested if a figure says so, else is as undecided as its figures are."""

import dataclasses
import math
import tomllib

from laetzel.campaign import longest_of_each_packing
from laetzel.statistics import common_slope, mean_over, rank_trend
from laetzel.text import readable, setting

#: from the most severe on
VERDICTS = ("refuted", "undecided", "reproduced", "cannot be tested")


@dataclasses.dataclass
class Band:
    name: str
    label: str
    why: str
    unit: str = ""
    low: float = None
    high: float = None
    testable: bool = True

    judged = property(lambda self: self.low is not None or self.high is not None)

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
    figures: dict  #: Bands by name; the first stands for the claim


@dataclasses.dataclass
class Rules:
    common: dict
    claims: dict  #: by id


def load_rules(file):
    values = lambda numbers: {name: number["value"] for name, number in numbers.items()}
    document = tomllib.loads(file.read_text(encoding="utf-8"))
    rules = Rules(values(document["common"]), {})
    for claim in document["claims"]:
        figures = {name: Band(name, **band) for name, band in claim["figures"].items()}
        rules.claims[claim["id"]] = Rule(**claim | {"numbers": values(claim.get("numbers", {})), "figures": figures})
    return rules


def load_reasons(file):
    return tomllib.loads(file.read_text(encoding="utf-8"))["reasons"]


#: What the thesis leaves open: family, label, of a leg, unit, its name
OPEN = (
    ("spacing", "wall spacing", lambda leg: leg.cell["wall_spacing"], 1e-3, "mm"),
    ("mass", "large mass", lambda leg: leg.large_mass, 1e-3, "g"),
    ("radius", "small radius", lambda leg: leg.cell["small_radius"], 1e-3, "mm"),
)


def same(a, b):
    """Of settings that were typed in."""
    return math.isclose(a, b, rel_tol=1e-9)


def describe(choice, leg):
    return f"{choice[1]} {choice[2](leg) / choice[3]:.4g} {choice[4]}"


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
    """One reading of what the thesis leaves open."""

    key: str  #: "spacing", "mass", "radius"; empty: the default
    label: str
    judged: list = dataclasses.field(default_factory=list)  #: legs that claims are judged by
    timed: list = dataclasses.field(default_factory=list)  #: legs whose history shows how states change


def readings_of(campaign):
    """The default first: what the reference leg has; then the values that differ."""
    reference = campaign.reference
    default = [leg for leg in campaign.legs if same_but(None, False, leg, reference)]
    label = "default: " + ", ".join([describe(choice, reference) for choice in OPEN] + [describe_rate(reference)])
    judged = [leg for leg in default if "packings" in leg.families]
    readings = [Reading("", label, judged, [leg for leg in default if {"packings", "time"} & set(leg.families)])]
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
        return f"there are no {self.label}: " + (f"none of {', '.join(self.without)}" if self.without else "no case of theirs")


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
        those = [run for run in runs.runs if run.wheel_contacts >= self["wheel_contacts"]]
        return RunSet(those, f"{runs.label} that carry ({len(those)} of {len(runs.runs)})", runs.without)

    def _evidence(self, runs, number, estimate, few="", counts=True):
        """estimate(runs, values) of those that have the number, a function of a run; few: why there may be none of theirs"""
        found = [(run, value) for run in runs.runs if is_number(value := number(run))]
        used, values = [run for run, _ in found], [value for _, value in found]
        missing = f"{runs.label}: {few.format(len(used))}" if found else runs.missing()
        return Evidence(estimate(used, values) if found else None, missing, used, len(runs.runs) if counts else 0)

    def mean(self, runs, number):
        return self._evidence(runs, number, lambda used, values: mean_over(values))

    def means(self, runs, **numbers):
        """Evidence of several figures by their names."""
        return {name: self.mean(runs, number) for name, number in numbers.items()}

    def trends(self, runs, **numbers):
        return {name: self.trend(runs, number) for name, number in numbers.items()}

    def trend(self, runs, number):
        """Kendall's τ with ν̄"""
        few = "{} with the data, of different ν̄, are too few for a trend"
        labels = lambda used: [run.leg.label for run in used]
        tau = lambda used, values: rank_trend(labels(used), [float(value) for value in values], self["fewest_for_trend"])
        return self._evidence(runs, number, tau, few)

    def slope_in_rate(self, runs, number):
        """in lg Ω, with a level for each ν̄"""
        few = "{} with the data, no two rates at one ν̄ or none left for the error"
        rates = lambda used: [math.log10(abs(run.leg.omega)) for run in used]
        levels = lambda used: [round(run.leg.label / self["same_label"]) for run in used]
        slope = lambda used, values: common_slope(rates(used), [float(value) for value in values], levels(used))
        return self._evidence(runs, number, slope, few, counts=False)

    def slope_in_density(self, runs, number, span=1.0):
        """times a span of ν̄"""
        labels = lambda used: [run.leg.label / span for run in used]
        slope = lambda used, values: common_slope(labels(used), [float(value) for value in values], [0] * len(used))
        return self._evidence(runs, number, slope, "too few, or of one ν̄")


def place(band, estimate, confidence, figures):
    half = estimate.half(confidence)
    if half is None:
        return "undecided"
    x, low, high = estimate.value, band.low, band.high
    if (low is None or x - half >= low) and (high is None or x + half <= high):
        return "reproduced"
    wide = estimate.half(1 - (1 - confidence) / max(figures, 1))
    return "refuted" if (low is not None and x + wide < low) or (high is not None and x - wide > high) else "undecided"


def runs_to_decide(band, estimate, confidence, most=1000):
    """Runs that it would take for the interval to leave the edge that it lies across, if their scatter stays as it is."""
    if estimate.basis != "runs" or estimate.error is None or estimate.runs < 2:
        return None
    room = min(abs(estimate.value - edge) for edge in (band.low, band.high) if edge is not None)
    more = lambda n: dataclasses.replace(
        estimate, error=estimate.error * math.sqrt(estimate.runs / n), dof=estimate.dof + n - estimate.runs
    )
    return next((n for n in range(estimate.runs + 1, most + 1) if more(n).half(confidence) < room), None)


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
    if verdict != "undecided":
        return f"{text}, {'not ' if verdict == 'refuted' else ''}{band.text()}"
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
    judged = sum(band.judged for band in rule.figures.values())
    figures, sentences = {}, {verdict: [] for verdict in VERDICTS}
    for name, evidence in found.items():
        band, verdict = rule.figures[name], ""
        if not band.testable:
            verdict = "cannot be tested"
        elif band.judged:
            verdict = place(band, evidence.estimate, confidence, judged) if evidence.estimate else "undecided"
        figures[name] = Figure(band, evidence.estimate, verdict)
        if verdict:
            sentences[verdict].append(sentence(band, evidence, verdict, confidence))
    verdict = next(each for each in VERDICTS if sentences[each])
    if verdict != "refuted" and sentences["cannot be tested"]:
        verdict = "cannot be tested"  # what holds as far as it goes is not reproduced while a part of it cannot be tested
    why = " ".join(f"{each}: {'; '.join(texts)}." for each, texts in sentences.items() if texts)
    legs = {run.leg.name: run.leg for evidence in found.values() for run in evidence.runs}
    if legs:
        windows = sorted({(leg.settle_rotations, leg.end) for leg in legs.values()})
        why += f" Averaged over rotations {', '.join(f'{a:g} to {b:g}' for a, b in windows)} since the ring had closed."
    return Row(rule.id, scope.engine, scope.reading.label, figures, verdict, why, set(legs))
