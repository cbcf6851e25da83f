"""Closed pockets that leak, along with the opening of the pair inside them.

The wrap parts pocket from pocket by half a turn at each contact: a pair of contacts at t has the
tips 2π r_b t of two wraps and two flanks of the height h, hence the gaps 2 (π r_b t δ_t + h δ_f).
"""

from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array
from .chambers import contact_angle, contacts_at_opening, pocket_volume
from .leakage_equations import LeakingPairs, leaking_turn
from .opening_equations import OpeningConstants
from .parameters import ScrollGas, ScrollLeakage, ScrollWraps
from .pressures import TrappedGas, built_in_pressure_pa, polytropic_pressure_pa
from .suction import SuctionFlow

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
