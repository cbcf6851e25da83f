"""A plate under the feet that radiates what they push into it: a floor, a panel of a cupboard."""

from math import pi, sqrt

from pydantic import Field

from ..base.constants import SPEED_OF_SOUND_M_PER_S
from ..base.parameters import Contradictions, Parameters
from ..machine.floor import FloorMobility
from ..machine.machine import Machine


class StructureBorne(Parameters):
    """Plate under the feet and room in front of it; without length and width it has no end.

    Notation and formulas: Cremer, Heckl, Petersson, Structure-Borne Sound (2005), chapters on
    bending waves and on mobilities of plates.
    """

    thickness_m: float = Field(ge=1e-4, le=1.0)
    density_kg_per_m3: float = Field(ge=10.0, le=2e4)
    youngs_modulus_pa: float = Field(ge=1e7, le=1e12)
    poisson_ratio: float = Field(default=0.3, ge=0.0, le=0.49)
    loss_factor_ratio: float = Field(ge=1e-4, le=1.0)
    """Loss factor of the plate as it is built in, without what it radiates."""
    length_m: float | None = Field(default=None, ge=0.05, le=50.0)
    width_m: float | None = Field(default=None, ge=0.05, le=50.0)
    absorption_area_m2: float | None = Field(default=None, ge=0.1, le=1e5)
    """Absorption area of the room in front of the plate; none for an open half space."""
    deviation_db: float = Field(default=5.0, ge=0.0, le=20.0)
    """Standard deviation of such predictions apart from the spread of the plate's modes."""

    def contradictions(self) -> Contradictions:
        if (self.length_m is None) != (self.width_m is None):
            yield "length_mm, width_mm: give both, or none for a plate without end"

    @property
    def size_m(self) -> tuple[float, float] | None:
        """Length and width; none of a plate without end."""
        if self.length_m is None or self.width_m is None:
            return None
        return self.length_m, self.width_m

    @property
    def mass_kg_per_m2(self) -> float:
        """m = ρ h."""
        return self.density_kg_per_m3 * self.thickness_m

    @property
    def bending_stiffness_n_m(self) -> float:
        """B = E h³ / (12 (1 - ν²))."""
        return self.youngs_modulus_pa * self.thickness_m**3 / (12.0 * (1.0 - self.poisson_ratio**2))

    @property
    def coincidence_hz(self) -> float:
        """f_c = c²/(2π) √(m/B), where bending waves are as fast as sound in air."""
        ratio = self.mass_kg_per_m2 / self.bending_stiffness_n_m
        return SPEED_OF_SOUND_M_PER_S**2 / (2.0 * pi) * sqrt(ratio)

    @property
    def mobility_m_per_ns(self) -> float:
        """Y = 1/(8 √(B m)) at a point, without end; of a finite plate the mean over its modes.

        The mean: Skudrzyk, J. Acoust. Soc. Am. 67 (1980) 1105.
        """
        return 1.0 / (8.0 * sqrt(self.bending_stiffness_n_m * self.mass_kg_per_m2))

    def under(self, machine: Machine) -> Machine:
        """The machine on the plate; unchanged where it has a compliant floor already.

        A single row of a mobility holds above its frequency; below, the plate is a spring.
        """
        if machine.floor is not None or machine.floor_mobility is not None:
            return machine
        return machine.model_copy(update={"floor_mobility": self.floor})

    @property
    def floor(self) -> FloorMobility:
        """The plate's mobility up and down under every foot; sideways it is rigid."""
        return FloorMobility(
            file="structure_borne",
            foot=("",),
            frequency_hz=(1.0,),
            vertical_m_per_ns=(self.mobility_m_per_ns,),
            vertical_phase_rad=(0.0,),
            lateral_m_per_ns=(0.0,),
            lateral_phase_rad=(0.0,),
        )
