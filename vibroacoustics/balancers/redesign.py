"""A machine with changed values of its own: nothing is added beside it."""

from typing import ClassVar

from pydantic import Field

from ..base.registry import register
from ..machine.machine import AnyMachine, Machine
from ..machine.option import Option
from ..mechanics.added import Added
from ..mechanics.moving_parts import Revolution


@register
class Redesign(Option):
    """The machine with other values; its file's table `change` names them."""

    kind: ClassVar[str] = "redesign"
    changes_machine: ClassVar[bool] = True
    machine: AnyMachine
    """Machine with the changed values."""
    added_mass_kg: float = Field(default=0.0, ge=-1e4, le=1e4)

    def applied_to(self, machine: Machine) -> Machine:
        """The changed machine."""
        return self.machine

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """The changed machine makes other forces; the option itself adds none."""
        return Added(figures={"added_mass_kg": self.added_mass_kg})
