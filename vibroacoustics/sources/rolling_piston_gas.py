"""Gas of a rolling piston in its shell as a source: torque pair and discharge flow."""

from collections.abc import Mapping
from typing import ClassVar, Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.parameters import Parameters
from ..base.registry import register
from ..machine.cavities import DischargeDome, GasPort
from ..machine.frame import BEARING_HOUSING, STATOR
from ..machine.machine import Machine
from ..machine.source import Case, Source
from ..mechanics.capabilities import Capability
from ..mechanics.loads import Loads
from ..mechanics.ports import Port
from ..mechanics.rolling_piston import RollingHistories, RollingPiston
from ..orders.spectrum import order_spectrum_at_speed
from .part_loads import about_z

SAMPLES_PER_ORDER: Final = 4
"""Crank angles a turn over the highest order."""
DOME: Final = "discharge_dome"


@register
class RollingPistonGas(Source):
    """Torque of the gas on the cylinder block, of the motor on the stator, flow into the shell.

    Forces of the gas across the shaft are pairs between cylinder and bearings, which are one block.
    """

    kind: ClassVar[str] = "rolling-piston-gas"
    position: ClassVar[float] = 1.0
    label: ClassVar[str] = "gas forces"
    needs: ClassVar[type[Capability]] = RollingPiston
    drives_shell: ClassVar[bool] = True

    @classmethod
    def tables_read(cls, machine: Machine) -> Mapping[str, type[Parameters]]:
        """The shell's gas, where the machine has it."""
        return {DOME: DischargeDome} if machine.has_table(DischargeDome) else {}

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Orders of both torques and of the flow; the shaft needs the mean torque alone.

        The swing of the shaft's speed, which answers to the others, is that of the moving parts.
        """
        piston, highest = case.machine.require(RollingPiston), case.maximum_order
        histories = histories_of(case)
        block = spectrum(histories, histories.block_torque_n_m, highest)
        motor = spectrum(histories, histories.motor_torque_n_m, highest)
        mean = np.zeros(highest + 1, dtype=complex)
        mean[0] = motor[0]
        motor[0] = block[0] = 0.0
        lines: dict[Port, ComplexArray] = {
            BEARING_HOUSING: about_z(block),
            STATOR: about_z(-motor),
        }
        if case.machine.has_table(DischargeDome):
            flow = spectrum(histories, histories.discharge_m3_per_s, highest)
            lines[_port(piston)] = flow[None]
        return Loads(lines=lines, shaft_torque_n_m=mean)


@register
class VaneImpacts(Source):
    """Landings of the vane's tip on the roller, along the vane on the cylinder block.

    Silent while the tip does not leave the roller.
    """

    kind: ClassVar[str] = "vane-impacts"
    position: ClassVar[float] = 1.2
    label: ClassVar[str] = "vane impacts"
    needs: ClassVar[type[Capability]] = RollingPiston
    drives_shell: ClassVar[bool] = True

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Return lines of the impulses at the mean height of the vanes.

        The couple of the two vanes of a twin is neglected.
        """
        piston, highest = case.machine.require(RollingPiston), case.maximum_order
        histories = histories_of(case)
        force = spectrum(histories, histories.landing_n, highest)
        still = np.zeros_like(force)
        wrench = [force, still, still, still, piston.vane_height_m * force, still]
        return Loads(lines={BEARING_HOUSING: np.stack(wrench)})


def histories_of(case: Case) -> RollingHistories:
    """Time histories of the case's machine, which sources and cases of a sample share.

    Parameters
    ----------
    case : with a rolling piston
    """
    samples = SAMPLES_PER_ORDER * (case.maximum_order + 1)
    machine = case.machine
    piston = machine.require(RollingPiston)
    _, histories = case.shared(
        ("rolling piston", id(machine), case.speed_rpm, samples),
        lambda: (machine, piston.histories(case.speed_rpm, samples)),  # held, as its id is the key
    )
    return histories


def spectrum(histories: RollingHistories, history: Array, highest: int) -> ComplexArray:
    """Complex peaks at multiples of the mean shaft frequency, shape (highest + 1,).

    Parameters
    ----------
    histories : with the speed
    history : over its crank angles, shape (samples,)
    highest : order
    """
    return order_spectrum_at_speed(history, histories.speed_rad_per_s, highest)


def _port(piston: RollingPiston) -> GasPort:
    state = piston.density_kg_per_m3, piston.sound_speed_m_per_s
    return GasPort(DOME, density_kg_per_m3=state[0], sound_speed_m_per_s=state[1])
