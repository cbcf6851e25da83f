"""From the forces of the feet through the plate under them to the microphones."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..levels.structure_borne import (
    PlateSound,
    mean_square_per_power,
    structure_borne_variables,
    weight_of,
)
from ..machine.source import Case
from ..mechanics.loads import Loads, PortLoads, lines_of, summed
from ..study.structure_borne import StructureBorne
from ..study.study import Study
from ..transfer import on_mounts
from ..transfer.foot_figures import foot_force
from ..transfer.machine import MachineOnMounts
from ..transfer.plate.driven import Plate, input_power, likeness, near_power, wave_power
from ..transfer.plate.spread import level_range, modal_overlap, relative_variance
from .motion import Motion

_NO_LINE: Final = 1.0
"""Frequency, Hz, that stands where there is no line and nothing is pushed."""


def structure_borne_sound(study: Study, motion: Motion, levels: xr.Dataset) -> xr.Dataset:
    """Sound of the plate under the feet; empty where the study has none.

    Parameters
    ----------
    study : with its table of the plate
    motion : of every speed with every option
    levels : with the lines of all sources and the levels by air
    """
    settings = study.structure_borne
    if settings is None:
        return xr.Dataset()
    frequency_hz = levels["tone_frequency"].transpose("speed", "line").values
    names = [str(name) for name in levels["line"].values]
    shape = (len(study.operation.speed_rpm), len(study.options), len(names))
    sound = PlateSound(np.zeros(shape), np.zeros(shape), np.zeros(shape))
    for s, speed in enumerate(study.operation.speed_rpm):
        for o, option in enumerate(study.options):
            case, loads = motion.cases[speed, option], motion.loads[speed, option]
            force = force_at_lines(case, loads, motion.wrenches[speed, option], names)
            row = np.nan_to_num(frequency_hz[s])
            _of_case(settings, on_mounts(case.machine), force, row, sound, (s, o))
    away_m = np.array([one.distance_m for one in study.receivers.values()])
    return structure_borne_variables(
        sound,
        mean_square_per_power(away_m, settings.absorption_area_m2),
        frequency_hz,
        _spread(settings, sound, frequency_hz),
        levels["level_total"],
        names,
    )


def force_at_lines(
    case: Case,
    loads: Mapping[str, Loads],
    wrenches: Mapping[str, PortLoads],
    names: list[str],
) -> ComplexArray:
    """Force of each foot on the floor at the lines, of all sources, shape (line, foot, axis), N.

    Parameters
    ----------
    case : speed and option
    loads : of all sources in it
    wrenches : lines of the wrenches over crank angle by source
    names : of the lines
    """
    orders = sum(name.startswith("order ") for name in names)
    lines = lines_of(loads, case.shaft_frequency_hz, orders - 1, wrenches)
    known = foot_force(on_mounts(case.machine), summed(lines.loads.values()), lines.frequency_hz)
    force = np.zeros((len(names), *known.shape[1:]), dtype=complex)
    force[[names.index(name) for name in lines.names]] = known
    return force


def _of_case(
    settings: StructureBorne,
    machine: MachineOnMounts,
    force: ComplexArray,
    frequency_hz: Array,
    sound: PlateSound,
    case: tuple[int, int],
) -> None:
    """Fill in the powers of a case."""
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
    sound.input_power_w[case], sound.power_w[case] = power, total
    if settings.size_m is not None:
        by_modes = np.where(total > 0.0, waves / np.where(total > 0.0, total, 1.0), 0.0)
        overlap = modal_overlap(
            frequency,
            plate.mass_kg_per_m2,
            plate.bending_stiffness_n_m,
            plate.total_loss_ratio(frequency),
            settings.size_m[0] * settings.size_m[1],
        )
        sound.variance[case] = relative_variance(overlap) * by_modes**2


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


def _spread(
    settings: StructureBorne, sound: PlateSound, frequency_hz: Array
) -> dict[str, tuple[Array, Array]]:
    """Of each line and of the A-weighted total, whose lines spread each for itself."""
    weighted = sound.power_w * weight_of("A", frequency_hz)[:, None]
    total = weighted.sum(axis=-1)
    squares = (weighted**2 * sound.variance).sum(axis=-1)
    variance = np.where(total > 0.0, squares / np.where(total > 0.0, total, 1.0) ** 2, 0.0)
    return {
        "line": level_range(sound.variance, settings.deviation_db),
        "total": level_range(variance, settings.deviation_db),
    }
