"""Limits, comb and mains of a speed without a tacho, from the motor of a machine file."""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np

from ..base.errors import ParameterError
from ..machine.machine import Machine
from ..mechanisms.hermetic.parameters import InductionMotor
from ..mechanisms.slider_link.parameters import Motor
from ..sources.air_gap.parameters import AirGap
from ..sources.induction_motor.revolving_fields import CapacitorMotor
from ..sources.synchronous_motor.parameters import SynchronousMotor
from ..study.order_analysis import DEFAULT_COMB, TacholessSpeed

LARGEST_SLIP: Final = 0.1
"""Slip of an induction motor under load; at its breakdown torque it is larger."""
MAINS_TOLERANCE: Final = 0.01
"""Deviation of the mains frequency from its nominal value: EN 50160, 99.5 % of a year."""
MAINS_HZ: Final = (50.0, 60.0)
MOST_POLE_PAIRS: Final = 8
RIPPLE_PER_POLE_PAIR: Final = 6
"""Order of a three-phase motor's torque ripple over its pole pairs (Krause et al., 3.3)."""


class Supply(NamedTuple):
    """Supply of an induction motor.

    Attributes
    ----------
    mains_hz : nominal frequency
    pole_pairs : half the number of poles
    """

    mains_hz: float
    pole_pairs: int


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


def supplies_within_slip(speed_rpm: float) -> Iterator[Supply]:
    """Supplies of 50 and 60 Hz and up to 8 pole pairs with which a speed has a slip of 0 to 0.1.

    Parameters
    ----------
    speed_rpm : speed of the shaft under load
    """
    for mains_hz in MAINS_HZ:
        for pole_pairs in range(1, MOST_POLE_PAIRS + 1):
            synchronous_rpm = 60.0 * mains_hz / pole_pairs
            if 1.0 - LARGEST_SLIP <= speed_rpm / synchronous_rpm <= 1.0 + 1e-3:
                yield Supply(mains_hz, pole_pairs)


def speed_of_machine(
    machine: Machine,
    channel: str | None = None,
    mains_hz: float | None = None,
    limits_rpm: tuple[float, float] | None = None,
) -> TacholessSpeed:
    """Make the source of the speed of a machine with a motor, without a tacho.

    The limits are those of an induction motor's slip. Of a synchronous motor on an inverter they
    must be given. The comb has orders 1 to 10; of an induction motor with an air gap also that of
    the rotor's slots, of a synchronous motor those of its torque ripple and of its cogging.

    Parameters
    ----------
    machine : with a table of the motor
    channel : in which the speed is looked for; default: the recording's only one
    mains_hz : frequency of the mains, whose multiples do not count; default: that of an induction
        motor, none beside an inverter
    limits_rpm : lowest and highest speed instead of those of the slip

    Raises
    ------
    ParameterError
        The machine has no motor from whose table a speed follows.
    """
    synchronous, supply = machine.has_table(SynchronousMotor), _supply(machine)
    if synchronous and (limits_rpm is not None or supply is None):
        if limits_rpm is None:
            raise ParameterError(
                f"machine {machine.name}: has a synchronous motor on an inverter, of any speed: "
                "give --tacholess LOWEST HIGHEST too"
            )
        return TacholessSpeed(channel, *limits_rpm, _synchronous_comb(machine), mains_hz)
    if supply is None:
        raise ParameterError(
            f"machine {machine.name}: has no motor (table `motor` or `synchronous_motor`) that "
            "gives a speed: give --tacholess LOWEST HIGHEST without --tacholess-machine"
        )
    frequency_hz = supply.mains_hz if mains_hz is None else mains_hz
    limits = slip_limits_rpm(frequency_hz, supply.pole_pairs) if limits_rpm is None else limits_rpm
    return TacholessSpeed(channel, *limits, _induction_comb(machine), frequency_hz)


def _supply(machine: Machine) -> Supply | None:
    """Supply of an induction motor: of its circuit, its synchronous speed or a published speed."""
    if machine.has_table(CapacitorMotor):
        circuit = machine.table(CapacitorMotor)
        return Supply(circuit.line_frequency_hz, circuit.pole_pairs)
    if machine.has_table(InductionMotor):
        speed_rpm = 30.0 / np.pi * machine.table(InductionMotor).synchronous_speed_rad_per_s
    elif machine.has_table(Motor) and machine.overall_noise is not None:
        speed_rpm = machine.overall_noise.speed_rpm
    else:
        return None
    return next(supplies_within_slip(speed_rpm), None)


def _induction_comb(machine: Machine) -> tuple[float, ...]:
    slots = [machine.table(AirGap).rotor_slots] if machine.has_table(AirGap) else []
    return tuple(sorted({*DEFAULT_COMB, *map(float, slots)}))


def _synchronous_comb(machine: Machine) -> tuple[float, ...]:
    motor = machine.table(SynchronousMotor)
    teeth = (RIPPLE_PER_POLE_PAIR * motor.pole_pairs, motor.cogging_order)
    return tuple(sorted({*DEFAULT_COMB, *map(float, teeth)}))
