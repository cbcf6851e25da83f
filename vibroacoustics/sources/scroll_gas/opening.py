"""The opening of a pocket: pressures and flow of the gas over a turn, in its steady cycle."""

import math
from collections.abc import Callable
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError, SolverError
from ...base.units import shaft_frequency_hz
from .leakage import LeakingPockets, TightPockets
from .opening_equations import (
    CHAMBER,
    GAP_FLOW,
    PAIR,
    PLENUM,
    PORT_FLOW,
    OpeningConstants,
    density,
    one_turn,
)
from .parameters import (
    ScrollGas,
    ScrollLeakage,
    ScrollOpening,
    ScrollWraps,
    contacts_at_opening,
    full_gap_area_m2,
    least_chamber_volume_m3,
    pair_volume_m3,
    swept_volume_m3,
)
from .suction import OpenedGas, SuctionFlow, built_in_pressure_pa

STEPS: Final = 2048
"""A turn at least; 200 000 change no pressure by more than 1e-5 of the discharge pressure, no flow
by more than 5e-4 of its mean."""
STEPS_PER_S: Final = 50_000.0
"""Least number of steps a second: the gas swings in its passages at some kHz, however slow the
shaft."""
MOST_TURNS: Final = 200
REPEATED: Final = 1e-5
"""Change of the state over a turn, of its own size, below which it repeats."""


def steps_of_turn(speed_rpm: float) -> int:
    """Return how many steps of a turn the gas needs at a speed, a multiple of `STEPS`."""
    return STEPS * math.ceil(STEPS_PER_S / shaft_frequency_hz(speed_rpm) / STEPS)


def opening_constants(
    wraps: ScrollWraps, gas: ScrollGas, opening: ScrollOpening, speed_rpm: float
) -> OpeningConstants:
    """Constants of the equations; the mean flow is the mass of the pair at its opening a turn.

    Raises
    ------
    ParameterError
        The chamber would vanish within the turn, or the gas's state at discharge is not given.
    """
    least = least_chamber_volume_m3(wraps)
    if opening.chamber_volume_m3 <= least:
        raise ParameterError(
            f"opening.chamber_volume_cm3 = {1e6 * opening.chamber_volume_m3:.4g} cm³: must exceed "
            f"{1e6 * least:.4g} cm³, which these wraps sweep of it while a pair is open"
        )
    rho, sound = gas.discharge_state
    outer, inner = contacts_at_opening(wraps)
    frequency = shaft_frequency_hz(speed_rpm)
    constants = OpeningConstants(
        angular_speed=2.0 * np.pi * frequency,
        swept_volume=swept_volume_m3(wraps),
        outer_contact=outer,
        inner_contact=inner,
        chamber_volume=opening.chamber_volume_m3,
        plenum_volume=opening.plenum_volume_m3,
        gap_area=full_gap_area_m2(wraps),
        gap_length=opening.gap_length_m,
        port_area=0.25 * np.pi * opening.port_diameter_m**2,
        port_length=opening.port_length_m,
        discharge_coefficient=opening.discharge_coefficient_ratio,
        tube_admittance=0.25 * np.pi * opening.tube_diameter_m**2 / sound,
        mean_flow=0.0,
        pressure=gas.discharge_pressure_pa,
        density=rho,
        stiffness_exponent=rho * sound**2 / gas.discharge_pressure_pa,
    )
    trapped = float(pair_volume_m3(wraps, np.zeros(())))
    mass = trapped * density(built_in_pressure_pa(wraps, gas), constants)
    return constants._replace(mean_flow=mass * frequency)


def why_no_opening(wraps: ScrollWraps, gas: ScrollGas, opening: ScrollOpening) -> str | None:
    """Say why a pocket cannot open with inertia, at any speed; None where it can."""
    try:
        opening_constants(wraps, gas, opening, speed_rpm=60.0)
    except ParameterError as error:
        return str(error)
    return None


def steady_opening(
    wraps: ScrollWraps,
    gas: ScrollGas,
    opening: ScrollOpening,
    speed_rpm: float,
    steps: int | None = None,
    leakage: ScrollLeakage | None = None,
    filling: SuctionFlow | None = None,
) -> OpenedGas:
    """Pressures and flows over a turn that repeats.

    Parameters
    ----------
    wraps : geometry
    gas : pressures, polytropic index and state at discharge
    opening : passages and volumes
    speed_rpm : constant
    steps : number of steps of a turn, even; none for as many as the gas needs
    leakage : gaps between the pockets; none where they are tight
    filling : filling of the suction pockets; none where they are at the suction pressure
    """
    constants = opening_constants(wraps, gas, opening, speed_rpm)
    steps = steps or steps_of_turn(speed_rpm)
    pockets: TightPockets | LeakingPockets = TightPockets(wraps, gas, filling)
    if leakage is not None:
        pockets = LeakingPockets(wraps, gas, leakage, constants, filling)
    states = _steady_turn(constants, pockets, _opening_pair(wraps, gas, constants), steps)
    angle = np.linspace(0.0, 2.0 * np.pi, steps + 1, dtype=np.float64)
    flows = states[GAP_FLOW], states[PORT_FLOW]
    return OpenedGas(
        angle, states[PAIR], states[CHAMBER], states[PLENUM], *flows, pockets.trapped(), filling
    )


def _opening_pair(
    wraps: ScrollWraps, gas: ScrollGas, constants: OpeningConstants
) -> Callable[[float], tuple[float, float]]:
    """Pressure and mass of a pair that opens, of the mass over that without leakage."""
    built_in = built_in_pressure_pa(wraps, gas)
    volume = float(pair_volume_m3(wraps, np.zeros(())))

    def opening_pair(ratio: float) -> tuple[float, float]:
        pressure = built_in * ratio**gas.polytropic_index
        return pressure, volume * density(pressure, constants)

    return opening_pair


def _steady_turn(
    constants: OpeningConstants,
    pockets: TightPockets | LeakingPockets,
    opening_pair: Callable[[float], tuple[float, float]],
    steps: int,
) -> Array:
    """States of the turn that ends as it began, but for the pair, which is a new one.

    Each turn of the closed pockets follows one of the opened gas, whose leak and mean flow are then
    those of the next. Every second turn what is left of the change is taken as a geometric series
    (Irons and Tuck 1969): the plenum empties slowly.
    """
    size = np.array([constants.pressure, constants.pressure, constants.mean_flow])
    kept = [CHAMBER, PLENUM, PORT_FLOW]
    start = np.array([0.0, *size[:2], 0.0, size[2]])
    frequency, half_steps = constants.angular_speed / (2.0 * np.pi), np.arange(2 * steps + 1)
    before, beside = None, pockets.first
    for _ in range(MOST_TURNS):
        start[PAIR], mass = opening_pair(beside.opens_with)
        half_step = np.linspace(0.0, 2.0 * steps, beside.leak_kg_per_s.size)
        mean = mass * frequency - float(beside.leak_kg_per_s[:-1].mean())
        leak = np.interp(half_steps, half_step, beside.leak_kg_per_s)
        states = one_turn(start, steps, leak, constants._replace(mean_flow=mean))
        change = (states[kept, -1] - states[kept, 0]) / size
        if not np.all(np.isfinite(change)):
            break
        last, beside = beside, pockets.turn(states[PAIR])
        settles = abs(beside.opens_with - last.opens_with)
        if max(np.abs(change).max(), settles) < REPEATED:
            return states
        start[kept] = states[kept, -1]
        if before is None:
            before = change
            continue
        ratio = float(change @ before) / float(before @ before)
        if abs(ratio) < 1.0:
            start[kept] += ratio / (1.0 - ratio) * change * size
        before = None
    raise SolverError(
        "opening: the pressures after a pocket opens do not come to a periodic solution"
    )
