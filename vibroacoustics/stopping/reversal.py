"""Turning back after a stop: trapped gas drives the shaft backwards until the brake jams."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from scipy.integrate import solve_ivp

from ..base.arrays import Array
from ..base.errors import SolverError
from ..machine.stopping import TurningBack
from ..sources.oldham_keys.contact import contact_damping, dry_force
from .equation import Coasting, acceleration

RELATIVE_TOLERANCE: Final = 1e-9
LONGEST_S: Final = 60.0
MOST_TURNS: Final = 2000
"""Changes of direction before rest."""
CREEP_RAD_PER_S: Final = 1e-4
"""A shaft that slows to this in a contact that damps more than it swings stands."""
STUCK_RATIO: Final = 0.01
"""Share of the gas's torque that a standing shaft may lack: what the damping carries as it
creeps."""

CLOSED_RAD: Final = 1e-11
"""A gap as small is rounding of the angle at which the contact closed."""


@dataclass(frozen=True)
class TrappedGas:
    """Gas behind the shut valve.

    Attributes
    ----------
    volume_m3 : that is trapped
    per_turn_m3 : that a turn back gives to it, the pockets at their opening
    pressures_pa : pressures of suction and discharge
    index : index of the expansion
    """

    volume_m3: float
    per_turn_m3: float
    pressures_pa: tuple[float, float]
    index: float

    def share(self, turned_back: Array | float) -> Array:
        """Share of the torque that remains when the shaft has turned back by an angle, rad.

        It follows the difference of pressure with p V^κ constant; none below the suction's.
        """
        suction, discharge = self.pressures_pa
        grown = np.maximum(turned_back, 0.0) * self.per_turn_m3 / (2.0 * np.pi * self.volume_m3)
        pressure = discharge * (1.0 + grown) ** -self.index
        return np.asarray(np.maximum((pressure - suction) / (discharge - suction), 0.0))


@dataclass(frozen=True)
class Jamming:
    """The brake as a dry one-sided contact behind its free angle.

    Attributes
    ----------
    table : brake and wall
    rest_angle : at which the shaft first came to rest, rad
    damping : η of the contact, N s/m^1.25
    """

    table: TurningBack
    rest_angle: float
    damping: float

    def force_n(self, angle: float, speed: float) -> float:
        """Return the force around the shaft, forwards."""
        radius, stiffness = self.table.wall_radius_m, self.table.contact_stiffness_n_per_m1p5
        depth = max(-radius * self.gap(angle), 0.0)
        return float(dry_force(depth, -radius * speed, stiffness, self.damping))

    def gap(self, angle: float) -> float:
        """Angle to go before the contact closes."""
        return angle - self.rest_angle + self.table.free_angle_rad


@dataclass(frozen=True)
class Stretch:
    """Motion in one direction; `state` of times gives angle and speed."""

    start_s: float
    end_s: float
    turning: float
    jamming: Jamming
    state: Callable[[Array], Any]


@dataclass(frozen=True)
class Reversal:
    """All that follows the first rest.

    Attributes
    ----------
    gas : trapped
    stretches : one after another; none where friction holds the shaft
    """

    gas: TrappedGas
    stretches: Sequence[Stretch]

    @property
    def end_s(self) -> float | None:
        """Time at which the shaft stands for good."""
        return self.stretches[-1].end_s if self.stretches else None


def turn_back(
    coasting: Coasting, table: TurningBack, gas: TrappedGas, rest_s: float, rest_angle: float
) -> Reversal:
    """Motion from the first rest to the last.

    Lagrange's equation of the run-down with the trapped gas's torque, friction against the motion
    and the brake's contact. Each stretch ends where the shaft stands or the brake closes.

    Parameters
    ----------
    coasting : equation of motion
    table : brake
    gas : trapped
    rest_s, rest_angle : time and angle of the first rest

    Raises
    ------
    SolverError
        The integration fails or the shaft finds no rest.
    """
    mass = coasting.inertia_kg_m2(rest_s, rest_angle) / table.wall_radius_m**2
    damping = contact_damping(table.restitution_ratio, mass, table.contact_stiffness_n_per_m1p5)
    jamming, time, state = Jamming(table, rest_angle, damping), rest_s, np.array([rest_angle, 0.0])
    stretches: list[Stretch] = []
    while len(stretches) < MOST_TURNS:
        turning = np.sign(state[1]) or _starts(coasting, jamming, gas, time, state[0])
        if turning == 0.0:
            return Reversal(gas, stretches)
        stretch, closed = _stretch(coasting, jamming, gas, (time, state, turning))
        stretches.append(stretch)
        time, state = stretch.end_s, np.array(stretch.state(np.array(stretch.end_s)))
        if not closed:
            state[1] = 0.0
    raise SolverError(f"turning back: the shaft finds no rest within {MOST_TURNS} swings")


def _starts(
    coasting: Coasting, jamming: Jamming, gas: TrappedGas, time: float, angle: float
) -> float:
    """Sense in which a standing shaft starts; 0 where friction holds it."""
    share = float(gas.share(jamming.rest_angle - angle))
    push = jamming.table.wall_radius_m * jamming.force_n(angle, 0.0)
    free, rubbed, empty = (
        acceleration(time, angle, 0.0, coasting.constants, gas_share, turning, push)
        for gas_share, turning in ((share, 0.0), (share, 1.0), (0.0, 0.0))
    )
    held = abs(free - rubbed) + STUCK_RATIO * abs(free - empty)
    return float(np.sign(free)) if abs(free) > held else 0.0


def _stretch(
    coasting: Coasting,
    jamming: Jamming,
    gas: TrappedGas,
    start: tuple[float, Array, float],
) -> tuple[Stretch, bool]:
    """Motion in one direction, and whether the brake closed at its end."""
    begun, state, turning = start
    radius = jamming.table.wall_radius_m
    open_yet = turning < 0.0 and jamming.gap(float(state[0])) > CLOSED_RAD

    def slopes(time: float, now: Array) -> tuple[float, float]:
        angle, speed = float(now[0]), float(now[1])
        share = float(gas.share(jamming.rest_angle - angle))
        # A trial step beyond the closing must not meet the wall: the stretch ends there.
        push = 0.0 if open_yet else radius * jamming.force_n(angle, speed)
        return speed, acceleration(time, angle, speed, coasting.constants, share, turning, push)

    def stands(_: float, now: Array) -> float:
        return turning * float(now[1]) - CREEP_RAD_PER_S

    def closes(_: float, now: Array) -> float:
        return jamming.gap(float(now[0]))

    stands.terminal, stands.direction = True, -1.0  # type: ignore[attr-defined]
    closes.terminal, closes.direction = True, -1.0  # type: ignore[attr-defined]
    solution = solve_ivp(
        slopes,
        (begun, begun + LONGEST_S),
        state,
        method="LSODA",
        rtol=RELATIVE_TOLERANCE,
        atol=1e-12,
        events=[stands, closes] if open_yet else [stands],
        dense_output=True,
    )
    if not solution.success or solution.status != 1:
        raise SolverError(f"turning back: no rest within {LONGEST_S:g} s: {solution.message}")
    closed = open_yet and solution.t_events[1].size > 0
    end = float(solution.t[-1])
    return Stretch(begun, end, turning, jamming, solution.sol), closed
