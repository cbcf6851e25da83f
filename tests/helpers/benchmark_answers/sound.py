"""Answers on sound of vibrating bodies and in rooms."""

from typing import get_args

import numpy as np

from vibroacoustics.base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from vibroacoustics.base.decibel import level_of_power
from vibroacoustics.base.revolution import capped_cylinder
from vibroacoustics.levels.bands import bands_between
from vibroacoustics.radiation.arrays import Array, ComplexArray
from vibroacoustics.radiation.exact import wavenumber
from vibroacoustics.radiation.revolution.mesh import mesh
from vibroacoustics.radiation.revolution.radiator import null_points, radiated, wall_pressure
from vibroacoustics.radiation.rooms import Lattice, Material, Room, RoomSettings, room_transfer
from vibroacoustics.study.room import RoomSide

from .case import Answer, Answers, Case

_ANGLES = 128
_ORDERS = 3
_FREQUENCIES_HZ = (100.0, 1000.0, 4000.0, 10000.0)
_MICROPHONES = {"side": (1.0, 0.0), "above": (0.6, 0.8), "below": (0.8, -0.6)}
_AXES = ("x", "y", "z")
_HIGHEST_HZ = 500.0
_BANDS_HZ = (95.0, 440.0)


def point_and_ring_sources(case: Case) -> Answers:
    """Answer with the pressure that boundary elements find from the velocity of the wall.

    The velocity of the wall is that of the sources in it; their field at the microphones is not
    used.
    """
    values = case.values
    profile = capped_cylinder(values["body_radius"], values["body_bottom"], values["body_top"])
    points = np.array(list(_MICROPHONES.values()))
    for frequency_hz in _FREQUENCIES_HZ:
        k = float(wavenumber(np.array(frequency_hz)))
        elements = mesh(profile, min(0.06, 300.0 / frequency_hz), 2)
        height_m = values["source_height"]
        ring = wall_velocity(
            elements.points, elements.normals, (values["ring_radius"], height_m), k
        )
        point = wall_velocity(elements.points, elements.normals, (0.0, height_m), k)
        columns = [np.stack([point[0] / (2.0 * np.pi), ring[0]], axis=1)]
        columns += [order[:, None] for order in ring[1:]]
        wall = wall_pressure(elements, null_points(elements), k, columns)
        fields = radiated(elements, points, k, columns, wall)
        for row, name in enumerate(_MICROPHONES):
            pressures = [*fields[0][row], fields[1][row, 0], fields[2][row, 0]]
            sources = ["point", *(f"ring order {order}" for order in range(_ORDERS))]
            for source, pressure in zip(sources, pressures, strict=True):
                label = f"{source} at {name}, {frequency_hz:g} Hz"
                yield Answer(f"{label}: real", "Pa", float(pressure.real))
                yield Answer(f"{label}: imaginary", "Pa", float(pressure.imag))


def wall_velocity(
    points: Array, normals: Array, source: tuple[float, float], k: float
) -> ComplexArray:
    """Normal velocity of a ring source's field, -1/(jωρ) dp/dn, m/s, shape (order, node).

    The field is the integral of cos(n a) exp(-jkr)/(4πr) over the azimuth a of the ring.

    Parameters
    ----------
    points : radius and height of the nodes, shape (node, 2), m
    normals : out of the body, shape (node, 2)
    source : radius and height of the ring, m
    k : wavenumber, rad/m
    """
    azimuth = 2.0 * np.pi * np.arange(_ANGLES) / _ANGLES
    turns = np.cos(np.multiply.outer(np.arange(_ORDERS), azimuth)) * 2.0 * np.pi / _ANGLES
    radial = points[:, :1] - source[0] * np.cos(azimuth)
    across, along = source[0] * np.sin(azimuth), points[:, 1:] - source[1]
    distance = np.sqrt(radial**2 + across**2 + along**2)
    facing = normals[:, :1] * radial + normals[:, 1:] * along
    slope = -(1.0 + 1j * k * distance) * np.exp(-1j * k * distance) * facing
    slope /= 4.0 * np.pi * distance**3
    omega = k * SPEED_OF_SOUND_M_PER_S
    return np.asarray(-(turns @ slope.T) / (1j * omega * AIR_DENSITY_KG_PER_M3))


def exact_room(case: Case) -> Answers:
    """Answer with the waves in the room, whose materials have the absorption of the case."""
    values = case.values
    size_x, size_y, size_z = (values[f"size_{axis}"] for axis in _AXES)
    room = Room((size_x, size_y, size_z), _walls(case))
    source = np.array([values[f"source_{axis}"] for axis in _AXES])
    points = [
        Lattice.of_point(np.array([values[f"microphone_{number}_{axis}"] for axis in _AXES]))
        for number in (1, 2, 3)
    ]
    frequency_hz = np.arange(80.0, _HIGHEST_HZ, 5.0)
    settings = RoomSettings(_HIGHEST_HZ)
    response = room_transfer(room, points, {"source": source}, frequency_hz, settings)["source"]
    green = np.stack([field.reshape(-1) for field in response.values], axis=1)
    for band in bands_between(3, *_BANDS_HZ):
        rows = (frequency_hz >= band.lower_hz) & (frequency_hz < band.upper_hz)
        level = level_of_power(np.mean(np.abs(green[rows]) ** 2, axis=0))
        for number, value in enumerate(level, 1):
            label = f"microphone {number}, third octave {band.nominal_hz:g} Hz"
            yield Answer(label, "dB re 1/m2", float(value))


def _walls(case: Case) -> dict[RoomSide, Material]:
    """Materials by side; above the highest octave of the case its absorption stays."""
    walls: dict[RoomSide, Material] = {}
    for side in get_args(RoomSide):
        octaves = [float(row["absorption"]) for row in case.rows if row["side"] == side]
        walls[side] = Material(side, (*octaves, octaves[-1], octaves[-1]))
    return walls
