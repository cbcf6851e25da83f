"""Balance quality of a rotor."""

from math import pi

from pydantic import Field

from ..base.parameters import Parameters
from ..base.units import shaft_frequency_hz

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
