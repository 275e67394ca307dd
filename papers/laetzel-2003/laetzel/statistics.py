"""What many runs say together. A run is one packing, and runs are independent of each other."""

import dataclasses
import math

import numpy as np
import scipy.optimize
import scipy.stats

from laetzel.campaign import Measured

WITHIN_DOF = 8  # errors within a run rest on at most that many modes (averaging/statistics.cpp)
NO_SPREAD = 1e-12  # what rounding leaves of the spread of equal x, relative to x²


@dataclasses.dataclass
class Estimate:
    value: float
    error: float = None  #: standard error; None: not known
    dof: float = math.inf  #: of Student's t
    runs: int = 0
    basis: str = "runs"  #: over "runs"; "within" a single one; "exact": of a calculation, without error

    def half(self, confidence):
        """Half width of the interval; None where there is no error."""
        if self.basis == "exact":
            return 0.0
        if self.error is None:
            return None
        return scipy.stats.t.ppf(0.5 * (1 + confidence), min(self.dof, 1e6)) * self.error


def exactly(value):
    return Estimate(value, basis="exact")


def mean_over(numbers):
    """Mean and sd/√n; of one run its own error. None of none."""
    if not numbers:
        return None
    if len(numbers) == 1:
        error = numbers[0].error if isinstance(numbers[0], Measured) else None
        return Estimate(float(numbers[0]), error, WITHIN_DOF, 1, "within")
    values = np.array([float(number) for number in numbers])
    return Estimate(values.mean(), values.std(ddof=1) / math.sqrt(len(values)), len(values) - 1, len(values))


def rank_trend(x, y, fewest):
    """Kendall's τ_b, with the error that it has where y does not depend on x: the variance of S with ties in x and y (Kendall
    1970, chapter 4), taken as normal. None of fewer points than that, or where all x or all y are the same."""
    n = len(x)
    if n < max(fewest, 2) or len(set(x)) == 1 or len(set(y)) == 1:
        return None
    ties, others = (np.unique(values, return_counts=True)[1].astype(float) for values in (x, y))

    pairs = lambda t: t * (t - 1)
    full = lambda t: t * (t - 1) * (2 * t + 5)
    triple = lambda t: t * (t - 1) * (t - 2)
    variance = (full(n) - full(ties).sum() - full(others).sum()) / 18
    if n > 2:
        variance += triple(ties).sum() * triple(others).sum() / (9 * triple(n))
    variance += pairs(ties).sum() * pairs(others).sum() / (2 * pairs(n))
    scale = 0.5 * math.sqrt((pairs(n) - pairs(ties).sum()) * (pairs(n) - pairs(others).sum()))
    return Estimate(scipy.stats.kendalltau(x, y).statistic, math.sqrt(variance) / scale, runs=n)


def common_slope(x, y, groups):
    """Least-squares slope of y in x with a level of its own for each group. None where there is no spread in x within a group, or
    no point left over for the error."""
    x, y, groups = np.array(x, float), np.array(y, float), np.array(groups)
    dx, dy = x.copy(), y.copy()
    for group in set(groups):
        own = groups == group
        dx[own] -= x[own].mean()
        dy[own] -= y[own].mean()
    dof, spread = len(x) - len(set(groups)) - 1, np.sum(dx**2)
    if dof <= 0 or not spread > NO_SPREAD * np.sum(x**2):
        return None
    slope = np.sum(dx * dy) / spread
    return Estimate(slope, math.sqrt(np.sum((dy - slope * dx) ** 2) / dof / spread), dof, len(x))


def slope_over_runs(runs):
    """The slope through all points of all runs, [(x, y) …], with the error that leaving out one run after the other gives
    (jackknife; Efron 1982): points of one run are not independent. None of fewer than three runs, or without spread in x."""
    n = len(runs)
    if n < 3:
        return None

    def slope(points):
        x, y = np.concatenate(points, axis=1)
        if not np.sum((x - x.mean()) ** 2) > NO_SPREAD * np.sum(x**2):
            return np.nan
        return scipy.stats.linregress(x, y).slope

    without = np.array([slope(runs[:k] + runs[k + 1 :]) for k in range(n)])
    if not np.all(np.isfinite(without)):
        return None
    return Estimate(slope(runs), math.sqrt(np.sum((without - without.mean()) ** 2) * (n - 1) / n), n - 1, n)


def critical_density(labels, carries, beyond):
    """ν̄ at which half of the packings carry, by logistic regression with Jeffreys' prior (Firth 1993: finite where the two kinds
    do not overlap), its error by linearisation: (ν̄, error). None where all carry or none does, where more do at low ν̄, and where
    the half lies further outside of the packings' than `beyond`."""
    x, y = np.array(labels, float), np.array(carries, float)
    if len(x) == 0 or y.min() == y.max() or x.min() == x.max():
        return None
    middle, unit = 0.5 * (x.min() + x.max()), 0.5 * (x.max() - x.min())
    design = np.stack([np.ones(len(x)), (x - middle) / unit], axis=1)

    def information(parameters):
        chance = scipy.special.expit(design @ parameters)
        return chance, np.einsum("k,ki,kj->ij", chance * (1 - chance), design, design)

    def score(parameters):
        """Firth's: Σ (y − p + h(½ − p)) (1, x), h being the hat values"""
        chance, fisher = information(parameters)
        hat = chance * (1 - chance) * np.einsum("ki,ij,kj->k", design, np.linalg.inv(fisher), design)
        return design.T @ (y - chance + hat * (0.5 - chance))

    found = scipy.optimize.root(score, [0.0, 1.0], options={"xtol": 1e-13})
    level, slope = found.x
    if np.abs(score(found.x)).max() > 1e-9 or not slope > 0:
        return None
    half = -level / slope
    critical = middle + unit * half
    if not x.min() - beyond <= critical <= x.max() + beyond:
        return None
    # Var(−a/b) = (Var a + 2h Cov(a, b) + h² Var b)/b², h = −a/b
    gradient = np.array([1.0, half])
    variance = gradient @ np.linalg.inv(information(found.x)[1]) @ gradient
    return critical, unit * math.sqrt(variance) / slope


def power_law(x, y, errors):
    """The exponent p of y = A x^p with its error, weighted by 1/error² if all errors are there and positive, else equally; errors
    are scaled by χ²/dof without weights, and with weights where that exceeds 1. NaN where the points do not determine it, lie ten
    of their own errors off, or are fitted no better than by zero (F test at 0.01): as averaging/fits.hpp fits."""
    there = np.isfinite(y)
    x, y, errors = x[there], y[there], errors[there]
    if len(x) < 3:
        return Measured(np.nan)
    weighted = bool(np.all(errors > 0))
    sigma = errors if weighted else np.full(len(y), np.sqrt(np.mean(y**2)))

    law = lambda x, amplitude, p: amplitude * x**p
    slopes = lambda x, amplitude, p: np.stack([x**p, amplitude * x**p * np.log(x)], axis=1)
    start = np.array([y[0], -2.0])
    try:
        best, covariance = scipy.optimize.curve_fit(
            law, x, y, start, sigma, absolute_sigma=True, jac=slopes, xtol=1e-14, ftol=1e-14, gtol=1e-14, maxfev=1000
        )
    except RuntimeError:
        return Measured(np.nan)
    chi2, dof = np.sum(((law(x, *best) - y) / sigma) ** 2), len(x) - 2
    gained = (np.sum((y / sigma) ** 2) - chi2) / 2 / (chi2 / dof)
    if not np.all(np.isfinite(covariance)) or not -10 <= best[1] <= 5 or not scipy.stats.f.sf(max(gained, 0), 2, dof) < 0.01:
        return Measured(np.nan)
    if weighted and chi2 / dof > 100:
        return Measured(np.nan)
    scale = math.sqrt(max(chi2 / dof, 1.0) if weighted else chi2 / dof)
    return Measured(best[1], scale * math.sqrt(covariance[1, 1]))
