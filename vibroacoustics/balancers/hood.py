"""A hood, jacket or damping sheet around the shell: insertion loss by third octave."""

from typing import ClassVar

import numpy as np
from pydantic import Field

from ..base.parameters import Contradictions
from ..base.registry import register
from ..machine.machine import Machine
from ..machine.option import Option
from ..mechanics.added import Added, InsertionLoss, third_octave_number
from ..mechanics.moving_parts import Revolution


@register
class Hood(Option):
    """Hood, jacket or damping sheet with a known insertion loss; the machine stays as it is."""

    kind: ClassVar[str] = "hood"
    band_hz: tuple[float, ...] = Field(min_length=1, max_length=40)
    """Nominal middles of the third octaves in which the loss is known."""
    insertion_loss_db: tuple[float, ...]
    """Loss in each band, level without less level with the hood (ISO 11546, ISO 15665)."""
    mass_kg: float = Field(default=0.0, ge=0.0, le=100.0)
    """Mass, which is not on the mounts."""

    def contradictions(self) -> Contradictions:
        if len(self.band_hz) != len(self.insertion_loss_db):
            yield (
                f"insertion_loss_db: {len(self.insertion_loss_db)} values for "
                f"{len(self.band_hz)} bands in band_hz"
            )
        numbers = third_octave_number(np.asarray(self.band_hz))
        if min(self.band_hz) < 20.0 or max(self.band_hz) > 20e3 or np.any(np.diff(numbers) < 1):
            yield (
                f"band_hz = {list(self.band_hz)} Hz: must rise by a third octave or more from "
                "20 to 20000 Hz"
            )
        if max(map(abs, self.insertion_loss_db)) > 80.0:
            yield f"insertion_loss_db = {list(self.insertion_loss_db)} dB: allowed -80 to 80 dB"

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """Return no moving part."""
        return Added(figures={"added_mass_kg": self.mass_kg})

    def insertion_loss(self) -> InsertionLoss:
        """Return the measured insertion loss."""
        return InsertionLoss(np.array(self.band_hz), np.array(self.insertion_loss_db))

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Name the effects that an insertion loss by third octaves neglects."""
        return (
            "A hood acts on airborne sound only, alike in all directions. Its insertion loss "
            "is 0 dB outside the given bands. Unmodelled noise is assumed evenly spread over them.",
        )
