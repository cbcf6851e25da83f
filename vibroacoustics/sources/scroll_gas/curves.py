"""Curves of the gas in a scroll: pressure of a pocket, forces and their direction, torque."""

from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...base.curves import CRANK_ANGLES, Curve, CurveAxis, angle_axis
from ...base.units import shaft_frequency_hz
from ...machine.cavities import DischargeMuffler
from ...mechanics.rotation import uniform_crank_angle
from ...orders import order_spectrum
from ...transfer.four_poles import pipe, pressure_ratio, transmission_loss_db
from .cycle import ScrollGasCycle, scroll_gas_cycle
from .parameters import ScrollGas, ScrollWraps, pocket_volume
from .suction import OpenedGas, SuctionFlow, TrappedGas, pocket_pressure

AFTER_OPENING: Final = np.pi / 3.0
"""Angle to which the pressure of a pocket is shown beyond its opening, rad."""
AFTER_CLOSING: Final = np.pi / 18.0
"""Angle from which a suction pocket is shown, rad: before, the gap's length exceeds its own."""
HIGHEST_HZ: Final = 4000.0
"""Highest frequency of plane waves in the chamber, roughly, and of what the radiation takes."""


def scroll_gas_curves(
    wraps: ScrollWraps,
    gas: ScrollGas,
    opened: OpenedGas | None = None,
    filling: SuctionFlow | None = None,
) -> Iterator[Curve]:
    """Pressure and volume of one pocket; forces on the fixed scroll, their direction, torques.

    Parameters
    ----------
    wraps : geometry, m and rad
    gas : pressures in Pa and polytropic index
    opened : gas after the opening, where it has inertia
    filling : filling of the suction pockets, where it has inertia
    """
    yield from _of_a_pocket(wraps, gas, opened)
    if opened is not None:
        yield from _of_the_opening(opened)
        if opened.trapped is not None:
            yield _of_the_leak(opened.trapped)
    if filling is not None:
        yield from _of_the_filling(filling)
    cycle = scroll_gas_cycle(wraps, gas, uniform_crank_angle(CRANK_ANGLES), opened)
    angle = angle_axis(cycle.crank_angle)
    yield from _forces(cycle, angle)
    yield Curve(
        "gas_moment", "Gas torque on the shaft, gas moment on the Oldham ring",
        np.array([cycle.torque_n_m, cycle.self_rotation_moment_n_m]),
        (CurveAxis("moment_on", ["shaft, F_t r", "ring, F_t r/2"]), angle), "n_m",
        "thesis, section 6.1 corrected",
    )  # fmt: skip


def _of_a_pocket(wraps: ScrollWraps, gas: ScrollGas, opened: OpenedGas | None) -> Iterator[Curve]:
    """Figure 18."""
    shown = max(AFTER_OPENING, 1.5 * gas.equalisation_angle_rad) if opened is None else np.pi
    end = wraps.opening_angle_rad + shown
    since = np.linspace(0.0, end, CRANK_ANGLES + 1, dtype=np.float64)
    yield Curve(
        "pocket_pressure", "Pressure of one pocket from its closing to its discharge",
        pocket_pressure(wraps, gas, since, opened), (_since_closing(since),), "bar",
        "thesis, section 6.1 and figure 18",
    )  # fmt: skip
    trapped = np.linspace(0.0, wraps.opening_angle_rad, CRANK_ANGLES + 1, dtype=np.float64)
    axis = _since_closing(trapped)._replace(name="trapped_angle")
    yield Curve(
        "pocket_volume", "Volume of one pocket from its closing to its opening",
        pocket_volume(wraps, trapped), (axis,), "cm3", "thesis, (4.1), (4.2) and figure 7",
    )  # fmt: skip


def _of_the_opening(opened: OpenedGas) -> Iterator[Curve]:
    """Pressures and flows while a pair of pockets empties into the chamber."""
    angle = np.linspace(0.0, 2.0 * np.pi, CRANK_ANGLES + 1, dtype=np.float64)
    axis = angle_axis(angle, "opening_angle", "Crank angle since a pocket has opened")
    pressures = {
        "opened pocket": opened.pair_pa,
        "chamber inside": opened.chamber_pa,
        "plenum": opened.plenum_pa,
    }
    flows = {
        "gap, pockets to chamber": opened.gap_flow_kg_per_s,
        "port, chamber to plenum": opened.port_flow_kg_per_s,
    }
    yield Curve(
        "opening_pressure", "Pressure in opened pocket, chamber and plenum",
        _at(opened, angle, pressures), (CurveAxis("volume", list(pressures)), axis), "bar",
        "derived: unsteady flow through gap and port",
    )  # fmt: skip
    yield Curve(
        "opening_flow", "Mass flow out of a pair of opened pockets and through the port",
        _at(opened, angle, flows), (CurveAxis("passage", list(flows)), axis), "kg_per_s",
        "derived: unsteady flow through gap and port",
    )  # fmt: skip


def _of_the_leak(trapped: TrappedGas) -> Curve:
    """Flow back across the outer contacts of a pair of pockets while these last."""
    angle = np.linspace(0.0, trapped.contact_angle[-1], CRANK_ANGLES + 1, dtype=np.float64)
    axis = angle_axis(angle, "contact_angle", "Crank angle since the pocket has closed")
    flow = np.interp(angle, trapped.contact_angle, trapped.leak_kg_per_s)
    return Curve(
        "leak_flow", "Mass flow back across the outer contacts of a pair of pockets", flow, (axis,),
        "kg_per_s", "derived: nozzle through the gaps at tips and flanks",
    )  # fmt: skip


def _of_the_filling(filling: SuctionFlow) -> Iterator[Curve]:
    """Pressure and flow of a pair of suction pockets."""
    angle = np.linspace(AFTER_CLOSING, 2.0 * np.pi, CRANK_ANGLES + 1, dtype=np.float64)
    axis = angle_axis(angle, "filling_angle", "Crank angle since the pocket before has closed")
    for name, label, history, unit in (
        ("suction_pressure", "Pressure in a suction pocket", filling.pocket_pa, "bar"),
        ("suction_flow", "Mass flow into a pair of suction pockets", filling.flow_kg_per_s,
         "kg_per_s"),
    ):  # fmt: skip
        at_angle = np.interp(angle, filling.since_closing, history)
        yield Curve(name, label, at_angle, (axis,), unit, "derived: unsteady flow through the gap")


def _at(opened: OpenedGas, angle: Array, histories: Mapping[str, Array]) -> Array:
    return np.array(
        [np.interp(angle, opened.since_opening, history) for history in histories.values()]
    )


def _since_closing(angle: Array) -> CurveAxis:
    return angle_axis(angle, "pocket_angle", "Crank angle since the pocket has closed")


def _forces(cycle: ScrollGasCycle, angle: CurveAxis) -> Iterator[Curve]:
    """Figures 19 and 20."""
    tangential, radial = cycle.tangential_force_n, cycle.radial_force_n
    parts = {
        "resultant in the plane": np.hypot(tangential, radial),
        "tangential F_t": tangential,
        "radial F_r": radial,
        "axial F_z": cycle.axial_force_n,
    }
    yield Curve(
        "gas_force", "Gas force on one scroll", np.array(list(parts.values())),
        (CurveAxis("part", list(parts)), angle), "n",
        "thesis, figure 19, appendix A corrected",
    )  # fmt: skip
    x, y, _ = cycle.on_orbiting_scroll_n
    directions = {
        "continuous": np.unwrap(np.arctan2(y, x)),
        "within ±90°, as drawn there": np.arctan(y / x),
    }
    yield Curve(
        "gas_force_angle", "Direction of the gas force on the orbiting scroll from x",
        np.array(list(directions.values())), (CurveAxis("reading", list(directions)), angle), "deg",
        "thesis, figure 20",
    )  # fmt: skip


def discharge_line_curves(
    muffler: DischargeMuffler,
    opened: OpenedGas,
    state: tuple[float, float],
    tube_diameter_m: float,
    speed_rpm: float,
) -> Iterator[Curve]:
    """Pressure in the tube over a turn, and transmission loss of the chamber.

    The plenum gives the pressure at the tube's beginning, whatever the tube does: at these
    frequencies it is much the softer of the two.

    Parameters
    ----------
    muffler : chamber, and tube up to it
    opened : gas after the opening, with the plenum's pressure
    state : density and speed of sound at discharge, kg/m³ and m/s
    tube_diameter_m : before and behind the chamber
    speed_rpm : constant
    """
    density, sound_speed = state
    tube = 0.25 * np.pi * tube_diameter_m**2
    impedance, chamber = density * sound_speed / tube, 0.25 * np.pi * muffler.diameter_m**2

    shaft = shaft_frequency_hz(speed_rpm)
    orders = np.arange(int(HIGHEST_HZ / shaft) + 1)
    lines = np.asarray(orders * shaft)
    before = pipe(muffler.distance_m, tube, *state, lines)
    through = np.matmul(before, pipe(muffler.length_m, chamber, *state, lines))
    angle = np.linspace(0.0, 2.0 * np.pi, CRANK_ANGLES + 1, dtype=np.float64)
    at_shell = np.interp(angle[:-1], opened.since_opening, opened.plenum_pa)
    spectrum = order_spectrum(at_shell, int(orders[-1]))
    spectrum[0] = 0.0
    behind = spectrum * pressure_ratio(through, impedance)
    histories = {"at the shell": spectrum, "behind the muffler": behind}
    yield Curve(
        "tube_pressure", "Pulsation in the discharge tube",
        np.array([_over_angle(history, angle) for history in histories.values()]),
        (CurveAxis("tube_at", list(histories)),
         angle_axis(angle, "opening_angle", "Crank angle since a pocket has opened")),
        "bar", "derived: plane waves in tube and chamber",
    )  # fmt: skip
    frequency = np.linspace(0.0, HIGHEST_HZ, 801, dtype=np.float64)
    poles = pipe(muffler.length_m, chamber, *state, frequency)
    yield Curve(
        "muffler_loss", "Transmission loss of the muffler's chamber",
        transmission_loss_db(poles, impedance),
        (CurveAxis("tube_frequency", frequency, "hz", "Frequency"),), "db",
        "Munjal, Acoustics of Ducts and Mufflers, 1987",
    )  # fmt: skip


def _over_angle(spectrum: ComplexArray, angle: Array) -> Array:
    """Complex peaks by order."""
    turning = np.exp(1j * np.outer(np.arange(spectrum.size), angle))
    return np.asarray((spectrum @ turning).real)
