"""The motor's torque as two sources: its answer to the load's ripple, and its own pulsation."""

from collections.abc import Mapping, Sequence
from typing import ClassVar, Final

import numpy as np

from ..base.arrays import ComplexArray
from ..base.errors import ParameterError
from ..base.parameters import Parameters
from ..base.registry import register
from ..machine.source import Case, Source
from ..mechanics.loads import Loads, Tone, total_torque_n_m
from ..mechanics.ports import Port
from .induction_motor.revolving_fields import (
    CapacitorMotor,
    TurningRotor,
    on_supply,
    supply_frequency_hz,
)
from .induction_motor.torque_lines import TorqueLine, TorqueLines, rotor_in_motor, torque_lines
from .part_loads import motor_lines

TWICE_LINE: Final = "2 x line"
TWICE_LINE_FIGURE: Final = "foot_force_2x_line_n"
_FIGURE: Final = {TWICE_LINE: TWICE_LINE_FIGURE}
LOWEST_LINE_HZ: Final = 10.0
"""Sidebands below are no sound."""
LEAST_SIDEBAND: Final = 1e-4
"""Least torque of a sideband over that of the largest line; weaker ones are omitted."""


class _MotorTorque(Source):
    tables: ClassVar[Mapping[str, type[Parameters]]] = {
        "motor": CapacitorMotor,
        "rotor": TurningRotor,
    }
    drives_shell: ClassVar[bool] = True

    def supply_frequency_hz(self, case: Case, before: Mapping[str, Loads]) -> float:
        """Frequency of the supply on which the motor carries the mean load at the case's speed."""
        mean = float(_load_torque(case, before)[0].real)
        return supply_frequency_hz(case.machine.table(CapacitorMotor), case.speed_rpm, mean)


@register
class TorqueRipple(_MotorTorque):
    """Orders of the load's torque on stator and machine."""

    kind: ClassVar[str] = "torque-ripple"
    position: ClassVar[float] = 3.0
    label: ClassVar[str] = "torque ripple on the stator"

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Torque on the stator and roll moment of the rotor's swing, by order."""
        lines = motor_lines(case.machine.mechanism_port, _balance(case, before).shaft)
        return Loads(lines={port: np.pad(load, ((0, 0), (1, 0))) for port, load in lines.items()})


@register
class MotorPulsation(_MotorTorque):
    """Torque at twice the line frequency and its sidebands, which are no orders."""

    kind: ClassVar[str] = "motor-pulsation"
    position: ClassVar[float] = 4.0
    label: ClassVar[str] = "motor at twice the line frequency"
    labels: ClassVar[Mapping[str, str]] = {
        TWICE_LINE_FIGURE: "Largest foot force at twice the line frequency (motor, not 2×)"
    }

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Tones from LOWEST_LINE_HZ to the highest frequency."""
        balance = _balance(case, before)
        least = LEAST_SIDEBAND * max(abs(line.motor_torque_n_m) for line in balance.line)
        strong = (line for line in balance.sidebands if abs(line.motor_torque_n_m) > least)
        kept = [
            line
            for line in (*balance.line, *strong)
            if LOWEST_LINE_HZ <= line.frequency_hz <= case.maximum_frequency_hz
        ]
        return Loads(tones=_tones(case.machine.mechanism_port, kept))


def _tones(mechanism: Port, lines: Sequence[TorqueLine]) -> tuple[Tone, ...]:
    loads = motor_lines(mechanism, lines)
    return tuple(
        Tone(
            line.name,
            line.frequency_hz,
            {port: load[:, number] for port, load in loads.items()},
            _FIGURE.get(line.name),
        )
        for number, line in enumerate(lines)
    )


def _balance(case: Case, before: Mapping[str, Loads]) -> TorqueLines:
    """Torque balance with the motor on the supply of this speed, at the same flux."""
    if case.supply_frequency_hz is None:
        raise ParameterError("operation.supply_frequency_hz: is missing; the motor needs it")
    rated, turning = case.machine.table(CapacitorMotor), case.machine.table(TurningRotor)
    motor = on_supply(rated, case.supply_frequency_hz)
    torque = _load_torque(case, before)
    inertia, mean = turning.inertia_kg_m2, float(torque[0].real)
    rotor = case.shared(
        ("rotor in motor", motor, inertia, mean), lambda: rotor_in_motor(motor, inertia, mean)
    )
    return case.shared(
        ("torque lines", motor, inertia, torque.tobytes()),
        lambda: torque_lines(rotor, torque[1:]),
    )


def _load_torque(case: Case, before: Mapping[str, Loads]) -> ComplexArray:
    """Torque of the load by order, the mean first, N m."""
    return total_torque_n_m(before.values(), case.maximum_order)
