"""Blocked forces at shaft orders, as a machine by table reads them."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.errors import ParameterError
from ..base.units import shaft_frequency_hz
from ..mechanisms.tabulated.csv_layout import orders_csv

ON_ORDER: Final = 0.01
"""Largest distance of a line from an order, in orders."""
SOURCE: Final = "blocked_forces"


def blocked_orders_csv(blocked: xr.Dataset) -> bytes | None:
    """Return force and moment by order as CSV for a machine by table; None without a speed.

    Raises
    ------
    ParameterError
        No line is an order of the speed.
    """
    speed = blocked.attrs.get("speed_rpm")
    if speed is None:
        return None
    force = blocked["blocked_force_sum"].values
    peaks = np.concatenate([force, blocked["blocked_moment_sum"].values])
    shaft_hz = shaft_frequency_hz(float(speed))
    order = blocked["frequency"].values / shaft_hz
    lines = np.flatnonzero((np.abs(order - np.rint(order)) <= ON_ORDER) & (order > 0.5))
    numbers = np.rint(order[lines]).astype(int)
    if len(lines) == 0 or len(set(numbers.tolist())) < len(numbers):
        count = "no line is" if len(lines) == 0 else "several lines are"
        raise ParameterError(
            f"blocked_forces.speed_rpm = {speed:g} rpm: {count} within {ON_ORDER:g} of an order, "
            f"a multiple of {shaft_hz:g} Hz; give operating spectra at the orders"
        )
    return orders_csv(
        (float(speed), int(number), SOURCE, peaks[:, line])
        for number, line in zip(numbers, lines, strict=True)
    )
