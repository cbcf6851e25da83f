"""Scroll with mini-crank (Zhao et al. 2013): loads, input torque, speed fluctuation."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.constants import STANDARD_GRAVITY_M_PER_S2
from ...base.errors import ParameterError
from ...base.units import shaft_frequency_hz
from ...mechanics.crankshaft import DrivenRotation, reduced_inertia, steady_rotation
from ...mechanics.rotation import uniform_crank_angle
from .four_bar import FourBarMotion, four_bar_motion, three_minicranks_motion
from .links import FourBar, Links
from .parameters import Masses, MiniCrankTables, ScrollLoads

SAMPLES: Final = 14400
"""Crank angles a revolution. Errors of 10 µm make a torque peak some 1° wide: 40 samples."""


@dataclass(frozen=True)
class ScrollLoad:
    """Load on the scroll over crank angle.

    Attributes
    ----------
    tangential_force_n : F_t at the crank pin, against its motion, shape (samples,)
    radial_force_n : F_r at the crank pin, towards the axis, shape (samples,)
    rotation_moment_n_m : M_z of the gas, in the direction of θ2, shape (samples,)
    friction_moment_n_m : M_sd of the plates, in the direction of θ2, shape (samples,)
    """

    tangential_force_n: Array
    radial_force_n: Array
    rotation_moment_n_m: Array
    friction_moment_n_m: Array

    @property
    def moment_n_m(self) -> Array:
        return self.rotation_moment_n_m + self.friction_moment_n_m


def scroll_load(loads: ScrollLoads, links: Links, crank_angle: Array) -> ScrollLoad:
    """Load of the gas with one harmonic; M_z = F_t l1/2, M_sd = µ_d M_m sin(γ - η) (eq. 14).

    The paper shows the load in figures without numbers; its shape here is an assumption.
    """
    force = loads.tangential_force_n * (1.0 + loads.ripple_ratio * np.cos(crank_angle))
    overturning = loads.overturning_arm_m * loads.tangential_force_n
    friction = loads.plate_friction * overturning * np.sin(loads.friction_angle_rad)
    return ScrollLoad(
        force,
        np.full_like(force, loads.radial_force_n),
        0.5 * links.crank_m * force,
        np.full_like(force, friction),
    )


def input_torque(
    links: Links, moved: FourBarMotion, masses: Masses, load: ScrollLoad, speed_rad_per_s: float
) -> dict[str, Array]:
    """Torque that keeps the crankshaft at constant speed, by source, N m.

    Zhao et al. 2013, eq. 15 to 17, with the inertia torque of the scroll positive: printed is
    -J2 θ̈2 δθ2/δθ1, which contradicts the energy of the scroll. The paper prints no value of it.

    Returns
    -------
    T_d of scroll and mini-crank, T_w of the mini-crank's weight, T_F of the load, each of shape
    (samples,)
    """
    scroll, minicrank = moved.scroll_angle, moved.minicrank_angle
    square = speed_rad_per_s**2
    return {
        "scroll_inertia": masses.scroll_inertia_kg_m2 * square * scroll[2] * scroll[1],
        "minicrank_inertia": masses.minicrank_inertia_kg_m2 * square * minicrank[2] * minicrank[1],
        "weight": weight_moment(links, moved, masses) * minicrank[1],
        "load": load.tangential_force_n * links.crank_m - load.moment_n_m * scroll[1],
    }


def weight_moment(links: Links, moved: FourBarMotion, masses: Masses) -> Array:
    """Moment about the mini-crank's axis that holds its weight, y upwards, N m."""
    lever = links.minicrank_m * np.cos(moved.minicrank_angle[0])
    return np.asarray(masses.minicrank_mass_kg * STANDARD_GRAVITY_M_PER_S2 * lever)


@dataclass(frozen=True)
class MiniCrankCycle:
    """One steady revolution over uniform crank angles.

    Attributes
    ----------
    links : lengths with their errors
    moved : motion of scroll and mini-crank
    masses : with all mini-cranks as one
    load : on the scroll
    input_torque_n_m : at constant speed by source, equation (17)
    rotation : of the crankshaft with its own inertia and motor
    """

    links: Links
    moved: FourBarMotion
    masses: Masses
    load: ScrollLoad
    input_torque_n_m: Mapping[str, Array]
    rotation: DrivenRotation


def steady_minicrank_cycle(
    machine: MiniCrankTables, speed_rpm: float, samples: int = SAMPLES
) -> MiniCrankCycle:
    """Torque ripple of the mechanism's errors and the rotor's speed under it.

    Raises
    ------
    ParameterError
        The mechanism does not close, or the speed cannot be.
    """
    if not 0.0 < speed_rpm < np.inf:
        raise ParameterError(f"speed_rpm = {speed_rpm:g} rpm: must be positive and finite")
    links = machine.four_bar.links
    masses = machine.masses.of_all(machine.four_bar.minicranks)
    moved = _motion(machine.four_bar, uniform_crank_angle(samples))
    load = scroll_load(machine.loads, links, moved.crank_angle)
    mean_speed = 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
    torque = input_torque(links, moved, masses, load, mean_speed)
    turning = (
        (masses.scroll_inertia_kg_m2, moved.scroll_angle),
        (masses.minicrank_inertia_kg_m2, moved.minicrank_angle),
    )
    rotation = steady_rotation(
        *reduced_inertia(masses.rotor_inertia_kg_m2, turning),
        torque["load"] + torque["weight"],
        mean_speed,
        masses.motor_slope_ratio,
    )
    return MiniCrankCycle(links, moved, masses, load, torque, rotation)


def _motion(four_bar: FourBar, crank_angle: Array) -> FourBarMotion:
    if four_bar.minicranks == 1:
        return four_bar_motion(four_bar.links, crank_angle, four_bar.branch)
    return three_minicranks_motion(four_bar.links, crank_angle)
