"""The feet of a machine as bushings: places, stiffness, the floor under them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..machine.feet import FOOT_NAMES, Feet, Foot, Mounts, MountStiffness
from ..machine.floor import Floor, FloorMobility
from ..mechanics.bushings import Bushing


@dataclass(frozen=True)
class Stand:
    """Mounts and floor under a machine.

    Attributes
    ----------
    mounts : stiffness of one mount, pitch of the square, loss factor
    height_m : height of the mounts from the centre of mass, except of feet that give their own
    feet : anywhere; four in a square where there are none
    stiffness : over frequency, of every mount without one of its own
    floor : compliant floor; rigid where there is none
    """

    mounts: Mounts
    height_m: float
    feet: Feet | None = None
    stiffness: MountStiffness | None = None
    floor: Floor | FloorMobility | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the feet, in their order."""
        return FOOT_NAMES if self.feet is None else tuple(self.feet.by_name)

    @property
    def position(self) -> Array:
        """Position of the feet, shape (foot, 3), m from the centre of mass."""
        if self.feet is None:
            return corners(self.mounts.pitch_m, self.height_m)
        return np.array([self._position(foot) for foot in self.feet.by_name.values()])

    @property
    def is_over_frequency(self) -> bool:
        """Whether the stiffness of a mount changes with frequency."""
        return any(self._table(name) is not None for name in self.names)

    def bushings(self, body: str, with_floor: bool = True) -> list[Bushing]:
        """One a foot, between a body and the ground; without `with_floor` that is rigid."""
        return [
            self._bushing(name, point, body, with_floor)
            for name, point in zip(self.names, self.position, strict=True)
        ]

    def _bushing(self, name: str, point: Array, body: str, with_floor: bool) -> Bushing:
        foot, mounts, table = self._foot(name), self.mounts, self._table(name)
        lateral = mounts.lateral_stiffness_n_per_m
        vertical, loss = mounts.vertical_stiffness_n_per_m, mounts.loss_factor_ratio
        if table is not None:
            lateral, _, vertical = table.dynamic_stiffness(np.array(0.0)).real.tolist()
            loss = 0.0
        elif foot is not None:
            lateral = _or(foot.lateral_stiffness_n_per_m, lateral)
            vertical = _or(foot.vertical_stiffness_n_per_m, vertical)
            loss = _or(foot.loss_factor_ratio, loss)
        constant = np.array([lateral, lateral, vertical])
        floor = self.floor if with_floor else None
        over_frequency = None
        if table is not None or floor is not None:
            mount = _constant(constant, loss) if table is None else table.dynamic_stiffness
            over_frequency = mount if floor is None else _in_series(mount, floor, name)
        return Bushing(
            f"foot_{name}".replace("foot_foot", "foot"), body, None, point, _matrix(constant),
            loss_factor_ratio=loss, over_frequency=over_frequency,
        )  # fmt: skip

    def _foot(self, name: str) -> Foot | None:
        by_name: Mapping[str, Foot] = {} if self.feet is None else self.feet.by_name
        return by_name.get(name)

    def _table(self, name: str) -> MountStiffness | None:
        """Stiffness over frequency of a foot's mount; none where it is constant."""
        foot = self._foot(name)
        if foot is None or not (foot.has_constant_values or foot.stiffness):
            return self.stiffness
        return foot.stiffness

    def _position(self, foot: Foot) -> tuple[float, float, float]:
        return foot.x_m, foot.y_m, _or(foot.height_m, self.height_m)


def corners(pitch_m: float, height_m: float) -> Array:
    """Corners of a square in the order of FOOT_NAMES, shape (4, 3), m."""
    half = pitch_m / 2.0
    return np.array(
        [(x, y, height_m) for x, y in ((half, half), (half, -half), (-half, half), (-half, -half))]
    )


def _or(value: float | None, default: float) -> float:
    return default if value is None else value


def _matrix(stiffness: Array) -> Array:
    return np.diag([*stiffness, 0.0, 0.0, 0.0])


def _constant(stiffness: Array, loss: float) -> Callable[[Array], ComplexArray]:
    """Function of frequencies to a stiffness that is the same at all of them, lossless at zero."""

    def stiffness_at(frequency_hz: Array) -> ComplexArray:
        moving = np.asarray(frequency_hz, dtype=float)[..., None] > 0.0
        return np.asarray(stiffness * (1.0 + 1j * loss * moving))

    return stiffness_at


def _in_series(
    mount: Callable[[Array], ComplexArray], floor: Floor | FloorMobility, foot: str
) -> Callable[[Array], ComplexArray]:
    """Stiffness of a mount on a compliant floor: 1/(1/k + receptance of the floor)."""

    def stiffness_at(frequency_hz: Array) -> ComplexArray:
        stiffness = mount(frequency_hz)
        return np.asarray(stiffness / (1.0 + stiffness * floor.receptance(foot, frequency_hz)))

    return stiffness_at
