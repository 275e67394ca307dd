"""The thesis' figures from the campaign's data, with the thesis' axes: colours are volume fractions, means are over packings, bars
over runs. Drawn is what there are data for, by the first engine."""

import dataclasses

import matplotlib
import numpy as np

from laetzel import collisions, cosserat
from laetzel.claims import divergence_trace, field, fitted, over_rim_speed, over_spin_scale, share
from laetzel.statistics import mean_over

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

SHEAR_FLOW = 0.793, 0.810  # table 3.2
DEPTH, QUARTER = "(r − R$_i$) / d", {"π/4": ([0, 20], [np.pi / 4] * 2)}
FABRIC = 0.789, 0.800, 0.804, 0.807, 0.810, 0.811, 0.819
STRESS = 0.796, 0.800, 0.804, 0.807, 0.810, 0.811, 0.828
STRAIN = 0.796, 0.800, 0.804, 0.807, 0.810, 0.811
MODULI = *STRAIN, 0.819


@dataclasses.dataclass
class Panel:
    x_label: str
    y_label: str
    x: tuple = None  #: the thesis' axes; that of y is drawn wider where data lie beyond
    y: tuple = None
    log: bool = False
    title: str = ""
    curves: list = dataclasses.field(default_factory=list)  #: (name, x, y, error or None, style)
    lines: dict = dataclasses.field(default_factory=dict)  #: by name, (x, y) of what no data make
    image: tuple = None  #: (x, y, densities)


def draw(folder, number, panels):
    panels = [panel for panel in panels if panel.image or any(np.isfinite(y).any() for _, _, y, _, _ in panel.curves)]
    if not panels:
        return
    figure, axes = pyplot.subplots(1, len(panels), figsize=(4.2 * len(panels), 3.2), squeeze=False, layout="constrained")
    for ax, panel in zip(axes[0], panels):
        for name, x, y, error, style in panel.curves:
            y = np.where(np.asarray(y) > 0, y, np.nan) if panel.log else y
            bars = error if error is not None and np.isfinite(error).any() else None
            ax.errorbar(x, y, bars, fmt=style, ms=2, lw=0.8, elinewidth=0.5, label=name)
        if panel.image:
            ax.pcolormesh(*panel.image, cmap="Greys")
        ax.set(xlabel=panel.x_label, ylabel=panel.y_label, title=panel.title, yscale="log" if panel.log else "linear")
        if panel.y:
            low = ax.dataLim.minposy if panel.log else ax.dataLim.intervaly[0]
            ax.set_ylim(min(panel.y[0], low), max(panel.y[1], ax.dataLim.intervaly[1]))
        for name, (x, y) in panel.lines.items():
            ax.plot(x, y, "--", color="grey", lw=0.8, label=name)
        ax.set_xlim(panel.x)
        if ax.get_legend_handles_labels()[0]:
            ax.legend(fontsize=7)
    figure.suptitle(f"Figure {number}", fontsize=9)
    figure.savefig(folder / f"figure_{number.replace('.', '_')}.png", dpi=110)
    pyplot.close(figure)


# ---- Curves over rings: number, ν̄, y label, the thesis' axis, fields by name, and what differs from a linear plot over r̃.


def times(name, factor):
    return lambda rings: rings[name] * factor(rings.leg)


def thesis_rate(leg):
    return -0.1 / leg.omega


def per_kn(factor):
    return lambda leg: factor * np.pi * leg.cell["height"] / leg.kn


OVER_FABRIC = {"of": field("fabric_trace"), "fine": True, "x_label": "tr F", "x": (0, 3.5)}
IN_THESIS_RATE = "−ω{} [rad/s], at Ω = 0.1 /s".format
R = np.linspace(0.5, 10, 200)
SPIN_OF_THE_TEXT = {"thesis, fit at 0.796": (R, 0.24 * np.exp(-1.46 * R) * np.cos(np.pi * R + 1.79))}
DYNAMIC = {"σ$_φφ$": field("dynamic_stress_pp"), "σ$_rr$": field("dynamic_stress_rr")}
DYNAMIC |= {"|σ$_rφ$|": lambda r: abs(r["dynamic_stress_rp"]), "ρ v$_φ$²": lambda r: r["density"] * r["azimuthal_velocity"] ** 2}
SPIN = {"": lambda rings: rings.by("centre", "spin") * over_spin_scale(rings.leg)}
ROTATIONS = {"spin": times("spin", thesis_rate), "continuum": times("continuum_rotation", thesis_rate)}
NU_C = {"of": lambda rings: rings["volume_fraction"] * rings["coordination"], "x_label": "ν C", "x": (0, 3)}
PROFILES = (
    ("5.7", (0.804,), "ν", (0, 1.6), {m: lambda rings, m=m: rings.by(m) for m in ("centre", "slicing")}, {"fine": True}),
    ("6.2", (0.789, 0.804, 0.811), "ν", (0.4, 1), {"": field("volume_fraction")}, {}),
    ("6.7", (0.796, 0.804, 0.811), "v$_φ$ / (Ω R$_i$)", (1e-5, 1), {"": times("azimuthal_velocity", over_rim_speed)}, {"log": True}),
    ("6.8", (0.796, 0.811), "S d / (Ω D)", (-0.2, 0.15), SPIN, {"x": (0, 10), "fine": True, "lines": SPIN_OF_THE_TEXT}),
    ("7.4", FABRIC, "tr F", (0, 3), {"": field("fabric_trace")}, NU_C | {"lines": {"tr F = ν C": ([0, 3], [0, 3])}}),
    ("7.5", FABRIC, "tr F", (0, 3.5), {"": field("fabric_trace")}, {}),
    ("7.6", FABRIC, "dev F / tr F", (0, 0.6), {"": share("fabric")}, {}),
    ("7.7", FABRIC, "φ$_F$ [rad]", (0, np.pi / 2), {"": field("fabric_angle")}, {"lines": QUARTER}),
    ("7.11", (0.804,), "dynamic stress [N/m²]", (1e-5, 1e-2), DYNAMIC, {"log": True}),
    ("7.12", (0.804,), "stress [N/m²]", (0.1, 10), {ab: field(f"stress_{ab}") for ab in ("rr", "pp", "pr", "rp")}, {"log": True}),
    ("7.13a", STRESS, "σ$_{rr}$ [N/m²]", (0.1, 1000), {"": field("stress_rr")}, {"log": True}),
    ("7.13b", STRESS, "σ$_{rφ}$ [N/m²]", (1e-3, 100), {"": field("stress_rp")}, {"log": True}),
    ("7.14", STRESS, "tr σ [N/m²]", (0.1, 1000), {"": field("stress_trace")}, {"log": True}),
    ("7.15", STRESS, "dev σ / tr σ", (0, 0.6), {"": share("stress")}, {}),
    ("7.17", STRAIN, "tr ε", (1e-5, 1e-2), {"": field("strain_trace")}, {"log": True}),
    ("7.18", STRAIN, "dev ε / tr ε", (0, 0.35), {"": share("strain")}, {}),
    ("7.19", STRAIN, "φ$_ε$ [rad]", (0, np.pi / 2), {"": field("strain_angle")}, {"lines": QUARTER}),
    ("7.21", (0.811,), "angle [rad]", (0, 1.6), {t: field(f"{t}_angle") for t in ("fabric", "stress", "strain")}, {"lines": QUARTER}),
    ("7.22", MODULI, "2πhE / k$_n$", (0, 3.5), {"": times("bulk_modulus", per_kn(2))}, OVER_FABRIC),
    ("7.23", MODULI, "πhG / k$_n$", (0, 9), {"": times("shear_modulus", per_kn(1))}, OVER_FABRIC),
    ("8.3", (0.809,), IN_THESIS_RATE(""), (1e-4, 1), ROTATIONS, {"log": True}),
    ("8.4", (0.809,), IN_THESIS_RATE("*"), (-0.4, 0.6), {"": times("excess_rotation", thesis_rate)}, {"x": (1, 7), "fine": True}),
    ("8.5", (0.809,), "M$_{zr}$ / d² [N/m³]", (-2, 12), {"": times("couple_stress_zr", lambda leg: leg.d**-2)}, {}),
    ("8.6", (0.809,), "κ$_{zr}$ / d² [1/m]", (-0.2, 1.8), {"": times("curvature_zr", lambda leg: leg.d**-2)}, {}),
    ("8.7", (0.800, 0.809, 0.811), "µ$_c$ l² [N/m²]", (0, 500), {"": field("torque_resistance")}, {}),
)


def mean_of(runs, of):
    """(means over runs, their errors), element by element"""
    found = [mean_over([v for v in column if np.isfinite(v)]) for column in zip(*(of(run) for run in runs))]
    return np.array([(e.value, np.nan if e.error is None else e.error) if e else (np.nan, np.nan) for e in found]).reshape(-1, 2).T


class Figures:
    """Panels of figures of a campaign."""

    def __init__(self, campaign, rules):
        self.campaign, self.engine, self.factor = campaign, campaign.engines[0], rules.claims["C27"].numbers["factor"]

    def runs(self, label):
        leg = self.campaign.packing_leg(label)
        return self.campaign.of(leg, self.engine) if leg else []

    def profile(self, labels, y_label, y, fields, given):
        given = {"x_label": DEPTH, "x": (0, 20)} | given
        of, fine = given.pop("of", lambda rings: rings.r_tilde), given.pop("fine", False)
        panel = Panel(y_label=y_label, y=y, **given)
        for label in labels:
            rings = [run.fine() or run if fine else run for run in self.runs(label)]
            for name, values in fields.items() if rings else ():
                (x, _), (means, errors) = mean_of(rings, of), mean_of(rings, values)
                style = "o-" if panel.x_label == DEPTH else "o"
                panel.curves.append((f"{label:.3f}" if len(labels) > 1 else name or None, x, means, errors, style))
        return [panel]

    def over_density(self, y_label, y, number):
        legs = sorted(self.campaign.family("packings"), key=lambda leg: leg.label)
        found = [(leg.label, mean_of(self.campaign.of(leg, self.engine), lambda run: [float(number(run))])) for leg in legs]
        points = [(label, *values[:, 0]) for label, values in found if values.size]
        lines = {"shear flow by table 3.2": ([SHEAR_FLOW[0]] * 2 + [SHEAR_FLOW[1]] * 2, [y[1], y[0], y[0], y[1]])}
        curves = [(None, *np.transpose(points), "o")] if points else []
        return [Panel("ν̄", y_label, (0.78, 0.83), y, curves=curves, lines=lines)]

    def over_rotations(self, label):
        for name, key in (("ν, innermost ring", "volume_fraction_at_wheel"), ("ν, outer half", "volume_fraction_outside")):
            spans = [[(s["from"] + s["to"], 2 * s[key]) for s in run.history] for run in self.runs(label)]
            curves = [(None, *np.transpose(own) / 2, None, "o-") for own in spans]
            yield Panel("rotations since the ring had closed", name, None, (0.4, 1), curves=curves)

    def over_widths(self, label):
        """ν of neighbouring fine rings put together about a radius"""
        panel = Panel("Δr / d", "ν", (0.2, 3), (0, 2))
        fine = [run.fine() for run in self.runs(label) if run.fine()]
        for radius in (0.12, 0.13, 0.14, 0.20) if fine else ():
            width = fine[0].leg.gap / fine[0].count
            counts = np.arange(1, int(3 * fine[0].leg.d / width) + 1)
            firsts = np.round((radius - fine[0].leg.inner) / width - counts / 2).astype(int)
            spans = [slice(first, first + count) for first, count in zip(firsts, counts) if first >= 0]
            for method, style in (("slicing", "o-"), ("centre", "o--")):
                of = [[np.sum((rings.by(method) * rings.r)[s]) / np.sum(rings.r[s]) for s in spans] for rings in fine]
                name = f"r = {radius:.2f} m, {method}"
                panel.curves.append((name, counts[: len(spans)] * width / fine[0].leg.d, np.mean(of, axis=0), None, style))
        return [panel]

    def densities(self, labels, quantity, places, x_label, unit, y):
        """places: titles by r̃"""
        for r_tilde, title in places.items():
            panel = Panel(x_label, "probability density", None, y, True, title)
            for label, run in ((label, run) for label in labels for run in self.runs(label)[:1]):
                if found := run.distribution(quantity, run.near(r_tilde)):
                    panel.curves.append((f"{label:.3f}", found[0] * unit(run.leg), found[1] / unit(run.leg), None, "o-"))
            yield panel

    def joint(self, label):
        for run in self.runs(label)[:1]:
            found, ridge = run.distribution("azimuthal_velocity_and_spin", None), {"v = 1 + S d/(ΩD)": ([0, 1], [-1, 0])}
            yield Panel("v$_φ$ / (Ω R$_i$)", "S d / (Ω D)", title=f"ν̄ = {label:.3f}", lines=ridge, image=found)

    def directions(self, label):
        for run in self.runs(label)[:1]:
            for r_tilde in (0.5, 2.5, 8, 12, 19.5):
                if found := run.distribution("contact_direction", run.near(r_tilde)):
                    curves = [(None, found[0] / np.pi, 2 * np.pi * found[1], None, "o-")]
                    yield Panel("angle from r [π]", "relative to uniform", (-1, 1), (0, 2), title=f"r̃ = {r_tilde:g}", curves=curves)

    def collisions(self):
        for tension, title in collisions.TENSION.items():
            panel = Panel("Ψ$_i$", "Ψ$_f$", (0, 4), (-1, 3), title=title)
            for law, (psi, after, en, mu) in collisions.sweeps(self.campaign.collisions, self.engine, tension, 50).items():
                panel.curves.append((law, psi, after, None, "o"))
                panel.lines["sliding"] = [3 * (1 + en) * mu, 4], [0, 4 - 3 * (1 + en) * mu]
            yield panel

    def models(self, label):
        """9.1 to 9.4: Mohan's model as printed and with frictions fitted to the ring at the wheel, scaled to that ring's velocity."""
        runs = self.runs(label)
        if not runs:
            return
        leg, r = runs[0].leg, runs[0].r
        mean = {name: mean_of(runs, field(name))[0] for name in "stress_rr stress_pp stress_rp stress_pr couple_stress_zr".split()}
        mean |= {name: mean_of(runs, field(name))[0] for name in ("azimuthal_velocity", "spin", "stress_trace")}
        xi, fine = (r - leg.inner) / leg.gap, np.linspace(0, 1, 201)
        p = cosserat.Parameters(inner_radius=leg.inner / leg.gap, grain_size=0.008 / leg.gap)
        stresses = [mean[name][0] for name in ("stress_rr", "stress_pp", "stress_rp", "stress_pr", "couple_stress_zr")]
        models, frictions = {"model as printed": p}, cosserat.frictions(leg, r[0], *stresses, p)
        if frictions:
            models["fitted frictions"] = dataclasses.replace(p, wall_friction=frictions[0], internal_friction=frictions[1])
        found = {name: solution for name, model in models.items() if (solution := cosserat.solve(model))}
        velocity, sigma = mean["azimuthal_velocity"] * over_rim_speed(leg), mean["stress_trace"] / 2
        m = -mean["couple_stress_zr"] / sigma / (0.008 * p.length_scale * p.root)
        averages = (("9.1", "u", velocity, (1e-5, 1)), ("9.2", "omega", abs(mean["spin"]) * leg.gap * over_rim_speed(leg), (1e-4, 10)))
        averages += (("9.3a", "s", mean["stress_pr"] / sigma, (0, 0.6)), ("9.3b", "q", mean["stress_rp"] / sigma, (0, 0.6)))
        for number, name, values, y in (*averages, ("9.4", "m", m, (0, 0.25))):
            panel = Panel("ξ", name, (0, 1), None if y[0] else y, bool(y[0]), curves=[(self.engine, xi, values, None, "o")])
            for title, solution in found.items():
                scale = velocity[0] / solution(xi[0])["u"] if name in ("u", "omega") else 1
                inside = solution(fine)[name] * scale
                panel.curves.append((title, fine, np.where(inside > 0.1 * y[0], inside, np.nan), None, "-"))
            yield number, [panel]


def draw_all(campaign, rules, folder):
    folder.mkdir(parents=True, exist_ok=True)
    of, flow = Figures(campaign, rules), (0.789, 0.804, 0.811)
    per_second = lambda leg: abs(leg.omega) * leg.inner / leg.d  # noqa: E731
    places, at_wheel = {0.5: "0 < r̃ < 1", 12.5: "12 < r̃ < 13"}, {0.5: ""}
    with np.errstate(all="ignore"):
        figures = [(number, of.profile(*given)) for number, *given in PROFILES] + [
            ("4.3", of.collisions()),
            ("5.5", of.over_rotations(0.796)),
            ("5.6", of.over_widths(0.804)),
            ("6.1", of.over_rotations(0.804)),
            ("6.4a", of.over_density("ν$_0$", (0.82, 0.87), fitted("volume_fraction_outside"))),
            ("6.4b", of.over_density("B", (0, 0.7), fitted("dilation"))),
            ("6.5", of.over_density("1/C [d]", (0, 10), lambda run: run.fit("dilation_decay").over(1))),
            ("6.6", of.densities(flow, "radial_velocity", places, "v$_r$ / d [1/s]", per_second, (1e-3, 10))),
            ("6.10a", of.densities(flow[1:], "azimuthal_velocity", at_wheel, "v$_φ$ / (Ω R$_i$)", lambda leg: 1, (1e-3, 10))),
            ("6.10b", of.densities(flow[1:], "spin", at_wheel, "S d / (Ω D)", lambda leg: 1, (1e-4, 1))),
            ("6.11", [panel for label in (0.800, 0.811) for panel in of.joint(label)]),
            ("7.9", of.directions(0.804)),
            ("7.24", of.over_density("tr F$_{div}$", (0.5, 3.5), divergence_trace(of.factor))),
            *of.models(0.804),
        ]
        for number, panels in figures:
            draw(folder, number, list(panels))
