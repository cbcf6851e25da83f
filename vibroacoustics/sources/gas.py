"""Gas forces of a scroll as a source."""

from collections.abc import Iterable, Mapping
from typing import ClassVar, Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.curves import Curve
from ..base.parameters import Parameters
from ..base.registry import register
from ..machine.cavities import SPACES, DischargeDome, DischargeMuffler, GasPort, SuctionAnnulus
from ..machine.frame import Frame
from ..machine.machine import Machine
from ..machine.source import Case, Shared, Source
from ..mechanics.capabilities import Capability, OldhamRing
from ..mechanics.loads import Loads
from ..mechanics.ports import Port
from ..mechanics.rotation import uniform_crank_angle
from ..orders import order_spectrum
from .part_loads import gas_loads
from .scroll_gas.curves import discharge_line_curves, scroll_gas_curves
from .scroll_gas.cycle import ScrollGasCycle, scroll_gas_cycle
from .scroll_gas.opening import steady_opening, steps_of_turn, why_no_opening
from .scroll_gas.parameters import (
    ScrollGas,
    ScrollLeakage,
    ScrollOpening,
    ScrollWraps,
    SuctionPockets,
)
from .scroll_gas.suction import OpenedGas, SuctionFlow, suction_flow

GAS_SAMPLES: Final = 8192
"""Crank angles a revolution: the step of the force where a pocket opens makes an error of the
step over the samples, below 1 % of the order at 4 kHz. Where it opens without a step they are
those of the opening: four times as many change the level by 0.0009 dB rms."""

ORBIT_TOLERANCE: Final = 0.01
_WITH_INERTIA: Final[Mapping[str, type[Parameters]]] = {
    "leakage": ScrollLeakage,
    "suction_pockets": SuctionPockets,
    **SPACES,
}
"""Tables that a machine may have, which are read where its gas has inertia."""


@register
class ScrollGasForces(Source):
    """Pressure in the pockets, on the two scrolls."""

    kind: ClassVar[str] = "scroll-gas"
    position: ClassVar[float] = 1.0
    label: ClassVar[str] = "gas forces"
    tables: ClassVar[Mapping[str, type[Parameters]]] = {"wraps": ScrollWraps, "gas": ScrollGas}
    needs: ClassVar[type[Capability]] = OldhamRing
    drives_shell: ClassVar[bool] = True

    @classmethod
    def tables_read(cls, machine: Machine) -> Mapping[str, type[Parameters]]:
        """Wraps, gas and, where it has inertia, the opening."""
        return gas_tables(machine)

    @classmethod
    def why_not(cls, machine: Machine) -> str | None:
        """A table is missing, or the wraps orbit at another radius than the machine."""
        ring = machine.capability(OldhamRing)
        reason = super().why_not(machine) or _why_no_opening(machine)
        if reason or ring is None:
            return reason
        wraps = machine.table(ScrollWraps).orbit_radius_m
        if abs(ring.stroke_m - wraps) <= ORBIT_TOLERANCE * wraps:
            return None
        return (
            f"kinematics.orbit_radius_mm = {1e3 * ring.stroke_m:.4g} mm: must agree within 1 % "
            f"with π wraps.base_radius_mm - wraps.thickness_mm = {1e3 * wraps:.4g} mm"
        )

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Orders of the gas forces on the scrolls, and the torque that the shaft needs."""
        cycle = gas_cycle(case.machine, case.shared, case.speed_rpm)
        of_frame, highest = _of_frame(case.machine), case.maximum_order

        def compute() -> tuple[ScrollGasCycle, Loads]:
            lines = {
                port: order_spectrum(load, highest)
                for port, load in gas_loads(cycle, *of_frame).items()
            }
            torque = order_spectrum(cycle.torque_n_m, highest)
            flows = _flows(case, cycle, highest)
            return cycle, Loads(lines=lines | flows, shaft_torque_n_m=torque)

        key = "gas loads", id(cycle), of_frame, highest
        return case.shared(key, compute)[1]  # the cycle is held, as its id is the key

    def curves(self, case: Case) -> Iterable[Curve]:
        """Pressures of pockets, flows, forces and torque; see `scroll_gas_curves`."""
        machine, opened = case.machine, opened_gas(case.machine, case.shared, case.speed_rpm)
        filling = None if opened is None else opened.filling
        if opened is not None and filling is None and machine.has_table(SuctionAnnulus):
            filling = suction_gas(machine, SuctionAnnulus, case.shared, case.speed_rpm)
        wraps, gas = machine.table(ScrollWraps), machine.table(ScrollGas)
        yield from scroll_gas_curves(wraps, gas, opened, filling)
        if opened is not None and machine.has_table(DischargeMuffler):
            muffler, tube = machine.table(DischargeMuffler), machine.table(ScrollOpening)
            yield from discharge_line_curves(
                muffler, opened, gas.discharge_state, tube.tube_diameter_m, case.speed_rpm
            )


def _flows(case: Case, cycle: ScrollGasCycle, highest: int) -> dict[Port, ComplexArray]:
    """Flows into dome and annulus, where the gas has inertia and the machine has the tables."""
    machine, flows = case.machine, dict[Port, ComplexArray]()
    if cycle.port_flow_kg_per_s is None:
        return flows
    if machine.has_table(DischargeDome):
        rho, sound = machine.table(ScrollGas).discharge_state
        flow = order_spectrum(cycle.port_flow_kg_per_s, highest) / rho
        flows[_port("discharge_dome", rho, sound)] = flow[None]
    if machine.has_table(SuctionAnnulus):
        _, rho, sound = _suction_state(machine, SuctionAnnulus)
        filling = suction_gas(machine, SuctionAnnulus, case.shared, case.speed_rpm)
        wraps = machine.table(ScrollWraps)
        flow = order_spectrum(filling.over_crank_angle(wraps, cycle.crank_angle), highest)
        flows[_port("suction_annulus", rho, sound)] = -flow[None] / rho
    return flows


def _port(space: str, density: float, sound_speed: float) -> GasPort:
    return GasPort(space, density_kg_per_m3=density, sound_speed_m_per_s=sound_speed)


def suction_gas(
    machine: Machine,
    state_in: type[SuctionAnnulus] | type[SuctionPockets],
    shared: Shared,
    speed_rpm: float,
) -> SuctionFlow:
    """The filling of the machine's pockets; see `suction_flow`.

    Parameters
    ----------
    machine : with wraps, opening and the table with the state
    state_in : table with the speed of sound and κ of the gas
    shared : with what else needs it
    speed_rpm : constant
    """
    wraps, opening = machine.table(ScrollWraps), machine.table(ScrollOpening)
    passage = opening.gap_length_m, opening.discharge_coefficient_ratio
    state = _suction_state(machine, state_in)
    return shared(
        ("suction", wraps, passage, state, speed_rpm),
        lambda: suction_flow(wraps, *passage, state, speed_rpm),
    )


def _suction_state(
    machine: Machine, state_in: type[SuctionAnnulus] | type[SuctionPockets]
) -> tuple[float, float, float]:
    """Pressure, density and speed of sound."""
    pressure, gas = machine.table(ScrollGas).suction_pressure_pa, machine.table(state_in)
    return pressure, gas.density_kg_per_m3(pressure), gas.sound_speed_m_per_s


def _of_frame(machine: Machine) -> tuple[float, bool]:
    """Height of the wraps, and whether the flanks take the radial force."""
    if not machine.has_table(Frame):
        return 0.0, False
    frame = machine.table(Frame)
    return frame.wraps_height_m, frame.radially_compliant


def gas_cycle(machine: Machine, shared: Shared, speed_rpm: float) -> ScrollGasCycle:
    """One revolution of the machine's gas, over uniform crank angles.

    Parameters
    ----------
    machine : with wraps and gas
    shared : with what else needs the cycle
    speed_rpm : constant; only a flow with inertia depends on it
    """
    wraps, gas = machine.table(ScrollWraps), machine.table(ScrollGas)
    tables = (machine.table(table) for table in gas_tables(machine).values())
    with_inertia = (*tables, speed_rpm) if gas.opens_with_inertia else ()
    samples = steps_of_turn(speed_rpm) if gas.opens_with_inertia else GAS_SAMPLES
    angle = uniform_crank_angle(samples)
    return shared(
        ("gas cycle", wraps, gas, *with_inertia),
        lambda: scroll_gas_cycle(wraps, gas, angle, opened_gas(machine, shared, speed_rpm)),
    )


def gas_on_parts(machine: Machine, speed_rpm: float, angle: Array) -> dict[Port, Array]:
    """Gas forces of steady running at any crank angles by part, (component, times), N and N m.

    Parameters
    ----------
    machine : with wraps and gas
    speed_rpm : speed of the steady running
    angle : shape (times,), rad
    """
    cycle = gas_cycle(machine, Shared(), speed_rpm)
    samples = cycle.crank_angle.size
    sample, part = np.divmod(np.mod(angle, 2.0 * np.pi) * samples / (2.0 * np.pi), 1.0)
    before = sample.astype(int) % samples
    after = (before + 1) % samples
    return {
        port: (1.0 - part) * load[:, before] + part * load[:, after]
        for port, load in gas_loads(cycle, *_of_frame(machine)).items()
    }


def opened_gas(machine: Machine, shared: Shared, speed_rpm: float) -> OpenedGas | None:
    """Gas of pockets that open with inertia; none where they open by an angle."""
    gas = machine.table(ScrollGas)
    if not gas.opens_with_inertia:
        return None
    wraps, opening = machine.table(ScrollWraps), machine.table(ScrollOpening)
    leakage = machine.table(ScrollLeakage) if machine.has_table(ScrollLeakage) else None
    filling = None
    if machine.has_table(SuctionPockets):
        filling = suction_gas(machine, SuctionPockets, shared, speed_rpm)
    return steady_opening(wraps, gas, opening, speed_rpm, leakage=leakage, filling=filling)


def gas_tables(machine: Machine) -> Mapping[str, type[Parameters]]:
    """Tables of a machine that its gas reads; more of them where it has inertia."""
    tables: dict[str, type[Parameters]] = {"wraps": ScrollWraps, "gas": ScrollGas}
    if machine.has_table(ScrollGas) and machine.table(ScrollGas).opens_with_inertia:
        tables["opening"] = ScrollOpening
        tables |= {name: table for name, table in _WITH_INERTIA.items() if machine.has_table(table)}
    return tables


def _why_no_opening(machine: Machine) -> str | None:
    """Say why the machine's pockets cannot open with inertia; none where they can, or do not."""
    gas = machine.table(ScrollGas)
    if not gas.opens_with_inertia:
        return None
    return why_no_opening(machine.table(ScrollWraps), gas, machine.table(ScrollOpening))
