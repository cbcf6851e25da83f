"""Permanent-magnet synchronous motor on an inverter, by its circuit."""

import math
from typing import Literal

from pydantic import Field

from ...base.parameters import Contradictions, Parameters

RATIO = Field(default=0.0, ge=-1.0, le=1.0)


class SynchronousMotor(Parameters):
    """Magnets on or in the rotor, three phases in star, a fundamental of current that is held.

    Resistance and inductance are per phase. Saturation and core loss are neglected; the current's
    control holds its fundamental and answers to nothing else.
    """

    pole_pairs: int = Field(ge=1, le=50)
    slots: int = Field(ge=3, le=500)
    """Slots of the stator."""
    flux_linkage_vs: float = Field(gt=0.0, le=1e3)
    """Peak of the magnets' flux through a phase, fundamental."""
    fifth_ratio: float = RATIO
    """Harmonics of the magnets' voltage over its fundamental, cosines with it."""
    seventh_ratio: float = RATIO
    eleventh_ratio: float = RATIO
    thirteenth_ratio: float = RATIO
    phase_resistance_ohm: float = Field(gt=0.0, le=1e4)
    phase_inductance_h: float = Field(gt=0.0, le=1e2)
    """Mean of direct and quadrature axis."""
    saliency_ratio: float = Field(default=1.0, ge=0.2, le=10.0)
    """Inductance of the quadrature axis over that of the direct one, which is the magnets': 1 with
    magnets on the rotor's surface, more with magnets in it."""
    current_advance_rad: float = Field(default=0.0, ge=-1.4, le=1.4)
    """Angle by which the fundamental of the current leads the voltage of the magnets."""
    cogging_torque_n_m: float = Field(ge=0.0, le=1e4)
    """Peak of its first order, without current."""
    cogging_second_ratio: float = RATIO
    """Twice that order over it."""
    dc_link_voltage_v: float = Field(gt=0.0, le=1e5)
    switching_frequency_hz: float = Field(ge=100.0, le=1e6)
    modulation: Literal["sine", "space-vector"]
    """Reference that the triangular carrier is compared with."""
    dead_time_s: float = Field(ge=0.0, le=1e-3)
    """Time in which both switches of a leg are off."""

    @property
    def emf_ratios(self) -> dict[int, float]:
        """Harmonics of the magnets' voltage over its fundamental, by number."""
        ratios = (self.fifth_ratio, self.seventh_ratio, self.eleventh_ratio, self.thirteenth_ratio)
        return {1: 1.0, **dict(zip((5, 7, 11, 13), ratios, strict=True))}

    @property
    def saliency_h(self) -> float:
        """(L_q - L_d)/2, where (L_q + L_d)/2 is the phase inductance."""
        return self.phase_inductance_h * (self.saliency_ratio - 1.0) / (self.saliency_ratio + 1.0)

    @property
    def cogging_order(self) -> int:
        """Order of the shaft: the least common multiple of slots and poles."""
        return math.lcm(self.slots, 2 * self.pole_pairs)

    def contradictions(self) -> Contradictions:
        if self.dead_time_s * self.switching_frequency_hz > 0.1:
            yield (
                f"dead_time_us = {1e6 * self.dead_time_s:g} µs: more than a tenth of a switching "
                f"period of {1e6 / self.switching_frequency_hz:.4g} µs"
            )
