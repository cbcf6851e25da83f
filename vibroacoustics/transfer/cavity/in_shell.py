"""A space of gas in the elastic shell: its modes, what drives them, what they do to the wall."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...base.arrays import Array, IndexArray
from ..shell_modes.meridian import Meridian
from ..shell_modes.modes import Around, ShellMode
from .elements import interpolation
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


class _OrderWithSource(NamedTuple):
    """Modes of one order with what a source drives besides, see `GasOrder.with_attachment`.

    Attributes
    ----------
    squares : k² of the modes, shape (mode,), 1/m²
    shapes : pressures of the nodes, shape (node, mode)
    at_source : pressure at the source where θ = θ₀, shape (mode,)
    on_wall : by twin ∫ φ ψ dS with the wall's modes, shape (mode, wall)
    """

    squares: Array
    shapes: Array
    at_source: Array
    on_wall: Mapping[Around, Array]


@dataclass(frozen=True)
class GasInShell:
    """A space of gas with the wall's modes, whatever drives it.

    Attributes
    ----------
    profile : the space
    under_cap : see `WallPressure`
    meridian : meridian of the wall
    modes : modes of the wall
    """

    profile: Profile
    under_cap: bool
    meridian: Meridian
    modes: tuple[ShellMode, ...]
    _last: list[tuple[tuple[float, float], Sequence[_OrderWithSource]]] = field(
        default_factory=list, repr=False
    )

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
        mouth, parts, walls = interpolation(self.profile, tube.radius_m, tube.height_m), [], []
        for order in self._driven_at(source.radius_m, source.height_m):
            at_tube = mouth @ order.shapes
            for around, wall in order.on_wall.items():
                of_twin = source.around(around) * order.at_source, tube.around(around) * at_tube
                parts.append((order.squares, *of_twin))
                walls.append(wall)
        squares, at_source, at_tube = (np.concatenate(rows) for rows in zip(*parts, strict=True))
        on_modes = np.concatenate(walls)
        return DrivenGas(squares, at_source, at_tube, on_modes, tube_area_m2, quality_ratio)

    def _driven_at(self, radius_m: float, height_m: float) -> Sequence[_OrderWithSource]:
        """All orders with a source at a place; the last place is kept, as most samples share it."""
        opening = radius_m, height_m
        for kept, every in self._last.copy():
            if kept == opening:
                return every
        source = interpolation(self.profile, radius_m, height_m)
        driven = [
            self._of_order(gas, source, on_wall)
            for gas, on_wall in zip(self.orders, self._on_wall, strict=True)
        ]
        self._last[:] = [(opening, driven)]
        return driven

    def _of_order(
        self, gas: GasOrder, source: Array, on_wall: Mapping[Around, tuple[IndexArray, Array]]
    ) -> _OrderWithSource:
        squares, shapes = gas.with_attachment(source)
        walls = {}
        for around, (modes, forces) in on_wall.items():
            walls[around] = np.zeros((squares.size, len(self.modes)))
            walls[around][:, modes] = shapes.T @ forces
        return _OrderWithSource(squares, shapes, source @ shapes, walls)

    @cached_property
    def _on_wall(self) -> tuple[dict[Around, tuple[IndexArray, Array]], ...]:
        """Coupling of each order by twin: modes of the wall, force on these per pressure of a node,
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
