"""The machine side on two grids: what every pattern sends through the box, and how sure it is."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..base.forms import returned
from ..base.pieces import stored
from ..base.progress import Progress, no_progress
from ..base.threads import in_threads, mapped_in_threads
from .arrays import Array, ComplexArray
from .box import BoxField
from .exact import Mirror
from .near_field import NearField
from .near_memory import FIELDS_BYTES
from .near_run import PartField, Recording
from .patterns import Pattern
from .scene import Scene
from .task import Microphones

_UNIT_CELLS: Final = 3
"""Cells of the finer grid where the coarser one has one less, so that both have the same planes."""
COARSENING: Final = _UNIT_CELLS / (_UNIT_CELLS - 1)
"""Spacing of the coarser grid over that of the finer one."""
EXTRAPOLATION: Final = 1.0 / (COARSENING**2 - 1.0)
"""Richardson: the finer grid errs by this share of the difference at second order."""
ERROR: Final = 1.4
"""Estimated error of the extrapolated pressure over what the extrapolation adds."""
_POINTS_PER_TASK: Final = 4


@dataclass(frozen=True)
class Radiated:
    """Pressures at microphones with Green's functions in closed form, on both grids."""

    finer: ComplexArray
    """(point, pattern, frequency), Pa."""
    coarser: ComplexArray

    @property
    def correction(self) -> ComplexArray:
        """The estimated error of the finer grid, (point, pattern, frequency), Pa."""
        return np.asarray(EXTRAPOLATION * (self.finer - self.coarser))

    @property
    def pressure(self) -> ComplexArray:
        """Extrapolated."""
        return np.asarray(self.finer + self.correction)

    @property
    def error(self) -> Array:
        """Estimated of the extrapolated pressure, Pa."""
        return np.asarray(ERROR * np.abs(self.correction))


@dataclass(frozen=True)
class Room:
    """Green's functions that are computed, on the box of the finer grid, to some microphones."""

    microphones: Microphones
    greens: Callable[[], Sequence[BoxField]]
    """Called after the first runs, so that what these refuse is refused soon."""


class MachineSide:
    """Sound pressure of every pattern at microphones, from the finer and the coarser grid.

    The patterns' fields on the boxes are joined with Green's functions and forgotten a few at a
    time: all of them together need not fit the memory.
    """

    def __init__(
        self,
        scene: Scene,
        near: Sequence[NearField],
        patterns: Sequence[Pattern],
        frequency_hz: Array,
        microphones: Sequence[Microphones],
        progress: Progress = no_progress,
        room: Room | None = None,
    ) -> None:
        self._scene, self._near, self._names = scene, near, [pattern.name for pattern in patterns]
        self._frequency_hz, self._microphones = frequency_hz, microphones
        self._progress, self._room = progress, room
        self._points = np.concatenate([group.points for group in microphones])
        moving = [scene.moving(pattern) for pattern in patterns]
        self._fluxes = in_threads([partial(grid.wall_fluxes, moving) for grid in near])
        finer, coarser = (list(map(self._nothing, microphones)) for _ in near)
        self.closed = [Radiated(*pair) for pair in zip(finer, coarser, strict=True)]
        """Pressure at each of the microphones with Green's functions in closed form."""
        self.in_room = self._nothing(room.microphones) if room else None
        """Pressure at the microphones of the room on the finer grid, (point, pattern,
        frequency)."""
        for batch in self._batches():
            self._radiate(batch)

    def _nothing(self, microphones: Microphones) -> ComplexArray:
        names, frequencies = (
            self._names[: microphones.patterns],
            self._frequency_hz[microphones.frequencies],
        )
        shape = (microphones.points.shape[0], len(names), frequencies.size)
        return np.zeros(shape, dtype=complex)

    def _batches(self) -> Iterator[list[tuple[int, int]]]:
        """Grids and patterns whose fields are kept at the same time."""
        batch: list[tuple[int, int]] = []
        kept = 0.0
        for grid, near in enumerate(self._near):
            for number, flux in enumerate(self._fluxes[grid]):
                size = near.field_bytes(self._frequency_hz.size, len(near.parts(flux)))
                if batch and kept + size > FIELDS_BYTES:
                    yield batch
                    batch, kept = [], 0.0
                batch.append((grid, number))
                kept += size
        yield batch

    def _radiate(self, batch: Sequence[tuple[int, int]]) -> None:
        """Run grids and patterns and join what they send out."""

        def field(member: tuple[int, int]) -> Sequence[PartField]:
            grid, number = member
            flux, name = self._fluxes[grid][number], self._names[number]
            return self._near[grid].radiate(
                flux, self._frequency_hz, self._points, name, self._progress
            )

        name, in_parallel = ("near field", self._points), partial(mapped_in_threads, field)
        fields = list(stored(name, batch, in_parallel, returned(field)))
        tasks = []
        for grid in sorted({grid for grid, _ in batch}):
            members = {
                number: parts
                for (other, number), parts in zip(batch, fields, strict=True)
                if other == grid
            }
            for microphones, result in zip(self._microphones, self.closed, strict=True):
                values = (result.finer, result.coarser)[grid]
                chosen = [number for number in members if number < values.shape[1]]
                parts = [members[number] for number in chosen]
                tasks += [
                    partial(self._join_closed, grid, parts, microphones, points, values, chosen)
                    for points in _in_tasks(microphones.points.shape[0])
                ]
            if grid == 0 and self._room is not None:
                tasks.append(partial(self._join_room, members))
        in_threads(tasks)

    def _join_room(self, members: Mapping[int, Sequence[PartField]]) -> None:
        """Fill in the pressures of some patterns with the Green's functions of the room."""
        if self._room is not None and self.in_room is not None:
            fields, greens = list(members.values()), rows_of(self.greens)
            frequencies = self._indices(self._room.microphones)
            joined = join(self._near[0].recording, fields, frequencies, greens)
            self.in_room[:, list(members)] = joined

    @cached_property
    def greens(self) -> Sequence[BoxField]:
        """Those of the room."""
        return self._room.greens() if self._room else []

    def _indices(self, microphones: Microphones) -> range:
        return range(*microphones.frequencies.indices(self._frequency_hz.size))

    def _join_closed(
        self,
        grid: int,
        fields: Sequence[Sequence[PartField]],
        microphones: Microphones,
        points: slice,
        values: ComplexArray,
        chosen: Sequence[int],
    ) -> None:
        """Fill in the values of some points and patterns."""
        near = self._near[grid]
        layers = np.concatenate([near.box.inner, near.box.outer])
        frequency_hz = self._frequency_hz[microphones.frequencies]
        greens = self._scene.green_rows(layers, microphones.points[points], frequency_hz)
        values[points, chosen] = join(near.recording, fields, self._indices(microphones), greens)


def _in_tasks(points: int) -> list[slice]:
    """Points that are joined at a time."""
    return [slice(first, first + _POINTS_PER_TASK) for first in range(0, points, _POINTS_PER_TASK)]


def near_fields(scene: Scene, spacing_m: float, maximum_frequency_hz: float) -> list[NearField]:
    """The scene on the finer and on the coarser grid; nothing is computed yet."""
    return [
        NearField(
            scene.body,
            _UNIT_CELLS / cells * spacing_m,
            maximum_frequency_hz,
            scene.near_walls,
            cells_per_unit=cells,
            joins_floor=scene.outdoors is not None,
        )
        for cells in (_UNIT_CELLS, _UNIT_CELLS - 1)
    ]


def outside(near: Sequence[NearField], walls: Sequence[Mirror], points: Array) -> NDArray[np.bool_]:
    """Whether points (point, 3) lie outside the boxes of all grids and in front of every wall."""
    in_box = []
    for box in (step.box for step in near):
        # A point on a wall beside a box lies in it.
        low = np.minimum(box.lower, box.outer.min(axis=0)) - 1e-6
        high = np.maximum(box.upper, box.outer.max(axis=0)) + 1e-6
        in_box.append(np.all((points > low) & (points < high), axis=1))
    behind = [wall.depth_m(points) < -1e-9 for wall in walls]
    return np.asarray(~np.any([*in_box, *behind], axis=0))


def join(
    recorded: Recording,
    fields: Sequence[Sequence[PartField]],
    frequencies: Sequence[int],
    greens: Iterable[ComplexArray],
) -> ComplexArray:
    """Sound pressure where Green's functions lead, of every field, (point, field, frequency).

    Kirchhoff-Helmholtz integral over the box, with the normal n out of the box (towards the
    receiver): p = integral of [p dG/dn - G dp/dn] dS (Pierce, Acoustics (2019), section 4.6).
    With p and G half a cell inside (i) and outside (o) of every face of area A, a distance d apart,
    the central differences and means combine to

        p = sum of A/d (p_i G_o - p_o G_i),

    which no choice of box changes as long as both fields obey the discrete equations. So a rocking
    body's weak sound is not drowned by quadrature errors of its strong near field.

    Parameters
    ----------
    recorded : the cells of the box
    fields : the parts of each field
    frequencies : those of the fields that are joined
    greens : for each of these frequencies, Green's functions on the inner layer of the box and then
        on the outer one, (point, 2 pairs)
    """
    by_parity: dict[tuple[int, ...], list[tuple[int, PartField]]] = {}
    for number, parts in enumerate(fields):
        for part in parts:
            by_parity.setdefault(part.parity, []).append((number, part))
    matrices = {parity: recorded.join_matrix(parity) for parity in by_parity}
    rows = []
    for frequency, green in zip(frequencies, greens, strict=True):
        row = np.zeros((len(fields), green.shape[0]), dtype=complex)
        for parity, members in by_parity.items():
            spectra = np.stack([part.spectrum[frequency] for _, part in members])
            row[[number for number, _ in members]] += spectra @ (matrices[parity] @ green.T)
        rows.append(row.T)
    return np.stack(rows, axis=-1)


def rows_of(greens: Sequence[BoxField]) -> Iterable[ComplexArray]:
    """Green's functions (point, 2 pairs) at one frequency after the other."""
    for frequency in range(greens[0].inner.shape[0]):
        yield np.stack(
            [np.concatenate([table.inner[frequency], table.outer[frequency]]) for table in greens]
        )
