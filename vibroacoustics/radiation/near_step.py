"""One time step of the machine side: compiled loops over cells, faces and absorbing layers."""

from typing import Any, Final

import numba
import numpy as np
from numpy.typing import NDArray

from .arrays import Array
from .cut_cells import CutCells
from .near_grid import COURANT_NUMBER, NearGrid

_PLAIN_GAIN: Final = COURANT_NUMBER**2
BYTES_PER_CELL: Final = 120
"""Of a run and its geometry, at eight bytes a number; see `NearField` for what is recorded."""


class Fields:
    """Pressure, scaled fluxes and split pressure of one run, updated in place.

    The flux variable is A_f u_f rho dx/dt, so that a step is: subtract a pressure difference, then
    subtract a flux difference. Faces at the ends of the grid stay closed. The split of the pressure
    matters in the absorbing layers only.
    """

    def __init__(self, grid: NearGrid, cells: CutCells) -> None:
        self.pressure = np.zeros(grid.shape)
        self._flux = tuple(np.zeros(area.shape) for area in cells.open_areas)
        self._split = tuple(np.zeros(grid.shape) for _ in range(3))
        self._areas = cells.open_areas
        self._gain = COURANT_NUMBER**2 * np.divide(
            1.0, cells.volumes, out=np.zeros(grid.shape), where=cells.volumes > 0
        )
        self._plain = _plain_rows(cells)
        damping = [grid.absorption(axis) for axis in range(3)]
        self._cell_damping = tuple(cell for cell, _ in damping)
        self._face_damping = tuple(face for _, face in damping)
        self._undamped = _undamped(self._cell_damping[2])

    def advance(self) -> None:
        """One step of fluxes and pressure."""
        _advance(
            self.pressure,
            *self._flux,
            *self._split,
            *self._areas,
            self._gain,
            self._plain,
            *self._cell_damping,
            *self._face_damping,
            *self._undamped,
        )

    def add(self, cells: NDArray[np.intp], pressure: Array) -> None:
        """Add pressure to cells outside the absorbing layers."""
        self.pressure.reshape(-1)[cells] += pressure


def _plain_rows(cells: CutCells) -> NDArray[np.bool_]:
    """Rows along z, (x, y), none of whose cells and faces is cut."""
    x, y, z = (area == 1.0 for area in cells.open_areas)
    plain: NDArray[np.bool_] = (
        (x[1:] & x[:-1]).all(axis=2) & (y[:, 1:] & y[:, :-1]).all(axis=2) & z.all(axis=2)
    )
    return plain & (cells.volumes == 1.0).all(axis=2)


def _undamped(damping: Array) -> tuple[int, int]:
    """First and last cell, exclusive, of an axis outside its absorbing layers."""
    inside = np.flatnonzero(damping == 1.0)
    return int(inside[0]), int(inside[-1]) + 1


@numba.njit(cache=True, nogil=True)  # type: ignore[misc]
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
    start: int,
    stop: int,
) -> None:  # pragma: no cover
    """Planes along x in order: fluxes that need the old pressure, then the plane's pressure."""
    nx, ny, nz = p.shape
    for i in range(nx):
        if i + 1 < nx:
            for j in range(ny):
                _flow(fx[i + 1, j], ax[i + 1, j], plain[i, j], p[i, j], p[i + 1, j], dx[i])
        for j in range(ny - 1):
            _flow(fy[i, j + 1], ay[i, j + 1], plain[i, j], p[i, j], p[i, j + 1], dy[j])
        for j in range(ny):
            row = p[i, j]
            flux, area = fz[i, j, 1:-1], az[i, j, 1:-1]
            _flow_along(flux, area, plain[i, j], row[:-1], row[1:], dz)
        for j in range(ny):
            if cx[i] != 1.0 or cy[j] != 1.0:
                _absorb(p, fx, fy, fz, sx, sy, sz, cx, cy, cz, i, j, 0, nz)
                continue
            row, z = p[i, j], fz[i, j]
            _compress(
                row[start:stop],
                gain[i, j, start:stop],
                plain[i, j],
                fx[i, j, start:stop],
                fx[i + 1, j, start:stop],
                fy[i, j, start:stop],
                fy[i, j + 1, start:stop],
                z[start:stop],
                z[start + 1 : stop + 1],
            )
            _absorb(p, fx, fy, fz, sx, sy, sz, cx, cy, cz, i, j, 0, start)
            _absorb(p, fx, fy, fz, sx, sy, sz, cx, cy, cz, i, j, stop, nz)


@numba.njit(cache=True, nogil=True)  # type: ignore[misc]
def _flow(
    flux: Any, area: Any, plain: bool, low: Any, high: Any, damping: float
) -> None:  # pragma: no cover
    """Flux through a row of faces across x or y, driven by the pressure on both sides."""
    if not plain:
        for k in range(flux.size):
            flux[k] = damping * (damping * flux[k] - area[k] * (high[k] - low[k]))
    elif damping != 1.0:
        for k in range(flux.size):
            flux[k] = damping * (damping * flux[k] - (high[k] - low[k]))
    else:
        for k in range(flux.size):
            flux[k] -= high[k] - low[k]


@numba.njit(cache=True, nogil=True)  # type: ignore[misc]
def _flow_along(
    flux: Any, area: Any, plain: bool, low: Any, high: Any, damping: Any
) -> None:  # pragma: no cover
    """Flux through the faces of a row along z."""
    if plain:
        for k in range(flux.size):
            flux[k] = damping[k] * (damping[k] * flux[k] - (high[k] - low[k]))
    else:
        for k in range(flux.size):
            flux[k] = damping[k] * (damping[k] * flux[k] - area[k] * (high[k] - low[k]))


@numba.njit(cache=True, nogil=True)  # type: ignore[misc]
def _compress(
    p: Any, gain: Any, plain: bool, x0: Any, x1: Any, y0: Any, y1: Any, z0: Any, z1: Any
) -> None:  # pragma: no cover
    """Pressure of cells in a row outside the absorbing layers."""
    if plain:
        for k in range(p.size):
            p[k] -= _PLAIN_GAIN * (x1[k] - x0[k] + y1[k] - y0[k] + z1[k] - z0[k])
    else:
        for k in range(p.size):
            p[k] -= gain[k] * (x1[k] - x0[k] + y1[k] - y0[k] + z1[k] - z0[k])


@numba.njit(cache=True, nogil=True)  # type: ignore[misc]
def _absorb(
    p: Any,
    fx: Any,
    fy: Any,
    fz: Any,
    sx: Any,
    sy: Any,
    sz: Any,
    cx: Any,
    cy: Any,
    cz: Any,
    i: int,
    j: int,
    start: int,
    stop: int,
) -> None:  # pragma: no cover
    """Pressure of cells `start` to `stop` of a row within an absorbing layer; no wall is there."""
    split_x, split_y = sx[i, j, start:stop], sy[i, j, start:stop]
    split_z, row, z = sz[i, j, start:stop], p[i, j, start:stop], fz[i, j]
    _damp(split_x, fx[i, j, start:stop], fx[i + 1, j, start:stop], cx[i])
    _damp(split_y, fy[i, j, start:stop], fy[i, j + 1, start:stop], cy[j])
    z0, z1, damping = z[start:stop], z[start + 1 : stop + 1], cz[start:stop]
    for k in range(row.size):
        split_z[k] = damping[k] * (damping[k] * split_z[k] - _PLAIN_GAIN * (z1[k] - z0[k]))
    for k in range(row.size):
        row[k] = split_x[k] + split_y[k] + split_z[k]


@numba.njit(cache=True, nogil=True)  # type: ignore[misc]
def _damp(split: Any, low: Any, high: Any, damping: float) -> None:  # pragma: no cover
    for k in range(split.size):
        split[k] = damping * (damping * split[k] - _PLAIN_GAIN * (high[k] - low[k]))
