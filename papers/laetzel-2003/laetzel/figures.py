"""The thesis' figures from the campaign's data, with the thesis' axes: colours are volume fractions, means are over packings, bars
over runs. Drawn is what there are data for, by the first engine."""

import dataclasses

import matplotlib
import numpy as np

from laetzel import collisions, cosserat
from laetzel.claims import divergence_trace, over_rim_speed, over_spin_scale
from laetzel.statistics import mean_over

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

SHEAR_FLOW = 0.793, 0.810  # table 3.2
FABRIC = 0.789, 0.800, 0.804, 0.807, 0.810, 0.811, 0.819
STRESS = 0.796, 0.800, 0.804, 0.807, 0.810, 0.811, 0.828
STRAIN = 0.796, 0.800, 0.804, 0.807, 0.810, 0.811
MODULI = *STRAIN, 0.819
DEPTH = "(r − R$_i$) / d"


@dataclasses.dataclass
class Profile:
    """A figure of curves over rings."""

    number: str
    labels: tuple  #: ν̄ of its curves
    y_label: str
    curves: dict  #: by name, of rings
    y: tuple  #: the thesis' axis; drawn wider where data lie beyond
    log: bool = False
    x: object = lambda rings: rings.r_tilde
    x_label: str = DEPTH
    x_range: tuple = (0, 20)
    fine: bool = False  #: on the finest rings
    lines: dict = dataclasses.field(default_factory=dict)  #: by name, (x, y) of what no data make


def field(name, factor=lambda leg: 1):
    return lambda rings: rings[name] * factor(rings.leg)


def share(tensor):
    return lambda rings: rings[f"{tensor}_deviator"] / rings[f"{tensor}_trace"]


def over_fabric(number, label, field_name, factor, y, lines):
    curve = {"": field(field_name, factor)}
    return Profile(number, MODULI, label, curve, y, x=field("fabric_trace"), x_label="tr F", x_range=(0, 3.5), fine=True, lines=lines)


def thesis_rate(leg):
    return -0.1 / leg.omega


R = np.linspace(0.5, 10, 200)
SPIN_OF_THE_TEXT = {"thesis, fit at 0.796": (R, 0.24 * np.exp(-1.46 * R) * np.cos(np.pi * R + 1.79))}
NU = {"": field("volume_fraction")}
QUARTER = {"π/4": ([0, 20], [np.pi / 4] * 2)}
PROFILES = (
    Profile("5.7", (0.804,), "ν", {m: lambda rings, m=m: rings.by(m) for m in ("centre", "slicing")}, (0, 1.6), fine=True),
    Profile("6.2", (0.789, 0.804, 0.811), "ν", NU, (0.4, 1)),
    Profile("6.7", (0.796, 0.804, 0.811), "v$_φ$ / (Ω R$_i$)", {"": field("azimuthal_velocity", over_rim_speed)}, (1e-5, 1), True),
    Profile(
        "6.8", (0.796, 0.811), "S d / (Ω D)", {"": lambda rings: rings.by("centre", "spin") * over_spin_scale(rings.leg)},
        (-0.2, 0.15), x_range=(0, 10), fine=True, lines=SPIN_OF_THE_TEXT,
    ),
    Profile(
        "7.4", FABRIC, "tr F", {"": field("fabric_trace")}, (0, 3), x=lambda r: r["volume_fraction"] * r["coordination"],
        x_label="ν C", x_range=(0, 3), lines={"tr F = ν C": ([0, 3], [0, 3])},
    ),
    Profile("7.5", FABRIC, "tr F", {"": field("fabric_trace")}, (0, 3.5)),
    Profile("7.6", FABRIC, "dev F / tr F", {"": share("fabric")}, (0, 0.6)),
    Profile("7.7", FABRIC, "φ$_F$ [rad]", {"": field("fabric_angle")}, (0, np.pi / 2), lines=QUARTER),
    Profile(
        "7.11", (0.804,), "dynamic stress [N/m²]",
        {"σ$_φφ$": field("dynamic_stress_pp"), "σ$_rr$": field("dynamic_stress_rr"),
         "|σ$_rφ$|": lambda r: abs(r["dynamic_stress_rp"]), "ρ v$_φ$²": lambda r: r["density"] * r["azimuthal_velocity"] ** 2},
        (1e-5, 1e-2), True,
    ),
    Profile("7.12", (0.804,), "stress [N/m²]", {ab: field(f"stress_{ab}") for ab in ("rr", "pp", "pr", "rp")}, (0.1, 10), True),
    Profile("7.13a", STRESS, "σ$_{rr}$ [N/m²]", {"": field("stress_rr")}, (0.1, 1000), True),
    Profile("7.13b", STRESS, "σ$_{rφ}$ [N/m²]", {"": field("stress_rp")}, (1e-3, 100), True),
    Profile("7.14", STRESS, "tr σ [N/m²]", {"": field("stress_trace")}, (0.1, 1000), True),
    Profile("7.15", STRESS, "dev σ / tr σ", {"": share("stress")}, (0, 0.6)),
    Profile("7.17", STRAIN, "tr ε", {"": field("strain_trace")}, (1e-5, 1e-2), True),
    Profile("7.18", STRAIN, "dev ε / tr ε", {"": share("strain")}, (0, 0.35)),
    Profile("7.19", STRAIN, "φ$_ε$ [rad]", {"": field("strain_angle")}, (0, np.pi / 2), lines=QUARTER),
    Profile(
        "7.21", (0.811,), "angle from r [rad]", {t: field(f"{t}_angle") for t in ("fabric", "stress", "strain")},
        (0, np.pi / 2), lines=QUARTER,
    ),
    over_fabric(
        "7.22", "2πhE / k$_n$", "bulk_modulus", lambda leg: 2 * np.pi * leg.cell["height"] / leg.kn, (0, 3.5),
        {"mean field": ([0, 3.5], [0, 3.5])},
    ),
    over_fabric("7.23", "πhG / k$_n$", "shear_modulus", lambda leg: np.pi * leg.cell["height"] / leg.kn, (0, 9), {}),
    Profile(
        "8.3", (0.809,), "−ω [rad/s], at Ω = 0.1 /s",
        {"spin": field("spin", thesis_rate), "continuum": field("continuum_rotation", thesis_rate)}, (1e-4, 1), True,
    ),
    Profile("8.4", (0.809,), "−ω* [rad/s], at Ω = 0.1 /s", {"": field("excess_rotation", thesis_rate)}, (-0.4, 0.6), x_range=(1, 7), fine=True),
    Profile("8.5", (0.809,), "M$_{zr}$ / d² [N/m³]", {"": field("couple_stress_zr", lambda leg: leg.d**-2)}, (-2, 12)),
    Profile("8.6", (0.809,), "κ$_{zr}$ / d² [1/m]", {"": field("curvature_zr", lambda leg: leg.d**-2)}, (-0.2, 1.8)),
    Profile("8.7", (0.800, 0.809, 0.811), "µ$_c$ l² [N/m²]", {"": field("torque_resistance")}, (0, 500)),
)  # fmt: skip


def mean_of(runs, of):
    """(means over runs, their errors), element by element"""
    found = [mean_over([v for v in column if np.isfinite(v)]) for column in zip(*(of(run) for run in runs))]
    means = np.array([e.value if e else np.nan for e in found], float)
    return means, np.array([e.error if e and e.error is not None else np.nan for e in found], float)


class Painter:
    def __init__(self, campaign, rules, folder):
        self.campaign, self.rules, self.folder = campaign, rules, folder
        self.engine = campaign.engines[0]

    def runs(self, label):
        leg = self.campaign.packing_leg(label)
        return self.campaign.of(leg, self.engine) if leg else []

    def save(self, number, axes):
        if any(ax.has_data() for ax in axes):
            for ax in axes:
                if ax.get_legend_handles_labels()[0]:
                    ax.legend(fontsize=7)
            axes[0].figure.suptitle(f"Figure {number}", fontsize=9)
            axes[0].figure.savefig(self.folder / f"figure_{number.replace('.', '_')}.png", dpi=110, bbox_inches="tight")
        pyplot.close(axes[0].figure)

    @staticmethod
    def panels(count, size=(4.2, 3.2)):
        figure, axes = pyplot.subplots(1, count, figsize=(size[0] * count, size[1]), squeeze=False, layout="constrained")
        return list(axes[0])

    @staticmethod
    def frame(ax, x_label, y_label, x=None, y=None, log=False):
        """Axes as wide as the thesis', and wider where data lie beyond."""
        ax.set_xlabel(x_label)
        ax.set_ylabel(y_label)
        ax.set_yscale("log" if log else "linear")
        if x:
            ax.set_xlim(*x)
        if y and ax.has_data():
            low, high = ax.dataLim.intervaly
            low = ax.dataLim.minposy if log else low
            ax.set_ylim(min(y[0], low), max(y[1], high))

    def profile(self, figure):
        [ax] = axes = self.panels(1)
        for label in figure.labels:
            runs = self.runs(label)
            rings = [run.fine() or run for run in runs] if figure.fine else runs
            for name, of in figure.curves.items() if rings else ():
                (x, _), (y, error) = mean_of(rings, figure.x), mean_of(rings, of)
                y = np.where(y > 0, y, np.nan) if figure.log else y
                style = "o-" if figure.x_label == DEPTH else "o"
                name = name if len(figure.labels) == 1 else f"{label:.3f}"
                ax.errorbar(x, y, error, fmt=style, ms=2, lw=0.8, elinewidth=0.5, label=name or None)
        if ax.has_data():
            for name, (x, y) in figure.lines.items():
                ax.plot(x, y, "--", color="grey", lw=0.8, label=name)
        self.frame(ax, figure.x_label, figure.y_label, figure.x_range, figure.y, figure.log)
        self.save(figure.number, axes)

    def over_density(self, number, parts):
        """parts: (label, axis, number of a run)"""
        axes = self.panels(len(parts))
        for ax, (label, y, of) in zip(axes, parts):
            points = []
            for leg in sorted(self.campaign.family("packings"), key=lambda leg: leg.label):
                means, errors = mean_of(self.campaign.of(leg, self.engine), lambda run: [float(of(run))])
                points += [(leg.label, means[0], errors[0])] if len(means) and np.isfinite(means[0]) else []
            if points:
                ax.errorbar(*np.transpose(points), fmt="o", ms=3)
                ax.axvspan(*SHEAR_FLOW, color="grey", alpha=0.15)
            self.frame(ax, "ν̄", label, (0.78, 0.83), y)
        self.save(number, axes)

    def over_rotations(self, number, label):
        axes = self.panels(2)
        for ax, (name, key) in zip(axes, (("ν, innermost ring", "at_wheel"), ("ν, outer half", "outside"))):
            for run in self.runs(label):
                spans = [s for s in run.history if s[f"volume_fraction_{key}"] is not None]
                ax.plot([(s["from"] + s["to"]) / 2 for s in spans], [s[f"volume_fraction_{key}"] for s in spans], "o-", ms=2)
            self.frame(ax, "rotations since the ring had closed", name, None, (0.4, 1))
        self.save(number, axes)

    def over_widths(self, number, label):
        """ν of neighbouring fine rings put together about a radius"""
        [ax] = axes = self.panels(1)
        fine = [run.fine() for run in self.runs(label) if run.fine()]
        for k, radius in enumerate((0.12, 0.13, 0.14, 0.20)) if fine else ():
            width = fine[0].leg.gap / fine[0].count
            counts = np.arange(1, int(3 * fine[0].leg.d / width) + 1)
            firsts = np.round((radius - fine[0].leg.inner) / width - counts / 2).astype(int)
            for method, style in (("slicing", "o-"), ("centre", "o--")):

                def together(rings):
                    nu = rings.by(method)
                    spans = [slice(first, first + count) for first, count in zip(firsts, counts) if first >= 0]
                    values = [np.sum((nu * rings.r)[span]) / np.sum(rings.r[span]) for span in spans]
                    return values + [np.nan] * (len(counts) - len(values))

                name = f"r = {radius:.2f} m" if method == "slicing" else None
                ax.plot(counts * width / fine[0].leg.d, mean_of(fine, together)[0], style, color=f"C{k}", ms=2, lw=0.8, label=name)
        ax.set_xscale("log")
        self.frame(ax, "Δr / d", "ν", (0.25, 4), (0, 2))
        self.save(number, axes)

    def densities(self, number, labels, panels):
        """panels: (title, quantity, r̃, x label, unit of a leg, y)"""
        axes = self.panels(len(panels))
        for ax, (title, quantity, r_tilde, x_label, unit, y) in zip(axes, panels):
            for label in labels:
                for run in self.runs(label)[:1]:
                    found = run.distribution(quantity, run.near(r_tilde))
                    if found:
                        there = found[1] > 0
                        ax.plot(found[0][there] * unit(run.leg), found[1][there] / unit(run.leg), "o-", ms=2, lw=0.8, label=f"{label:.3f}")
            ax.set_title(title, fontsize=8)
            self.frame(ax, x_label, "probability density", None, y, log=True)
        self.save(number, axes)

    def joint(self, number, labels):
        axes = self.panels(len(labels))
        for ax, label in zip(axes, labels):
            for run in self.runs(label)[:1]:
                found = run.distribution("azimuthal_velocity_and_spin", None, axes=2)
                if found:
                    ax.pcolormesh(*found, cmap="Greys", shading="nearest")
                    ax.plot([0, 1], [-1, 0], "--", color="C1", lw=0.8)
            ax.set_title(f"ν̄ = {label:.3f}", fontsize=8)
            self.frame(ax, "v$_φ$ / (Ω R$_i$)", "S d / (Ω D)")
        self.save(number, axes)

    def directions(self, number, label):
        places = (0.5, 2.5, 4, 8, 12, 19.5)
        axes = self.panels(len(places), (2.8, 2.8))
        for ax, r_tilde in zip(axes, places):
            for run in self.runs(label)[:1]:
                found = run.distribution("contact_direction", run.near(r_tilde))
                if found:
                    ax.step(found[0] / np.pi, 2 * np.pi * found[1], where="mid", lw=0.8)
                    ax.axhline(1, color="grey", lw=0.5)
            ax.set_title(f"r̃ = {r_tilde:g}", fontsize=8)
            self.frame(ax, "angle from r [π]", "relative to uniform", (-1, 1))
        self.save(number, axes)

    def collisions(self, number):
        axes = self.panels(2)
        for ax, (tension, title) in zip(axes, collisions.TENSION.items()):
            for k, (law, (psi, after, en, mu)) in enumerate(collisions.sweeps(self.campaign.collisions, self.engine, tension, 50).items()):
                ax.plot(psi, after, "o", ms=2, color=f"C{k}", label=law)
                constant = 3 * (1 + en) * mu
                ax.plot([constant, 4], [0, 4 - constant], "--", color="grey", lw=0.8)
            ax.set_title(title, fontsize=8)
            self.frame(ax, "Ψ$_i$", "Ψ$_f$", (0, 4), (-1, 3))
        self.save(number, axes)

    def model(self, label):
        """9.1 to 9.4: Mohan's model as printed and with frictions fitted to the ring at the wheel, scaled to that ring's velocity."""
        runs = self.runs(label)
        if not runs:
            return
        leg = runs[0].leg

        def mean_profile(name):
            return mean_of(runs, field(name))[0]

        velocity = mean_profile("azimuthal_velocity") * over_rim_speed(leg)
        xi = (runs[0].r - leg.inner) / leg.gap
        of_cell = cosserat.Parameters(inner_radius=leg.inner / leg.gap, grain_size=0.008 / leg.gap)
        sets = {"model as printed": of_cell}
        stresses = [mean_profile(name)[0] for name in ("stress_rr", "stress_pp", "stress_rp", "stress_pr", "couple_stress_zr")]
        fitted = cosserat.frictions(leg, runs[0].r[0], *stresses, of_cell)
        if fitted:
            sets["fitted frictions"] = dataclasses.replace(of_cell, wall_friction=fitted[0], internal_friction=fitted[1])
        found = {name: cosserat.solve(p) for name, p in sets.items()}
        fine = np.linspace(0, 1, 201)
        fields = {name: (solution(fine), velocity[0] / solution(xi[0])["u"]) for name, solution in found.items() if solution}
        trace = mean_profile("stress_trace")
        m = -2 * mean_profile("couple_stress_zr") / trace / (0.008 * 10 * np.sqrt(2 * (1 / 3 + 1)))
        spin = abs(mean_profile("spin")) * leg.gap * over_rim_speed(leg)
        parts = (
            ("9.1", "v$_φ$ / (Ω R$_i$)", (1e-5, 1), True, {"u": velocity}),
            ("9.2", "|S| H / (Ω R$_i$)", (1e-4, 10), True, {"omega": spin}),
            ("9.3", "shear stress / σ$_c$", (0, 0.6), False, {"s": 2 * mean_profile("stress_pr") / trace, "q": 2 * mean_profile("stress_rp") / trace}),
            ("9.4", "m", (0, 0.25), False, {"m": m}),
        )  # fmt: skip
        for number, y_label, y, log, averages in parts:
            axes = self.panels(len(averages))
            for ax, (name, values) in zip(axes, averages.items()):
                ax.plot(xi, values, "o", ms=3, label=self.engine)
                for title, (solution, scale) in fields.items():
                    ax.plot(fine, solution[name] * (scale if name in ("u", "omega") else 1), lw=0.9, label=title)
                self.frame(ax, "ξ", y_label if len(averages) == 1 else f"{name}: {y_label}", (0, 1))
                ax.set_yscale("log" if log else "linear")
                ax.set_ylim(*y)
            self.save(number, axes)


def draw_all(campaign, rules, folder):
    folder.mkdir(parents=True, exist_ok=True)
    painter = Painter(campaign, rules, folder)
    factor = rules.claims["C27"].numbers["factor"]

    def per_second(leg):
        return abs(leg.omega) * leg.inner / leg.d

    with np.errstate(all="ignore"):
        for figure in PROFILES:
            painter.profile(figure)
        painter.collisions("4.3")
        painter.over_rotations("5.5", 0.796)
        painter.over_widths("5.6", 0.804)
        painter.over_rotations("6.1", 0.804)
        fits = (("ν$_0$", (0.82, 0.87), "volume_fraction_outside"), ("B", (0, 0.7), "dilation"))
        painter.over_density("6.4", [(label, y, lambda run, name=name: run.fit(name)) for label, y, name in fits])
        painter.over_density("6.5", [("1/C [d]", (0, 10), lambda run: run.fit("dilation_decay").over(1))])
        painter.over_density("7.24", [("tr F$_{div}$", (0.5, 3.5), lambda run: divergence_trace(run, factor))])
        radial = "radial_velocity", "v$_r$ / d [1/s]", per_second, (1e-3, 10)
        places = (("0 < r̃ < 1", 0.5), ("12 < r̃ < 13", 12.5))
        painter.densities("6.6", (0.789, 0.804, 0.811), [(t, radial[0], r, *radial[1:]) for t, r in places])
        at_wheel = (("velocity", "azimuthal_velocity", "v$_φ$ / (Ω R$_i$)"), ("spin", "spin", "S d / (Ω D)"))
        painter.densities("6.10", (0.800, 0.811), [(t, q, 0.5, label, lambda leg: 1, (1e-3, 10)) for t, q, label in at_wheel])
        painter.joint("6.11", (0.800, 0.811))
        painter.directions("7.9", 0.804)
        painter.model(0.804)
