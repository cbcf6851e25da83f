"""Wraps and gas of a scroll compressor, and the volumes of its opened pockets in closed form."""

from typing import Literal

import numpy as np
from pydantic import Field

from ...base.arrays import Array
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


def swept_volume_m3(wraps: ScrollWraps) -> float:
    """q = 2 r_b r_o h: a pair of contacts at t sweeps q t a radian, m³."""
    return 2.0 * wraps.base_radius_m * wraps.orbit_radius_m * wraps.height_m


def contacts_at_opening(wraps: ScrollWraps) -> tuple[float, float]:
    """Contact angles of the outer and the inner end of a pocket that opens, rad."""
    outer = float(contact_angle(wraps, np.asarray(wraps.opening_angle_rad)))
    return outer, outer - 2.0 * np.pi


def pair_volume_m3(wraps: ScrollWraps, since_opening: Array) -> Array:
    """Volume of both pockets of an opened pair until they are one with the chamber, m³.

    Parameters
    ----------
    wraps : geometry
    since_opening : crank angle, 0 to π, shape (...), rad
    """
    outer, _ = contacts_at_opening(wraps)
    mean = outer - np.pi - since_opening
    return np.asarray(2.0 * np.pi * swept_volume_m3(wraps) * mean)


def chamber_volume_m3(wraps: ScrollWraps, at_opening_m3: float, since_opening: Array) -> Array:
    """The chamber inside all closed pockets, from half a turn on with the opened pair, m³.

    Parameters
    ----------
    wraps : geometry
    at_opening_m3 : its volume when a pair opens
    since_opening : crank angle, 0 to 2π, shape (...), rad
    """
    outer, inner = contacts_at_opening(wraps)
    ends_at = np.where(since_opening < np.pi, inner, outer) - since_opening
    return np.asarray(at_opening_m3 + 0.5 * swept_volume_m3(wraps) * (ends_at**2 - inner**2))


def least_chamber_volume_m3(wraps: ScrollWraps) -> float:
    """Return the least chamber volume when a pair opens, so that gas remains in it, m³.

    The chamber shrinks until its contacts reach t = 0, or until it is one with the pair.
    """
    _, inner = contacts_at_opening(wraps)
    inner_turn = max(inner - np.pi, 0.0)
    return 0.5 * swept_volume_m3(wraps) * (inner**2 - inner_turn**2)


def full_gap_area_m2(wraps: ScrollWraps) -> float:
    """2 h r_o: the gap of a pair is this times 1 - cos φ, φ the crank angle since its opening."""
    return 2.0 * wraps.height_m * wraps.orbit_radius_m


def contact_angle(wraps: ScrollWraps, angle_since_closing: Array) -> Array:
    """Contact angle t of the outer end of a pocket, rad.

    Parameters
    ----------
    wraps : geometry
    angle_since_closing : crank angle since the pocket has closed, any shape, rad
    """
    return np.asarray(wraps.end_angle_rad - 0.5 * np.pi - angle_since_closing)


def contact_count(wraps: ScrollWraps, equalisation_angle_rad: float) -> int:
    """Largest number of contacts of a pair of flanks at a time.

    A contact that has just opened counts as long as its pocket comes to the discharge pressure.
    """
    kept = wraps.opening_angle_rad + equalisation_angle_rad
    return int(np.ceil(kept / (2.0 * np.pi))) + 1


def pocket_volume(wraps: ScrollWraps, angle_since_closing: Array) -> Array:
    """Volume of one pocket, V = 2π r_b r_o h t with the mean t of its two contacts, m³.

    Linear in the crank angle; displacement and volume ratio are those of Bell's PDSim
    (`Scroll.Vdisp`, `Scroll.Vratio`).

    Parameters
    ----------
    wraps : geometry
    angle_since_closing : crank angle since the pocket has closed, any shape, rad
    """
    mean = contact_angle(wraps, angle_since_closing) - np.pi
    return 2.0 * np.pi * wraps.base_radius_m * wraps.orbit_radius_m * wraps.height_m * mean


def area_inside(wraps: ScrollWraps, contact: Array) -> Array:
    """Plate area on which a pressure step at a pair of contacts acts axially, m².

    A = π r_b² (t² + a² + π²/12 - 1 + 4a/π), a = thickness/(2 r_b): all inside the two contacts,
    gas and wraps, and half the tips of the half turns of wrap that part the pressures there, as
    the pressure is taken to fall linearly across a tip. The shape of the wraps' starts does not
    matter, for the pressure is the same around them.

    From ½∮ r x dr along the closed line of the two inner flanks from φ - π to φ, where
    r x dr = r_b² u² dφ with u = φ - a, and across the two wraps at φ - π.

    Parameters
    ----------
    wraps : geometry
    contact : contact angle t, any shape, rad
    """
    a = wraps.half_thickness_angle
    square = contact**2 + a**2 + np.pi**2 / 12.0 - 1.0 + 4.0 * a / np.pi
    return np.asarray(np.pi * wraps.base_radius_m**2 * square)
