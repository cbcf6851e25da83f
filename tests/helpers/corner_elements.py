"""Wavenumbers of rectangles without rectangles: high-order elements, graded to corners."""

from itertools import pairwise

import numpy as np
from numpy.polynomial.legendre import Legendre, leggauss, legvander
from scipy.sparse import csc_array
from scipy.sparse.linalg import eigsh

ORDER, RATIO, LEVELS = 6, 0.15, 5


def squared_wavenumbers(size, blocks, count, longest):
    """Those of the first modes with hard walls but the constant one, (count,), rising.

    blocks : lower and upper corner of each; longest : edge of an element
    """
    lines = [_lines(size, blocks, axis, longest) for axis in (0, 1)]
    nodes = [ORDER * (line.size - 1) + 1 for line in lines]
    mass, stiffness = _on_the_unit_interval()
    rows, columns, masses, stiffnesses = [], [], [], []
    for i, (x, across) in enumerate(zip(lines[0], np.diff(lines[0]), strict=False)):
        for j, (y, along) in enumerate(zip(lines[1], np.diff(lines[1]), strict=False)):
            middle = np.array([x + across / 2.0, y + along / 2.0])
            if any(np.all((middle > low) & (middle < high)) for low, high in blocks):
                continue
            number = ORDER * i + np.arange(ORDER + 1)
            number = (number[:, None] * nodes[1] + ORDER * j + np.arange(ORDER + 1)).ravel()
            rows.append(np.repeat(number, number.size))
            columns.append(np.tile(number, number.size))
            masses.append(np.kron(mass * across, mass * along).ravel())
            stiffnesses.append(
                (
                    np.kron(stiffness / across, mass * along)
                    + np.kron(mass * across, stiffness / along)
                ).ravel()
            )
    at = np.concatenate(rows), np.concatenate(columns)
    used = np.unique(at[0])
    m, k = (
        csc_array((np.concatenate(values), at), shape=(nodes[0] * nodes[1],) * 2)[used][:, used]
        for values in (masses, stiffnesses)
    )
    values = eigsh(k, count + 1, M=m, sigma=-0.5, which="LM", return_eigenvectors=False)
    return np.sort(values)[1:]


def _lines(size, blocks, axis, longest):
    """Edges of elements along an axis: shorter by a ratio towards the planes of blocks."""
    planes = np.unique([0.0, size[axis], *(corner[axis] for block in blocks for corner in block)])
    edges = [planes[0]]
    for low, high in pairwise(planes):
        half = (high - low) / 2.0
        steps = half * RATIO ** np.arange(LEVELS + 1)
        ends = np.unique([low, high, *(low + steps), *(high - steps)])
        for start, stop in pairwise(ends):
            if stop - start > 1e-12:
                edges.extend(
                    np.linspace(start, stop, int(np.ceil((stop - start) / longest)) + 1)[1:]
                )
    return np.array(edges)


def _on_the_unit_interval():
    points = np.array([-1.0, *np.sort(Legendre.basis(ORDER).deriv().roots().real), 1.0])
    at, weight = leggauss(ORDER + 1)
    inverse = np.linalg.inv(legvander(points, ORDER))
    values = legvander(at, ORDER) @ inverse
    slopes = np.stack([Legendre.basis(n).deriv()(at) for n in range(ORDER + 1)], axis=1) @ inverse
    return values.T * weight @ values / 2.0, slopes.T * weight @ slopes * 2.0
