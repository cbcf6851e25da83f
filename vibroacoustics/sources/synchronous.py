"""The torque of a synchronous motor on an inverter as a source."""

from collections.abc import Mapping
from typing import ClassVar, Final

import numpy as np

from ..base.errors import ParameterError
from ..base.parameters import Parameters
from ..base.registry import register
from ..base.units import shaft_frequency_hz
from ..machine.source import Case, Source
from ..mechanics.loads import Loads, Tone, total_torque_n_m
from ..mechanics.ports import Port
from .part_loads import motor_loads
from .synchronous_motor.harmonics import OperatingPoint, operating_point, shaft_orders
from .synchronous_motor.parameters import SynchronousMotor
from .synchronous_motor.switching import Sideband, sidebands

SUPPLY_TOLERANCE: Final = 1e-6
"""A synchronous motor turns with its supply."""
SMALLEST_SHARE: Final = 1e-4
"""Share of the largest sideband: smaller ones are neglected, 80 dB down."""


@register
class SynchronousMotorTorque(Source):
    """Torque of the load and of the motor by order, and at sidebands of the switching frequency.

    The current's control holds the current, so that the motor does not answer to a swing of the
    speed: the rotor's inertia alone does.
    """

    kind: ClassVar[str] = "synchronous-motor"
    position: ClassVar[float] = 3.0
    label: ClassVar[str] = "synchronous motor on an inverter"
    labels: ClassVar[Mapping[str, str]] = {
        "motor_phase_current_a": "Current of a phase of the motor, peak",
        "motor_modulation_ratio": "Modulation of the inverter",
    }
    tables: ClassVar[Mapping[str, type[Parameters]]] = {"synchronous_motor": SynchronousMotor}
    drives_shell: ClassVar[bool] = True

    def supply_frequency_hz(self, case: Case, before: Mapping[str, Loads]) -> float:
        """Electrical frequency, pole pairs times that of the shaft."""
        return self._electrical_hz(case)

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Reaction on the stator and roll moment of the rotor's swing."""
        self._check_supply(case)
        motor = case.machine.table(SynchronousMotor)
        load = total_torque_n_m(before.values(), case.maximum_order)
        speed = 2.0 * np.pi * shaft_frequency_hz(case.speed_rpm)
        point = operating_point(motor, speed, float(load[0].real))
        torque = shaft_orders(motor, point, case.maximum_order)
        torque[0] = load[0]  # the mean turns no rotor
        tones = _tones(motor, point, case)
        return Loads(
            lines=motor_loads(case.machine.mechanism_port, load - torque, torque),
            tones=tones,
            figures={
                "motor_phase_current_a": abs(point.current_a[1]),
                "motor_modulation_ratio": point.modulation_ratio,
            },
        )

    def _check_supply(self, case: Case) -> None:
        stated_hz, needed = case.supply_frequency_hz, self._electrical_hz(case)
        if stated_hz is not None and abs(stated_hz - needed) > SUPPLY_TOLERANCE * needed:
            raise ParameterError(
                f"operation.supply_frequency_hz = {stated_hz:g} Hz: a synchronous motor turns at "
                f"{case.speed_rpm:g} rpm on {needed:.6g} Hz alone; leave it out"
            )

    def _electrical_hz(self, case: Case) -> float:
        pairs = case.machine.table(SynchronousMotor).pole_pairs
        return pairs * shaft_frequency_hz(case.speed_rpm)


def _tones(motor: SynchronousMotor, point: OperatingPoint, case: Case) -> tuple[Tone, ...]:
    """Torques of all sidebands that are no order, except those far below the largest."""
    every = sidebands(motor, point, case.maximum_frequency_hz)
    largest = max((abs(side.torque_n_m) for side in every), default=0.0)
    electrical_hz = point.electrical_rad_per_s / (2.0 * np.pi)
    return tuple(
        _tone(case.machine.mechanism_port, side, motor.switching_frequency_hz, electrical_hz)
        for side in every
        if abs(side.torque_n_m) > SMALLEST_SHARE * largest
    )


def _tone(mechanism: Port, side: Sideband, switching_hz: float, electrical_hz: float) -> Tone:
    torque = np.array([side.torque_n_m])
    return Tone(
        f"{side.carrier} x switching {side.electrical:+d} x electrical",
        side.carrier * switching_hz + side.electrical * electrical_hz,
        {port: load[:, 0] for port, load in motor_loads(mechanism, -torque, torque).items()},
    )
