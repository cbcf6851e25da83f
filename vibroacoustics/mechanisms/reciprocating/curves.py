"""Curves of the large reciprocating compressor (Tsuji et al. 2012, figures 3 to 6)."""

from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.curves import CRANK_ANGLES, Curve, CurveAxis, angle_axis
from ...base.errors import ParameterError
from ...mechanics.rotation import uniform_crank_angle
from .cycle import Cycle, efficiency_map, optimum_bore, steady_cycle
from .parameters import ReciprocatingTables
from .slider_crank import design_at_bore, rates_of_momentum

BORE_RATIOS: Final = np.arange(10.0, 18.5) / 13.0
"""Bores over the machine's: 100 to 180 mm of 130 mm, as in the paper."""
LINES: Final = (0, 3, 6, 8)
"""Numbers of the bores whose curves over the crank angle are shown, the machine's among them."""
SPEED_RATIOS: Final = np.array([0.8, 1.0, 1.2])
"""Speeds over the one asked for: 800, 1000 and 1200 rpm in the paper."""
PAIRS: Final = {
    "piston_pin": "piston pin, M_T",
    "crank_pin": "crank pin, M_S",
    "journal": "journal, M_Q",
}
LOSSES: Final = {"cylinder_wall": "cylinder wall", **{k: v[:-5] for k, v in PAIRS.items()}}


def reciprocating_curves(machine: ReciprocatingTables, speed_rpm: float) -> Iterator[Curve]:
    """Motion, torques and friction over the crank angle, losses and efficiency over the bore.

    All designs have the machine's displacement and length ratio, as in (6) of the paper.

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    """
    bores = machine.piston_and_rod.bore_m * BORE_RATIOS
    cycles = [steady_cycle(machine, float(bore), speed_rpm, CRANK_ANGLES) for bore in bores]
    bore = CurveAxis("bore", bores, "mm", "Bore")
    shown = [cycles[index] for index in LINES]
    designs = CurveAxis("design", bores[list(LINES)], "mm", "Bore")
    yield from _over_crank_angle(shown, designs)
    yield from _friction(shown, designs)
    yield from _over_bore(cycles, bore)
    yield _efficiency(machine, speed_rpm, bore)
    yield from _best(machine, speed_rpm)


def _over_crank_angle(cycles: list[Cycle], designs: CurveAxis) -> Iterator[Curve]:
    """Figure 3 (a), (b) and (d) to (f)."""
    axes = (designs, angle_axis(uniform_crank_angle(CRANK_ANGLES)))

    def curve(name: str, title: str, unit: str, panel: str, values: list[Array]) -> Curve:
        source = f"Tsuji et al. 2012, figure 3 ({panel})"
        return Curve(name, title, np.array(values), axes, unit, source)

    yield curve(
        "crank_acceleration", "Acceleration of the crankshaft", "rad_per_s2", "a",
        [cycle.rotation.acceleration_rad_per_s2 for cycle in cycles],
    )  # fmt: skip
    yield curve(
        "crank_speed", "Speed of the crankshaft", "rad_per_s", "b",
        [cycle.rotation.speed_rad_per_s for cycle in cycles],
    )  # fmt: skip
    yield curve(
        "gas_torque", "Torque of the gas against the crankshaft", "n_m", "d",
        [cycle.load_torque_n_m["gas"] for cycle in cycles],
    )  # fmt: skip
    yield curve(
        "piston_inertia_torque", "Inertia torque of the piston", "n_m", "e",
        [_inertia_torques_n_m(cycle)[0] for cycle in cycles],
    )  # fmt: skip
    yield curve(
        "rod_inertia_torque", "Inertia torque of the connecting rod", "n_m", "f",
        [_inertia_torques_n_m(cycle)[1] for cycle in cycles],
    )  # fmt: skip


def _inertia_torques_n_m(cycle: Cycle) -> tuple[Array, Array]:
    """Torque at the crankshaft that piston and connecting rod take up."""
    kinematics = cycle.kinematics
    piston, rod_x, rod_y, turn = rates_of_momentum(cycle.crank, kinematics, cycle.rotation)
    rod = (
        rod_x * kinematics.rod_x_m[1]
        + rod_y * kinematics.rod_y_m[1]
        + turn * kinematics.rod_angle[1]
    )
    return piston * kinematics.piston_m[1], rod


def _friction(cycles: list[Cycle], designs: CurveAxis) -> Iterator[Curve]:
    """Figure 4."""
    angle = angle_axis(uniform_crank_angle(CRANK_ANGLES))
    torques = [
        [cycle.friction.piston_pin_n_m for cycle in cycles],
        [cycle.friction.crank_pin_n_m for cycle in cycles],
        [cycle.friction.journal_n_m for cycle in cycles],
    ]
    yield Curve(
        "friction_torque", "Friction torques of the bearings", np.array(torques),
        (CurveAxis("bearing", list(PAIRS.values())), designs, angle), "n_m",
        "Tsuji et al. 2012, figure 4 (a) to (c)",
    )  # fmt: skip
    yield Curve(
        "wall_friction_force", "Friction force of the cylinder wall on the piston",
        np.array([cycle.friction.wall_n for cycle in cycles]), (designs, angle), "n",
        "Tsuji et al. 2012, figure 4 (d)",
    )  # fmt: skip


def _over_bore(cycles: list[Cycle], bore: CurveAxis) -> Iterator[Curve]:
    """Figures 3 (c), 5 (a) and 5 (b)."""
    fluctuation = np.array([cycle.rotation.fluctuation_ratio for cycle in cycles])
    yield Curve(
        "speed_fluctuation", "Largest less least speed over the mean", fluctuation, (bore,),
        "percent", "Tsuji et al. 2012, figure 3 (c)",
    )  # fmt: skip
    losses = np.transpose([_power_w(cycle, cycle.load_work_j) for cycle in cycles])
    names = CurveAxis("loss", [*LOSSES.values(), "all friction"])
    yield Curve(
        "friction_loss", "Power lost to friction", losses, (names, bore), "w",
        "Tsuji et al. 2012, figure 5 (a)",
    )  # fmt: skip
    powers = np.transpose(
        [
            np.array([cycle.supplied_work_j, cycle.load_work_j["gas"]]) / cycle.rotation.duration_s
            for cycle in cycles
        ]
    )
    yield Curve(
        "power", "Power of motor and gas", powers,
        (CurveAxis("power_of", ["motor", "gas"]), bore), "kw",
        "Tsuji et al. 2012, figure 5 (b)",
    )  # fmt: skip


def _power_w(cycle: Cycle, work_j: Mapping[str, float]) -> Array:
    """Power lost in each pair, and in all."""
    lost = np.array([work_j[name] for name in LOSSES])
    return np.append(lost, lost.sum()) / cycle.rotation.duration_s


def _efficiency(machine: ReciprocatingTables, speed_rpm: float, bore: CurveAxis) -> Curve:
    """Figure 5 (c)."""
    speeds = speed_rpm * SPEED_RATIOS
    return Curve(
        "mechanical_efficiency",
        "Mechanical efficiency at constant displacement",
        efficiency_map(machine, speeds, np.asarray(bore.values), CRANK_ANGLES),
        (CurveAxis("design_speed", speeds, "rpm", "Speed"), bore),
        "percent",
        "Tsuji et al. 2012, figure 5 (c)",
    )


def _best(machine: ReciprocatingTables, speed_rpm: float) -> Iterator[Curve]:
    """Figure 6, and the efficiency that belongs to it; nothing where no bore is the best."""
    reference = machine.piston_and_rod
    lowest, highest = reference.bore_m * BORE_RATIOS[[0, -1]]
    speeds = speed_rpm * SPEED_RATIOS
    try:
        best = [
            optimum_bore(machine, float(speed), lowest, highest, CRANK_ANGLES) for speed in speeds
        ]
    except ParameterError:  # the best lies beyond the bores that are shown
        return
    bores, efficiencies = np.transpose(best)
    strokes = [2.0 * design_at_bore(reference, float(bore)).crank_radius_m for bore in bores]
    axis = CurveAxis("design_speed", speeds, "rpm", "Speed")
    yield Curve(
        "best_design", "Bore and stroke of the best efficiency", np.array([bores, strokes]),
        (CurveAxis("length", ["bore", "stroke"]), axis), "mm", "Tsuji et al. 2012, figure 6",
    )  # fmt: skip
    yield Curve(
        "best_efficiency", "Best mechanical efficiency", efficiencies, (axis,), "percent",
        "Tsuji et al. 2012, figure 5 (c)",
    )  # fmt: skip
