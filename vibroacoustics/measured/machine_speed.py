"""Limits, comb and mains of a speed without a tacho, from the motor of a machine file."""

from typing import Final

from ..base.errors import ParameterError
from ..machine.machine import Machine
from ..sources.air_gap.parameters import AirGap
from ..sources.induction_motor.parameters import CapacitorMotor
from ..study.order_analysis import DEFAULT_COMB, TacholessSpeed

LARGEST_SLIP: Final = 0.1
"""Slip of an induction motor under load; at its breakdown torque it is larger."""
MAINS_TOLERANCE: Final = 0.01
"""Deviation of the mains frequency from its nominal value: EN 50160, 99.5 % of a year."""


def slip_limits_rpm(mains_hz: float, pole_pairs: int) -> tuple[float, float]:
    """Lowest and highest speed of an induction motor, rpm: n = 60 f (1 - s) / p, s from 0 to 0.1.

    Parameters
    ----------
    mains_hz : nominal frequency, which may deviate by 1 %
    pole_pairs : half the number of poles
    """
    synchronous_rpm = 60.0 * mains_hz / pole_pairs
    lowest = synchronous_rpm * (1.0 - MAINS_TOLERANCE) * (1.0 - LARGEST_SLIP)
    return lowest, synchronous_rpm * (1.0 + MAINS_TOLERANCE)


def speed_of_machine(
    machine: Machine, channel: str | None = None, mains_hz: float | None = None
) -> TacholessSpeed:
    """Make the source of the speed of a machine with an induction motor, without a tacho.

    The comb has orders 1 to 10 and that of the rotor's slots, where the machine has an air gap; the
    multiples of the mains do not count.

    Parameters
    ----------
    machine : with a table of the motor
    channel : in which the speed is looked for; default: the recording's only one
    mains_hz : frequency of the mains; default: that of the motor's table

    Raises
    ------
    ParameterError
        The machine has no induction motor.
    """
    if not machine.has_table(CapacitorMotor):
        raise ParameterError(
            f"machine {machine.name}: has no induction motor (table `motor`): give its lowest and "
            "highest speed"
        )
    motor = machine.table(CapacitorMotor)
    frequency_hz = motor.line_frequency_hz if mains_hz is None else mains_hz
    comb = set(DEFAULT_COMB)
    if machine.has_table(AirGap):
        comb.add(float(machine.table(AirGap).rotor_slots))
    limits = slip_limits_rpm(frequency_hz, motor.pole_pairs)
    return TacholessSpeed(channel, *limits, tuple(sorted(comb)), frequency_hz)
