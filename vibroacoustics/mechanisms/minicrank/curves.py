"""Curves of the scroll with mini-crank (Zhao et al. 2013, figures 3 to 8)."""

from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.curves import Curve, CurveAxis, angle_axis
from ...base.units import shaft_frequency_hz
from ...mechanics.rotation import uniform_crank_angle
from .cycle import (
    MiniCrankCycle,
    crank_pin_force,
    four_bar_motion,
    input_torque,
    minicrank_pin_force,
    scroll_load,
    steady_minicrank_cycle,
)
from .links import Links, MiniCrankTables, why_open

SOURCE: Final = "Zhao et al. 2013, "
CRANK_ANGLES: Final = 3600
"""Samples: errors of 10 µm make a peak some 1° wide."""
ERRORS_M: Final = (0.0, -10e-6, -50e-6, -100e-6)
"""Errors of the crank, beside which figure 8 shows no numbers."""
TORQUES: Final = {
    "load": "gas and friction",
    "scroll_inertia": "inertia of the scroll",
    "minicrank_inertia": "inertia of the mini-cranks",
    "weight": "weight of the mini-cranks",
}


def minicrank_curves(machine: MiniCrankTables, speed_rpm: float) -> Iterator[Curve]:
    """Load, input torque with and without errors, speed, and forces of rigid pins.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    speed_rpm : mean over time
    """
    cycle = steady_minicrank_cycle(machine, speed_rpm, CRANK_ANGLES)
    angle = angle_axis(cycle.motion.crank_angle)
    speed = 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
    yield from _loads(machine, cycle, speed, angle)
    ideal = _torque_n_m(machine, _ideal(machine), speed)
    yield Curve(
        "ideal_input_torque", "Input torque of a true parallelogram", _sum(ideal), (angle,), "n_m",
        f"{SOURCE}equation (18), figure 6",
    )  # fmt: skip
    lines = {words: cycle.input_torque_n_m[name] for name, words in TORQUES.items()}
    yield Curve(
        "input_torque", "Input torque of the machine at constant speed",
        np.array([*lines.values(), _sum(cycle.input_torque_n_m)]),
        (CurveAxis("torque_of", [*lines, "all"]), angle), "n_m",
        f"{SOURCE}equation (17) corrected, figure 7",
    )  # fmt: skip
    yield from _by_error(machine, speed, angle)
    yield Curve(
        "crank_speed", "Speed of the crankshaft", cycle.rotation.speed_rad_per_s, (angle,),
        "rad_per_s", "derived from the input torque and the inertia of the rotor",
    )  # fmt: skip
    if machine.four_bar.minicranks == 1 and not cycle.links.is_parallelogram:
        yield _pins(cycle, angle)


def _loads(
    machine: MiniCrankTables, cycle: MiniCrankCycle, speed_rad_per_s: float, angle: CurveAxis
) -> Iterator[Curve]:
    """Figures 4 and 5."""
    load, links = cycle.load, cycle.links
    scroll_kg_m = machine.masses.scroll_mass_kg * links.crank_m
    inertia = np.full_like(load.radial_force_n, scroll_kg_m * speed_rad_per_s**2)
    forces = [load.tangential_force_n, load.radial_force_n, inertia]
    yield Curve(
        "external_force", "Forces on the orbiting scroll", np.array(forces),
        (CurveAxis("force", ["tangential gas F_t", "radial gas F_r", "inertia F_c"]), angle), "n",
        f"{SOURCE}figure 4, shape assumed",
    )  # fmt: skip
    moments = [
        load.rotation_moment_n_m,
        load.tangential_force_n * links.crank_m,
        load.friction_moment_n_m,
    ]
    yield Curve(
        "external_moment", "Moments on scroll and crank", np.array(moments),
        (CurveAxis("moment", ["rotation M_z", "resistance M_t", "friction M_sd"]), angle), "n_m",
        f"{SOURCE}equation (14), figure 5, shape assumed",
    )  # fmt: skip


def _by_error(
    machine: MiniCrankTables, speed_rad_per_s: float, angle: CurveAxis
) -> Iterator[Curve]:
    """Figure 8: a single rigid mini-crank, errors of the crank that let it turn."""
    ideal = _ideal(machine)
    longer = {error: _with_error(ideal, error) for error in ERRORS_M}
    closed = {error: links for error, links in longer.items() if why_open(links) is None}
    torques = [_sum(_torque_n_m(machine, links, speed_rad_per_s)) for links in closed.values()]
    if torques:
        yield Curve(
            "input_torque_by_error", "Input torque with one rigid mini-crank", np.array(torques),
            (CurveAxis("crank_error", np.array(list(closed)), "um", "Error of the crank"), angle),
            "n_m", f"{SOURCE}equation (17) corrected, figure 8",
        )  # fmt: skip


def _ideal(machine: MiniCrankTables) -> Links:
    four_bar = machine.four_bar
    return Links(four_bar.crank_m, four_bar.scroll_m, four_bar.crank_m, four_bar.scroll_m)


def _with_error(links: Links, error_m: float) -> Links:
    return Links(links.crank_m + error_m, links.scroll_m, links.minicrank_m, links.bracket_m)


def _torque_n_m(
    machine: MiniCrankTables, links: Links, speed_rad_per_s: float
) -> Mapping[str, Array]:
    """Input torque of the machine's masses and load on rigid links with one mini-crank."""
    crank_angle = uniform_crank_angle(CRANK_ANGLES)
    motion = four_bar_motion(links, crank_angle, machine.four_bar.branch)
    load = scroll_load(machine.loads, links, crank_angle)
    return input_torque(links, motion, machine.masses.of_all(1), load, speed_rad_per_s)


def _sum(torques: Mapping[str, Array]) -> Array:
    return np.asarray(np.sum(list(torques.values()), axis=0))


def _pins(cycle: MiniCrankCycle, angle: CurveAxis) -> Curve:
    """Figure 3: forces that rigid pins take."""
    arguments = (cycle.links, cycle.motion, cycle.masses, cycle.load, cycle.rotation)
    forces = [np.hypot(*crank_pin_force(*arguments)), np.hypot(*minicrank_pin_force(*arguments))]
    return Curve(
        "pin_force", "Forces at rigid pins", np.array(forces),
        (CurveAxis("pin", ["crank pin", "mini-crank pin"]), angle), "n",
        f"{SOURCE}figure 3",
    )  # fmt: skip
