"""All boxes and faces of a room as flat arrays, as the compiled step takes them."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate

import numpy as np

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ..arrays import Array, IndexArray
from .cutting import AirBox, End, Face


@dataclass(frozen=True)
class Layout:
    """Layout of the boxes, their sides and the ends of faces in flat arrays.

    A side of a box has a plane of terms: sums of the series over its axis, and a flux. An end of a
    face has nodes, where pressures are compared and fluxes act. From terms to nodes leads a matrix
    for each axis of the face, and back another: the transposed one with the nodes' widths and the
    terms' norms. Where a face covers its sides completely with as many nodes as they have terms,
    those transforms undo each other and are omitted.
    """

    shapes: IndexArray
    """Terms of each box, (box, 3)."""
    terms: IndexArray
    """First term of each box, and the number of all, (box + 1,)."""
    norms: Array
    """Inverse norms along each axis, one box after the other."""
    norm_starts: IndexArray
    """(box, 3)."""
    sides: IndexArray
    """First term of each side's plane, (box, 3, 2)."""
    side_terms: int
    ends: IndexArray
    """Side's first term, terms along both axes, first node, nodes along both axes, first entry of
    the four matrices, and 1 where they are omitted, (end, 11)."""
    matrices: Array
    nodes: int
    omega: Array
    """c |k| of the terms, rad/s."""


def layout(boxes: Sequence[AirBox], faces: Sequence[Face]) -> Layout:
    """The layout of boxes and faces; ends in the order of the faces."""
    shapes = np.array([box.nodes for box in boxes])
    terms = [0, *accumulate(int(np.prod(box.nodes)) for box in boxes)]
    norms: list[Array] = []
    norm_starts: list[int] = []
    for box in boxes:
        for length, count in zip(box.size, box.nodes, strict=True):
            norm_starts.append(sum(norm.size for norm in norms))
            norms.append(inverse_norms(float(length), count))
    planes = [
        int(np.prod(box.nodes)) // box.nodes[axis]
        for box in boxes
        for axis in range(3)
        for _ in range(2)
    ]
    sides = np.array([0, *accumulate(planes)])
    starts = sides[:-1].reshape(-1, 3, 2)
    ends, matrices = _ends(boxes, faces, starts)
    return Layout(
        shapes=shapes,
        terms=np.array(terms),
        norms=np.concatenate(norms),
        norm_starts=np.array(norm_starts).reshape(-1, 3),
        sides=starts,
        side_terms=int(sides[-1]),
        ends=ends,
        matrices=matrices,
        nodes=int(ends[-1, 3] + ends[-1, 4] * ends[-1, 5]) if len(ends) else 0,
        omega=np.concatenate([angular_frequencies(box).ravel() for box in boxes]),
    )


def _ends(
    boxes: Sequence[AirBox], faces: Sequence[Face], sides: IndexArray
) -> tuple[IndexArray, Array]:
    rows: list[list[int]] = []
    matrices: list[Array] = [np.zeros(0)]
    node = entry = 0
    for face in faces:
        counts = face_nodes(boxes, face)
        left_out = all(_covers(boxes[end.box], end, face, counts) for end in face.ends)
        for end in face.ends:
            box = boxes[end.box]
            across = [axis for axis in range(3) if axis != end.axis]
            terms = [box.nodes[axis] for axis in across]
            row = [int(sides[end.box, end.axis, end.end]), *terms, node, *counts]
            for matrix in _matrices(box, across, face, counts):
                row.append(entry)
                matrices.append(matrix.ravel())
                entry += matrix.size
            rows.append([*row, int(left_out)])
            node += counts[0] * counts[1]
    ends: IndexArray = np.array(rows, dtype=np.intp).reshape(-1, 11)
    return ends, np.concatenate(matrices)


def face_nodes(boxes: Sequence[AirBox], face: Face) -> list[int]:
    """Nodes of a face along its axes: as dense as in the finest of its boxes."""
    spacing = np.min([np.delete(boxes[end.box].spacing, end.axis) for end in face.ends], axis=0)
    return [int(count) for count in np.ceil((face.upper - face.lower) / spacing - 1e-6)]


def _covers(box: AirBox, end: End, face: Face, counts: Sequence[int]) -> bool:
    across = [axis for axis in range(3) if axis != end.axis]
    size = np.delete(box.size, end.axis)
    same = np.allclose(face.upper - face.lower, size, rtol=0.0, atol=1e-9)
    return same and [box.nodes[axis] for axis in across] == list(counts)


def _matrices(
    box: AirBox, across: Sequence[int], face: Face, counts: Sequence[int]
) -> tuple[Array, Array, Array, Array]:
    """Matrices to the nodes from the left and the right, and back from the left and the right."""
    to_nodes, back = [], []
    for row, axis in enumerate(across):
        width = (face.upper[row] - face.lower[row]) / counts[row]
        points = face.lower[row] - box.lower[axis] + width * (np.arange(counts[row]) + 0.5)
        values = cosines(points, float(box.size[axis]), box.nodes[axis])
        to_nodes.append(values)
        back.append(
            inverse_norms(float(box.size[axis]), box.nodes[axis])[:, None] * values.T * width
        )
    return to_nodes[0], to_nodes[1].T, back[0], back[1].T


def wavenumbers(length_m: float, nodes: int) -> Array:
    """Return the wavenumbers of the terms along one axis, n pi/L, rad/m, (term,)."""
    return np.asarray(np.pi * np.arange(nodes) / length_m)


def inverse_norms(length_m: float, nodes: int) -> Array:
    """One over the integral of cos² of each term along one axis, 1/m, (term,)."""
    inverse = np.full(nodes, 2.0 / length_m)
    inverse[0] = 1.0 / length_m
    return inverse


def cosines(points_m: Array, length_m: float, nodes: int) -> Array:
    """Terms at points along one axis, counted from the box's lower end, (point, term)."""
    return np.asarray(np.cos(np.outer(points_m, wavenumbers(length_m, nodes))))


def slopes(points_m: Array, length_m: float, nodes: int) -> Array:
    """Derivatives of the terms along the axis, 1/m, (point, term)."""
    k = wavenumbers(length_m, nodes)
    return np.asarray(-k * np.sin(np.outer(points_m, k)))


def angular_frequencies(box: AirBox) -> Array:
    """c |k| of all terms, rad/s, (x, y, z)."""
    kx, ky, kz = (wavenumbers(*of) for of in zip(box.size, box.nodes, strict=True))
    k = np.sqrt(kx[:, None, None] ** 2 + ky[:, None] ** 2 + kz**2)
    return np.asarray(SPEED_OF_SOUND_M_PER_S * k)


def flux_gain(omega: Array, time_step_s: float) -> Array:
    """Return the gain of a term by a flux at a wall: cos²(omega dt/2).

    With fluxes midway in the steps a term at resonance answers to its mean flux by
    omega/(2 tan(omega dt/2)/dt) sin(omega dt)/(omega dt) too much; this undoes it. It is the
    correction of k-Wave's sources (E. Wise, B. Treeby et al.), once for the flux and once for its
    mean over a step.
    """
    return np.asarray(np.cos(omega * time_step_s / 2.0) ** 2)


def left_out(
    points_m: Array, length_m: float, nodes: int, time_step_s: float
) -> tuple[Array, Array]:
    """Return what a series lacks of the answer to a flux at its lower end, m; its derivative;
    (point,).

    Terms far above the frequencies of interest follow a flux at once: the pressure lacks
    P(x)/c dU/dt with P(x) = 2/L sum of cos(n pi x/L)/k² over n >= N, and what `flux_gain` takes
    from the terms that are kept. P(0) is the length of air that stands for them at the end.
    The sum over all n >= 1 of cos(n theta)/n² is pi²/6 - pi theta/2 + theta²/4.
    """
    numbers = np.arange(1, nodes)
    phase = np.pi * numbers / length_m * SPEED_OF_SOUND_M_PER_S * time_step_s / 2.0
    weight = ((phase / np.tan(phase)) ** 2) / numbers**2
    theta = np.pi * points_m / length_m
    total = np.pi**2 / 6.0 - np.pi * theta / 2.0 + theta**2 / 4.0
    even = (SPEED_OF_SOUND_M_PER_S * time_step_s / 2.0) ** 2 * 2.0 / 3.0 / length_m
    scale = 2.0 * length_m / np.pi**2
    values: Array = scale * (total - np.cos(np.outer(theta, numbers)) @ weight) + even
    slope = np.sin(np.outer(theta, numbers)) @ (weight * numbers) + (theta - np.pi) / 2.0
    slopes_: Array = scale * np.pi / length_m * slope
    return values, slopes_


def series_mass_m(
    length_m: float, nodes: int, time_step_s: float, squared_wavenumber: float = 0.0
) -> float:
    """Length of air at the end of a series that stands for what it lacks, m.

    It is the sum of 2/L / (k_n² - k²) over n >= N, to the first order in k², where k² is that of
    the wave along the axis, 1/m². To the order zero the length is too short for short waves, and
    their frequencies come out too high.
    """
    values, _ = left_out(np.zeros(1), length_m, nodes, time_step_s)
    fourth_powers = np.pi**4 / 90.0 - np.sum(np.arange(1.0, nodes) ** -4)
    return float(values[0] + 2.0 * length_m**3 / np.pi**4 * fourth_powers * squared_wavenumber)
