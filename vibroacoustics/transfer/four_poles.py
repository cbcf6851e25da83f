"""Plane waves in pipes as four-poles of pressure and volume flow (Munjal, Acoustics of Ducts and
Mufflers, 1987, chapter 2)."""

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.decibel import level_of_power


def pipe(
    length_m: float, area_m2: float, density: float, sound_speed: float, frequency_hz: Array
) -> ComplexArray:
    """[p, q] at the beginning by [p, q] at the end, shape (frequency, 2, 2).

    [[cos kL, j Z sin kL], [j sin kL / Z, cos kL]], Z = ρc/S.

    Parameters
    ----------
    length_m, area_m2 : length and area of the pipe
    density, sound_speed : density and speed of sound of the gas, kg/m³ and m/s
    frequency_hz : shape (frequency,)
    """
    angle = 2.0 * np.pi * frequency_hz * length_m / sound_speed
    impedance = density * sound_speed / area_m2
    cosine, sine = np.cos(angle), 1j * np.sin(angle)
    rows = [[cosine + 0j, impedance * sine], [sine / impedance, cosine + 0j]]
    return np.moveaxis(np.array(rows), 2, 0)


def pressure_ratio(poles: ComplexArray, end_impedance: float) -> ComplexArray:
    """Pressure at the end over that at the beginning, shape (frequency,).

    Parameters
    ----------
    poles : shape (frequency, 2, 2)
    end_impedance : p/q at the end, ρc/S of a pipe that goes on without reflection, Pa s/m³
    """
    return np.asarray(1.0 / (poles[:, 0, 0] + poles[:, 0, 1] / end_impedance))


def transmission_loss_db(poles: ComplexArray, impedance: float) -> Array:
    """Incident over transmitted power between two like pipes without reflection, (frequency,).

    20 lg |A + B/Z + C Z + D|/2.

    Parameters
    ----------
    poles : four poles of what lies between them, shape (frequency, 2, 2)
    impedance : Z = ρc/S of the pipes, Pa s/m³
    """
    (a, b), (c, d) = np.moveaxis(poles, 0, 2)
    return level_of_power(np.abs(0.5 * (a + b / impedance + c * impedance + d)) ** 2)
