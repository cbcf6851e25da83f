"""Slider-link mechanism: unbalanced forces and moments on the block, and its free vibration."""

import numpy as np

from ...base.arrays import Array
from ...mechanics.moving_parts import Wrench
from .parameters import SliderLinkTables
from .piston import CrankState


def unbalance(machine: SliderLinkTables, state: CrankState) -> dict[str, Wrench]:
    """Unbalanced forces and moments about the origin O (25), (26), (36) to (40), paper's frame.

    By source: -Σ m a and -Σ r x m a of piston, slider and crankshaft. The slider's moment about
    the shaft has R², which (39) and (40) print as R. `Wrench.placed` takes them to the block's
    centre of mass (41).

    Parameters
    ----------
    machine : masses in kg, lengths in m
    state : motion of the crank
    """
    masses, mechanism = machine.masses, machine.mechanism
    radius, height = mechanism.crank_radius_m, machine.heights.piston_axis_m
    turning, zero = np.stack([state.along, state.across]), np.zeros_like(state.angle)
    piston = masses.piston_mass_kg * radius * state.along
    slider = masses.slider_mass_kg * radius * turning
    shaft = -masses.crankshaft_mass_kg * masses.crankshaft_mass_offset_m * turning
    couple = masses.crankshaft_product_kg_m2 * turning
    arm = mechanism.link_offset_m - mechanism.piston_mass_offset_m
    slider_spin = -masses.slider_mass_kg * radius**2 * state.acceleration
    shaft_spin = -masses.crankshaft_inertia_kg_m2 * state.acceleration
    return {
        "piston": _wrench((piston, zero, zero), (zero, -height * piston, arm * piston)),
        "slider": _wrench((*slider, zero), (height * slider[1], -height * slider[0], slider_spin)),
        "crankshaft": _wrench((*shaft, zero), (-couple[1], couple[0], shaft_spin)),
    }


def _wrench(force: tuple[Array, ...], moment: tuple[Array, ...]) -> Wrench:
    return Wrench(np.stack(force), np.stack(moment))
