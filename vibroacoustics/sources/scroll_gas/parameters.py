"""Wraps and gas of a scroll compressor: what its gas forces follow from."""

import numpy as np
from pydantic import Field, model_validator

from ...base.parameters import Parameters

PRESSURE = Field(gt=0.0, le=1e9)


class ScrollWraps(Parameters):
    """Two like wraps on the involute of a circle, one turned by half a revolution.

    The involute angle is that of the tangent of the base circle; both flanks of a wrap are
    involutes turned by half the thickness over the base radius, its middle is one from angle zero.
    """

    base_radius_m: float = Field(gt=0.0, le=0.1)
    height_m: float = Field(gt=0.0, le=1.0)
    thickness_m: float = Field(ge=0.0, le=0.1)
    start_angle_rad: float = Field(ge=0.0, le=20.0 * np.pi)
    """Involute angle at which both flanks begin, near the centre."""
    turns: float = Field(gt=0.0, le=20.0)
    """The wrap ends at this many turns of the involute angle from zero."""
    closing_crank_angle_rad: float = Field(ge=-2.0 * np.pi, le=2.0 * np.pi)
    """Crank angle at which the outer pockets close."""

    @property
    def half_thickness_angle(self) -> float:
        """Half the thickness over the base radius, by which both flanks are turned, rad."""
        return 0.5 * self.thickness_m / self.base_radius_m

    @property
    def orbit_radius_m(self) -> float:
        """Half the pitch of the wraps less their thickness: the flanks touch."""
        return float(np.pi * self.base_radius_m - self.thickness_m)

    @property
    def end_angle_rad(self) -> float:
        return float(2.0 * np.pi * self.turns)

    @property
    def opening_angle_rad(self) -> float:
        """Crank angle from the closing of a pocket to its opening to the discharge.

        The pocket's inner contact leaves the start of the outer flank, half a turn inwards of
        that of the inner flank, which began a turn inwards of the wrap's end.
        """
        return float(self.end_angle_rad - 3.0 * np.pi - self.start_angle_rad)

    @model_validator(mode="after")
    def _orbits_and_closes(self) -> "ScrollWraps":
        if self.orbit_radius_m <= 0.0:
            raise ValueError(
                f"thickness_mm = {1e3 * self.thickness_m:g} mm: must be below "
                f"π base_radius_mm = {1e3 * np.pi * self.base_radius_m:g} mm"
            )
        if self.start_angle_rad < self.half_thickness_angle:
            raise ValueError(
                f"start_angle_deg = {np.degrees(self.start_angle_rad):g}°: must be at least half "
                f"the thickness over the base radius, {np.degrees(self.half_thickness_angle):g}°"
            )
        if self.opening_angle_rad <= 0.0:
            least = 1.5 + self.start_angle_rad / (2.0 * np.pi)
            raise ValueError(
                f"turns = {self.turns:g}: must exceed {least:g}, or no pocket ever closes"
            )
        return self


class ScrollGas(Parameters):
    suction_pressure_pa: float = PRESSURE
    discharge_pressure_pa: float = PRESSURE
    polytropic_index: float = Field(gt=1.0, le=2.0)
    equalisation_angle_rad: float = Field(default=0.0, ge=0.0, le=6.283185307179586)
    """Crank angle over which an opened pocket comes to the discharge pressure; 0 is at once."""

    @model_validator(mode="after")
    def _compresses(self) -> "ScrollGas":
        if self.discharge_pressure_pa <= self.suction_pressure_pa:
            raise ValueError(
                f"discharge_pressure_bar = {1e-5 * self.discharge_pressure_pa:g} bar: must exceed "
                f"suction_pressure_bar = {1e-5 * self.suction_pressure_pa:g} bar"
            )
        return self
