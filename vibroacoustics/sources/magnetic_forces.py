"""Magnetic forces across the air gap of either motor as sources."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ..base.arrays import ComplexArray
from ..base.errors import ParameterError
from ..base.parameters import Parameters
from ..base.registry import register
from ..machine.shell_structure import ShellStructure
from ..machine.source import Case, Source
from ..machine.stator_yoke import StatorYoke
from ..mechanics.loads import Loads, PortLoads, Tone, total_torque_n_m
from ..mechanics.ports import Port
from ..mechanics.scroll_shaft import ScrollShaft
from .air_gap.parameters import AirGap
from .air_gap.waves import (
    PORTS,
    Wave,
    Waves,
    cosine,
    loads_of_stress,
    permeance,
    product,
    stress_pa,
)
from .induction_motor.revolving_fields import (
    CapacitorMotor,
    air_gap_voltages,
    on_supply,
    point_at_torque,
    supply_frequency_hz,
)
from .synchronous_motor.parameters import SynchronousMotor

_TABLES: Mapping[str, type[Parameters]] = {
    "air_gap": AirGap,
    "stator_yoke": StatorYoke,
    "shaft": ScrollShaft,
}


class _AirGapForces(Source):
    position: ClassVar[float] = 5.0
    drives_shell: ClassVar[bool] = True

    def _flux(self, case: Case, before: Mapping[str, Loads]) -> Waves:
        """Flux density of the motor's waves, coefficients, T."""
        raise NotImplementedError

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Waves that press the stator's yoke, and the pull between rotor and stator."""
        machine, supply_hz = case.machine, case.supply_frequency_hz
        if supply_hz is None:
            raise ParameterError("operation.supply_frequency_hz: is missing; the motor needs it")
        stack_m = machine.table(ShellStructure).stator.height_m
        loads = loads_of_stress(
            stress_pa(self._flux(case, before)),
            machine.table(StatorYoke),
            machine.table(ScrollShaft),
            stack_m,
        )
        orders = case.maximum_order + 1
        lines: dict[Port, ComplexArray] = {
            port: np.zeros((len(port.components), orders), dtype=complex) for port in PORTS
        }
        tones = []
        for (line, turns), load in loads.items():
            if line == 0 and turns < orders:
                for port, amplitudes in load.items():
                    lines[port][:, turns] = amplitudes
            frequency = line * supply_hz + turns * case.shaft_frequency_hz
            if line > 0 and 0.0 < abs(frequency) <= case.maximum_frequency_hz:
                tones.append(_tone(line, turns, frequency, load))
        return Loads(lines=lines, tones=tuple(tones))


def _tone(line: int, turns: int, frequency_hz: float, loads: PortLoads) -> Tone:
    """A line; one of negative frequency is its conjugate's."""
    name = f"{line} x line" + (f" {turns:+d} x shaft" if turns else "")
    if frequency_hz < 0.0:
        loads = {port: load.conj() for port, load in loads.items()}
    return Tone(name, abs(frequency_hz), loads)


@register
class InductionMotorForces(_AirGapForces):
    """Forces of the capacitor motor: both its fields, the slots of stator and cage,
    eccentricity."""

    kind: ClassVar[str] = "induction-motor-forces"
    label: ClassVar[str] = "magnetic forces of the motor"
    tables: ClassVar[Mapping[str, type[Parameters]]] = {"motor": CapacitorMotor, **_TABLES}

    def supply_frequency_hz(self, case: Case, before: Mapping[str, Loads]) -> float:
        """Supply frequency of the motor's torque."""
        mean = float(total_torque_n_m(before.values(), case.maximum_order)[0].real)
        return supply_frequency_hz(case.machine.table(CapacitorMotor), case.speed_rpm, mean)

    def _flux(self, case: Case, before: Mapping[str, Loads]) -> Waves:
        """Forward and backward wave in the ratio of the fields' voltages, under the mean load."""
        assert case.supply_frequency_hz is not None  # noqa: S101 - `loads` refuses it
        motor = on_supply(case.machine.table(CapacitorMotor), case.supply_frequency_hz)
        mean = total_torque_n_m(before.values(), case.maximum_order)[0].real
        forward, backward = air_gap_voltages(motor, point_at_torque(motor, float(mean)))
        gap, pairs = case.machine.table(AirGap), motor.pole_pairs
        waves = cosine(Wave(pairs, 1, 0), gap.flux_density_t * forward / abs(forward))
        waves |= cosine(Wave(-pairs, 1, 0), gap.flux_density_t * backward / abs(forward))
        return product(waves, permeance(gap, gap.stator_slots, gap.rotor_slots))


@register
class SynchronousMotorForces(_AirGapForces):
    """Forces of the synchronous motor: its magnets' fundamental, the stator's slots, eccentricity.

    All of them are orders of the shaft. The field of the currents is neglected.
    """

    kind: ClassVar[str] = "synchronous-motor-forces"
    label: ClassVar[str] = "magnetic forces of the synchronous motor"
    tables: ClassVar[Mapping[str, type[Parameters]]] = {
        "synchronous_motor": SynchronousMotor,
        **_TABLES,
    }

    def supply_frequency_hz(self, case: Case, before: Mapping[str, Loads]) -> float:
        """Electrical frequency."""
        return case.machine.table(SynchronousMotor).pole_pairs * case.shaft_frequency_hz

    def _flux(self, case: Case, before: Mapping[str, Loads]) -> Waves:
        motor, gap = case.machine.table(SynchronousMotor), case.machine.table(AirGap)
        magnets = cosine(Wave(motor.pole_pairs, 0, motor.pole_pairs), gap.flux_density_t + 0j)
        return product(magnets, permeance(gap, motor.slots, None))
