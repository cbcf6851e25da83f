"""A plate under the feet of a machine: power of the feet's forces into it, and its sound power."""

from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...study.structure_borne import StructureBorne
from ..machine import MachineOnMounts
from .driven import Plate, input_power, likeness, near_power, wave_power
from .spread import modal_overlap, relative_variance

_NO_LINE: Final = 1.0
"""Frequency, Hz, where there is no line and no force."""


class PlatePower(NamedTuple):
    """Power of the lines of one case, shape (line,).

    Attributes
    ----------
    input_w : into the plate
    sound_w : radiated to one side; zero where there is no line
    variance : of the sound power by the plate's modes, over its squared mean
    """

    input_w: Array
    sound_w: Array
    variance: Array


def plate_power(
    settings: StructureBorne, machine: MachineOnMounts, force: ComplexArray, frequency_hz: Array
) -> PlatePower:
    """Compute the power of the feet's vertical forces into the plate, and its sound power.

    Parameters
    ----------
    settings : plate under the feet
    machine : on its mounts
    force : of each foot at the lines, complex peaks, shape (line, foot, axis), N
    frequency_hz : of the lines, shape (line,); zero where there is none
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
    return PlatePower(power, total, variance)


def _input_power(
    settings: StructureBorne,
    plate: Plate,
    machine: MachineOnMounts,
    vertical: ComplexArray,
    frequency_hz: Array,
) -> Array:
    """Into the plate; where the machine has a floor of its file or a measured one, into that.

    Of a plate the motion of one foot by another is known, of other floors it is not.
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
