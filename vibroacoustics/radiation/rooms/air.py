"""The air of a room in motion: cosine boxes joined by fluxes, a step at a time."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ...base.errors import SolverError
from ..arrays import Array, IndexArray
from .box_step import pass_seams, step_series, sum_on_sides, to_nodes, to_sides
from .cutting import AirBox, End, Face
from .layout import (
    Layout,
    angular_frequencies,
    cosines,
    flux_gain,
    inverse_norms,
    layout,
    left_out,
    series_mass_m,
)
from .wall_step import WallPatch, Walls, interface_air_m, pass_walls

_LARGEST_PHASE: Final = 2.8
"""Phase of the highest term in a step, rad, where the search for the time step begins."""
_LARGEST_EIGENVALUE: Final = 3.9
"""Eigenvalue of a step's operator without walls' resistance: from 4 on, terms grow."""


class Air:
    """Pressure of all boxes as cosine series, with fluxes through joints of boxes and into
    walls."""

    def __init__(
        self,
        boxes: Sequence[AirBox],
        faces: Sequence[Face],
        time_step_s: float,
        maximum_frequency_hz: float = 0.0,
    ) -> None:
        self.boxes, self.time_step_s = boxes, time_step_s
        self._layout = plan = layout(boxes, faces)
        self.terms = np.zeros(plan.terms[-1])
        """Terms of the series now, box after box."""
        self._before = np.zeros_like(self.terms)
        self._turn = 2.0 * np.cos(plan.omega * time_step_s)
        reach = SPEED_OF_SOUND_M_PER_S * time_step_s
        self._gain = reach * flux_gain(plan.omega, time_step_s)
        self._push = np.zeros_like(self.terms)
        self._near = np.zeros(plan.nodes)
        self._sums, self._flux = np.zeros(plan.side_terms), np.zeros(plan.side_terms)
        self._pressure, self._change = np.zeros(plan.nodes), np.zeros(plan.nodes)
        largest = int(plan.ends[:, [1, 4]].max(initial=1) * plan.ends[:, [2, 5]].max(initial=1))
        self._work = np.zeros(2 * largest)
        masses = [
            sum(_mass_m(boxes, end, time_step_s, maximum_frequency_hz) for end in face.ends)
            for face in faces
        ]
        self._seams, self._give = _seams(boxes, faces, plan, masses)
        self._give *= reach
        self._walls = Walls(_patches(faces, plan, masses), time_step_s)

    def set_source(self, box: int, point: Array) -> None:
        """Let a monopole act at a point of a box: what `force` gives to series and nodes."""
        plan, air = self._layout, self.boxes[box]
        of = [(float(size), count) for size, count in zip(air.size, air.nodes, strict=True)]
        offset = point - air.lower
        lines = [
            cosines(offset[[axis]], *of[axis])[0] * inverse_norms(*of[axis]) for axis in range(3)
        ]
        first, last = plan.terms[box], plan.terms[box + 1]
        self._push[:] = 0.0
        self._push[first:last] = np.einsum("i,j,k->ijk", *lines).ravel()
        self._push *= SPEED_OF_SOUND_M_PER_S * self.time_step_s * self._gain
        planes = np.zeros(plan.side_terms)
        for axis in range(3):
            across = np.outer(*(lines[other] for other in range(3) if other != axis))
            for end, from_end in enumerate((offset[axis], of[axis][0] - offset[axis])):
                lacking, _ = left_out(np.array([from_end]), *of[axis], self.time_step_s)
                start = plan.sides[box, axis, end]
                planes[start : start + across.size] = lacking[0] * across.ravel()
        to_nodes(planes, plan.ends, plan.matrices, self._near, self._work)

    def exchange(self, force: float = 0.0) -> None:
        """Fluxes of a step; after it, series and fluxes are those of one time."""
        self._to_nodes(self.terms)
        if force:
            self._pressure += force * self._near
        pass_seams(self._pressure, self._change, self._seams, self._give)
        pass_walls(self._pressure, self._change, self._walls.arguments)
        self._to_sides()

    def advance(self, force: float = 0.0) -> None:
        """The series a step on."""
        self._step_series(self.terms, self._before, self._turn)
        self.terms, self._before = self._before, self.terms
        if force:
            self.terms += force * self._push

    @property
    def plan(self) -> Layout:
        """Layout of `terms` and `flux`."""
        return self._layout

    @property
    def flux(self) -> Array:
        """Change of the fluxes through all sides in the step, as terms of the sides."""
        return self._flux

    def operator(self, terms: Array) -> Array:
        """Return the change of a series in a step of the air without resistance: 2 now - before - M
        now.

        Walls are nothing but their mass of air: whatever passive stands behind it lowers the
        largest eigenvalue of M.
        """
        self._to_nodes(terms)
        pass_seams(self._pressure, self._change, self._seams, self._give)
        for (first, count), mass in zip(self._walls.patches, self._walls.mass, strict=True):
            nodes = slice(first, first + count)
            self._change[nodes] = self._pressure[nodes] / mass
        self._to_sides()
        result = np.zeros_like(terms)
        self._step_series(terms, result, 2.0 - self._turn)
        return np.asarray(2.0 * (2.0 - self._turn) * terms - result)

    def balance(self) -> Array:
        """Factors of terms that make `operator` symmetric."""
        plan = self._layout
        norms = []
        for starts, shape in zip(plan.norm_starts, plan.shapes, strict=True):
            lines = [
                plan.norms[start : start + count]
                for start, count in zip(starts, shape, strict=True)
            ]
            norms.append(np.einsum("i,j,k->ijk", *lines).ravel())
        return np.asarray(1.0 / np.sqrt(self._gain * np.concatenate(norms)))

    def _to_nodes(self, terms: Array) -> None:
        plan = self._layout
        sum_on_sides(terms, plan.shapes, plan.terms, plan.sides, self._sums)
        to_nodes(self._sums, plan.ends, plan.matrices, self._pressure, self._work)

    def _to_sides(self) -> None:
        plan = self._layout
        to_sides(self._change, plan.ends, plan.matrices, self._flux, self._work)

    def _step_series(self, now: Array, before: Array, turn: Array) -> None:
        plan = self._layout
        layout = plan.shapes, plan.terms, plan.sides, plan.norms, plan.norm_starts
        step_series(now, before, turn, self._gain, self._flux, layout)


def _mass_m(
    boxes: Sequence[AirBox], end: End, time_step_s: float, maximum_frequency_hz: float
) -> float:
    """Length of air at an end, for the mean over directions at the highest frequency, m."""
    box = boxes[end.box]
    squared = (2.0 * np.pi * maximum_frequency_hz / SPEED_OF_SOUND_M_PER_S) ** 2 / 3.0
    return series_mass_m(float(box.size[end.axis]), box.nodes[end.axis], time_step_s, squared)


def _seams(
    boxes: Sequence[AirBox], faces: Sequence[Face], plan: Layout, masses: Sequence[float]
) -> tuple[IndexArray, Array]:
    """First nodes of both ends of every joint and their number; 1/(d1 + d2) by node, 1/m."""
    rows, give, row = [], np.zeros(plan.nodes), 0
    for face, mass in zip(faces, masses, strict=True):
        if len(face.ends) == 2:
            first, second = plan.ends[row], plan.ends[row + 1]
            nodes = int(first[4]), int(first[5])
            rows.append([first[3], second[3], nodes[0] * nodes[1]])
            air_m = interface_air_m(boxes, face, nodes, mass)
            give[first[3] : first[3] + air_m.size] = 1.0 / air_m.ravel()
        row += len(face.ends)
    return np.array(rows, dtype=np.intp).reshape(-1, 3), give


def _patches(faces: Sequence[Face], plan: Layout, masses: Sequence[float]) -> list[WallPatch]:
    patches, row = [], 0
    for face, mass in zip(faces, masses, strict=True):
        if face.material is not None:
            end = plan.ends[row]
            patches.append(WallPatch(int(end[3]), int(end[4] * end[5]), face.material, mass))
        row += len(face.ends)
    return patches


def largest_eigenvalue(air: Air) -> float:
    """Largest eigenvalue of a step's operator: Lanczos iteration, an upper bound to its
    tolerance."""
    from scipy.sparse.linalg import LinearOperator, eigsh

    factors = air.balance()
    size = factors.size

    def product(vector: Array) -> Array:
        return factors * air.operator(np.ravel(vector) / factors)

    operator = LinearOperator((size, size), matvec=product, dtype=float)
    if size < 4:
        return float(np.linalg.eigvalsh(operator @ np.eye(size)).max())
    start = np.random.default_rng(0).standard_normal(size)
    value = eigsh(operator, 1, which="LA", tol=1e-3, v0=start, return_eigenvectors=False)
    return 1.001 * float(value[0])


def stable_air(
    boxes: Sequence[AirBox],
    faces: Sequence[Face],
    longest_step_s: float,
    maximum_frequency_hz: float = 0.0,
) -> Air:
    """The air with a time step at which no series grows: computed, as no closed bound is known.

    Raises
    ------
    SolverError
        No time step down to a hundredth of the usual one is stable.
    """
    highest = max(float(angular_frequencies(box).max()) for box in boxes)
    step = min(longest_step_s, _LARGEST_PHASE / highest)
    for _ in range(20):
        air = Air(boxes, faces, step, maximum_frequency_hz)
        value = largest_eigenvalue(air)
        if value <= _LARGEST_EIGENVALUE:
            return air
        step *= min(0.97, max(0.8, np.sqrt(_LARGEST_EIGENVALUE / value)))
    raise SolverError("room: no time step is stable; the room's smallest gaps are too thin")
