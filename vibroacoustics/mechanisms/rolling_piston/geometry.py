"""Volumes of a rolling-piston cylinder and motion of its vane, in closed form (Park 2010).

The angle θ goes from the vane to the line where the roller touches the bore, in the sense of the
shaft. The suction chamber is behind this line, the compression chamber ahead of it. The vane's tip
is a point in its mid-plane.
"""

import numpy as np

from ...base.arrays import Array
from .parameters import Cylinder


def vane_extension(cylinder: Cylinder, angle: Array) -> Array:
    """Extension x of the vane into the bore, with its first and second derivative over the angle.

    Park, Energy Conversion and Management 51 (2010) 277, equation of the vane:
    x = R_c - e cos θ - √(R_r² - e² sin²θ), with a = R_r/R_c the same as
    R_c (1 - (1-a) cos θ - √((1-a)² cos²θ + 2a - 1)). To first order in e/R_c, x = e (1 - cos θ).

    Parameters
    ----------
    cylinder : radii in m
    angle : θ, shape (samples,), rad

    Returns
    -------
    shape (3, samples), m, m/rad, m/rad²
    """
    e = cylinder.eccentricity_m
    sine, cosine = np.sin(angle), np.cos(angle)
    root = np.sqrt(cylinder.roller_radius_m**2 - (e * sine) ** 2)
    slope = -(e**2) * sine * cosine / root
    bend = (-(e**2) * np.cos(2.0 * angle) - slope**2) / root
    # 1 - cos θ and R_r - root, each without cancellation near θ = 0
    near = 2.0 * e * np.sin(0.5 * angle) ** 2 + (e * sine) ** 2 / (cylinder.roller_radius_m + root)
    return np.stack([near, e * sine - slope, e * cosine - bend])


def suction_volume(cylinder: Cylinder, angle: Array) -> Array:
    """Volume V_s of the suction chamber and its derivative over the angle.

    Park (2010): V_s = H R_c²/2 [(1-a²) θ - (1-a)² sin 2θ/2 - a² arcsin((1/a-1) sin θ)
    - a (1-a) sin θ √(1 - (1/a-1)² sin²θ)] - B H x/2, with half of the vane in each chamber. Its
    derivative is H/2 [x (2 R_c - x) - B x'], what the vane's middle line sweeps.

    Parameters
    ----------
    cylinder : radii, height H and vane thickness B in m
    angle : θ from 0 to 2π, shape (samples,), rad

    Returns
    -------
    shape (2, samples), m³ and m³/rad
    """
    a = cylinder.roller_radius_m / cylinder.bore_radius_m
    height, sine = cylinder.height_m, np.sin(angle)
    lever = (1.0 / a - 1.0) * sine
    area = (1.0 - a**2) * angle - 0.5 * (1.0 - a) ** 2 * np.sin(2.0 * angle)
    area -= a**2 * np.arcsin(lever) + a * (1.0 - a) * sine * np.sqrt(1.0 - lever**2)
    x, slope, _ = vane_extension(cylinder, angle)
    vane = cylinder.vane_thickness_m
    volume = 0.5 * height * (cylinder.bore_radius_m**2 * area - vane * x)
    swept = 0.5 * height * (x * (2.0 * cylinder.bore_radius_m - x) - vane * slope)
    return np.stack([volume, swept])


def compression_volume(cylinder: Cylinder, angle: Array) -> Array:
    """Volume V_c(θ) = V_s(2π - θ) of the compression chamber and its derivative over the angle.

    Parameters
    ----------
    cylinder : lengths in m
    angle : θ from 0 to 2π, shape (samples,), rad

    Returns
    -------
    shape (2, samples), m³ and m³/rad
    """
    volume, slope = suction_volume(cylinder, 2.0 * np.pi - angle)
    return np.stack([volume, -slope])


def displaced_m3(cylinder: Cylinder) -> float:
    """Volume that the roller displaces in a turn, π H (R_c² - R_r²).

    Parameters
    ----------
    cylinder : lengths in m
    """
    bore, roller = cylinder.bore_radius_m, cylinder.roller_radius_m
    return float(np.pi * cylinder.height_m * (bore**2 - roller**2))


def gas_force(cylinder: Cylinder, angle: Array, difference_pa: Array) -> Array:
    """Force of the gas on the roller, along and across the vane: Δp H times the turned chord.

    The chord goes from the contact with the bore to the vane's tip; the force passes through the
    roller's centre. Its moment about the shaft is -Δp H x (2 R_c - x)/2.

    Parameters
    ----------
    cylinder : lengths in m
    angle : θ, shape (samples,), rad
    difference_pa : p_c - p_s, shape (samples,)

    Returns
    -------
    shape (2, samples), N
    """
    bore = cylinder.bore_radius_m
    tip = bore - vane_extension(cylinder, angle)[0]
    chord = np.stack([bore * np.sin(angle), tip - bore * np.cos(angle)])
    return np.asarray(difference_pa * cylinder.height_m * chord)
