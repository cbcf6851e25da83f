"""A space of gas in the elastic shell: its modes, what drives them, what they do to the wall."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...base.arrays import Array, IndexArray
from ..shell_modes.meridian import Meridian
from ..shell_modes.modes import Around, ShellMode
from .modes import GasOrder
from .profile import Profile
from .response import DrivenGas
from .wall import WallPressure


@dataclass(frozen=True)
class Mouth:
    """Openings alike around the axis, which share a flow equally.

    Attributes
    ----------
    radius_m, height_m : from the axis, from the centre of mass
    angles_rad : from x towards y
    """

    radius_m: float
    height_m: float
    angles_rad: Sequence[float]

    def around(self, around: Around) -> float:
        """Mean of cos n(θ - θ₀) over the openings."""
        return float(np.mean(around.radial(np.asarray(self.angles_rad))))


@dataclass(frozen=True)
class GasInShell:
    """A space of gas with the wall's modes, whatever drives it.

    Attributes
    ----------
    profile : the space
    under_cap : see `WallPressure`
    meridian : of the wall
    modes : of the wall
    """

    profile: Profile
    under_cap: bool
    meridian: Meridian
    modes: tuple[ShellMode, ...]

    @cached_property
    def orders(self) -> tuple[GasOrder, ...]:
        """Those around that a mode of the wall has."""
        orders = sorted({mode.around.order for mode in self.modes})
        return tuple(GasOrder(self.profile, order) for order in orders)

    def driven(
        self, source: Mouth, tube: Mouth, tube_area_m2: float, quality_ratio: float
    ) -> DrivenGas:
        """Modes of all orders and twins for a source and a tube.

        Parameters
        ----------
        source : where the volume flow comes in
        tube : where sound goes out without reflection
        tube_area_m2 : 0 where there is no tube
        quality_ratio : Q
        """
        parts, walls = [], []
        for gas, on_wall in zip(self.orders, self._on_wall, strict=True):
            driven = gas.at(source.radius_m, source.height_m)
            squares, shapes = gas.with_attachment(driven)
            at_source = driven @ shapes
            at_tube = gas.at(tube.radius_m, tube.height_m) @ shapes
            for around, (modes, forces) in on_wall.items():
                of_twin = source.around(around) * at_source, tube.around(around) * at_tube
                parts.append((squares, *of_twin))
                wall = np.zeros((squares.size, len(self.modes)))
                wall[:, modes] = shapes.T @ forces
                walls.append(wall)
        squares, at_source, at_tube = (np.concatenate(rows) for rows in zip(*parts, strict=True))
        on_modes = np.concatenate(walls)
        return DrivenGas(squares, at_source, at_tube, on_modes, tube_area_m2, quality_ratio)

    @cached_property
    def _on_wall(self) -> tuple[dict[Around, tuple[IndexArray, Array]], ...]:
        """Of each order by twin: modes of the wall, force on these per pressure of a node,
        (node, mode)."""
        load = WallPressure(self.profile, self.under_cap)
        arounds = dict.fromkeys(mode.around for mode in self.modes)
        return tuple(
            {around: self._of_twin(load, around) for around in arounds if around.order == gas.order}
            for gas in self.orders
        )

    def _of_twin(self, load: WallPressure, around: Around) -> tuple[IndexArray, Array]:
        alike = [row for row, mode in enumerate(self.modes) if mode.around == around]
        shapes = np.stack([self.modes[row].shape for row in alike], axis=1)
        return np.array(alike), load.generalised(self.meridian, around).T @ shapes
