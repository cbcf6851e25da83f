"""Scroll with mini-crank (Zhao et al. 2013): loads, input torque, speed fluctuation."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.constants import STANDARD_GRAVITY_M_PER_S2
from ...base.errors import ParameterError
from ...base.units import shaft_frequency_hz
from ...mechanics.crankshaft import (
    DrivenRotation,
    acceleration_of,
    reduced_inertia,
    steady_rotation,
)
from ...mechanics.rotation import Rotation, uniform_crank_angle
from .links import FourBar, Links, Masses, MiniCrankTables, ScrollLoads, why_open

SAMPLES: Final = 14400
"""Crank angles a revolution. Errors of 10 µm make a torque peak some 1° wide: 40 samples."""


@dataclass(frozen=True)
class FourBarMotion:
    """Angles over crank angle, each with first and second derivative, shape (3, samples).

    Attributes
    ----------
    crank_angle : θ1 from the bracket's line, shape (samples,), rad
    scroll_angle : θ2, continuous over crank angle
    minicrank_angle : θ3, continuous over crank angle
    """

    crank_angle: Array
    scroll_angle: Array
    minicrank_angle: Array


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
    links: Links, motion: FourBarMotion, masses: Masses, load: ScrollLoad, speed_rad_per_s: float
) -> dict[str, Array]:
    """Torque that keeps the crankshaft at constant speed, by source, N m.

    Zhao et al. 2013, eq. 15 to 17, with the inertia torque of the scroll positive: printed is
    -J2 θ̈2 δθ2/δθ1, which contradicts the energy of the scroll. The paper prints no value of it.

    Returns
    -------
    T_d of scroll and mini-crank, T_w of the mini-crank's weight, T_F of the load, each of shape
    (samples,)
    """
    scroll, minicrank = motion.scroll_angle, motion.minicrank_angle
    square = speed_rad_per_s**2
    return {
        "scroll_inertia": masses.scroll_inertia_kg_m2 * square * scroll[2] * scroll[1],
        "minicrank_inertia": masses.minicrank_inertia_kg_m2 * square * minicrank[2] * minicrank[1],
        "weight": weight_moment(links, motion, masses) * minicrank[1],
        "load": load.tangential_force_n * links.crank_m - load.moment_n_m * scroll[1],
    }


def weight_moment(links: Links, motion: FourBarMotion, masses: Masses) -> Array:
    """Moment about the mini-crank's axis that holds its weight, y upwards, N m."""
    lever = links.minicrank_m * np.cos(motion.minicrank_angle[0])
    return np.asarray(masses.minicrank_mass_kg * STANDARD_GRAVITY_M_PER_S2 * lever)


@dataclass(frozen=True)
class MiniCrankCycle:
    """One steady revolution over uniform crank angles.

    Attributes
    ----------
    links : lengths with their errors
    motion : motion of scroll and mini-crank
    masses : with all mini-cranks as one
    load : on the scroll
    input_torque_n_m : at constant speed by source, equation (17)
    rotation : rotation of the crankshaft with its own inertia and motor
    """

    links: Links
    motion: FourBarMotion
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
    motion = _motion(machine.four_bar, uniform_crank_angle(samples))
    load = scroll_load(machine.loads, links, motion.crank_angle)
    mean_speed = 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
    torque = input_torque(links, motion, masses, load, mean_speed)
    turning = (
        (masses.scroll_inertia_kg_m2, motion.scroll_angle),
        (masses.minicrank_inertia_kg_m2, motion.minicrank_angle),
    )
    rotation = steady_rotation(
        *reduced_inertia(masses.rotor_inertia_kg_m2, turning),
        torque["load"] + torque["weight"],
        mean_speed,
        masses.motor_slope_ratio,
    )
    return MiniCrankCycle(links, motion, masses, load, torque, rotation)


def _motion(four_bar: FourBar, crank_angle: Array) -> FourBarMotion:
    if four_bar.minicranks == 1:
        return four_bar_motion(four_bar.links, crank_angle, four_bar.branch)
    return three_minicranks_motion(four_bar.links, crank_angle)


def minicrank_pin_force(
    links: Links, motion: FourBarMotion, masses: Masses, load: ScrollLoad, rotation: Rotation
) -> Array:
    """Force of the scroll on the mini-crank, x and y, shape (2, samples), N.

    From the moments of the scroll about the crank pin and of the mini-crank about its axis.

    Raises
    ------
    ParameterError
        The links are a parallelogram: a single mini-crank cannot hold the scroll where all links
        are in line.
    """
    if links.is_parallelogram:
        raise ParameterError(
            "crank_error_um, scroll_error_um, minicrank_error_um, bracket_error_um = 0 µm: a "
            "parallelogram with one mini-crank takes no moment where its links are in line"
        )
    second, third = motion.scroll_angle, motion.minicrank_angle
    scroll_turn, minicrank_turn = (acceleration_of(angle, rotation) for angle in (second, third))
    on_scroll = load.moment_n_m - masses.scroll_inertia_kg_m2 * scroll_turn
    on_minicrank = masses.minicrank_inertia_kg_m2 * minicrank_turn
    on_minicrank = on_minicrank + weight_moment(links, motion, masses)
    along_third = on_scroll / links.scroll_m
    along_second = -on_minicrank / links.minicrank_m
    sine = np.sin(third[0] - second[0])
    return np.asarray(
        (along_third * direction(third[0]) + along_second * direction(second[0])) / sine
    )


def crank_pin_force(
    links: Links, motion: FourBarMotion, masses: Masses, load: ScrollLoad, rotation: Rotation
) -> Array:
    """Force of the scroll on the crank pin, x and y, shape (2, samples), N.

    Gas, weight and inertia of the scroll, less what the mini-crank takes (Zhao et al. 2013,
    figure 3).
    """
    outward, forward = direction(motion.crank_angle), direction(motion.crank_angle + 0.5 * np.pi)
    gas = -load.tangential_force_n * forward - load.radial_force_n * outward
    weight = np.array([[0.0], [-masses.scroll_mass_kg * STANDARD_GRAVITY_M_PER_S2]])
    inertia = turning_force(masses.scroll_mass_kg * links.crank_m, motion.crank_angle, rotation)
    taken = minicrank_pin_force(links, motion, masses, load, rotation)
    return np.asarray(gas + weight + inertia - taken)


def turning_force(mass_moment_kg_m: float, crank_angle: Array, rotation: Rotation) -> Array:
    """-Σ m a of a mass moment that turns with the crankshaft, x and y, shape (2, samples), N."""
    outward, forward = direction(crank_angle), direction(crank_angle + 0.5 * np.pi)
    along = rotation.speed_rad_per_s**2 * outward - rotation.acceleration_rad_per_s2 * forward
    return np.asarray(mass_moment_kg_m * along)


def direction(angle: Array) -> Array:
    """Unit vectors x and y, shape (2, samples)."""
    return np.stack([np.cos(angle), np.sin(angle)])


def four_bar_motion(links: Links, crank_angle: Array, branch: int) -> FourBarMotion:
    """Scroll and mini-crank angles of one branch (Zhao et al. 2013, eq. 5 and 6; ideal: 7).

    With errors a branch is never left: the mini-crank runs along with the crankshaft on one half
    of the revolution and back on the other. Only a true parallelogram, in which both branches
    meet, turns through; it follows (7).

    Parameters
    ----------
    links : lengths, m
    crank_angle : shape (samples,), rad
    branch : M of (5), 1 or -1; with -1 the mini-crank runs along for θ1 from 0 to 180°, and the
        hinges of crank, scroll and bracket stand clockwise (the paper's text has it inverted)

    Raises
    ------
    ParameterError
        The links do not close at every crank angle, or only just.
    """
    if links.is_parallelogram:
        turning, still = np.zeros((2, 3, crank_angle.size))
        turning[0], turning[1] = crank_angle, 1.0
        return FourBarMotion(crank_angle, still, turning)
    if reason := why_open(links):
        raise ParameterError(reason)
    l1, l2, l3, l4 = links.crank_m, links.scroll_m, links.minicrank_m, links.bracket_m
    A, B = l4 - l1 * np.cos(crank_angle), -l1 * np.sin(crank_angle)
    span = np.hypot(A, B)
    # √(A² + B² - C²) and that with D, as products: their differences cancel near collinearity.
    area = np.sqrt((l2 + l3 - span) * (l2 + l3 + span) * (l3 + span - l2) * (l2 + span - l3))
    C = (l2**2 - l3**2 + span**2) / (2.0 * l2)
    D = (l2**2 - l3**2 - span**2) / (2.0 * l3)
    second = np.unwrap(2.0 * np.arctan2(B - branch * area / (2.0 * l2), A + C))
    third = np.unwrap(2.0 * np.arctan2(B - branch * area / (2.0 * l3), A + D))
    sine = np.sin(third - second)
    second_1 = l1 * np.sin(crank_angle - third) / (l2 * sine)
    third_1 = l1 * np.sin(crank_angle - second) / (l3 * sine)
    second_2 = l1 * np.cos(crank_angle - third) + second_1**2 * l2 * np.cos(second - third)
    third_2 = l1 * np.cos(crank_angle - second) + second_1**2 * l2
    return FourBarMotion(
        crank_angle,
        np.stack([second, second_1, (second_2 - third_1**2 * l3) / (l2 * sine)]),
        np.stack(
            [third, third_1, (third_2 - third_1**2 * l3 * np.cos(third - second)) / (l3 * sine)]
        ),
    )


def three_minicranks_motion(links: Links, crank_angle: Array) -> FourBarMotion:
    """Scroll on three mini-cranks at 120° with equal elastic pins, the first with the errors.

    Each turns freely about its axis, so its pin holds the scroll along the crank's direction only.
    There pin k is strained by g_k - l2 θ2 sin(θ1 - β_k) with g_1 = (l4 - l2) cos θ1 + l3 - l1
    and no g of the others. The least Σ strain² gives θ2 = (2/(3 l2)) g_1 sin θ1 (positive with
    the crank), as Σ sin²(θ1 - β_k) = 3/2 at every crank angle: no change point is left. With one
    mini-crank it would be g_1/(l2 sin θ1), which the links in line do not bound. Our derivation,
    to first order in the errors; the mini-cranks then turn with the crank.

    Parameters
    ----------
    links : lengths of the crankshaft and the first mini-crank's loop, m
    crank_angle : shape (samples,), rad
    """
    in_line = (links.bracket_m - links.scroll_m) / (3.0 * links.scroll_m)
    longer = 2.0 * (links.minicrank_m - links.crank_m) / (3.0 * links.scroll_m)
    once, twice = np.sin(crank_angle), np.sin(2.0 * crank_angle)
    slope = longer * np.cos(crank_angle) + 2.0 * in_line * np.cos(2.0 * crank_angle)
    turn = np.stack(
        [longer * once + in_line * twice, slope, -longer * once - 4.0 * in_line * twice]
    )
    even = np.zeros((3, crank_angle.size))
    even[0], even[1] = crank_angle, 1.0
    return FourBarMotion(crank_angle, turn, even)
