"""Sound radiated by vibrating bodies in free field, by boundary elements (bempp-cl).

A second method beside the package's cut cells: it shares no code with `vibroacoustics` and runs in
its own environment (see README.md). Every body is a surface of revolution about the z axis.

Indirect formulation of Brakhage and Werner (1965) for exterior Neumann problems, free of spurious
resonances: p = (D - jk S) psi outside, so W psi + jk (K' - 1/2) psi = -dp/dn on the surface.
Galerkin, continuous linear elements. Inside this file the time factor is bempp's exp(-j omega t);
the written pressures are conjugated to the package's exp(+j omega t).
"""

import argparse
import csv
import datetime
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Final

import bempp_cl.api as bempp
import numpy as np
import numpy.typing as npt
from bempp_cl.api.integration.triangle_gauss import rule
from bempp_cl.api.space.space import FunctionSpace
from scipy import linalg, special

Array = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
IndexArray = npt.NDArray[np.intp]

SPEED_OF_SOUND_M_PER_S: Final = 343.0
AIR_DENSITY_KG_PER_M3: Final = 1.2
FREQUENCIES_HZ: Final = (48.0, 117.0, 250.0, 500.0, 1000.0, 1500.0, 2000.0)
MORE_FREQUENCIES_HZ: Final = (3000.0, 4000.0)
"""Only for the body `cylinder`."""
COARSE_M: Final = 0.020
FINE_M: Final = 0.013
SECTORS: Final = 12
"""Equal sectors of every mesh; operators are assembled for the test functions of one of them."""
QUADRATURE_ORDER: Final = 4
RELEVANT_DB: Final = 20.0
"""Microphones this far below the loudest one are left out of the printed differences."""

COLUMNS: Final = (
    "body",
    "pattern",
    "frequency_hz",
    "microphone",
    "x_m",
    "y_m",
    "z_m",
    "pressure_real_pa",
    "pressure_imaginary_pa",
    "uncertainty_db",
)

# Hemisphere of ISO 3744, annex B, before each point is put at exactly one metre.
_HEMISPHERE: Final = (
    (0.16, -0.96, 0.22),
    (0.78, -0.60, 0.20),
    (0.78, 0.55, 0.31),
    (0.16, 0.90, 0.41),
    (-0.83, 0.32, 0.45),
    (-0.83, -0.40, 0.38),
    (-0.26, -0.65, 0.71),
    (0.74, -0.07, 0.67),
    (-0.26, 0.50, 0.83),
    (0.10, -0.10, 0.99),
)
MICROPHONES: Final[Array] = np.array(_HEMISPHERE) / np.linalg.norm(_HEMISPHERE, axis=1)[:, None]


@dataclass(frozen=True)
class Body:
    """Upright cylinder with flat or half-ellipsoidal caps; a sphere is two caps."""

    name: str
    radius_m: float
    bottom_z_m: float
    top_z_m: float
    cap_m: float = 0.0
    """Height of each cap; 0 is flat."""
    rim: float = 1.0
    """Element size at the rims of the caps, as a share of the size elsewhere."""


CYLINDER: Final = Body("cylinder", 0.0825, -0.190, 0.227, rim=0.2)
DOMED: Final = Body("domed", 0.0825, -0.190, 0.227, cap_m=0.040, rim=0.6)
LARGE_CYLINDER: Final = Body("large_cylinder", 0.121, -0.2085, 0.2085, rim=0.2)
SPHERE: Final = Body("sphere", 0.12, -0.12, 0.12, cap_m=0.12)
_RIM_WIDTH_M: Final = 0.03

Velocity = Callable[[Array], Array]
"""Points (..., 3) -> velocity vectors (..., 3)."""


def rigid_motions() -> dict[str, Velocity]:
    """Translations e and rotations e x r about the origin, along and about x, y and z."""
    motions: dict[str, Velocity] = {}
    for name, axis in zip("xyz", np.eye(3), strict=True):
        motions[f"t{name}"] = lambda points, axis=axis: np.broadcast_to(axis, points.shape)
        motions[f"r{name}"] = lambda points, axis=axis: np.cross(axis, points)
    return motions


def patterns(body: Body) -> dict[str, Velocity]:
    """Surface velocities of a body, in m/s."""

    def height(points: Array) -> Array:
        return (points[..., 2:] - body.bottom_z_m) / (body.top_z_m - body.bottom_z_m)

    def beam(points: Array) -> Array:
        return np.cos(2 * np.pi * height(points)) * np.array([1.0, 0.0, 0.0])

    def oval(points: Array) -> Array:
        radial = points * [1.0, 1.0, 0.0]
        angle = np.arctan2(points[..., 1:2], points[..., :1])
        direction = radial / np.maximum(np.linalg.norm(radial, axis=-1, keepdims=True), 1e-12)
        return np.cos(2 * angle) * np.sin(np.pi * height(points)) * direction

    rigid = rigid_motions()
    return {name: rigid[name] for name in ("tx", "tz", "ry")} | {"beam": beam, "oval": oval}


def sphere_patterns() -> dict[str, Velocity]:
    """Normal velocities P_n(cos theta) of a sphere about the origin, n = 0 to 3."""

    def legendre(points: Array, order: int) -> Array:
        radial = points / np.linalg.norm(points, axis=-1, keepdims=True)
        return special.eval_legendre(order, radial[..., 2:]) * radial

    return {f"P{n}": lambda points, n=n: legendre(points, n) for n in range(4)}


def exact_sphere(order: int, frequency_hz: float) -> ComplexArray:
    """Pressure at the microphones of the sphere with the normal velocity P_n(cos theta), Pa.

    Morse and Ingard, Theoretical Acoustics (1968), section 7.2, for exp(+j omega t).
    """
    k = 2 * np.pi * frequency_hz / SPEED_OF_SOUND_M_PER_S

    def hankel(argument: float, derivative: bool) -> complex:
        real = special.spherical_jn(order, argument, derivative)
        return complex(real - 1j * special.spherical_yn(order, argument, derivative))

    radial = hankel(k, False) / hankel(k * SPHERE.radius_m, True)
    impedance = AIR_DENSITY_KG_PER_M3 * SPEED_OF_SOUND_M_PER_S
    pressure: ComplexArray = (
        -1j * impedance * radial * special.eval_legendre(order, MICROPHONES[:, 2])
    )
    return pressure


@dataclass(frozen=True)
class Mesh:
    """Closed triangle mesh with normals outwards, which a turn by one sector maps onto itself."""

    vertices: Array
    triangles: IndexArray
    in_first_sector: npt.NDArray[np.bool_]
    turned: IndexArray
    """Vertex onto which each vertex falls when the mesh turns by one sector."""


def meridian(body: Body, size_m: float) -> tuple[Array, Array, Array]:
    """Nodes (r, z) of a body's meridian from top to bottom, normals and local element sizes.

    The normal is that of the curved wall; on the flat caps it is zero, on their rims radial.
    """
    radius, cap = body.radius_m, body.cap_m
    top, bottom = body.top_z_m - cap, body.bottom_z_m + cap
    share = np.linspace(0.0, 1.0, 20001)
    angle = np.pi / 2 * share
    across = radius * (np.sin(angle) if cap else share)
    pieces = [
        _divide(np.column_stack([across, top + cap * np.cos(angle)]), body, size_m)[:-1],
        _divide(np.column_stack([across, bottom - cap * np.cos(angle)]), body, size_m)[::-1],
    ]
    if top > bottom:
        straight = np.column_stack([np.full_like(share, radius), top + (bottom - top) * share])
        pieces.insert(1, _divide(straight, body, size_m, both_rims=True)[:-1])
    nodes = np.concatenate(pieces)
    points, sizes = nodes[:, :2], nodes[:, 2]
    if cap:
        above = points[:, 1] - np.clip(points[:, 1], bottom, top)
        normals = np.column_stack([points[:, 0] / radius**2, above / cap**2])
        return points, normals / np.linalg.norm(normals, axis=1, keepdims=True), sizes
    wall = points[:, 0] > radius * (1 - 1e-9)
    return points, np.column_stack([wall, np.zeros_like(wall)]).astype(float), sizes


def _divide(curve: Array, body: Body, size_m: float, both_rims: bool = False) -> Array:
    """Nodes (r, z, local element size) on a curve that ends at a rim, or also starts at one."""
    step = np.linalg.norm(np.diff(curve, axis=0), axis=1)
    length = np.concatenate([[0.0], np.cumsum(step)])
    from_rim = length[-1] - length
    if both_rims:
        from_rim = np.minimum(from_rim, length)
    size = size_m * (body.rim + (1 - body.rim) * np.minimum(1.0, from_rim / _RIM_WIDTH_M))
    count = np.concatenate([[0.0], np.cumsum(2 * step / (size[1:] + size[:-1]))])
    rows = int(np.ceil(count[-1] * 2 / np.sqrt(3)))
    at = np.interp(np.linspace(0.0, count[-1], rows + 1), count, length)
    return np.column_stack([np.interp(at, length, values) for values in (*curve.T, size)])


def mesh(body: Body, size_m: float) -> Mesh:
    """Mesh of a body by rings of nearly equilateral triangles with sides of about `size_m`.

    The vertices lie slightly outside the body, so that the facets lie on it in the mean.
    """
    points, direction, sizes = meridian(body, size_m)
    vertices, normals, turned, rings = [], [], [], []
    total = 0
    for row, ((radius, z), (n_r, n_z), size) in enumerate(
        zip(points, direction, sizes, strict=True)
    ):
        pole = row in (0, len(points) - 1)
        around = 1 if pole else SECTORS * max(1, round(2 * np.pi * radius / size / SECTORS))
        angle = 2 * np.pi * (np.arange(around) + row % 2 / 2) / around
        cosine, sine, one = np.cos(angle), np.sin(angle), np.ones(around)
        across = 0.0 if pole else radius
        vertices.append(np.column_stack([across * cosine, across * sine, z * one]))
        normals.append(np.column_stack([n_r * cosine, n_r * sine, n_z * one]))
        if pole:
            normals[-1][:, :2] = 0.0
        rings.append(total + np.arange(around))
        turned.append(np.roll(rings[-1], 0 if pole else -around // SECTORS))
        total += around
    turn = np.concatenate(turned)
    sector = np.concatenate(
        [_stitch(*rings[row : row + 2], row % 2 / 2) for row in range(len(rings) - 1)]
    )
    copies = [sector]
    for _ in range(SECTORS - 1):
        copies.append(turn[copies[-1]])
    triangles = np.concatenate(copies)
    first = np.arange(len(triangles)) < len(sector)
    placed = _outwards(np.concatenate(vertices), np.concatenate(normals), triangles)
    return Mesh(placed, triangles, first, turn)


def _stitch(upper: IndexArray, lower: IndexArray, shift: float) -> IndexArray:
    """Triangles between one sector of two rings; a ring of one vertex is a pole."""
    counts = [len(ring) // SECTORS for ring in (upper, lower)]
    i = j = 0
    triangles = []
    while i < counts[0] or j < counts[1]:
        a, b = upper[i % len(upper)], lower[j % len(lower)]
        ahead = (i + 1 + shift) * counts[1] - (j + 1 + 0.5 - shift) * counts[0]
        if i == counts[0] or (j < counts[1] and ahead > 0):
            j += 1
            triangles.append((a, b, lower[j % len(lower)]))
        else:
            i += 1
            triangles.append((a, b, upper[i % len(upper)]))
    return np.array(triangles)


def _outwards(vertices: Array, normals: Array, triangles: IndexArray) -> Array:
    """Vertices moved along the normals by the mean gap between the facets and the wall."""
    curved = triangles[np.ptp(vertices[triangles, 2], axis=1) > 1e-9]
    gap = np.zeros(len(curved))
    for one, other in ((0, 1), (1, 2), (2, 0)):
        edge = vertices[curved[:, other]] - vertices[curved[:, one]]
        gap += np.sum(edge * (normals[curved[:, other]] - normals[curved[:, one]]), axis=1) / 24
    weight, total = np.zeros((2, len(vertices)))
    np.add.at(weight, curved, 1.0)
    np.add.at(total, curved, gap[:, None])
    return vertices + normals * (total / np.maximum(weight, 1.0))[:, None]


class Radiation:
    """Pressures at the microphones of a body that vibrates in free field."""

    def __init__(self, shape: Mesh, by_sectors: bool = True) -> None:
        bempp.DEFAULT_DEVICE_INTERFACE = "numba"
        bempp.GLOBAL_PARAMETERS.quadrature.regular = QUADRATURE_ORDER
        self._shape = shape
        grid = bempp.Grid(
            np.ascontiguousarray(shape.vertices.T),
            np.ascontiguousarray(shape.triangles.T.astype(np.uint32)),
            np.where(shape.in_first_sector, 1, 2).astype(np.uint32),
        )
        self._trial = bempp.function_space(grid, "P", 1)
        options = {
            "segments": [1],
            "include_boundary_dofs": True,
            "truncate_at_segment_edge": True,
        }
        self._test = bempp.function_space(grid, "P", 1, **options) if by_sectors else self._trial
        self._by_sectors = by_sectors
        self._columns = self._vertices_of(self._trial)
        self._rows = self._vertices_of(self._test)

    def _vertices_of(self, space: FunctionSpace) -> IndexArray:
        """Vertex of each degree of freedom of a space."""
        vertices = np.full(space.global_dof_count, -1, dtype=np.intp)
        used = space.local_multipliers != 0
        vertices[space.local2global[used]] = self._shape.triangles[used]
        assert np.all(vertices >= 0)
        return vertices

    def matrix(self, frequency_hz: float) -> ComplexArray:
        """Matrix of W + jk (K' - 1/2) over the vertices."""
        k = 2 * np.pi * frequency_hz / SPEED_OF_SOUND_M_PER_S
        boundary = bempp.operators.boundary
        spaces = (self._trial, self._trial, self._test)
        part = boundary.helmholtz.hypersingular(*spaces, k).weak_form().to_dense()
        adjoint = boundary.helmholtz.adjoint_double_layer(*spaces, k).weak_form().to_dense()
        identity = boundary.sparse.identity(*spaces).weak_form().to_dense()
        part = part + 1j * k * (adjoint - identity / 2)
        rows, columns = self._rows, self._columns
        whole = np.zeros((len(columns), len(columns)), dtype=complex)
        for _ in range(SECTORS if self._by_sectors else 1):
            whole[np.ix_(rows, columns)] += part
            rows, columns = self._shape.turned[rows], self._shape.turned[columns]
        return whole

    def load(self, velocities: Iterable[Velocity]) -> Array:
        """Normal velocities against the linear functions of the vertices, (vertex, pattern)."""
        corners = self._shape.vertices[self._shape.triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        (u, v), weights = rule(6)
        shares = np.array([1 - u - v, u, v])
        points = np.einsum("cq,tcx->tqx", shares, corners)
        columns = []
        for velocity in velocities:
            flux = np.einsum("tqx,tx->tq", velocity(points), normals)
            column = np.zeros(len(self._shape.vertices))
            np.add.at(
                column, self._shape.triangles, np.einsum("tq,q,cq->tc", flux, weights, shares)
            )
            columns.append(column)
        return np.column_stack(columns)

    def pressures(self, velocities: Iterable[Velocity], frequency_hz: float) -> ComplexArray:
        """Pressure for exp(+j omega t), Pa, (pattern, microphone)."""
        omega = 2 * np.pi * frequency_hz
        k = omega / SPEED_OF_SOUND_M_PER_S
        slope = 1j * omega * AIR_DENSITY_KG_PER_M3 * self.load(velocities)
        density = linalg.lu_solve(
            linalg.lu_factor(self.matrix(frequency_hz), overwrite_a=True, check_finite=False),
            -slope,
        )
        potential = bempp.operators.potential.helmholtz
        double = potential.double_layer(self._trial, MICROPHONES.T, k)
        single = potential.single_layer(self._trial, MICROPHONES.T, k)
        fields = []
        for column in density.T:
            function = bempp.GridFunction(self._trial, coefficients=column[self._columns])
            fields.append(double.evaluate(function) - 1j * k * single.evaluate(function))
        result: ComplexArray = np.conj(np.concatenate(fields))
        return result


def solve(body: Body, size_m: float, frequencies_hz: Iterable[float]) -> ComplexArray:
    """Pressure of every pattern of a body, Pa, (frequency, pattern, microphone)."""
    shape = mesh(body, size_m)
    print(f"{body.name}: {len(shape.vertices)} vertices, {len(shape.triangles)} triangles")
    radiation = Radiation(shape)
    motions = (sphere_patterns() if body is SPHERE else patterns(body)).values()
    results = []
    for frequency_hz in frequencies_hz:
        start = time.perf_counter()
        results.append(radiation.pressures(motions, frequency_hz))
        print(f"  {frequency_hz:g} Hz: {time.perf_counter() - start:.1f} s", flush=True)
    return np.array(results)


def mean_difference_db(pressure: ComplexArray, reference: ComplexArray) -> Array:
    """Difference of the levels of the mean squares over the microphones (last axis), dB."""
    power = np.mean(np.abs(pressure) ** 2, axis=-1) / np.mean(np.abs(reference) ** 2, axis=-1)
    difference: Array = 10 * np.log10(power)
    return difference


def largest_difference_db(pressure: ComplexArray, reference: ComplexArray) -> Array:
    """Largest difference at one microphone within `RELEVANT_DB` of the loudest, dB."""
    magnitude = np.abs(reference)
    loudest = magnitude.max(axis=-1, keepdims=True)
    relevant = magnitude >= loudest * 10 ** (-RELEVANT_DB / 20)
    level = 20 * np.log10(np.abs(pressure) / np.where(relevant, magnitude, 1.0))
    largest: Array = np.where(relevant, np.abs(level), 0.0).max(axis=-1)
    return largest


def print_differences(
    names: Iterable[str],
    frequencies_hz: Iterable[float],
    pressure: ComplexArray,
    reference: ComplexArray,
) -> None:
    """Print a table of differences, mean and largest at one microphone, in dB."""
    names = list(names)
    mean = mean_difference_db(pressure, reference)
    largest = largest_difference_db(pressure, reference)
    print("| Hz | " + " | ".join(names) + " |")
    print("|---" * (len(names) + 1) + "|")
    for frequency_hz, *row in zip(frequencies_hz, mean, largest, strict=True):
        cells = [f"{a:+.4f}, {b:.4f}" for a, b in zip(*row, strict=True)]
        print(f"| {frequency_hz:g} | " + " | ".join(cells) + " |")


def prove() -> None:
    """Print the differences of vibrating spheres from the exact solution."""
    orders = range(len(sphere_patterns()))
    exact = np.array([[exact_sphere(n, f) for n in orders] for f in FREQUENCIES_HZ])
    for size_m in (COARSE_M, FINE_M):
        pressure = solve(SPHERE, size_m, FREQUENCIES_HZ)
        print_differences(sphere_patterns(), FREQUENCIES_HZ, pressure, exact)


def tabulate(path: Path) -> None:
    """Solve every body on both meshes; print the differences and write the finer results."""
    with path.open("w", newline="", encoding="utf-8") as file:
        file.write(
            f"# Made by run.py with bempp-cl {version('bempp-cl')} on {datetime.date.today()}.\n"
            "# Sound pressure in free field of a body whose surface moves with 1 m/s (tx, tz, beam,"
            " oval) or 1 rad/s (ry).\n"
            "# Time factor exp(+j omega t), peak values.\n"
            f"# c = {SPEED_OF_SOUND_M_PER_S:g} m/s, rho = {AIR_DENSITY_KG_PER_M3:g} kg/m3.\n"
            "# Indirect Brakhage-Werner formulation p = (D - jk S) psi, Galerkin, continuous linear"
            " elements.\n"
            f"# Quadrature order {QUADRATURE_ORDER}; element size {FINE_M:g} m, finer at the rims."
            f" uncertainty_db: against {COARSE_M:g} m, as a complex difference.\n"
        )
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(COLUMNS)
        for body in (CYLINDER, DOMED, LARGE_CYLINDER):
            frequencies_hz = FREQUENCIES_HZ + MORE_FREQUENCIES_HZ * (body is CYLINDER)
            coarse, fine = (solve(body, size, frequencies_hz) for size in (COARSE_M, FINE_M))
            names = list(patterns(body))
            print_differences(names, frequencies_hz, coarse, fine)
            uncertainty = 20 * np.log10(1 + np.abs(coarse / fine - 1))
            for f, n, m in np.ndindex(fine.shape):
                value = fine[f, n, m]
                rows.writerow(
                    [body.name, names[n], f"{frequencies_hz[f]:g}", m + 1]
                    + [f"{coordinate:.9f}" for coordinate in MICROPHONES[m]]
                    + [f"{value.real:.9e}", f"{value.imag:.9e}", f"{uncertainty[f, n, m]:.4f}"]
                )


def main() -> None:
    """Print the proof and write the results."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--out", type=Path, default=Path(__file__).with_name("results.csv"))
    prove()
    tabulate(parser.parse_args().out)


if __name__ == "__main__":
    main()
