"""The scroll compressor's shaft as a rotor: section, bearings, motor rotor, overhung mass."""

from math import pi

from pydantic import Field

from ..base.parameters import Contradictions, Parameters

LENGTH = Field(gt=0.0, le=2.0)
MASS = Field(gt=0.0, le=100.0)


class ScrollShaft(Parameters):
    """A uniform vertical shaft; heights are above its lower end, where the lower bearing is."""

    length_m: float = LENGTH
    """Length from the centre of the lower bearing to the centre of the crank pin."""
    diameter_m: float = LENGTH
    youngs_modulus_pa: float = Field(gt=0.0, le=1e13)
    density_kg_per_m3: float = Field(gt=0.0, le=1e5)
    main_bearing_height_m: float = LENGTH
    bearing_stiffness_n_per_m: float = Field(gt=0.0, le=1e13)
    """Metal of each bearing, alike in all directions; an oil film is in series."""
    rotor_height_m: float = LENGTH
    """Middle of the motor's rotor."""
    rotor_length_m: float = LENGTH
    rotor_diameter_m: float = LENGTH
    rotor_mass_kg: float = MASS
    """Mass of the rotor with the counterweights; its stiffness is neglected."""
    pin_mass_kg: float = Field(ge=0.0, le=100.0)
    """Scroll and brake as a point mass on the crank pin, as in the thesis's model."""

    @property
    def mass_kg(self) -> float:
        """Mass of shaft and rotor."""
        volume = 0.25 * pi * self.diameter_m**2 * self.length_m
        return self.density_kg_per_m3 * volume + self.rotor_mass_kg

    def contradictions(self) -> Contradictions:
        top = self.rotor_height_m + 0.5 * self.rotor_length_m
        if not top < self.main_bearing_height_m < self.length_m:
            yield (
                f"main_bearing_height_mm = {1e3 * self.main_bearing_height_m:g} mm: must be above "
                f"the rotor's top at {1e3 * top:g} mm and below the crank pin at "
                f"{1e3 * self.length_m:g} mm"
            )
        if self.rotor_height_m < 0.5 * self.rotor_length_m:
            yield (
                f"rotor_height_mm = {1e3 * self.rotor_height_m:g} mm: the rotor of "
                f"{1e3 * self.rotor_length_m:g} mm reaches below the lower bearing"
            )
