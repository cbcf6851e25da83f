"""One time step of the machine side: compiled loops over cells, faces and absorbing layers."""

from collections.abc import Sequence
from typing import Any, Final

import numba
import numpy as np
from numpy.typing import NDArray

from .arrays import Array
from .near_grid import NearGrid

_kernel = numba.njit(cache=True, nogil=True)

PRECISION: Final = np.float32
"""Double precision changes the pressure at a microphone by less than 0.003 dB from 48 Hz up."""
BYTES_PER_CELL: Final = 11 * 4
"""Eleven fields in single precision."""


class Fields:
    """Pressure, scaled fluxes and split pressure of one run, updated in place.

    The flux variable is A_f u_f rho h/dt with the open share A_f of a face and the grid's spacing
    h, so that a step is: subtract a pressure difference, then a flux difference, each times h over
    the distance between its ends. Faces at the ends of the grid stay closed. The split of the
    pressure matters in the absorbing layers only.

    Across the first face along each of the axes `odd` the pressure is odd: as large on the other
    side, of the other sign.
    """

    def __init__(
        self, grid: NearGrid, open_areas: Sequence[Array], volumes: Array, odd: Sequence[int]
    ) -> None:
        self.pressure = np.zeros(grid.shape, PRECISION)
        self._flux = tuple(np.zeros(area.shape, PRECISION) for area in open_areas)
        self._split = tuple(np.zeros(grid.shape, PRECISION) for _ in range(3))
        self._areas = tuple(area.astype(PRECISION) for area in open_areas)
        inverse = np.divide(1.0, volumes, out=np.zeros(grid.shape), where=volumes > 0)
        self._gain = (grid.courant_number**2 * inverse).astype(PRECISION)
        self._plain = _plain_rows(open_areas, volumes)
        damping = [grid.absorption(axis) for axis in range(3)]
        self._cell_damping = tuple(cell.astype(PRECISION) for cell, _ in damping)
        self._face_damping = tuple(face.astype(PRECISION) for _, face in damping)
        self._slopes = tuple(
            (grid.spacing_m / grid.gaps(axis)).astype(PRECISION) for axis in range(3)
        )
        self._squeezes = tuple(
            (grid.spacing_m / grid.widths(axis)).astype(PRECISION) for axis in range(3)
        )
        self._plain_gain = PRECISION(grid.courant_number**2)
        self._undamped = _undamped(self._cell_damping[2])
        self._released = [self._at_first_face(axis) for axis in odd]

    def _at_first_face(self, axis: int) -> tuple[Any, Any, Any]:
        """Flux through the first faces along an axis, factor, pressure behind them."""
        first = (slice(None),) * axis + (0,)
        factor = PRECISION(2.0) * self._squeezes[axis][0] * self._areas[axis][first]
        return self._flux[axis][first], factor, self.pressure[first]

    def advance(self) -> None:
        """One step of fluxes and pressure."""
        for flux, factor, pressure in self._released:
            np.subtract(flux, factor * pressure, out=flux)
        step: Any = _advance  # numba's types do not tell its arguments
        step(
            self.pressure,
            *self._flux,
            *self._split,
            *self._areas,
            self._gain,
            self._plain,
            *self._cell_damping,
            *self._face_damping,
            *self._slopes,
            *self._squeezes,
            *self._undamped,
            self._plain_gain,
        )

    def add(self, cells: NDArray[np.intp], pressure: Array) -> None:
        """Add pressure to cells outside the absorbing layers."""
        self.pressure.reshape(-1)[cells] += pressure


def _plain_rows(open_areas: Sequence[Array], volumes: Array) -> NDArray[np.bool_]:
    """Rows along z, (x, y), none of whose cells and faces is cut."""
    x, y, z = (area == 1.0 for area in open_areas)
    plain: NDArray[np.bool_] = (
        (x[1:] & x[:-1]).all(axis=2) & (y[:, 1:] & y[:, :-1]).all(axis=2) & z.all(axis=2)
    )
    plain &= (volumes == 1.0).all(axis=2)
    return plain


def _undamped(damping: Array) -> tuple[int, int]:
    """First and last cell, exclusive, of an axis outside its absorbing layers."""
    inside = np.flatnonzero(damping == 1.0)
    return int(inside[0]), int(inside[-1]) + 1


@_kernel
def _advance(
    p: Any,
    fx: Any,
    fy: Any,
    fz: Any,
    sx: Any,
    sy: Any,
    sz: Any,
    ax: Any,
    ay: Any,
    az: Any,
    gain: Any,
    plain: Any,
    cx: Any,
    cy: Any,
    cz: Any,
    dx: Any,
    dy: Any,
    dz: Any,
    gx: Any,
    gy: Any,
    gz: Any,
    wx: Any,
    wy: Any,
    wz: Any,
    start: int,
    stop: int,
    plain_gain: Any,
) -> None:  # pragma: no cover
    """Planes along x in order: fluxes that need the old pressure, then the plane's pressure.

    Every inner loop runs over a whole row and touches few arrays: that is what compilers vectorise.
    """
    nx, ny, _ = p.shape
    for i in range(nx):
        for j in range(ny):
            if i + 1 < nx:
                _flow_x(fx, ax, plain[i, j], p, i, j, dx[i], gx[i])
            if j + 1 < ny:
                _flow_y(fy, ay, plain[i, j], p, i, j, dy[j], gy[j])
            _flow_along(fz, az, plain[i, j], p, i, j, dz, gz)
        for j in range(ny):
            x, y, c, d = plain_gain * wx[i], plain_gain * wy[j], cx[i], cy[j]
            if c != 1.0 or d != 1.0:
                _absorb_row(p, fx, fy, fz, sx, sy, sz, c, d, cz, i, j, x, y, wz, plain_gain)
            else:
                _compress(p, fx, fy, fz, gain, plain[i, j], i, j, wx[i], wy[j], wz, plain_gain)
                _absorb_ends(p, fx, fy, fz, sx, sy, sz, cz, i, j, 0, start, x, y, wz, plain_gain)
                _absorb_ends(
                    p, fx, fy, fz, sx, sy, sz, cz, i, j, stop, p.shape[2], x, y, wz, plain_gain
                )


@_kernel
def _flow_x(
    fx: Any, ax: Any, plain: bool, p: Any, i: int, j: int, damping: Any, slope: Any
) -> None:  # pragma: no cover
    """Flux through a row of faces across x, driven by the pressure on both sides."""
    if plain:
        for k in range(p.shape[2]):
            drop = slope * (p[i, j, k] - p[i + 1, j, k])
            fx[i + 1, j, k] = damping * (damping * fx[i + 1, j, k] + drop)
    else:
        for k in range(p.shape[2]):
            drop = slope * ax[i + 1, j, k] * (p[i, j, k] - p[i + 1, j, k])
            fx[i + 1, j, k] = damping * (damping * fx[i + 1, j, k] + drop)


@_kernel
def _flow_y(
    fy: Any, ay: Any, plain: bool, p: Any, i: int, j: int, damping: Any, slope: Any
) -> None:  # pragma: no cover
    """Flux through a row of faces across y, driven by the pressure on both sides."""
    if plain:
        for k in range(p.shape[2]):
            drop = slope * (p[i, j, k] - p[i, j + 1, k])
            fy[i, j + 1, k] = damping * (damping * fy[i, j + 1, k] + drop)
    else:
        for k in range(p.shape[2]):
            drop = slope * ay[i, j + 1, k] * (p[i, j, k] - p[i, j + 1, k])
            fy[i, j + 1, k] = damping * (damping * fy[i, j + 1, k] + drop)


@_kernel
def _flow_along(
    fz: Any, az: Any, plain: bool, p: Any, i: int, j: int, damping: Any, slope: Any
) -> None:  # pragma: no cover
    """Flux through the faces of a row along z."""
    if plain:
        for k in range(p.shape[2] - 1):
            drop = slope[k] * (p[i, j, k] - p[i, j, k + 1])
            fz[i, j, k + 1] = damping[k] * (damping[k] * fz[i, j, k + 1] + drop)
    else:
        for k in range(p.shape[2] - 1):
            drop = slope[k] * az[i, j, k + 1] * (p[i, j, k] - p[i, j, k + 1])
            fz[i, j, k + 1] = damping[k] * (damping[k] * fz[i, j, k + 1] + drop)


@_kernel
def _compress(
    p: Any,
    fx: Any,
    fy: Any,
    fz: Any,
    gain: Any,
    plain: bool,
    i: int,
    j: int,
    x: Any,
    y: Any,
    wz: Any,
    plain_gain: Any,
) -> None:  # pragma: no cover
    """Pressure of a row outside the absorbing layers of x and y."""
    if plain:
        for k in range(p.shape[2]):
            net = x * (fx[i + 1, j, k] - fx[i, j, k]) + y * (fy[i, j + 1, k] - fy[i, j, k])
            p[i, j, k] -= plain_gain * (net + wz[k] * (fz[i, j, k + 1] - fz[i, j, k]))
    else:
        for k in range(p.shape[2]):
            net = x * (fx[i + 1, j, k] - fx[i, j, k]) + y * (fy[i, j + 1, k] - fy[i, j, k])
            p[i, j, k] -= gain[i, j, k] * (net + wz[k] * (fz[i, j, k + 1] - fz[i, j, k]))


@_kernel
def _absorb_row(
    p: Any,
    fx: Any,
    fy: Any,
    fz: Any,
    sx: Any,
    sy: Any,
    sz: Any,
    c: Any,
    d: Any,
    cz: Any,
    i: int,
    j: int,
    x: Any,
    y: Any,
    wz: Any,
    gain: Any,
) -> None:  # pragma: no cover
    """Split pressure of a whole row within an absorbing layer of x or y; no wall is there."""
    for k in range(p.shape[2]):
        sx[i, j, k] = c * (c * sx[i, j, k] - x * (fx[i + 1, j, k] - fx[i, j, k]))
    for k in range(p.shape[2]):
        sy[i, j, k] = d * (d * sy[i, j, k] - y * (fy[i, j + 1, k] - fy[i, j, k]))
    for k in range(p.shape[2]):
        gain_z = gain * wz[k]
        sz[i, j, k] = cz[k] * (cz[k] * sz[i, j, k] - gain_z * (fz[i, j, k + 1] - fz[i, j, k]))
    for k in range(p.shape[2]):
        p[i, j, k] = sx[i, j, k] + sy[i, j, k] + sz[i, j, k]


@_kernel
def _absorb_ends(
    p: Any,
    fx: Any,
    fy: Any,
    fz: Any,
    sx: Any,
    sy: Any,
    sz: Any,
    cz: Any,
    i: int,
    j: int,
    start: int,
    stop: int,
    x: Any,
    y: Any,
    wz: Any,
    gain: Any,
) -> None:  # pragma: no cover
    """Split pressure of the cells of a row within an absorbing layer of z only."""
    for k in range(start, stop):
        sx[i, j, k] -= x * (fx[i + 1, j, k] - fx[i, j, k])
        sy[i, j, k] -= y * (fy[i, j + 1, k] - fy[i, j, k])
        gain_z = gain * wz[k]
        sz[i, j, k] = cz[k] * (cz[k] * sz[i, j, k] - gain_z * (fz[i, j, k + 1] - fz[i, j, k]))
        p[i, j, k] = sx[i, j, k] + sy[i, j, k] + sz[i, j, k]
