"""Equations of keys, film and faces written a second time, for scipy's stiff solver Radau."""

from dataclasses import dataclass
from math import cos, inf, log, pi, sin, sqrt, tanh

import numpy as np
from scipy.integrate import solve_ivp

STICKING_M_PER_S = 2e-3
TINY_M = 1e-16
"""Deflection below which a face that parts from its key stays where it is."""


@dataclass(frozen=True)
class FaceLaw:
    """A crowned face with its film.

    Attributes
    ----------
    stiffness, damping : K and η
    area : A of the flat limit A/h³
    sag, shape, layer : S, a and t
    """

    stiffness: float
    damping: float
    area: float
    sag: float
    shape: float
    layer: float = inf

    def coefficient(self, h: float) -> float:
        """Film force per speed of approach, N s/m; zero above the layer, infinite at contact."""
        if h >= self.layer:
            return 0.0
        if h <= 0.0:
            return inf
        wet = min(self.sag, self.layer - h)
        flooded = self.area / (h * (h * h + 2.0 * self.shape * h * wet + wet * wet))
        return flooded * (wet / self.sag) ** 2

    def force_and_rate(self, d: float, gap: float, speed: float) -> tuple[float, float]:
        """Push on the key, N, and d', m/s."""
        if d <= TINY_M:
            waits = speed <= 0.0 or gap >= self.layer
            return 0.0, 0.0 if waits else speed
        damper = self.damping * d**0.25
        push = max(self.stiffness * d**1.5 + damper * speed, 0.0)
        c = self.coefficient(gap + d)
        if c == inf:
            return push, speed
        return push * c / (c + damper), speed - push / (c + damper)


def tsuji_damping(restitution: float, mass: float, stiffness: float) -> float:
    """η of Tsuji for the restitution e as obtained: e = f + (1 - f)²/5, f the formula's value."""
    formula = 1.0 - 2.5 * (1.0 - sqrt(1.0 - 0.8 * (1.0 - restitution)))
    return -sqrt(5.0) * log(formula) / sqrt(log(formula) ** 2 + pi**2) * sqrt(mass * stiffness)


@dataclass(frozen=True)
class Ring:
    """Ring and scroll, driven at constant speed.

    Attributes
    ----------
    law : of every face
    mass, ring_inertia, scroll_inertia, radius, clearance, friction : of the ring
    stroke, omega : of the orbit
    moment, force : on the scroll and on the ring, of the crank angle
    """

    law: FaceLaw
    mass: float
    ring_inertia: float
    scroll_inertia: float
    radius: float
    clearance: float
    friction: float
    stroke: float
    omega: float
    moment: object
    force: object

    def normal(self, time, state):
        """Force on each key across its slot, its friction's sum of pushes, and all d'."""
        u, y, turn, scroll, vu, vy, spin, scroll_spin, *faces = state
        sway = self.stroke * sin(self.omega * time)
        sway_rate = self.omega * self.stroke * cos(self.omega * time)
        radius = self.radius
        shifts = (
            u - radius * turn + (radius - sway) * scroll,
            u + radius * turn - (radius + sway) * scroll,
            y + radius * turn,
            y - radius * turn,
        )
        rates = (
            vu - radius * spin + (radius - sway) * scroll_spin - sway_rate * scroll,
            vu + radius * spin - (radius + sway) * scroll_spin - sway_rate * scroll,
            vy + radius * spin,
            vy - radius * spin,
        )
        normal, pushes, slopes = [], [], []
        for key in range(4):
            net = total = 0.0
            for number, side in ((2 * key, 1.0), (2 * key + 1, -1.0)):
                gap = self.clearance - side * shifts[key]
                push, slope = self.law.force_and_rate(faces[number], gap, side * rates[key])
                net, total = net - side * push, total + push
                slopes.append(slope)
            normal.append(net)
            pushes.append(total)
        return normal, pushes, slopes

    def __call__(self, time, state):
        normal, pushes, slopes = self.normal(time, state)
        angle, orbital = self.omega * time, self.omega * self.stroke
        sway = self.stroke * sin(angle)
        on_y = -self.friction * tanh((state[5] - orbital * cos(angle)) / STICKING_M_PER_S)
        on_x = -self.friction * tanh((state[4] - orbital * sin(angle)) / STICKING_M_PER_S)
        a, b, c, d = normal
        force_x = a + b + on_x * (pushes[2] + pushes[3]) + self.force(angle)
        force_y = c + d + on_y * (pushes[0] + pushes[1])
        scroll = self.moment(angle) + (self.radius - sway) * a - (self.radius + sway) * b
        return [
            *state[4:8],
            force_x / self.mass + self.omega * orbital * cos(angle),
            force_y / self.mass,
            self.radius * (b - a + c - d) / self.ring_inertia,
            scroll / self.scroll_inertia,
            *slopes,
        ]

    def forces(self, time, tolerance=1e-4):
        """Force on each key across its slot at given times from rest, shape (4, times), N.

        A hundredth of the tolerance changes no root mean square of a key by more than 4e-5.
        """
        scales = np.array([1e-9] * 4 + [1e-4] * 4 + [1e-9] * 8)
        solved = solve_ivp(
            self, (0.0, time[-1]), np.zeros(16), "Radau", t_eval=time,
            rtol=tolerance, atol=tolerance * scales * 1e2, max_step=2e-5,
        )  # fmt: skip
        assert solved.success
        return np.array([self.normal(t, s)[0] for t, s in zip(solved.t, solved.y.T, strict=True)]).T


def rebound_speed(law: FaceLaw, mass: float, speed: float, gap: float) -> float:
    """Speed at which a mass leaves a face that it approached from a gap with a speed, m/s."""

    def slopes(_, state):
        d, place, rate = state
        push, slope = law.force_and_rate(max(d, 0.0), place, -rate)
        return [slope, rate, push / mass]

    def gone(_, state):
        return state[1] - 1.01 * gap

    gone.terminal, gone.direction = True, 1.0
    solved = solve_ivp(
        slopes, (0.0, 50.0 * gap / speed + 1e-2), [0.0, gap, -speed], "Radau",
        rtol=1e-8, atol=[1e-16, 1e-15, 1e-9 * speed], events=gone, max_step=gap / speed / 20.0,
    )  # fmt: skip
    assert solved.success
    return float(solved.y[2, -1])
