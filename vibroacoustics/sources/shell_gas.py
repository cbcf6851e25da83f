"""Gas in the shell as a source: the flow into the suction valve excites it, and it the shell."""

from collections.abc import Mapping
from typing import ClassVar, Final

import numpy as np
import scipy  # loads its subpackages when they are needed

from ..base.arrays import Array, ComplexArray
from ..base.parameters import Parameters
from ..base.registry import register
from ..machine.gas_in_shell import ShellGas
from ..machine.machine import Machine
from ..machine.source import Case, Source
from ..mechanics.capabilities import Capability
from ..mechanics.cylinder_gas import FLOW_SAMPLES, ValvedCylinder
from ..mechanics.loads import Loads
from ..mechanics.ports import HOUSING
from ..orders import order_spectrum

MODES: Final = 20
"""Modes with one node across the axis; the last is at 60 times the first one's frequency."""


@register
class GasInShell(Source):
    """Cavity modes of the gas round the block, of the flow through the suction valve."""

    kind: ClassVar[str] = "shell-gas"
    position: ClassVar[float] = 1.6
    label: ClassVar[str] = "gas in the shell"
    labels: ClassVar[Mapping[str, str]] = {
        "first_gas_mode_hz": "First mode of the gas across the shell",
    }
    tables: ClassVar[Mapping[str, type[Parameters]]] = {"shell_gas": ShellGas}
    needs: ClassVar[type[Capability]] = ValvedCylinder

    @classmethod
    def why_not(cls, machine: Machine) -> str | None:
        """Say that there is no gas around a block."""
        if machine.suspension is None:
            return "needs a block on springs in a shell, suspension"
        return super().why_not(machine)

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Force on the shell in the direction of the intake, at mid-height of the gas."""
        gas = case.machine.table(ShellGas)
        shaft = 2.0 * np.pi * case.shaft_frequency_hz
        angular = shaft * np.arange(case.maximum_order + 1, dtype=float)
        flow, _ = case.machine.require(ValvedCylinder).flows_m3_per_rad(FLOW_SAMPLES)
        rate = -order_spectrum(flow, case.maximum_order) * shaft  # drawn out of the gas
        force = rate * wall_force_per_flow(gas, angular)
        c, s = np.cos(gas.intake_angle_rad), np.sin(gas.intake_angle_rad)
        height, still = gas.middle_height_m, np.zeros_like(force)
        wrench = [c * force, s * force, still, -height * s * force, height * c * force, still]
        first = float(mode_numbers(1)[0]) * gas.speed_of_sound_m_per_s / gas.radius_m
        return Loads(
            lines={HOUSING: np.stack(wrench)},
            figures={"first_gas_mode_hz": first / (2.0 * np.pi)},
        )


def mode_numbers(count: int) -> Array:
    """Roots of J1'(κ): 1.8412, 5.3314, …"""
    return np.asarray(scipy.special.jnp_zeros(1, count))


def wall_force_per_flow(
    gas: ShellGas, angular_frequency: Array, modes: int = MODES
) -> ComplexArray:
    """Force of the gas on a rigid round wall per flow into it, towards the source, N s/m³.

    Sum over the modes J1(κ r/a) cos θ of a closed cylinder (P. M. Morse, K. U. Ingard, Theoretical
    Acoustics, McGraw-Hill 1968, 9.2): only those with one node across the axis push the wall to
    one side, and of these only those alike along it. Below all modes it is jωρ r, the momentum of
    the compliant gas.

    Parameters
    ----------
    gas : size, speed of sound, density, place of the source
    angular_frequency : ω, shape (line,), rad/s
    modes : number of modes of the sum
    """
    numbers = mode_numbers(modes)[:, None]
    at_wall = scipy.special.j1(numbers)
    at_source = scipy.special.j1(numbers * gas.intake_ratio)
    norm = 0.5 * np.pi * gas.radius_m**2 * (1.0 - numbers**-2.0) * at_wall**2  # per height
    sound = gas.speed_of_sound_m_per_s
    natural = (numbers * sound / gas.radius_m) ** 2 * (1.0 + 1j * gas.loss_factor_ratio)
    pressure = at_source / (norm * (natural - angular_frequency**2))
    pushing = np.pi * gas.radius_m * at_wall
    scale = 1j * angular_frequency * gas.density_kg_per_m3 * sound**2
    return np.asarray(scale * np.sum(pushing * pressure, axis=0))
