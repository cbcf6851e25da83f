"""A plate under the feet of a machine: power of the feet's forces into it, and its sound power."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from scipy.special import exp1

from ...base.arrays import Array, ComplexArray
from ...machine.cases import Cases
from ...machine.source import CaseKey
from ...mechanics.received_sound import PlateSound
from ...study.structure_borne import StructureBorne
from ..foot_figures import force_at_lines
from ..machine import MachineOnMounts, on_mounts
from .driven import Plate, input_power, likeness, near_power, wave_power

_NO_LINE: Final = 1.0
"""Frequency, Hz, where there is no line and no force."""


def plate_sound(
    settings: StructureBorne, cases: Cases, options: Sequence[str], frequency: xr.DataArray
) -> PlateSound:
    """Compute the power of the feet's vertical forces into the plate, and its sound power.

    Parameters
    ----------
    settings : plate under the feet
    cases : with their loads
    options : in the order of the result
    frequency : frequency of the lines by their names, (speed, line), Hz; not a number where there
        is none

    Returns
    -------
    shapes (speed, option, line)
    """
    names = [str(name) for name in frequency["line"].values]

    def of_case(key: CaseKey) -> PlateSound:
        case = cases.cases[key]
        force = force_at_lines(case, cases.loads[key], cases.wrenches[key], names)
        hertz = np.nan_to_num(frequency.sel(speed=key[0]).values)
        return plate_power(settings, on_mounts(case.machine), force, hertz)

    speeds = frequency["speed"].values.tolist()
    every = [[of_case((speed, option)) for option in options] for speed in speeds]
    return PlateSound(*np.moveaxis(np.array(every), 2, 0))


def plate_power(
    settings: StructureBorne, machine: MachineOnMounts, force: ComplexArray, frequency_hz: Array
) -> PlateSound:
    """Compute the sound power of the lines of one case, shape (line,).

    Parameters
    ----------
    settings : plate under the feet
    machine : on its mounts
    force : force of each foot at the lines, complex peaks, shape (line, foot, axis), N
    frequency_hz : frequency of the lines, shape (line,); zero where there is none
    """
    plate = Plate(
        settings.mass_kg_per_m2,
        settings.bending_stiffness_n_m,
        settings.loss_factor_ratio,
        settings.size_m,
    )
    moves = frequency_hz > 0.0
    frequency = np.where(moves, frequency_hz, _NO_LINE)
    vertical = force[..., 2] * moves[:, None]
    power = _input_power(settings, plate, machine, vertical, frequency)
    near = near_power(plate, frequency, vertical, machine.foot_position)
    waves = wave_power(plate, frequency, power)
    total = near + waves
    variance = np.zeros(frequency.shape)
    if settings.size_m is not None:
        by_modes = np.where(total > 0.0, waves / np.where(total > 0.0, total, 1.0), 0.0)
        overlap = modal_overlap(
            frequency,
            plate.mass_kg_per_m2,
            plate.bending_stiffness_n_m,
            plate.total_loss_ratio(frequency),
            settings.size_m[0] * settings.size_m[1],
        )
        variance = relative_variance(overlap) * by_modes**2
    return PlateSound(power, total, variance)


def _input_power(
    settings: StructureBorne,
    plate: Plate,
    machine: MachineOnMounts,
    vertical: ComplexArray,
    frequency_hz: Array,
) -> Array:
    """Power into the plate; where the machine has a floor of its file or a measured one, into that.

    The motion of one foot by another is known for a plate, for other floors it is not.
    """
    stand = machine.stand
    feet = len(stand.names)
    if stand.floor == settings.floor:
        alike = likeness(plate, frequency_hz, machine.foot_position)
        same = np.full(vertical.shape, settings.mobility_m_per_ns)
        return input_power(vertical, same, alike)
    omega = 2.0 * np.pi * frequency_hz
    mobility: Array = np.zeros(vertical.shape)
    if stand.floor is not None:
        each = [stand.floor.receptance(name, frequency_hz)[:, 2] for name in stand.names]
        mobility = np.asarray((1j * omega * np.array(each)).real.T)
    return input_power(
        vertical, mobility, np.broadcast_to(np.eye(feet), (*omega.shape, feet, feet))
    )


GAUSSIAN: Final = 3.0
"""E[φ⁴]/E[φ²]² of mode shapes at a point, taken as Gaussian; 2.25 of a hinged rectangle."""
_FEW: Final = 1e-3
_MANY: Final = 30.0


def modal_overlap(
    frequency_hz: Array,
    mass_kg_per_m2: float,
    bending_stiffness_n_m: float,
    loss_ratio: Array,
    area_m2: float,
) -> Array:
    """Half-power band of a mode times modes a hertz: f η S/2 √(m/B), shape (...).

    Modes a hertz of a plate: Cremer, Heckl, Petersson, Structure-Borne Sound (2005).
    """  # fmt: skip
    density = 0.5 * area_m2 * np.sqrt(mass_kg_per_m2 / bending_stiffness_n_m)
    return np.asarray(frequency_hz * loss_ratio * density)


def relative_variance(overlap: Array) -> Array:
    """Variance over squared mean of the energy by one force at one frequency, shape (...).

    r² = 1/(πM) {α - 1 + (1 - e^{-2πM})/(2πM) + E1(πM) [cosh πM - sinh πM/(πM)]} with the natural
    frequencies of a random matrix (Langley and Brown, J. Sound Vib. 275 (2004) 823), α = GAUSSIAN.

    Parameters
    ----------
    overlap : M above zero, shape (...)
    """
    x = np.pi * np.maximum(np.asarray(overlap, dtype=float), _FEW)
    some = np.minimum(x, _MANY)
    last = exp1(some) * (np.cosh(some) - np.sinh(some) / some)
    last = np.where(x > _MANY, 0.5 / x, last)  # E1(x) eˣ tends to 1/x
    return np.asarray((GAUSSIAN - 1.0 + (1.0 - np.exp(-2.0 * x)) / (2.0 * x) + last) / x)
