"""The reference: nothing added."""

from typing import ClassVar

from ..base.registry import register
from ..machine.machine import Machine
from ..machine.option import Option
from ..mechanics.added import Added
from ..mechanics.moving_parts import Revolution


@register
class NoBalancer(Option):
    """The machine as it is; the reference of every change."""

    kind: ClassVar[str] = "none"

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """Nothing."""
        return Added(figures={"added_mass_kg": 0.0})
