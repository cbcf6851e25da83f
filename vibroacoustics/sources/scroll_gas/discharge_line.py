"""Pulsation in the discharge tube of a scroll, before and behind a muffler chamber."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...base.curves import CRANK_ANGLES, Curve, CurveAxis, angle_axis
from ...base.units import shaft_frequency_hz
from ...machine.cavities import DischargeMuffler
from ...orders import order_spectrum
from ...transfer.four_poles import pipe, pressure_ratio, transmission_loss_db
from .opened_gas import OpenedGas

HIGHEST_HZ: Final = 4000.0
"""Of plane waves in the chamber, roughly, and of what the radiation takes."""


def discharge_line_curves(
    muffler: DischargeMuffler,
    opened: OpenedGas,
    state: tuple[float, float],
    tube_diameter_m: float,
    speed_rpm: float,
) -> Iterator[Curve]:
    """Pressure in the tube over a turn, and transmission loss of the chamber.

    The plenum gives the pressure at the tube's beginning, whatever the tube does: at these
    frequencies it is much the softer of the two.

    Parameters
    ----------
    muffler : chamber, and tube up to it
    opened : gas after the opening, with the plenum's pressure
    state : density and speed of sound at discharge, kg/m³ and m/s
    tube_diameter_m : before and behind the chamber
    speed_rpm : constant
    """
    density, sound_speed = state
    tube = 0.25 * np.pi * tube_diameter_m**2
    impedance, chamber = density * sound_speed / tube, 0.25 * np.pi * muffler.diameter_m**2

    shaft = shaft_frequency_hz(speed_rpm)
    orders = np.arange(int(HIGHEST_HZ / shaft) + 1)
    lines = np.asarray(orders * shaft)
    before = pipe(muffler.distance_m, tube, *state, lines)
    through = np.matmul(before, pipe(muffler.length_m, chamber, *state, lines))
    angle = np.linspace(0.0, 2.0 * np.pi, CRANK_ANGLES + 1, dtype=np.float64)
    at_shell = np.interp(angle[:-1], opened.since_opening, opened.plenum_pa)
    spectrum = order_spectrum(at_shell, int(orders[-1]))
    spectrum[0] = 0.0
    behind = spectrum * pressure_ratio(through, impedance)
    courses = {"at the shell": spectrum, "behind the muffler": behind}
    yield Curve(
        "tube_pressure", "Pulsation in the discharge tube",
        np.array([_over_angle(one, angle) for one in courses.values()]),
        (CurveAxis("tube_at", list(courses)),
         angle_axis(angle, "opening_angle", "Crank angle since a pocket has opened")),
        "bar", "derived: plane waves in tube and chamber",
    )  # fmt: skip
    frequency = np.linspace(0.0, HIGHEST_HZ, 801, dtype=np.float64)
    poles = pipe(muffler.length_m, chamber, *state, frequency)
    yield Curve(
        "muffler_loss", "Transmission loss of the muffler's chamber",
        transmission_loss_db(poles, impedance),
        (CurveAxis("tube_frequency", frequency, "hz", "Frequency"),), "db",
        "Munjal, Acoustics of Ducts and Mufflers, 1987",
    )  # fmt: skip


def _over_angle(spectrum: ComplexArray, angle: Array) -> Array:
    """Course of complex peaks by order."""
    turning = np.exp(1j * np.outer(np.arange(spectrum.size), angle))
    return np.asarray((spectrum @ turning).real)
