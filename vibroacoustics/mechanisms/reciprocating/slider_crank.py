"""Slider-crank: dimensions of a design, motion over crank angle, force on the housing."""

from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError
from ...mechanics.crankshaft import acceleration_of, planar
from ...mechanics.moving_parts import Wrench
from ...mechanics.rotation import Rotation
from .parameters import PistonAndRod


@dataclass(frozen=True)
class SliderCrank:
    """Dimensions and masses of one design.

    Attributes
    ----------
    bore_m : piston diameter
    crank_radius_m : half the stroke
    rod_length_m : between the eyes of the connecting rod
    piston_mass_kg : piston and pin
    rod_mass_kg : connecting rod
    small_end_to_centre_m, big_end_to_centre_m : to the rod's centre of mass
    rod_inertia_kg_m2 : about its centre of mass
    offset_m : e, cylinder axis from the crankshaft's axis, a quarter turn ahead of top dead centre
    """

    bore_m: float
    crank_radius_m: float
    rod_length_m: float
    piston_mass_kg: float
    rod_mass_kg: float
    small_end_to_centre_m: float
    big_end_to_centre_m: float
    rod_inertia_kg_m2: float
    offset_m: float

    @property
    def piston_area_m2(self) -> float:
        return 0.25 * np.pi * self.bore_m**2

    @property
    def displacement_m3(self) -> float:
        """Without crank offset, which lengthens the stroke a little."""
        return 2.0 * self.crank_radius_m * self.piston_area_m2


def top_dead_centre_m(crank: SliderCrank) -> float:
    """Place of the piston pin where crank and rod stand in line, from the crankshaft's axis."""
    return float(np.sqrt((crank.rod_length_m + crank.crank_radius_m) ** 2 - crank.offset_m**2))


def design_at_bore(reference: PistonAndRod, bore_m: float) -> SliderCrank:
    """Design of another bore at constant displacement and length ratio (Tsuji et al. 2012, eq. 6).

    2r = 4 V_s/(π d²), l = r/α; piston mass as d², rod mass as l. The rod's inertia goes as l³ and
    its centre of mass with l; the printed l² contradicts a mass that grows as l.

    Raises
    ------
    ParameterError
        The bore is not positive.
    """
    if not 0.0 < bore_m < np.inf:
        raise ParameterError(f"bore_mm = {1e3 * bore_m:g} mm: must be above 0 mm")
    crank_radius = 2.0 * reference.displacement_m3 / (np.pi * bore_m**2)
    rod_length = crank_radius / reference.crank_to_rod_ratio
    scale = rod_length / reference.rod_length_m
    small_end = reference.small_end_to_centre_m * scale
    return SliderCrank(
        bore_m=bore_m,
        crank_radius_m=crank_radius,
        rod_length_m=rod_length,
        piston_mass_kg=reference.piston_mass_kg * (bore_m / reference.bore_m) ** 2,
        rod_mass_kg=reference.rod_mass_kg * scale,
        small_end_to_centre_m=small_end,
        big_end_to_centre_m=rod_length - small_end,
        rod_inertia_kg_m2=reference.rod_inertia_kg_m2 * scale**3,
        offset_m=reference.crank_offset_m,
    )


@dataclass(frozen=True)
class Motion:
    """Positions over crank angle, each with its first and second derivative, shape (3, samples).

    Attributes
    ----------
    crank_angle : θ from top dead centre, shape (samples,), rad
    rod_angle : φ between rod and cylinder axis, rad
    piston_m : x_p of the piston pin from the crankshaft's axis
    rod_x_m, rod_y_m : centre of mass of the rod
    """

    crank_angle: Array
    rod_angle: Array
    piston_m: Array
    rod_x_m: Array
    rod_y_m: Array


def motion(crank: SliderCrank, crank_angle: Array) -> Motion:
    """l sin φ = r sin θ - e, x_p = r cos θ + l cos φ (Tsuji et al. 2012, figure 2, with e = 0).

    Raises
    ------
    ParameterError
        Crank and offset together are not shorter than the rod: the mechanism cannot turn.
    """
    r, a, e = crank.crank_radius_m, crank.small_end_to_centre_m, crank.offset_m
    if r + abs(e) >= crank.rod_length_m:
        raise ParameterError(
            f"crank_radius_mm = {1e3 * r:g} mm and crank_offset_mm = {1e3 * e:g} mm: together "
            f"must be below rod_length_mm = {1e3 * crank.rod_length_m:g} mm"
        )
    ratio = r / crank.rod_length_m
    sine, cosine = np.sin(crank_angle), np.cos(crank_angle)
    rod = np.arcsin(ratio * sine - e / crank.rod_length_m)
    s, c, t = np.sin(rod), np.cos(rod), np.tan(rod)
    rod_1 = ratio * cosine / c
    rod_2 = rod_1**2 * t - ratio * sine / c
    x = r * cosine + crank.rod_length_m * c
    x_1 = -r * (sine + cosine * t)
    x_2 = -r * (cosine - sine * t + cosine * rod_1 / c**2)
    return Motion(
        crank_angle=crank_angle,
        rod_angle=np.stack([rod, rod_1, rod_2]),
        piston_m=np.stack([x, x_1, x_2]),
        rod_x_m=np.stack([x - a * c, x_1 + a * s * rod_1, x_2 + a * (s * rod_2 + c * rod_1**2)]),
        rod_y_m=np.stack([e + a * s, a * c * rod_1, a * (c * rod_2 - s * rod_1**2)]),
    )


def moving_masses(crank: SliderCrank, moved: Motion) -> tuple[tuple[float, Array], ...]:
    """Masses and inertia of piston and rod with what they follow, for `reduced_inertia`.

    The left side of equation (1) of Tsuji et al. 2012 is then I θ̈ + ½ (dI/dθ) θ̇².
    """
    return (
        (crank.piston_mass_kg, moved.piston_m),
        (crank.rod_mass_kg, moved.rod_x_m),
        (crank.rod_mass_kg, moved.rod_y_m),
        (crank.rod_inertia_kg_m2, moved.rod_angle),
    )


def rates_of_momentum(
    crank: SliderCrank, moved: Motion, rotation: Rotation
) -> tuple[Array, Array, Array, Array]:
    """m_p ẍ_p, m_c ẍ_c, m_c ÿ_c in N and I_c φ̈ in N m, each of shape (samples,)."""
    piston, rod_x, rod_y, turn = (
        mass * acceleration_of(position, rotation) for mass, position in moving_masses(crank, moved)
    )
    return piston, rod_x, rod_y, turn


def housing_wrenches(crank: SliderCrank, moved: Motion, rotation: Rotation) -> dict[str, Wrench]:
    """-Σ m a and -d/dt of the angular momentum about the crankshaft's axis of piston and rod.

    A growing φ turns the rod against the crankshaft.
    """
    piston, rod_x, rod_y, turn = rates_of_momentum(crank, moved, rotation)
    rod_moment = turn - moved.rod_x_m[0] * rod_y + moved.rod_y_m[0] * rod_x
    return {
        "piston": planar(-np.stack([piston, np.zeros_like(piston)]), crank.offset_m * piston),
        "connecting_rod": planar(-np.stack([rod_x, rod_y]), rod_moment),
    }
