"""Additions of a balancing option to a machine."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ..base.arrays import Array
from ..base.decibel import amplitude_of_level
from .moving_parts import MovingPart


@dataclass(frozen=True)
class RingForce:
    """Force of a part that an option adds to an Oldham ring, along the ring's stroke.

    Attributes
    ----------
    force_n : over uniform crank angles, shape (samples,)
    from_housing : whether the housing takes the reaction, as of a layer between the two; else what
        hangs there does, by its change of momentum
    inertial : whether its part in phase with the stroke grows as the speed squared

    Examples
    --------
    >>> angle = va.constant_rotation(3000.0, 64).crank_angle
    >>> force = va.RingForce(12.0 * np.cos(angle))  # N
    >>> va.Added(figures={"added_mass_kg": 0.0}, on_ring=force).on_ring.from_housing
    False
    """

    force_n: Array
    from_housing: bool = False
    inertial: bool = True


@dataclass(frozen=True)
class FurtherRing:
    """A second Oldham ring in opposite phase, with keys of its own that no gas presses.

    Attributes
    ----------
    mass_kg : mass
    stroke_m : amplitude of its stroke
    height_m : from the centre of mass at rest
    driven_inertia_kg_m2 : inertia of the piece that it keeps from turning, about its centre; that
        of the orbiting scroll where it is none
    moment_n_m : turns this piece against the housing: a spring, drag
    on_ring : force along its stroke, towards its own crank pin at crank angle zero

    Examples
    --------
    >>> ring = va.FurtherRing(mass_kg=0.073, stroke_m=0.00675, height_m=0.11)
    >>> va.Added(figures={"added_mass_kg": ring.mass_kg}, rings=(ring,)).rings[0].stroke_m
    0.00675
    """

    mass_kg: float
    stroke_m: float
    height_m: float
    driven_inertia_kg_m2: float | None = None
    moment_n_m: float = 0.0
    on_ring: RingForce | None = None


@dataclass(frozen=True)
class Added:
    """Additions of an option at one speed.

    Attributes
    ----------
    parts : moving parts
    figures : to report of it, by name; the unit is the suffix of the name
    on_ring : force of a part on the machine's Oldham ring; none without one
    rings : further Oldham rings
    on_scroll_n_m : moment between housing and the part that the machine's ring keeps from turning

    Examples
    --------
    >>> angle = va.constant_rotation(3000.0, 64).crank_angle
    >>> weight = va.circling("balancer", 0.1, -0.02, 0.0, angle)  # kg, m, m
    >>> va.Added((weight,), {"added_mass_kg": 0.1}).figures
    {'added_mass_kg': 0.1}
    """

    parts: tuple[MovingPart, ...] = ()
    figures: Mapping[str, float] = field(default_factory=dict)
    on_ring: RingForce | None = None
    rings: tuple[FurtherRing, ...] = ()
    on_scroll_n_m: float = 0.0


@dataclass(frozen=True)
class InsertionLoss:
    """Insertion loss of a hood, jacket or damping sheet for airborne sound, by third octave.

    Attributes
    ----------
    band_hz : nominal midband frequency, shape (band,)
    loss_db : shape (band,)

    Examples
    --------
    >>> loss = va.InsertionLoss(np.array([500.0, 1000.0]), np.array([6.0, 10.0]))
    >>> loss.at(np.array([480.0, 990.0, 4000.0])).tolist()
    [6.0, 10.0, 0.0]
    """

    band_hz: Array
    loss_db: Array

    def at(self, frequency_hz: Array) -> Array:
        """Loss at each frequency, dB; zero outside the bands, where nothing is known."""
        numbers = third_octave_number(np.asarray(frequency_hz))
        same = numbers[..., None] == third_octave_number(self.band_hz)
        return np.asarray(np.where(same, self.loss_db, 0.0).sum(axis=-1))

    def amplitude_factor(self, frequency_hz: Array) -> Array:
        """Pressure with it over pressure without it at each frequency."""
        return amplitude_of_level(-self.at(frequency_hz))

    def power_factor(self, frequency_hz: Array) -> Array:
        """Mean square with it over mean square without it at each frequency."""
        return np.asarray(10.0 ** (-self.at(frequency_hz) / 10.0))


def third_octave_number(frequency_hz: Array) -> Array:
    """Number of the third octave of a frequency, 10 lg f rounded (IEC 61260-1, base ten)."""
    return np.asarray(np.rint(10.0 * np.log10(np.maximum(frequency_hz, 1e-3))))
