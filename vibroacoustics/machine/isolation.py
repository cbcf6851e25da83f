"""Mounts and springs against the shaft frequency, and the balance quality of the rotor."""

from collections.abc import Iterator, Sequence
from math import pi, sqrt
from typing import Final

import numpy as np
from pydantic import Field

from ..base.parameters import Parameters
from ..base.units import shaft_frequency_hz
from .feet import Foot, Mounts, MountStiffness

HEIGHT = Field(ge=-2.0, le=2.0)
ANGLE = Field(default=0.0, ge=0.0, le=2.0 * pi)


class BalanceQuality(Parameters):
    """A balance quality grade and where in two planes the unbalance is that it permits.

    ISO 21940-11:2016, Rotor balancing: a grade G 6.3 permits a rotor that runs at ω a centre of
    mass off the axis by e with e ω = 6.3 mm/s.
    """

    grade_m_per_s: float = Field(gt=0.0, le=4.0)
    """e ω of the grade."""
    service_speed_rpm: float = Field(ge=60.0, le=60000.0)
    """Highest speed for which the rotor is balanced."""
    rotor_mass_kg: float = Field(gt=0.0, le=1e3)
    """Mass of all that is balanced together."""
    used_ratio: float = Field(default=1.0, ge=0.0, le=1.0)
    """Residual unbalance over the permissible one."""
    lower_plane_height_m: float = HEIGHT
    """Height along the shaft, from the origin of the crank's axes."""
    upper_plane_height_m: float = HEIGHT
    upper_share_ratio: float = Field(default=0.5, ge=0.0, le=1.0)
    """Share of the upper plane; the lower one has the rest."""
    lower_angle_rad: float = ANGLE
    """Ahead of the crank pin, in the sense of the shaft."""
    upper_angle_rad: float = ANGLE

    @property
    def eccentricity_m(self) -> float:
        """e = G/ω at the service speed, as far as it is used."""
        omega = 2.0 * pi * shaft_frequency_hz(self.service_speed_rpm)
        return self.used_ratio * self.grade_m_per_s / omega

    @property
    def plane_masses_kg(self) -> tuple[float, float]:
        """Mass off the axis by that in the lower and the upper plane."""
        upper = self.upper_share_ratio * self.rotor_mass_kg
        return self.rotor_mass_kg - upper, upper


ISOLATING: Final = sqrt(2.0)
"""Ratio of shaft to natural frequency above which mounts transmit less than without them."""


def natural_frequency_hz(stiffness_n_per_m: float, mass_kg: float) -> float:
    """Natural frequency of a mass on springs to a rigid floor, sqrt(k/m)/2π.

    Parameters
    ----------
    stiffness_n_per_m : stiffness of all springs
    mass_kg : that they carry
    """
    return sqrt(stiffness_n_per_m / mass_kg) / (2.0 * pi)


def total_stiffness(
    mounts: Mounts, feet: Sequence[Foot], stiffness: MountStiffness | None, frequency_hz: float
) -> tuple[float, float]:
    """Lateral and vertical stiffness of all mounts at a frequency, N/m.

    Parameters
    ----------
    mounts : that feet have without a stiffness of their own; four where there are no feet
    feet : feet of the machine
    stiffness : over frequency, of mounts without a stiffness of their own
    frequency_hz : at which they count
    """
    total = np.zeros(2)
    for foot in feet or [Foot(x_m=0.0, y_m=0.0)] * 4:
        table = foot.stiffness or (None if foot.has_constant_values else stiffness)
        if table is not None:
            total += table.dynamic_stiffness(np.array(frequency_hz)).real[1:]
        else:
            total += (
                foot.lateral_stiffness_n_per_m or mounts.lateral_stiffness_n_per_m,
                foot.vertical_stiffness_n_per_m or mounts.vertical_stiffness_n_per_m,
            )
    return float(total[0]), float(total[1])


def doubts_of_isolation(
    name: str, stiffness_n_per_m: tuple[float, float], mass_kg: float, speed_rpm: float
) -> Iterator[str]:
    """Mounts that do not isolate the order 1 of a speed, a line for each direction.

    Parameters
    ----------
    name : name of the table of mounts
    stiffness_n_per_m : stiffness of all mounts, lateral and vertical
    mass_kg : that they carry
    speed_rpm : lowest one of the study
    """
    shaft = shaft_frequency_hz(speed_rpm)
    for axis, stiffness in zip(("lateral", "vertical"), stiffness_n_per_m, strict=True):
        natural = natural_frequency_hz(stiffness, mass_kg)
        if shaft < ISOLATING * natural:
            yield (
                f"operation.speed_rpm = {speed_rpm:g} rpm is 1x at {shaft:.3g} Hz: {name}, "
                f"{axis}, {stiffness:.3g} N/m in all under {mass_kg:.3g} kg, resonates at "
                f"{natural:.3g} Hz; usual is 1x above {ISOLATING * natural:.3g} Hz, or order 1 is "
                "not isolated"
            )
