"""Wraps and gas of a scroll compressor: what its gas forces follow from."""

from typing import Literal

import numpy as np
from pydantic import Field

from ...base.errors import ParameterError
from ...base.parameters import Contradictions, Parameters

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

    def contradictions(self) -> Contradictions:
        if self.orbit_radius_m <= 0.0:
            yield (
                f"thickness_mm = {1e3 * self.thickness_m:g} mm: must be below "
                f"π base_radius_mm = {1e3 * np.pi * self.base_radius_m:g} mm"
            )
        if self.start_angle_rad < self.half_thickness_angle:
            yield (
                f"start_angle_deg = {np.degrees(self.start_angle_rad):g}°: must be at least half "
                f"the thickness over the base radius, {np.degrees(self.half_thickness_angle):g}°"
            )
        if self.opening_angle_rad <= 0.0:
            least = 1.5 + self.start_angle_rad / (2.0 * np.pi)
            yield f"turns = {self.turns:g}: must exceed {least:g}, or no pocket ever closes"


class ScrollGas(Parameters):
    suction_pressure_pa: float = PRESSURE
    discharge_pressure_pa: float = PRESSURE
    polytropic_index: float = Field(gt=1.0, le=2.0)
    equalisation_angle_rad: float = Field(default=0.0, ge=0.0, le=6.283185307179586)
    """Crank angle over which an opened pocket comes to the discharge pressure; 0 is at once. Of
    the law of that name only."""
    opening_law: Literal["equalisation-angle", "inertia"] = "equalisation-angle"
    """Law by which an opened pocket comes to the discharge pressure: by the angle above, or by the
    flow out of it, with the table `opening`."""
    discharge_density_kg_per_m3: float | None = Field(default=None, gt=0.0, le=2000.0)
    discharge_sound_speed_m_per_s: float | None = Field(default=None, ge=50.0, le=2000.0)

    @property
    def opens_with_inertia(self) -> bool:
        """Whether a pocket opens by the flow out of it."""
        return self.opening_law == "inertia"

    @property
    def unread(self) -> frozenset[str]:
        """Values that the law of the opening does not need."""
        state = {"discharge_density_kg_per_m3", "discharge_sound_speed_m_per_s"}
        return frozenset({"equalisation_angle_rad"} if self.opens_with_inertia else state)

    @property
    def discharge_state(self) -> tuple[float, float]:
        """Density and speed of sound of the gas at discharge, kg/m³ and m/s.

        Raises
        ------
        ParameterError
            They are not given.
        """
        density, sound = self.discharge_density_kg_per_m3, self.discharge_sound_speed_m_per_s
        if density is None or sound is None:
            missing = "density_kg_per_m3" if density is None else "sound_speed_m_per_s"
            raise ParameterError(f"gas.discharge_{missing}: is missing; the law inertia needs it")
        return density, sound

    def contradictions(self) -> Contradictions:
        if self.discharge_pressure_pa <= self.suction_pressure_pa:
            yield (
                f"discharge_pressure_bar = {1e-5 * self.discharge_pressure_pa:g} bar: must exceed "
                f"suction_pressure_bar = {1e-5 * self.suction_pressure_pa:g} bar"
            )


class ScrollOpening(Parameters):
    """Passages and volumes between an opened pocket and the tube, for the law `inertia`.

    The gap of a pair of pockets leads into the chamber inside all closed pockets, its port into the
    plenum, which the tube leaves without reflection. Lengths count the gas that moves along with
    that in the passage.
    """

    gap_length_m: float = Field(ge=1e-3, le=0.05)
    port_length_m: float = Field(ge=1e-3, le=0.2)
    port_diameter_m: float = Field(ge=2e-3, le=0.1)
    discharge_coefficient_ratio: float = Field(ge=0.3, le=1.0)
    """Discharge coefficient of gap and port."""
    chamber_volume_m3: float = Field(gt=0.0, le=1e-3)
    """Volume of the chamber when a pocket opens; it shrinks at first."""
    plenum_volume_m3: float = Field(ge=1e-5, le=0.1)
    tube_diameter_m: float = Field(ge=2e-3, le=0.2)
    """Inner, of the discharge tube."""


class ScrollLeakage(Parameters):
    """Gaps through which gas flows back from pocket to pocket, for the law `inertia`."""

    tip_gap_m: float = Field(ge=0.0, le=1e-3)
    """Gap between the tip of a wrap and the plate of the other scroll."""
    flank_gap_m: float = Field(ge=0.0, le=1e-3)
    """Gap between two flanks at their contact."""
    flow_ratio: float = Field(gt=0.0, le=1.0)
    """Share of the flow without losses through either gap."""


class SuctionPockets(Parameters):
    """Gas that fills the suction pockets with inertia, for the law `inertia` of the opening.

    Its passages are those of `ScrollOpening`, whose gap is at the other end of the wraps.
    """

    sound_speed_m_per_s: float = Field(ge=50.0, le=2000.0)
    stiffness_exponent_ratio: float = Field(gt=1.0, le=2.0)
    """κ = ρ c²/p of the gas, which gives its density at the suction pressure."""

    def density_kg_per_m3(self, pressure_pa: float) -> float:
        """ρ = κ p/c²."""
        return self.stiffness_exponent_ratio * pressure_pa / self.sound_speed_m_per_s**2
