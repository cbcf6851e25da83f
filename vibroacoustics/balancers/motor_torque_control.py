"""An inverter whose motor torque follows the first orders of the load's torque."""

from typing import ClassVar

from pydantic import Field

from ..base import rounding
from ..base.registry import register
from ..machine.machine import Machine
from ..machine.option import Figures, Option
from ..mechanics.capabilities import Capability
from ..mechanics.torque_control import ControlledMotor, TorqueControl


@register
class MotorTorqueControl(Option):
    """Motor torque that follows shaft orders 1 to n of gas and friction.

    The swing of the shaft's speed and the roll of the machine at these orders go; an ideal drive
    leaves nothing of them, one with a current limit the part that the current does not reach.
    """

    kind: ClassVar[str] = "motor-torque-control"
    needs: ClassVar[type[Capability]] = ControlledMotor
    highest_order: int = Field(ge=1, le=3)
    """Orders 1 to this one are controlled."""
    current_limit_a: float | None = Field(default=None, gt=0.0, le=1e4)
    """Peak of the phase current; none is an ideal drive."""

    def applied_to(self, machine: Machine) -> Machine:
        """The machine with its motor under control."""
        control = TorqueControl(
            highest_order=self.highest_order, current_limit_a=self.current_limit_a
        )
        controlled: Machine = machine.require(ControlledMotor).under(control)
        return controlled

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Delay and losses of the drive."""
        return (
            "The torque control knows the load's orders exactly and has no delay. Losses that the "
            "alternating current adds in motor and inverter are neglected.",
        )

    def sentences(self, figures: Figures) -> tuple[str, ...]:
        """Say what remains at order 1 and the current that it takes."""
        if "residual_torque_1x_n_m" not in figures:
            return ()
        residual = rounding.span(figures["residual_torque_1x_n_m"], rounding.significant)
        current = rounding.span(figures["motor_peak_current_a"], rounding.significant)
        return (
            f"The residual torque at order 1 is {residual} N m.",
            f"The peak of the phase current is {current} A.",
        )
