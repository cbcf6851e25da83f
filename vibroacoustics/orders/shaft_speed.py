"""Speed of a shaft in a recording, and where it comes from."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from ..base.vocabulary import NO_ANGLE_ZERO
from .crank_motion import CrankMotion
from .pulse_faults import PulseFault


class UncertainSpeedWarning(UserWarning):
    """The speed that a signal gives need not be that of the shaft."""


@dataclass(frozen=True)
class RecordedSpeed:
    """Crank motion of a recording and where it comes from."""

    motion: CrankMotion
    source: str
    """Source of the speed, in words."""
    angle_zero: str = NO_ANGLE_ZERO
    """The mark on the shaft at which the crank angle is zero."""
    faults: tuple[PulseFault, ...] = ()
    quality: Mapping[str, float] = field(default_factory=dict)
    """`jitter` of a tacho in periods, or `confidence` without one."""

    kind: Literal["nominal", "recorded", "marks"] = "marks"
    """One number, a recorded speed, or marks: pulses, an angle, orders."""
    held_s: float = 0.0
    """Time for which each value of a recorded speed is held; 0 where it is not."""

    def attributes(self) -> dict[str, Any]:
        """Return attributes of the results on the speed."""
        return {
            "speed_source": self.source,
            "angle_zero": self.angle_zero,
            **self.quality,
            "tacho_faults": len(self.faults),
        }
