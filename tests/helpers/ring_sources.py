"""Exact sound fields: point sources in a body define the velocity of its wall."""

import numpy as np

from vibroacoustics.base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from vibroacoustics.radiation.exact import wavenumber

_ANGLES = 256


def ring_field(points, normals, source, frequency_hz, orders, floor_z_m=None):
    """Pressure and normal velocity of the orders of a ring, (order, point).

    Points and normals (point, 2) are radius and height; the ring has a source strength cos(n t)
    along it, unit by angle; its image in a floor is added.
    """
    k = float(wavenumber(np.array(frequency_hz)))
    angle = np.pi * (np.arange(_ANGLES) + 0.5) / _ANGLES
    turns = np.cos(np.multiply.outer(angle, np.arange(orders))) * 2.0 * np.pi / _ANGLES
    pressure = np.zeros((orders, len(points)), dtype=complex)
    slope = np.zeros_like(pressure)
    heights = [source[1]] if floor_z_m is None else [source[1], 2.0 * floor_z_m - source[1]]
    for height in heights:
        across, along = points[:, :1] - source[0], points[:, 1:] - height
        sine = np.sin(angle / 2.0) ** 2
        distance = np.sqrt(across**2 + along**2 + 4.0 * points[:, :1] * source[0] * sine)
        field = np.exp(-1j * k * distance) / (4.0 * np.pi * distance)
        facing = normals[:, :1] * (across + 2.0 * source[0] * sine) + normals[:, 1:] * along
        pressure += (field @ turns).T
        slope -= (((1.0 + 1j * k * distance) * field * facing / distance**2) @ turns).T
    omega = k * SPEED_OF_SOUND_M_PER_S
    return pressure, -slope / (1j * omega * AIR_DENSITY_KG_PER_M3)


def hemisphere(floor_z_m, number=18, radius_m=1.0):
    """Radius and height of points on a quarter circle about the axis' foot."""
    angle = np.linspace(0.02, np.pi / 2.0 - 0.02, number)
    return np.stack([radius_m * np.sin(angle), floor_z_m + radius_m * np.cos(angle)], axis=1)
