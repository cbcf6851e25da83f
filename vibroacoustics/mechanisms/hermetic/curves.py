"""Curves of the hermetic compressor (Estupiñan & Santos 2009, figures 5 to 13)."""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array
from ...base.curves import ORBIT_AXES, Curve, CurveAxis, angle_axis
from ...base.units import shaft_frequency_hz
from ...mechanics.beam_rotor import with_disc
from ...mechanics.whirl_curves import campbell_curve
from .cycle import (
    BearingCycle,
    bearing_cycles,
    cycle_at_speed,
    motion_of,
    support_reaction,
    uniform_samples,
)
from .gas import gas_force_n, piston_area_m2
from .journal_bearing import damped_modes, linear_film
from .parameters import Case, HermeticTables
from .shaft import ShaftEquations, crankshaft, rotor_matrices

SOURCE: Final = "Estupiñan & Santos 2009, "
STEPS: Final = 180
"""Crank angles a revolution: case III takes seconds."""
AXES: Final = CurveAxis("axis", list(ORBIT_AXES))
MODES: Final = 8


class Solved(NamedTuple):
    """A case of the machine over uniform crank angles.

    Attributes
    ----------
    words : description of the curve
    equations : equations of its shaft
    angle, states : rad, shape (STEPS,), and shape (STEPS, 2n + 1)
    """

    words: str
    equations: ShaftEquations
    angle: Array
    states: Array

    @property
    def bearings(self) -> tuple[BearingCycle, ...]:
        """Upper bearing, and the lower one where it has it."""
        return bearing_cycles(self.equations, self.states)


def hermetic_curves(machine: HermeticTables, speed_rpm: float) -> Iterator[Curve]:
    """Gas and motor, joint forces, films of both bearings in all three cases, Campbell map.

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa; whatever its case, all are shown
    speed_rpm : mean over time
    """
    held = _solved(machine, "I", speed_rpm)
    yield from _given(machine, held, speed_rpm)
    yield from _held_crank(held)
    flat = machine.model_copy(
        update={"crank": machine.crank.model_copy(update={"pin_offset_m": 0.0})}
    )
    rigid, bending = (_solved(machine, case, speed_rpm) for case in ("II", "III"))
    straight = _solved(flat, "III", speed_rpm, ", pin of no length")
    yield from _bearing_forces(held, rigid, bending)
    yield from _films((rigid, bending, straight))
    yield from _lower_film(bending)
    yield _campbell(machine, bending, speed_rpm)


def _solved(machine: HermeticTables, case: Case, speed_rpm: float, more: str = "") -> Solved:
    machine_of_case = machine.model_copy(update={"case": case})
    equations, solution = cycle_at_speed(machine_of_case, speed_rpm, STEPS)
    return Solved(f"case {case}{more}", equations, *uniform_samples(solution, STEPS))


def _given(machine: HermeticTables, held: Solved, speed_rpm: float) -> Iterator[Curve]:
    """Figure 5."""
    force = gas_force_n(machine, held.angle)
    pressure = machine.gas.suction_pressure_pa + force / piston_area_m2(machine)
    yield Curve(
        "cylinder_pressure", "Pressure in the cylinder, ideal valves", pressure,
        (angle_axis(held.angle),), "bar", f"{SOURCE}figure 5 (a), values assumed",
    )  # fmt: skip
    supply = held.equations.machine.motor.synchronous_speed_rad_per_s
    lowest = 0.95 * 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
    speed = np.linspace(min(lowest, 0.95 * supply), supply, 41, dtype=np.float64)
    yield Curve(
        "motor_torque", "Torque of the motor over its speed", held.equations.motor_torque(speed),
        (CurveAxis("motor_speed", speed, "rad_per_s", "Speed"),), "n_m",
        f"{SOURCE}figure 5 (b), running part, values assumed",
    )  # fmt: skip


def _held_crank(held: Solved) -> Iterator[Curve]:
    """Figures 6 and 7, case I."""
    joints = motion_of(held.equations, held.angle, held.states).joints
    forces = np.array([joints.piston_on_rod[:, :2].T, -joints.rod_on_crank[:, :2].T])
    angle = angle_axis(held.angle)
    yield Curve(
        "joint_force", "Forces on the connecting rod, case I", forces,
        (CurveAxis("joint", ["piston pin, f_B", "crank pin, f_A"]), AXES, angle), "n",
        f"{SOURCE}figure 6",
    )  # fmt: skip
    reaction = support_reaction(held.equations, held.angle, held.states)
    yield Curve(
        "crank_reaction_moment", "Reaction moments that hold the crank upright, case I",
        reaction[:, 2:].T, (CurveAxis("about", list(ORBIT_AXES)), angle), "n_m",
        f"{SOURCE}figure 7",
    )  # fmt: skip


def _bearing_forces(held: Solved, rigid: Solved, bending: Solved) -> Iterator[Curve]:
    """Figures 8 and 11, beside the reaction of case I."""
    angle = angle_axis(held.angle)
    reaction = support_reaction(held.equations, held.angle, held.states)[:, :2].T
    upper = [reaction, *(solved.bearings[0].force_n.T for solved in (rigid, bending))]
    names = ["case I, reaction", rigid.words, bending.words]
    yield Curve(
        "upper_bearing_force", "Forces on the journal in the upper bearing", np.array(upper),
        (CurveAxis("bearing_case", names), AXES, angle), "n", f"{SOURCE}figures 8 and 11 (a)",
    )  # fmt: skip
    yield Curve(
        "lower_bearing_force", "Forces on the journal in the lower bearing, case III",
        bending.bearings[1].force_n.T, (AXES, angle), "n", f"{SOURCE}figure 11 (b)",
    )  # fmt: skip


def _films(cases: tuple[Solved, ...]) -> Iterator[Curve]:
    """Figures 9, 10, 12 and 13: the upper bearing."""
    angle = angle_axis(cases[0].angle)
    axis = CurveAxis("film_case", [solved.words for solved in cases])
    uppers = [solved.bearings[0] for solved in cases]
    clearance = cases[0].equations.machine.bearing.clearance_m
    yield Curve(
        "journal_orbit", "Orbit of the journal in the upper bearing, over its clearance",
        np.array([upper.orbit_m.T / clearance for upper in uppers]), (axis, AXES, angle), "ratio",
        f"{SOURCE}figures 9 and 13 (a)", picture="orbit",
    )  # fmt: skip
    yield Curve(
        "thinnest_film", "Thinnest film of the upper bearing",
        np.array([upper.thinnest_film_m for upper in uppers]), (axis, angle), "um",
        f"{SOURCE}figures 12 (a) and 13 (b)",
    )  # fmt: skip
    yield Curve(
        "highest_film_pressure", "Highest pressure in the film of the upper bearing",
        np.array([upper.highest_pressure_pa for upper in uppers]), (axis, angle), "mpa",
        f"{SOURCE}figures 10 and 12 (b)",
    )  # fmt: skip


def _lower_film(bending: Solved) -> Iterator[Curve]:
    lower, angle = bending.bearings[1], angle_axis(bending.angle)
    clearance = bending.equations.machine.bearing.clearance_m
    yield Curve(
        "lower_journal_orbit",
        "Orbit of the journal in the lower bearing, over its clearance, case III",
        lower.orbit_m.T / clearance, (AXES, angle), "ratio", "as figure 9 of Estupiñan & Santos",
        picture="orbit",
    )  # fmt: skip
    yield Curve(
        "lower_thinnest_film", "Thinnest film of the lower bearing, case III",
        lower.thinnest_film_m, (angle,), "um", "as figure 12 of Estupiñan & Santos",
    )  # fmt: skip


def _campbell(machine: HermeticTables, bending: Solved, speed_rpm: float) -> Curve:
    """Frequencies on films linearised about the cycle's mean loads."""
    rotor = with_disc(rotor_matrices(machine), 0, machine.crank.mass_kg, 0.0, 0.0)
    loads = [float(np.linalg.norm(bearing.force_n, axis=-1).mean()) for bearing in bending.bearings]
    journals = crankshaft(bending.equations.machine).bearing_dofs

    def frequencies(spin: float) -> Array:
        films = {
            dof: linear_film(machine.bearing, load, spin)
            for dof, load in zip(journals, loads, strict=True)
        }
        return damped_modes(rotor, films, spin)[0]

    source = f"{SOURCE}case III, films linearised about their mean loads"
    return campbell_curve(frequencies, 2.0 * speed_rpm, MODES, source, 0.1 * speed_rpm)
