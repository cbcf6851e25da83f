"""Curves of the slider-link compressor: forces and friction over the crank angle (Dagilis et al.).

The paper prints equations and no curve; what is shown are the quantities of its equations.
"""

from collections.abc import Callable, Iterator
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.curves import CRANK_ANGLES, Curve, CurveAxis, angle_axis
from ...base.units import shaft_frequency_hz
from .bearing_friction import (
    journal_friction_coefficient,
    loaded_coefficient,
    petroff_coefficient,
)
from .motion import SliderLinkCycle, steady_motion
from .parameters import JournalBearing, SliderLinkTables
from .piston import cylinder_pressure, piston_velocity, slider_velocity

SOURCE: Final = "Dagilis et al. 2006, "
JOURNALS: Final = {"crank_pin": "crank pin", "upper": "upper bearing", "lower": "lower bearing"}
RESISTING: Final = {**JOURNALS, "thrust": "thrust bearing", "oil_pump": "oil pump"}
LAWS: Final[dict[str, Callable[[JournalBearing, Array, Array, float], Array]]] = {
    "unloaded, (19)": petroff_coefficient,
    "without eccentricity, (20)": loaded_coefficient,
    "short bearing, (21)": journal_friction_coefficient,
}


def slider_link_curves(machine: SliderLinkTables, speed_rpm: float) -> Iterator[Curve]:
    """Pressure, forces on piston and bearings, friction as force, moment, coefficient and power.

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    """
    cycle = steady_motion(machine, 2.0 * np.pi * shaft_frequency_hz(speed_rpm), CRANK_ANGLES)
    angle = angle_axis(cycle.state.angle)
    pressure = cylinder_pressure(machine.gas, cycle.state.angle)
    yield Curve(
        "cylinder_pressure", "Pressure in the cylinder, ideal valves", pressure, (angle,), "bar",
        f"{SOURCE}equation (1)",
    )  # fmt: skip
    yield Curve(
        "crank_speed", "Speed of the crankshaft", cycle.state.velocity, (angle,), "rad_per_s",
        f"{SOURCE}equation (35)",
    )  # fmt: skip
    yield from _loads(cycle, angle)
    yield from _friction(machine, cycle, angle)


def _loads(cycle: SliderLinkCycle, angle: CurveAxis) -> Iterator[Curve]:
    forces, contacts = cycle.forces, cycle.forces.contacts
    yield Curve(
        "piston_contact_force", "Contact forces on piston and link",
        np.array([contacts.front, contacts.rear, contacts.link]),
        (CurveAxis("contact", ["piston end", "cylinder end", "slider on link"]), angle), "n",
        f"{SOURCE}equations (8) to (15)",
    )  # fmt: skip
    loads = (forces.crank_pin, forces.upper_bearing, forces.lower_bearing)
    yield Curve(
        "bearing_load", "Loads of the journal bearings",
        np.array([np.hypot(*load) for load in loads]),
        (CurveAxis("journal", list(JOURNALS.values())), angle), "n",
        f"{SOURCE}equations (17) and (27) to (30), table 2",
    )  # fmt: skip


def _friction(
    machine: SliderLinkTables, cycle: SliderLinkCycle, angle: CurveAxis
) -> Iterator[Curve]:
    moments = np.array([cycle.forces.friction_moments[name] for name in RESISTING])
    yield Curve(
        "friction_moment", "Friction moments on the crankshaft", moments,
        (CurveAxis("resistance", list(RESISTING.values())), angle), "n_m",
        f"{SOURCE}equations (21) to (24)",
    )  # fmt: skip
    sliding = _sliding_friction_n(machine, cycle)
    yield Curve(
        "friction_force", "Friction forces of piston and link", np.array(list(sliding.values())),
        (CurveAxis("sliding_pair", list(sliding)), angle), "n",
        f"{SOURCE}equations (4) and (7)",
    )  # fmt: skip
    yield Curve(
        "friction_coefficient", "Friction coefficients of the journal bearings",
        _coefficients(machine, cycle),
        (
            CurveAxis("journal", list(JOURNALS.values())),
            CurveAxis("friction_law", list(LAWS)),
            angle,
        ),
        "ratio", f"{SOURCE}equations (19) to (22), (20) corrected",
    )  # fmt: skip
    powers = {
        "piston": _piston_power_w(machine, cycle, sliding),
        "slider in the link": np.abs(sliding["slider in the link"] * _slider(machine, cycle)),
        **dict(zip(RESISTING.values(), moments * cycle.state.velocity, strict=True)),
    }
    yield Curve(
        "friction_power", "Power lost to friction", np.array(list(powers.values())),
        (CurveAxis("lost_in", list(powers)), angle), "w", f"{SOURCE}section 4",
    )  # fmt: skip


def _sliding_friction_n(machine: SliderLinkTables, cycle: SliderLinkCycle) -> dict[str, Array]:
    """Friction forces in their direction: along x on the piston, along y on the link."""
    mechanism, contacts = machine.mechanism, cycle.forces.contacts
    pressed = np.abs(contacts.front) + np.abs(contacts.rear)
    rubbing = contacts.slider_sense * mechanism.link_friction_ratio
    return {
        "oil film of the piston": cycle.forces.film,
        "piston on the cylinder": contacts.piston_sense
        * mechanism.cylinder_friction_ratio
        * pressed,
        "slider in the link": rubbing * np.abs(contacts.link),
    }


def _slider(machine: SliderLinkTables, cycle: SliderLinkCycle) -> Array:
    return slider_velocity(machine.mechanism, cycle.state)


def _piston_power_w(
    machine: SliderLinkTables, cycle: SliderLinkCycle, sliding: dict[str, Array]
) -> Array:
    force = np.abs(sliding["oil film of the piston"]) + np.abs(sliding["piston on the cylinder"])
    return np.asarray(force * np.abs(piston_velocity(machine.mechanism, cycle.state)))


def _coefficients(machine: SliderLinkTables, cycle: SliderLinkCycle) -> Array:
    """Friction coefficient of each journal by each law, shape (journals, laws, samples)."""
    forces = cycle.forces
    loads = (forces.crank_pin, forces.upper_bearing, forces.lower_bearing)
    bearings = [getattr(machine.bearings, name) for name in JOURNALS]
    return np.array(
        [
            [
                law(bearing, np.hypot(*load), cycle.state.velocity, machine.oil.viscosity_pa_s)
                for law in LAWS.values()
            ]
            for bearing, load in zip(bearings, loads, strict=True)
        ]
    )
