"""A check valve that shuts after the stop: flight under a constant force, and an impact."""

import numpy as np

from ..base.arrays import Array
from ..machine.turning_back import CheckValve


def flight_s(valve: CheckValve) -> float:
    """From rest over the lift, √(2 m s/F)."""
    return float(np.sqrt(2.0 * valve.mass_kg * valve.lift_m / valve.closing_force_n))


def impact_s(valve: CheckValve) -> float:
    """Half a period on the seat, π √(m/k)."""
    return float(np.pi * np.sqrt(valve.mass_kg / valve.seat_stiffness_n_per_m))


def closing_time_s(valve: CheckValve) -> float:
    """Flight and impact."""
    return flight_s(valve) + impact_s(valve)


def closing_force_n(valve: CheckValve, time_s: Array) -> Array:
    """Force along z on what carries the valve, by its change of momentum, shape of the times.

    The disc flies down: its reaction F pushes up; on the seat it stays, with the half sine of the
    impulse √(2 F s m). Both cancel over time.

    Parameters
    ----------
    valve : disc
    time_s : from where it starts, uniform; an impact shorter than a step keeps its impulse
    """
    flight, length = flight_s(valve), impact_s(valve)
    step = float(time_s[1] - time_s[0])
    edges = np.append(time_s - 0.5 * step, time_s[-1] + 0.5 * step)
    flown = valve.closing_force_n * np.clip(edges, 0.0, flight)
    struck = np.clip((edges - flight) / length, 0.0, 1.0)
    impulse = valve.closing_force_n * flight
    momentum = flown - impulse * 0.5 * (1.0 - np.cos(np.pi * struck))
    return np.asarray(np.diff(momentum) / step)
