"""Mohan's frictional Cosserat model of the steady flow between two cylinders (Lätzel 2003, chapter 9).

Eqs. 9.19–9.24 with the plus root of the yield condition. Lengths are in units of the gap H = R_o − R_i; ξ = (r − R_i)/H, r̄ = R̄_i + ξ:

    s = σ_rφ/σ_c, q = σ_φr/σ_c     shear stresses, *first index the normal of the face*: the stress_pr and stress_rp of averages
    m = M_rz/(d_p L √(2(A+1)) σ_c)  couple stress
    u = v_φ/(ΩR_i), ω = −spin·H/(ΩR_i)   velocity; spin, clockwise positive: only so does 9.21 leave a rigid rotation at rest

    9.20  q = −A s + R,   R² = (A² − 1) s² − 4(A+1)² m² + 2(A+1) sin²ψ
    9.23  s′ = −(s + q)/r̄
    9.24  c (m′ + m/r̄) = s − q          c = ε as printed; the definition of m in 9.18 calls for ε L √(2(A+1))
    9.21  u′ = u/r̄ − (ω + u/r̄) (A+1)(s + q)/R
    9.22  ε α ω′ = −(ω + u/r̄) 2(A+1) m/R,   α = L/√(2(A+1))

with s(0) = tan δ, q(1) = s(1) (the other end is a classical continuum), u(1) = 0 and u(0) = u₀. The thesis writes s(0) = −tan δ with
the minus root: nothing changes if s, q, m and R all change sign. u and ω fall by many decades, so that u/ω and ln ω are solved for."""

import dataclasses
import math

import numpy as np
import scipy.integrate

FLOOR = 1e-9  # of R², below which the stresses do not yield


@dataclasses.dataclass(frozen=True)
class Parameters:
    """The thesis' own."""

    inner_radius: float = 0.6916  #: R̄_i = R_i/H
    grain_size: float = 0.0536  #: ε = d_p/H
    length_scale: float = 10.0  #: L, in grain diameters
    asymmetry: float = 1 / 3  #: A, within (−1, 1)
    internal_friction: float = math.radians(22.6)  #: ψ [rad]
    wall_friction: float = math.radians(9.8)  #: δ [rad]
    wheel_velocity: float = 1.0  #: u₀
    consistent: bool = False  #: c by the definition of m instead of as printed

    @property
    def root(self):
        return math.sqrt(2 * (self.asymmetry + 1))

    @property
    def moment_factor(self):
        return self.grain_size * (self.length_scale * self.root if self.consistent else 1)

    @property
    def largest_shear(self):
        """s up to which the yield condition can be met, with m = 0"""
        return math.sin(self.internal_friction) * math.sqrt(2 / (1 - self.asymmetry))

    def yield_square(self, s, m):
        """R²; where it is negative no q meets the yield condition"""
        a, sine = self.asymmetry, math.sin(self.internal_friction)
        return (a**2 - 1) * s**2 - 4 * (a + 1) ** 2 * m**2 + 2 * (a + 1) * sine**2

    def yield_root(self, s, m):
        """R; a search may pass where there is none"""
        return np.sqrt(np.maximum(self.yield_square(s, m), FLOOR))

    def outer_couple(self, s):
        """m where q = s"""
        return math.sqrt(max(math.sin(self.internal_friction) ** 2 - s**2, 0.0)) / self.root


@dataclasses.dataclass(frozen=True)
class Solution:
    parameters: Parameters
    stresses: object  #: s and m over ξ
    motion: object  #: u/ω and ln ω

    def __call__(self, xi):
        """The fields at ξ: a dict of s, q, m, u, omega."""
        p = self.parameters
        (s, m), (ratio, log_omega), at_wheel = self.stresses(xi), self.motion(xi), self.motion(0.0)
        omega = p.wheel_velocity / at_wheel[0] * np.exp(log_omega - at_wheel[1])
        return {"s": s, "q": p.yield_root(s, m) - p.asymmetry * s, "m": m, "u": omega * ratio, "omega": omega}


def solve(p=Parameters(), tolerance=1e-10):
    """The Solution; None where none is found: the stresses cannot yield from the ring to the wheel with these frictions."""
    a, c, epsilon_alpha = p.asymmetry, p.moment_factor, p.grain_size * p.length_scale / p.root
    wall = math.tan(p.wall_friction)
    if wall > p.largest_shear:
        return None

    def stresses(xi, y):
        s, m = y
        r, q = p.inner_radius + xi, p.yield_root(s, m) - a * s
        return np.stack([-(s + q) / r, (s - q) / c - m / r])

    ends_of_stresses = lambda wheel, ring: np.array([wheel[0] - wall, ring[1] - p.outer_couple(ring[0])])
    def motion(xi, y):
        """of u/ω and ln ω, inward from the ring, where it is stable"""
        s, m = found.sol(xi)
        r, root = p.inner_radius + xi, p.yield_root(s, m)
        excess = 1 + y[0] / r  # of spin over the continuum's rotation, in units of ω
        shear, turn = (a + 1) * (s + root - a * s) / root, 2 * (a + 1) * m / (root * epsilon_alpha)
        return [y[0] / r + (y[0] * turn - shear) * excess, -turn * excess]

    # A start: s falls about as 1/r̄², m is what the ring has.
    xi = np.linspace(0, 1, 201)
    s = wall * (p.inner_radius / (p.inner_radius + xi)) ** 2
    guess = np.stack([s, np.full_like(xi, p.outer_couple(s[-1])) * np.sqrt(np.maximum(1 - (s / p.largest_shear) ** 2, 0.01))])
    with np.errstate(all="ignore"):
        found = scipy.integrate.solve_bvp(stresses, ends_of_stresses, xi, guess, tol=tolerance, max_nodes=20000)
        if found.status != 0 or p.yield_square(*found.y).min() <= FLOOR:
            return None
        moved = scipy.integrate.solve_ivp(motion, (1, 0), [0, 0], "DOP853", dense_output=True, rtol=1e-11, atol=1e-13)
    return Solution(p, found.sol, moved.sol) if moved.success and moved.y[0][-1] > 0 else None


def frictions(leg, r, rr, pp, rp, pr, couple, p=Parameters()):
    """(δ, ψ) with which the model has a ring's stresses [N/m², N/m], in the signs of averages (the force's index first): ψ is the
    angle of the yield condition that its own s, q and m meet,
        sin²ψ = (s² + q² + 2A s q + 4(A+1)² m²)/(2(A+1))   (9.19),
    and tan δ is σ_φr/σ_c at the wheel, to where the balance of moments carries the ring's, R_i(R_i σ_φr(R_i) + M_zr) = r(r σ_φr + M_zr).
    None where σ_c or σ_φr are not positive, or more than any ψ yields with."""
    a, sigma = p.asymmetry, 0.5 * (rr + pp)
    if not (sigma > 0 and pr > 0):
        return None
    s, q = pr / sigma, rp / sigma
    m = -couple / (p.grain_size * leg.gap * p.length_scale * p.root * sigma)
    square = (s**2 + q**2 + 2 * a * s * q + (2 * (a + 1) * m) ** 2) / (2 * (a + 1))
    at_wheel = (r * (r * pr + couple) / leg.inner - couple) / leg.inner
    if not (square <= 1 and at_wheel > 0):
        return None
    return math.atan(at_wheel / sigma), math.asin(math.sqrt(square))
