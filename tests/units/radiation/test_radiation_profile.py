"""Shells by points: exact spheres, the cylinder with domes by points, cut cells."""

import numpy as np
import pytest
from sphere_sound import sphere_pressure

from vibroacoustics.base.revolution import polygon
from vibroacoustics.machine.shell import Shell
from vibroacoustics.radiation.patterns import Pattern, rigid_body
from vibroacoustics.radiation.revolution.side import RevolutionSide
from vibroacoustics.radiation.rooms.room import Room
from vibroacoustics.radiation.rooms.standing import standing
from vibroacoustics.radiation.scene import machine_body
from vibroacoustics.radiation.transfer_vectors import transfer_vectors
from vibroacoustics.study.body import ShellBody
from vibroacoustics.study.radiation import RadiationSettings
from vibroacoustics.study.receivers import Receiver

RADIUS_M = 0.1
POINTS = np.array([[0.3, 0.0, 1.0], [1.0, 0.0, 0.0], [0.2, 0.0, -0.9], [0.15, 0.0, 0.1]])
PLACE = {"centre_of_mass_height_m": 0.2, "floor_clearance_m": 0.02}
DOMED = Shell(outer_diameter_m=0.165, height_m=0.417, dome_height_m=0.03, **PLACE)
BY_POINTS = Shell(
    profile_m=tuple((float(r), float(z) + 0.2) for r, z in DOMED.profile.points()), **PLACE
)
BOTTLE = Shell(
    profile_m=((0.0, 0.0), (0.1, 0.0), (0.1, 0.2), (0.05, 0.28), (0.05, 0.35), (0.0, 0.35)),
    centre_of_mass_height_m=0.15,
    floor_clearance_m=0.03,
)
RECEIVERS = {
    "front": Receiver(x_m=1.0825, y_m=0.0, height_m=0.24),
    "above": Receiver(x_m=0.3, y_m=0.2, height_m=1.2),
}


def of_sphere(step_deg, frequency_hz, **sizes):
    """Pressures and errors (point, pattern) of a sphere by points; it oscillates and pulsates."""
    angle = np.radians(np.linspace(-90.0, 90.0, round(180.0 / step_deg) + 1))
    points = RADIUS_M * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points[[0, -1], 0] = 0.0
    unit = Pattern(
        "pulsates", lambda at: at.position / np.linalg.norm(at.position, axis=1)[:, None]
    )
    patterns = [rigid_body("tx"), rigid_body("tz"), unit]
    return RevolutionSide(polygon(points), patterns, 10000.0).pressures(frequency_hz, POINTS)


def exact(frequency_hz):
    away = np.linalg.norm(POINTS, axis=1)
    ahead, hertz = np.array([1.0]), np.array([frequency_hz])
    swings, pulsates = (
        np.array([sphere_pressure(n, RADIUS_M, r, ahead, hertz)[0, 0] for r in away])
        for n in (1, 0)
    )
    x, z = POINTS[:, 0] / away, POINTS[:, 2] / away
    return np.stack([swings * x, swings * z, pulsates], axis=1)


def largest(difference, reference):
    return (np.abs(difference).max(axis=0) / np.abs(reference).max(axis=0)).max()


@pytest.mark.parametrize(
    ("frequency_hz", "tolerance"), [(100.0, 1e-4), (1000.0, 1e-4), (4000.0, 1e-4), (10000.0, 1e-3)]
)
def test_sphere_by_points_against_hankel_functions(frequency_hz, tolerance):
    """Straight lines leave an error of the square of their length, and the estimate covers it.

    Without it the boundary elements' own is left: 1e-4 to 4 kHz, 1e-3 at 10 kHz.
    """
    expected = exact(frequency_hz)
    (coarse, _), (fine, estimated) = (of_sphere(step, frequency_hz) for step in (7.5, 5.0))
    assert 3e-4 < largest(fine - expected, expected) < 2e-2
    assert np.all(np.abs(fine - expected).max(axis=0) < estimated.max(axis=0))
    ratio = (7.5 / 5.0) ** 2
    assert largest((ratio * fine - coarse) / (ratio - 1.0) - expected, expected) < tolerance


def test_cylinder_with_domes_by_points():
    """66 points of it give the same transfer vectors within what straight lines leave."""
    settings = RadiationSettings(room_solver="closed-form", maximum_frequency_hz=1000.0,
                                 frequency_step_hz=100.0)  # fmt: skip
    ours, smooth = (transfer_vectors(one, RECEIVERS, settings) for one in (BY_POINTS, DOMED))
    moving = ["tx", "tz", "rx"]
    ours, smooth = (one["transfer_vector"].sel(dof=moving) for one in (ours, smooth))
    away = abs(ours - smooth).max(["receiver", "frequency"])
    size = abs(smooth).max(["receiver", "frequency"])
    assert float((away / size).max()) < 1e-3
    assert machine_body(BY_POINTS, ShellBody()).vertices == pytest.approx(
        machine_body(DOMED, ShellBody()).vertices, abs=1e-12
    )


def test_cut_cells_take_a_profile():
    """A bottle's neck, against boundary elements, in the mean of all motions that make sound."""
    levels = []
    for method in ("revolution", "cut-cells"):
        settings = RadiationSettings(
            method=method,
            room_solver="closed-form",
            maximum_frequency_hz=500.0,
            near_field_spacing_m=0.02,
            frequency_step_hz=100.0,
        )
        made = transfer_vectors(BOTTLE, RECEIVERS, settings)["transfer_vector"]
        levels.append(20.0 * np.log10(np.abs(made.sel(dof=["tx", "tz"], frequency=500.0))))
    assert float(abs(levels[0] - levels[1]).max()) < 0.3


def test_room_has_a_cuboid_of_the_volume_of_the_profile():
    room = Room((4.0, 3.0, 2.5))
    stands = standing(BOTTLE, BOTTLE.profile, room, np.array([1.5, 1.5, 0.0]), 0.1)
    (body,) = stands.room.blocks
    sides = np.subtract(body.upper, body.lower)
    assert sides[2] == pytest.approx(0.35 + 0.03)
    assert sides[0] ** 2 * 0.35 == pytest.approx(BOTTLE.profile.volume_m3)


def test_kwave_takes_a_profile():
    """On the box around the bottle k-Wave gives the closed form's pressure."""
    settings = RadiationSettings(maximum_frequency_hz=300.0, frequency_step_hz=100.0)
    made = transfer_vectors(BOTTLE, {"front": RECEIVERS["front"]}, settings)
    kwave, closed = (
        made[name].sel(dof=["tx", "tz"])
        for name in ("transfer_vector", "transfer_vector_closed_form")
    )
    assert float((abs(kwave - closed) / abs(closed)).max()) < 0.01
