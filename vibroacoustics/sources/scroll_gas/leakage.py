"""Closed pockets that leak, along with the opening of the pair inside them.

The wrap parts pocket from pocket by half a turn at each contact: a pair of contacts at t has the
tips 2π r_b t of two wraps and two flanks of the height h, hence the gaps 2 (π r_b t δ_t + h δ_f).
"""

from typing import Final, NamedTuple

import numba
import numpy as np

from ...base.arrays import Array
from ...mechanics.nozzle import nozzle_flow
from ...mechanics.runge_kutta import stage_of
from .opening_equations import OpeningConstants
from .parameters import (
    ScrollGas,
    ScrollLeakage,
    ScrollWraps,
    contact_angle,
    contacts_at_opening,
    pocket_volume,
)
from .suction import SuctionFlow, TrappedGas, built_in_pressure_pa, polytropic_pressure_pa


class LeakingPairs(NamedTuple):
    """Pairs over the crank angle since the opening of pair 0, at half steps.

    Time histories run from `pairs` + 1 turns before an opening to it, those of contacts a turn
    further.
    """

    pairs: int
    """Closed ones at most."""
    steps: int
    """Steps of a turn."""
    closes_at: float
    """Half step at which a pair closes; before, the base pressure is that of suction pockets."""
    base_pa: Array
    """Pressure without leakage."""
    volume_m3: Array
    """Volume of both pockets."""
    area_m2: Array
    """Area of the gaps at the outer contacts, with their losses; zero before the pair has
    closed."""
    polytropic_index: float
    suction_density: float
    isentropic_exponent: float
    """κ of the flow through the gaps."""
    angular_speed: float


@numba.njit(cache=True, nogil=True, error_model="numpy")
def leaks_at(
    half: int, ratio: Array, mass: float, opened: tuple[float, float], p: LeakingPairs, leak: Array
) -> None:
    """Flow across the outer contacts of each pair into `leak`, kg/s.

    Parameters
    ----------
    half : half steps since the opening
    ratio : masses of the pairs 1 to `pairs`, over `mass`, shape (pairs,)
    mass : mass of a pair without leakage, kg
    opened : pressure and density of pair 0
    p : pairs
    leak : shape (pairs + 1,); it is changed
    """
    inner_pa, inner = opened
    for j in range(p.pairs + 1):
        number = (p.pairs - j) * 2 * p.steps + half
        outer_pa, outer = p.base_pa[number], p.suction_density
        if number >= p.closes_at:
            outer_pa *= ratio[j] ** p.polytropic_index
            outer = ratio[j] * mass / p.volume_m3[number]
        area = p.area_m2[number + 2 * p.steps]
        leak[j] = 0.0
        if area > 0.0:
            flow = nozzle_flow(inner_pa, outer_pa, inner, outer, p.isentropic_exponent)
            leak[j] = area * flow
        inner_pa, inner = outer_pa, outer


@numba.njit(cache=True, nogil=True, error_model="numpy")
def leaking_turn(
    start: Array, mass: float, opened_pa: Array, opened_density: Array, p: LeakingPairs
) -> tuple[Array, Array]:
    """Masses of the pairs and flows between them over a turn, by Runge-Kutta steps.

    Parameters
    ----------
    start : masses of the pairs 1 to `pairs` at the opening, over `mass`, shape (pairs,)
    mass : mass of a pair without leakage, kg
    opened_pa, opened_density : pressure and density of pair 0 at half steps, shape (2 steps + 1,)
    p : pairs

    Returns
    -------
    ratios, leaks : shapes (pairs, steps + 1) and (pairs + 1, steps + 1); leaks in kg/s
    """
    ratios, leaks = np.empty((p.pairs, p.steps + 1)), np.empty((p.pairs + 1, p.steps + 1))
    state, trial, rate = start.copy(), start.copy(), np.zeros(p.pairs)
    leak, step = np.empty(p.pairs + 1), 2.0 * np.pi / p.steps
    ratios[:, 0] = start
    for number in range(p.steps):
        trial[:] = state
        for stage in range(4):
            halves, reach, weight = stage_of(stage, step)
            half = 2 * number + halves
            leaks_at(half, trial, mass, (opened_pa[half], opened_density[half]), p, leak)
            if stage == 0:
                leaks[:, number] = leak
            for j in range(p.pairs):
                since = (p.pairs - j) * 2 * p.steps + 2 * (number + 1) - p.closes_at
                closed = min(max(0.5 * since, 0.0), 1.0)  # of this step
                rate[j] = closed * (leak[j] - leak[j + 1]) / (mass * p.angular_speed)
                trial[j] = ratios[j, number] + reach * rate[j]
                state[j] += weight * rate[j]
        ratios[:, number + 1] = state
    last = 2 * p.steps
    leaks_at(last, state, mass, (opened_pa[last], opened_density[last]), p, leak)
    leaks[:, p.steps] = leak
    return ratios, leaks


TURN: Final = 2.0 * np.pi
STEPS: Final = 512
"""A turn; four times as many change no pressure by more than 1e-5 of itself."""
ALMOST: Final = 1e-6
"""Share of a step."""
FIRST_TURNS: Final = 4
"""Turns beside gas at the discharge pressure, from which the opening's turns begin."""


class PocketTurn(NamedTuple):
    """Effect of a turn of the closed pockets on the opened pair."""

    opens_with: float
    """Mass of a pair at its opening, over that of one without leakage."""
    leak_kg_per_s: Array
    """Leakage out of the opened pair and the chamber that it becomes, over a turn."""


class TightPockets:
    """Closed pockets that keep what they closed with."""

    def __init__(self, wraps: ScrollWraps, gas: ScrollGas, filling: SuctionFlow | None) -> None:
        self._opens, self._fills = wraps.opening_angle_rad, filling is not None
        self.first = PocketTurn(closing_ratio(gas, filling), np.zeros(2))

    def turn(self, opened_pa: Array) -> PocketTurn:
        """Return the turn; all turns are equal."""
        return self.first

    def trapped(self) -> TrappedGas | None:
        """Return None where they close with gas at the suction pressure."""
        if not self._fills:
            return None
        angle = np.array([0.0, self._opens])
        return TrappedGas(angle, np.full(2, self.first.opens_with), angle, np.zeros(2))


class LeakingPockets:
    """Closed pockets around an opening, turn after turn."""

    def __init__(
        self,
        wraps: ScrollWraps,
        gas: ScrollGas,
        leakage: ScrollLeakage,
        opening: OpeningConstants,
        filling: SuctionFlow | None,
    ) -> None:
        self._opening, self._built_in = opening, built_in_pressure_pa(wraps, gas)
        self._index, self._begins_with = gas.polytropic_index, closing_ratio(gas, filling)
        pairs = int(wraps.opening_angle_rad // TURN) + 1
        self._angle = wraps.opening_angle_rad + TURN * (
            np.arange(2 * STEPS * (pairs + 2) + 1, dtype=np.float64) / (2.0 * STEPS) - pairs - 1.0
        )
        volume = 2.0 * pocket_volume(wraps, np.maximum(self._until_open, 0.0))
        self._volume = float(volume[-1])
        closes_at = max(-self._angle[0] / TURN * 2.0 * STEPS, 2.0 * STEPS + ALMOST)
        fills = int(np.ceil(closes_at))
        base = polytropic_pressure_pa(wraps, gas, self._until_open)
        if filling is not None:
            suction = filling.pocket_pressure_pa(self._until_open, gas.suction_pressure_pa)
            base[:fills] = suction[:fills]
        area = leakage.flow_ratio * gap_area_m2(wraps, leakage, self._angle)
        area[:fills] = 0.0
        self._pairs = LeakingPairs(
            pairs, STEPS, float(closes_at), base, volume, area, gas.polytropic_index,
            self._mass(self._begins_with) / float(volume[0]),
            opening.stiffness_exponent, opening.angular_speed,
        )  # fmt: skip
        self._start: Array = np.full(pairs, self._begins_with)
        self._ratios: Array = np.repeat(self._start[:, None], STEPS + 1, axis=1)
        self._leaks: Array = np.zeros((pairs + 1, STEPS + 1))
        for _ in range(FIRST_TURNS):
            self.first = self.turn(np.full(2, opening.pressure))

    @property
    def _until_open(self) -> Array:
        """Crank angles since a closing at half steps, of pockets; those of contacts go further."""
        return self._angle[: -2 * STEPS]

    def _mass(self, opens_with: float) -> float:
        """Return the mass of a pair without leakage, kg.

        At its opening a pair has the density of the opening's gas at the pair's pressure.

        Parameters
        ----------
        opens_with : mass of a pair at its opening, over that without leakage
        """
        c = self._opening
        pressure = self._built_in * opens_with**self._index
        density = c.density * (pressure / c.pressure) ** (1.0 / c.stiffness_exponent)
        return float(self._volume * density / opens_with)

    def turn(self, opened_pa: Array) -> PocketTurn:
        """One more turn beside the pressure in the opened pair, shape (steps + 1,), Pa."""
        c, half_steps = self._opening, np.linspace(0.0, 1.0, 2 * STEPS + 1)
        inner_pa = np.interp(half_steps, np.linspace(0.0, 1.0, opened_pa.size), opened_pa)
        density = c.density * (inner_pa / c.pressure) ** (1.0 / c.stiffness_exponent)
        mass = self._mass(float(self._ratios[0, -1]))
        self._ratios, self._leaks = leaking_turn(self._start, mass, inner_pa, density, self._pairs)
        self._start = np.append(self._ratios[1:, -1], self._begins_with)
        return PocketTurn(float(self._ratios[0, -1]), self._leaks[0])

    def trapped(self) -> TrappedGas:
        """Gas trapped in the last turn."""
        angle = self._angle[::2]
        ratio, leak = (
            np.append(rows[::-1, :-1].ravel(), rows[0, -1]) for rows in (self._ratios, self._leaks)
        )
        closed, contacts = angle[STEPS:][: ratio.size], angle[STEPS:]
        first = int(np.searchsorted(closed, 0.0))
        return TrappedGas(
            np.append(0.0, closed[first:]),
            np.append(self._begins_with, ratio[first:]),
            np.append(0.0, contacts[first:]),
            np.append(leak[first], leak[first:]),
        )


def gap_area_m2(wraps: ScrollWraps, leakage: ScrollLeakage, since_closing: Array) -> Array:
    """Return the area of the gaps at a pair of contacts, at tips and flanks, m².

    Parameters
    ----------
    wraps : geometry
    leakage : gaps
    since_closing : crank angle since the closing of the pocket inside, shape (...), rad
    """
    contact = np.maximum(contact_angle(wraps, since_closing), contacts_at_opening(wraps)[1])
    tips = np.pi * wraps.base_radius_m * contact * leakage.tip_gap_m
    return np.asarray(2.0 * (tips + wraps.height_m * leakage.flank_gap_m))


def closing_ratio(gas: ScrollGas, filling: SuctionFlow | None) -> float:
    """Mass that a pocket closes with, over that at the suction pressure."""
    if filling is None:
        return 1.0
    ratio = float(filling.pocket_pa[-1]) / gas.suction_pressure_pa
    return float(ratio ** (1.0 / gas.polytropic_index))
