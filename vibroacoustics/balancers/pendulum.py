"""Pendulums hung from the Oldham ring (thesis 7.1): the driven nonlinear pendulum."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from math import cos, pi, sin, sqrt
from typing import ClassVar

import numpy as np
from pydantic import Field
from scipy.integrate import solve_ivp

from ..base import rounding
from ..base.registry import register
from ..constants import STANDARD_GRAVITY_M_PER_S2
from ..errors import ParameterError, SolverError
from ..mechanics.added import Added, RingForce
from ..mechanics.capabilities import Capability, OldhamRing
from ..mechanics.moving_parts import Array, MovingPart, Revolution, path, wrench
from ..parameters.machine import Machine
from ..parameters.option import Figures, Option
from ..units import shaft_frequency_hz

SETTLING_REVOLUTIONS = 300
NEWTON_STEPS = 30
STATE_TOLERANCE = 1e-11

State = tuple[float, float]
"""Angle from the vertical, rad, and its rate per radian of crank angle."""


@register
class Pendulum(Option):
    """Two equal pendulums hung from the Oldham ring (thesis 7.1).

    The masses follow from (7.5): all of the ring's momentum is to be taken by bobs that swing out
    by `horizontal_reach_m` at the end of the stroke.
    """

    kind: ClassVar[str] = "pendulum"
    needs: ClassVar[type[Capability]] = OldhamRing
    labels: ClassVar[Mapping[str, str]] = {
        "settled_angle_deg": "Mean angle in which the pendulum settles, from hanging (to either "
        "side)",
        "hanging_multiplier": "Growth per revolution when hanging (Floquet multiplier)",
        "settled_multiplier": "Growth per revolution when settled (Floquet multiplier)",
    }
    length_m: float = Field(ge=1e-3, le=1.0)
    horizontal_reach_m: float = Field(ge=1e-3, le=1.0)
    damping_ratio: float = Field(ge=1e-4, le=1.0)
    """Damping of the bearing, as a fraction of critical of the hanging pendulum."""

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """Two equal pendulums on the ring, in the periodic state that they settle in.

        Both bobs are taken on the same side, so that their vertical forces add. Their arms to
        either side of the ring are equal: one bob of the total mass in the middle makes the same
        force and moment.

        Raises
        ------
        SolverError
            No periodic state was found.
        """
        ring, rotation = machine.require(OldhamRing), revolution.rotation
        stroke = ring.stroke_m
        mass = pendulum_mass(stroke, ring.mass_kg, self.horizontal_reach_m)
        frequency = shaft_frequency_hz(revolution.speed_rpm)
        drive = Drive(self.length_m, self.damping_ratio, stroke, frequency)
        settled = settle(drive)
        hanging = periodic_state(drive, (-stroke / self.length_m, 0.0))
        angle = swing(drive, settled, rotation.crank_angle)
        bob = path(
            stroke * np.cos(rotation.crank_angle) + self.length_m * np.sin(angle),
            0.0,
            ring.height_m - self.length_m * np.cos(angle),
        )
        part = MovingPart("balancer", mass, bob)
        return Added(
            (part,),
            {
                "added_mass_kg": mass,
                "settled_angle_deg": float(np.rad2deg(abs(np.mean(angle)))),
                "hanging_multiplier": multiplier(drive, hanging),
                "settled_multiplier": multiplier(drive, settled),
            },
            RingForce(wrench((part,), rotation).force_n[0]),
        )

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Where the bobs hang, and what they would hit."""
        return (
            "Both bobs of a pendulum option are taken on the same side, so that their vertical "
            "forces add; on opposite sides the vertical 1× force would cancel. Stops are not "
            "modelled.",
        )

    def sentences(self, figures: Figures) -> tuple[str, ...]:
        """Whether hanging is stable, and where the pendulum settles."""
        growth = figures["hanging_multiplier"]
        size = rounding.span(growth, lambda value: rounding.fixed(value, 2))
        state = "stable" if growth.max() < 1.0 else "stable at some of the speeds only"
        hanging = f"Hanging is {state} (Floquet multiplier {size})."
        if growth.min() > 1.0:
            hanging = (
                f"Hanging is unstable: a deviation grows {size}-fold a revolution (Floquet "
                "multiplier)."
            )
        where = rounding.span(abs(figures["settled_angle_deg"]), rounding.fixed)
        return (
            hanging,
            f"The pendulum settles {where}° from hanging on average; stops are not modelled.",
        )


def pendulum_mass(stroke_m: float, ring_mass_kg: float, horizontal_reach_m: float) -> float:
    """Total bob mass of thesis (7.5) and (7.10): m = x_b M / (l_h - x_b), kg.

    Raises
    ------
    ParameterError
        The bobs cannot swing farther out than the ring moves.
    """
    if horizontal_reach_m <= stroke_m:
        raise ParameterError(
            f"horizontal_reach_mm = {1e3 * horizontal_reach_m:g} mm: must exceed the "
            f"ring's stroke amplitude of {1e3 * stroke_m:g} mm"
        )
    return stroke_m * ring_mass_kg / (horizontal_reach_m - stroke_m)


@dataclass(frozen=True)
class Drive:
    """A pendulum whose pivot moves as x = stroke cos(2π f t)."""

    length_m: float
    damping_ratio: float
    stroke_m: float
    frequency_hz: float

    @cached_property
    def natural_ratio(self) -> float:
        """Natural frequency of the hanging pendulum over the shaft frequency."""
        return sqrt(STANDARD_GRAVITY_M_PER_S2 / self.length_m) / (2.0 * pi * self.frequency_hz)

    def slope(self, crank_angle: float, state: Sequence[float]) -> State:
        """d(angle, rate)/dθ with rate = d(angle)/dθ.

        φ'' + 2ζ(ω_n/ω) φ' + (ω_n/ω)² sin φ + (x_b''/l) cos φ = 0 (corrected thesis 7.1).
        """
        angle, rate = state
        ratio = self.natural_ratio
        push = self.stroke_m / self.length_m * cos(crank_angle)
        damping = 2.0 * self.damping_ratio * ratio * rate
        return rate, push * cos(angle) - ratio**2 * sin(angle) - damping

    def extended_slope(self, crank_angle: float, extended: Sequence[float]) -> tuple[float, ...]:
        """Slope of the state and of its derivatives with respect to the two starting values."""
        angle, rate, *deviations = extended
        ratio = self.natural_ratio
        push = self.stroke_m / self.length_m * cos(crank_angle)
        stiffness = -(ratio**2) * cos(angle) - push * sin(angle)
        damping = -2.0 * self.damping_ratio * ratio
        first, second, first_rate, second_rate = deviations
        return (
            *self.slope(crank_angle, (angle, rate)),
            first_rate,
            second_rate,
            stiffness * first + damping * first_rate,
            stiffness * second + damping * second_rate,
        )


@cache
def settle(drive: Drive) -> State:
    """State at crank angle zero of the periodic motion that follows a start near hanging.

    Raises
    ------
    SolverError
        The motion does not become periodic, or only an unstable one was found.
    """
    start = (-drive.stroke_m / drive.length_m + 1e-3, 0.0)
    end = 2.0 * pi * SETTLING_REVOLUTIONS
    solution = solve_ivp(
        drive.slope, (0.0, end), start, method="LSODA", rtol=1e-8, atol=1e-10, t_eval=[end]
    )
    state = periodic_state(drive, tuple(solution.y[:, -1]))
    if multiplier(drive, state) >= 1.0:
        raise SolverError(f"pendulum at {drive.frequency_hz:g} Hz settles in no stable motion")
    return state


@cache
def periodic_state(drive: Drive, guess: State) -> State:
    """Fixed point of the once-per-revolution map, by Newton's method from a guess.

    Raises
    ------
    SolverError
        Newton's method does not converge.
    """
    state = np.array(guess)
    for _ in range(NEWTON_STEPS):
        after, tangent = revolution(drive, state)
        try:
            step = np.linalg.solve(tangent - np.eye(2), state - after)
        except np.linalg.LinAlgError:  # a bifurcation: the motion is not isolated
            break
        state = state + step
        if np.max(np.abs(step)) < STATE_TOLERANCE:
            return float(state[0]), float(state[1])
    raise SolverError(f"pendulum at {drive.frequency_hz:g} Hz: no periodic motion found")


@cache
def multiplier(drive: Drive, state: State) -> float:
    """Largest growth of a small deviation per revolution (Floquet); above one is unstable."""
    tangent = revolution(drive, np.array(state))[1]
    return float(np.max(np.abs(np.linalg.eigvals(tangent))))


def revolution(drive: Drive, state: Array) -> tuple[Array, Array]:
    """State after one revolution and its derivative with respect to the state before."""
    start = (*state, 1.0, 0.0, 0.0, 1.0)
    end = _integrate(drive.extended_slope, start, np.array([2.0 * pi]))[:, -1]
    return np.asarray(end[:2]), np.asarray(end[2:].reshape(2, 2))


def swing(drive: Drive, state: State, crank_angle: Array) -> Array:
    """Angle of the pendulum from the vertical over one revolution, rad."""
    return np.asarray(_integrate(drive.slope, state, crank_angle)[0])


def _integrate(
    slope: Callable[..., Sequence[float]], start: Sequence[float], crank_angle: Array
) -> Array:
    """Solution at crank angles from zero to one revolution, to nearly rounding."""
    solution = solve_ivp(
        slope,
        (0.0, 2.0 * pi),
        start,
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
        t_eval=crank_angle,
        max_step=0.1,
    )
    return np.asarray(solution.y)
