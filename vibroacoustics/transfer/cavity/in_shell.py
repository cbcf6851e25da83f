"""A space of gas in the elastic shell: its modes, what drives them, what they do to the wall."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np
from scipy.linalg import cho_factor, cho_solve, eigh

from ...base.arrays import Array, IndexArray
from ..shell_modes.meridian import Meridian
from ..shell_modes.modes import Around, ShellMode
from .elements import Profile, interpolation, matrices
from .response import DrivenGas
from .wall import WallPressure

MODES: Final = 12
"""Modes of each order; what higher ones do is in the attachment mode."""
_UNIFORM: Final = 1e-6
"""Share of the largest k² of the order; below it a mode is the uniform pressure."""


@dataclass(frozen=True)
class GasOrder:
    """Modes p cos n(θ - θ₀) of one order n in rigid walls, with ∫ φ² dV = 1.

    Attributes
    ----------
    profile : the space
    order : waves around the axis
    """

    profile: Profile
    order: int

    @cached_property
    def modes(self) -> tuple[Array, Array]:
        """k² (mode,) in 1/m² and pressures of the nodes (node, mode)."""
        stiffness, mass = self._matrices
        squares, free = eigh(stiffness, mass, subset_by_index=(0, MODES - 1))
        shapes = np.zeros((self._count, MODES))
        shapes[self._free] = free
        return np.maximum(squares, 0.0), shapes

    def with_attachment(self, source: Array) -> tuple[Array, Array]:
        """The modes and the steady response to a source that they lack, as one more.

        It is orthogonal to the modes in stiffness and mass, so it acts as one (Craig & Bampton
        1968, of structures; attachment mode). None where the source drives no pressure.

        Parameters
        ----------
        source : its share of each node, shape (node,)
        """
        squares, shapes = self.modes
        free_source, (response, its_mass) = source[self._free], self._steady
        remaining = free_source - self._moved @ (shapes[self._free].T @ free_source)
        steady = response @ free_source
        size = float(steady @ its_mass @ free_source)
        if size <= 0.0 or not np.any(free_source):
            return squares, shapes
        column = np.zeros((self._count, 1))
        column[self._free, 0] = steady / np.sqrt(size)
        square = float(steady @ remaining) / size  # the stiffness makes of it what is left
        return np.append(squares, square), np.hstack([shapes, column])

    @cached_property
    def _moved(self) -> Array:
        """Mass times the modes, shape (free node, mode)."""
        return np.asarray(self._matrices[1] @ self.modes[1][self._free])

    @property
    def _count(self) -> int:
        return int(self.profile.nodes[..., 0].size)

    @cached_property
    def _free(self) -> IndexArray:
        """Nodes with pressure: on the axis none from order 1 up."""
        radius = self.profile.nodes[..., 0].ravel()
        return np.flatnonzero((radius > 0.0) | (self.order == 0))

    @cached_property
    def _matrices(self) -> tuple[Array, Array]:
        indices = np.ix_(self._free, self._free)
        stiffness, mass = matrices(self.profile, self.order)
        return stiffness[indices], mass[indices]

    @cached_property
    def _steady(self) -> tuple[Array, Array]:
        """Steady response of each node to a source at each, without the modes; mass times it.

        Kept whole, as sampled sources differ in their places. The uniform pressure, which order 0
        has, gets some stiffness.
        """
        stiffness, mass = self._matrices
        squares, shapes = self.modes
        free, boundary = shapes[self._free], self._moved
        uniform = boundary[:, squares < _UNIFORM * squares[-1]]
        held = cho_factor(stiffness + squares[-1] * uniform @ uniform.T)
        response = cho_solve(held, np.eye(len(mass)) - boundary @ free.T)
        response -= free @ (boundary.T @ response)
        return response, mass @ response


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
