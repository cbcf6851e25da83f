"""Compiled parts of a time step: sums on the sides, fluxes at faces, the series a step on."""

from typing import Any

import numba
import numpy as np

kernel = numba.njit(cache=True, nogil=True, error_model="numpy")
fast_kernel = numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)


@fast_kernel
def sum_on_sides(
    now: Any, shapes: Any, terms: Any, sides: Any, sums: Any
) -> None:  # pragma: no cover
    """Series of the pressure on each side of each box: sums over the axis across it."""
    sums[:] = 0.0
    for box in range(shapes.shape[0]):
        nx, ny, nz = shapes[box]
        a = now[terms[box] : terms[box + 1]].reshape(nx, ny, nz)
        start = sides[box]
        x = sums[start[0, 0] : start[0, 0] + 2 * ny * nz].reshape(2, ny, nz)
        y = sums[start[1, 0] : start[1, 0] + 2 * nx * nz].reshape(2, nx, nz)
        z = sums[start[2, 0] : start[2, 0] + 2 * nx * ny].reshape(2, nx, ny)
        for i in range(nx):
            for j in range(ny):
                row, x_row, y_row = a[i, j], x[i % 2, j], y[j % 2, i]
                even, odd = 0.0, 0.0
                for k in range(nz):
                    x_row[k] += row[k]
                    y_row[k] += row[k]
                for k in range(0, nz, 2):
                    even += row[k]
                for k in range(1, nz, 2):
                    odd += row[k]
                z[0, i, j], z[1, i, j] = even, odd
        _ends_of_parities(x)
        _ends_of_parities(y)
        _ends_of_parities(z)


@kernel
def _ends_of_parities(planes: Any) -> None:  # pragma: no cover
    """Change even and odd terms to values at the lower and the upper end, and back but for 1/2."""
    for i in range(planes.shape[1]):
        for j in range(planes.shape[2]):
            even, odd = planes[0, i, j], planes[1, i, j]
            planes[0, i, j], planes[1, i, j] = even + odd, even - odd


@kernel
def to_nodes(
    sums: Any, ends: Any, matrices: Any, pressure: Any, work: Any
) -> None:  # pragma: no cover
    """Pressure at the nodes of every end of a face."""
    for end in range(ends.shape[0]):
        side, n1, n2, node, m1, m2, left_start, right, _, _, left_out = ends[end]
        if left_out:
            pressure[node : node + m1 * m2] = sums[side : side + n1 * n2]
            continue
        plane = sums[side : side + n1 * n2].reshape(n1, n2)
        half = work[: m1 * n2].reshape(m1, n2)
        np.dot(matrices[left_start : left_start + m1 * n1].reshape(m1, n1), plane, half)
        nodes = pressure[node : node + m1 * m2].reshape(m1, m2)
        np.dot(half, matrices[right : right + n2 * m2].reshape(n2, m2), nodes)


@kernel
def to_sides(
    flux: Any, ends: Any, matrices: Any, sides: Any, work: Any
) -> None:  # pragma: no cover
    """Flux of every side of the boxes from that at the nodes of its faces."""
    sides[:] = 0.0
    for end in range(ends.shape[0]):
        side, n1, n2, node, m1, m2, _, _, left_start, right, left_out = ends[end]
        plane = sides[side : side + n1 * n2]
        if left_out:
            plane += flux[node : node + m1 * m2]
            continue
        nodes = flux[node : node + m1 * m2].reshape(m1, m2)
        half = work[: m1 * n2].reshape(m1, n2)
        np.dot(nodes, matrices[right : right + m2 * n2].reshape(m2, n2), half)
        product = work[m1 * n2 : m1 * n2 + n1 * n2].reshape(n1, n2)
        np.dot(matrices[left_start : left_start + n1 * m1].reshape(n1, m1), half, product)
        plane += product.ravel()


@kernel
def step_series(
    now: Any, before: Any, turn: Any, gain: Any, flux: Any, layout: Any
) -> None:  # pragma: no cover
    """The series a step on, written over the one before: turn now - before - gain flux.

    The planes of the flux are overwritten by their even and odd parts.
    """
    shapes, terms, sides, norms, norm_starts = layout
    for box in range(shapes.shape[0]):
        nx, ny, nz = shapes[box]
        first, last = terms[box], terms[box + 1]
        a, b = now[first:last].reshape(nx, ny, nz), before[first:last].reshape(nx, ny, nz)
        t, g = turn[first:last].reshape(nx, ny, nz), gain[first:last].reshape(nx, ny, nz)
        start = sides[box]
        x = flux[start[0, 0] : start[0, 0] + 2 * ny * nz].reshape(2, ny, nz)
        y = flux[start[1, 0] : start[1, 0] + 2 * nx * nz].reshape(2, nx, nz)
        z = flux[start[2, 0] : start[2, 0] + 2 * nx * ny].reshape(2, nx, ny)
        _ends_of_parities(x)
        _ends_of_parities(y)
        _ends_of_parities(z)
        wx, wy = norms[norm_starts[box, 0] :], norms[norm_starts[box, 1] :]
        wz = norms[norm_starts[box, 2] : norm_starts[box, 2] + nz]
        for i in range(nx):
            for j in range(ny):
                x_row, y_row = x[i % 2, j], y[j % 2, i]
                even, odd = z[0, i, j], z[1, i, j]
                now_row, before_row, turn_row, gain_row = a[i, j], b[i, j], t[i, j], g[i, j]
                across_x, across_y = wx[i], wy[j]
                for k in range(nz):
                    across = odd if k % 2 else even
                    push = across_x * x_row[k] + across_y * y_row[k] + wz[k] * across
                    before_row[k] = turn_row[k] * now_row[k] - before_row[k] - gain_row[k] * push


@kernel
def pass_seams(pressure: Any, flux: Any, seams: Any, give: Any) -> None:  # pragma: no cover
    """Change of flux through joints of boxes by the difference of pressure across them.

    `joints` holds the first node of both ends and their number; `give` is c dt/(d1 + d2) by node.
    """
    for joint in range(seams.shape[0]):
        first, second, count = seams[joint]
        for node in range(count):
            change = give[first + node] * (pressure[first + node] - pressure[second + node])
            flux[first + node] = change
            flux[second + node] = -change
