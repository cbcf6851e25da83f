"""Run-downs of one machine without a balancer, from any speed."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.units import shaft_frequency_hz
from ..machine.machine import Machine
from ..machine.source import Shared
from ..machine.stopping import CheckValve, Stopping, TurningBack
from ..mechanics.moving_parts import MovingPart
from ..mechanics.rotation import uniform_crank_angle
from ..sources.gas import gas_cycle
from ..sources.scroll_gas.parameters import ScrollGas, ScrollWraps, pair_volume_m3
from .coasting import AfterStop, RunDown, run_down
from .reversal import TrappedGas

SHIFTED: Final = ("orbiting_scroll", "brake", "oldham")
"""The set that the brake lets turn against pin and counterweights (thesis 6.4)."""
PATH_SAMPLES: Final = 256
"""Samples of the moving parts' paths, which are circles and a line."""


@dataclass(frozen=True)
class Stops:
    """Run-downs of one machine.

    Attributes
    ----------
    stopping : inertia, drag, shift
    parts : moving parts over a revolution
    machine : with its gas, whose torque is that of steady running at the speed before the stop
    after : stretch after the first rest; none for stops that end there
    """

    stopping: Stopping
    parts: Sequence[MovingPart]
    machine: Machine
    after: AfterStop | None = None

    @classmethod
    def of(cls, machine: Machine, turns_back: bool = False) -> "Stops":
        """Return the stops of a machine with gas and a table of stopping.

        Parameters
        ----------
        machine : with the table of turning back where it does
        turns_back : whether stops go on after the first rest
        """
        parts = machine.moving_parts(uniform_crank_angle(PATH_SAMPLES))
        after = _after(machine) if turns_back else None
        return cls(machine.table(Stopping), parts, machine, after)

    def run_down(self, speed_rpm: float, rate_hz: float, steady_revolutions: int) -> RunDown:
        """Return the run-down from a speed to rest.

        Parameters
        ----------
        speed_rpm : before switch-off
        rate_hz : samples of the result
        steady_revolutions : before switch-off, at constant speed
        """
        gas = gas_cycle(self.machine, Shared(), speed_rpm)
        return run_down(
            self.stopping,
            self.parts,
            SHIFTED,
            gas.torque_n_m,
            2.0 * np.pi * shaft_frequency_hz(speed_rpm),
            rate_hz,
            steady_revolutions,
            self.after,
        )


def _after(machine: Machine) -> AfterStop:
    """Brake, trapped gas, and valve where the machine has one."""
    gas, table = machine.table(ScrollGas), machine.table(TurningBack)
    trapped = TrappedGas(
        table.trapped_volume_m3,
        float(pair_volume_m3(machine.table(ScrollWraps), np.zeros(1))[0]),
        (gas.suction_pressure_pa, gas.discharge_pressure_pa),
        gas.polytropic_index,
    )
    valve = machine.table(CheckValve) if machine.has_table(CheckValve) else None
    return AfterStop(table, trapped, valve)
