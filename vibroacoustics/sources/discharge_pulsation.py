"""Pulsation of the discharged gas as a source: its thrust on block, discharge tube and shell."""

from collections.abc import Mapping
from itertools import pairwise
from typing import ClassVar

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.parameters import Parameters
from ..base.registry import register
from ..machine.gas_in_shell import DischargeGas
from ..machine.machine import Machine
from ..machine.source import Case, Source
from ..machine.suspension import BLOCK, DischargeTube
from ..mechanics.capabilities import Capability
from ..mechanics.cylinder_gas import FLOW_SAMPLES, ValvedCylinder
from ..mechanics.loads import Loads
from ..mechanics.ports import HOUSING
from ..orders import order_spectrum
from ..transfer.tube import tube_end_reactions, tube_stiffness


@register
class DischargePulsation(Source):
    """Pressure in muffler and discharge tube, of the flow through the discharge valve."""

    kind: ClassVar[str] = "discharge-pulsation"
    position: ClassVar[float] = 1.5
    label: ClassVar[str] = "pulsation of the discharged gas"
    labels: ClassVar[Mapping[str, str]] = {
        "discharge_pulsation_pa": "Pulsation in the discharge muffler at the first order, peak",
    }
    tables: ClassVar[Mapping[str, type[Parameters]]] = {"discharge_gas": DischargeGas}
    needs: ClassVar[type[Capability]] = ValvedCylinder

    @classmethod
    def why_not(cls, machine: Machine) -> str | None:
        """Say that there is no discharge tube between a block and its shell."""
        suspended = machine.suspension
        if suspended is None or suspended.discharge_tube is None:
            return "needs a block on springs with a discharge tube, suspension.discharge_tube"
        return super().why_not(machine)

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Thrust of the tube's root and of its bends, on the block and on the shell.

        The tube runs straight on outside the shell, where the line takes its thrust.
        """
        machine, suspended = case.machine, case.machine.suspension
        gas = machine.table(DischargeGas)
        if suspended is None or suspended.discharge_tube is None:
            return Loads()
        tube, height = suspended.discharge_tube, suspended.height_m
        shaft = 2.0 * np.pi * case.shaft_frequency_hz
        angular = shaft * np.arange(case.maximum_order + 1, dtype=float)
        area = 0.25 * np.pi * tube.inner_diameter_m**2
        _, flow = machine.require(ValvedCylinder).flows_m3_per_rad(FLOW_SAMPLES)
        rate = order_spectrum(flow, case.maximum_order) * shaft
        pressure = muffler_pressure_pa(rate, angular, gas, area)
        path = np.array([tube.x_m, tube.y_m, tube.z_m]).T
        waves = pressure * np.exp(
            -1j * np.outer(_lengths(path), angular) / gas.speed_of_sound_m_per_s
        )
        block, shell = _ends(tube, path, area * waves)
        block_arm, shell_arm = path[-1], path[-1] + np.array([0.0, 0.0, height])
        return Loads(
            lines={BLOCK: _moved(block, block_arm), HOUSING: _moved(shell, shell_arm)},
            figures={"discharge_pulsation_pa": float(abs(pressure[1]))},
        )


def muffler_pressure_pa(
    flow_m3_per_s: ComplexArray, angular_frequency: Array, gas: DischargeGas, area_m2: float
) -> ComplexArray:
    """p = Q/(jωV/(ρ c²) + A/(ρ c)): a volume in front of a line without reflection.

    M. L. Munjal, Acoustics of Ducts and Mufflers, Wiley 1987, chapter 2. The mean has no sound.

    Parameters
    ----------
    flow_m3_per_s : flow Q through the valve, shape (line,)
    angular_frequency : angular frequency of the lines, shape (line,), rad/s
    gas : volume, density, speed of sound
    area_m2 : area of the tube
    """
    impedance = gas.density_kg_per_m3 * gas.speed_of_sound_m_per_s
    stored = 1j * angular_frequency * gas.muffler_volume_m3
    admittance = (stored / gas.speed_of_sound_m_per_s + area_m2) / impedance
    return np.where(angular_frequency > 0.0, flow_m3_per_s / admittance, 0.0)


def _lengths(path_m: Array) -> Array:
    """Way along the tube to each point, m."""
    steps = np.linalg.norm(np.diff(path_m, axis=0), axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)])


def _ends(
    tube: DischargeTube, path_m: Array, thrust_n: ComplexArray
) -> tuple[ComplexArray, ComplexArray]:
    """Wrench on block and shell about the tube's last point, of p A at each point, (6, line)."""
    directions = [end - start for start, end in pairwise(path_m)]
    units = np.array([each / np.linalg.norm(each) for each in directions])
    turns = np.concatenate([np.zeros((1, 3)), units[:-1] - units[1:], np.zeros((1, 3))])
    sizes = (tube.outer_diameter_m, tube.inner_diameter_m)
    steel = (tube.youngs_modulus_pa, tube.poisson_ratio)
    stiffness = tube_stiffness(path_m, *sizes, *steel)
    bends = turns[:, :, None] * thrust_n[:, None, :]
    block, shell = tube_end_reactions(path_m, bends, stiffness, *sizes, *steel)
    root = -units[0][:, None] * thrust_n[0]
    arm = path_m[0] - path_m[-1]
    block += np.concatenate([root, np.cross(arm[:, None], root, axis=0)])
    return block, shell


def _moved(wrench: ComplexArray, arm_m: Array) -> ComplexArray:
    """A wrench about a point at `arm_m` from where it is wanted."""
    force, moment = wrench[:3], wrench[3:]
    return np.concatenate([force, moment + np.cross(arm_m[:, None], force, axis=0)])
