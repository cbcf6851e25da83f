"""Any number of rigid bodies and the bushings between them: grommets, springs, a tube."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, Final

import numpy as np
from scipy.linalg import eigh

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError

SYMMETRY: Final = 1e-9
"""Asymmetry and negative part of a matrix, relative to its largest entry, that pass as rounding."""


FREE: Final = 1e-12
"""A squared natural frequency below this part of the highest one is that of a free motion."""


_ALONG: Final = np.eye(3)


def _free() -> Array:
    return np.zeros((6, 6))


class _ByContent:
    """Base of dataclasses with arrays, compared and hashed by their content."""

    def _content(self) -> tuple[Any, ...]:
        values = (getattr(self, each.name) for each in fields(self))  # type: ignore[arg-type]
        return tuple(v.tobytes() if isinstance(v, np.ndarray) else v for v in values)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, type(self)) and self._content() == other._content()

    def __hash__(self) -> int:
        return hash(self._content())

    def _read_arrays(self, *names: str) -> None:
        """Turn fields into arrays; a tuple of numbers will do."""
        for name in names:
            object.__setattr__(self, name, np.asarray(getattr(self, name), dtype=float))


@dataclass(frozen=True, eq=False)
class RigidBody(_ByContent):
    """A rigid body at rest.

    Attributes
    ----------
    name : unique among the bodies
    mass_kg : mass
    inertia_kg_m2 : inertia tensor about the centre of mass, shape (3, 3)
    centre_of_mass_m : from the centre of mass of the housing at rest, z up, shape (3,)

    Examples
    --------
    >>> body = va.RigidBody("damper", 0.2, 1e-5 * np.eye(3), (0.1, 0.0, 0.05))
    >>> body.mass_matrix.shape
    (6, 6)
    """

    name: str
    mass_kg: float
    inertia_kg_m2: Array
    centre_of_mass_m: Array

    def __post_init__(self) -> None:
        self._read_arrays("inertia_kg_m2", "centre_of_mass_m")
        _check_shape(self.inertia_kg_m2, (3, 3), f"body {self.name}: inertia_kg_m2")
        _check_shape(self.centre_of_mass_m, (3,), f"body {self.name}: centre_of_mass_m")
        if not (np.isfinite(self.mass_kg) and self.mass_kg > 0.0):
            raise ParameterError(
                f"body {self.name}: mass_kg = {self.mass_kg:g} kg: must be above 0"
            )
        _check_symmetric(self.inertia_kg_m2, f"body {self.name}: inertia_kg_m2")
        moments = np.linalg.eigvalsh(self.inertia_kg_m2)
        if moments[0] <= 0.0 or moments[2] > (moments[0] + moments[1]) * (1.0 + SYMMETRY):
            raise ParameterError(
                f"body {self.name}: inertia_kg_m2: principal moments {moments[0]:g}, "
                f"{moments[1]:g}, {moments[2]:g} kg m²: must be above 0, none above the sum of "
                "the others"
            )

    @property
    def mass_matrix(self) -> Array:
        """Mass matrix about the centre of mass, shape (6, 6), kg and kg m²."""
        matrix = np.zeros((6, 6))
        matrix[:3, :3], matrix[3:, 3:] = self.mass_kg * np.eye(3), self.inertia_kg_m2
        return matrix


@dataclass(frozen=True, eq=False)
class Bushing(_ByContent):
    """A massless elastic link between two bodies, or between a body and the ground.

    The six relative displacements and rotations at its point, in its own axes, times the 6 x 6
    stiffness give force and moment, N and N m; likewise the velocities times the damping.

    Attributes
    ----------
    name : unique among the bushings
    body : name of the first body
    other_body : name of the second body, such as that of a port; None for the ground
    position_m : its point, from the centre of mass of the housing at rest, shape (3,)
    stiffness : symmetric, positive semidefinite, shape (6, 6), N/m, N and N m
    damping : viscous, symmetric, positive semidefinite, shape (6, 6), N s/m, N s and N m s
    loss_factor_ratio : structural loss factor of the stiffness
    axes : its own axes as columns, a rotation, shape (3, 3)
    over_frequency : function of frequencies, shape (...), to complex stiffness along the axes of
        the frame, shape (..., 3), N/m, in place of stiffness and loss but in natural modes

    Examples
    --------
    >>> stiffness = np.diag([1e5, 1e5, 2e4, 50.0, 50.0, 50.0])  # N/m, N m
    >>> rubber = va.Bushing("rubber", "damper", va.HOUSING.name, (0.1, 0.0, 0.04), stiffness,
    ...                     loss_factor_ratio=0.1)
    >>> rubber.other_body
    'housing'
    """

    name: str
    body: str
    other_body: str | None
    position_m: Array
    stiffness: Array
    damping: Array = field(default_factory=_free)
    loss_factor_ratio: float = 0.0
    axes: Array = field(default_factory=lambda: np.eye(3))
    over_frequency: Callable[[Array], ComplexArray] | None = None

    def __post_init__(self) -> None:
        where = f"bushing {self.name}"
        self._read_arrays("position_m", "stiffness", "damping", "axes")
        _check_shape(self.position_m, (3,), f"{where}: position_m")
        for name, matrix in (("stiffness", self.stiffness), ("damping", self.damping)):
            _check_shape(matrix, (6, 6), f"{where}: {name}")
            _check_symmetric(matrix, f"{where}: {name}")
            values = _eigenvalues(matrix)
            if values[0] < -SYMMETRY * max(values[-1], 0.0) or values[-1] < 0.0:
                raise ParameterError(f"{where}: {name}: must be positive semidefinite")
        _check_shape(self.axes, (3, 3), f"{where}: axes")
        turned = not np.array_equal(self.axes, _ALONG)
        if turned and (
            np.max(np.abs(self.axes.T @ self.axes - _ALONG)) > SYMMETRY
            or np.linalg.det(self.axes) < 0.0
        ):
            raise ParameterError(f"{where}: axes: must be a rotation")
        if not 0.0 <= self.loss_factor_ratio <= 1.0:
            raise ParameterError(
                f"{where}: loss_factor_ratio = {self.loss_factor_ratio:g}: allowed 0 to 1"
            )

    def added_stiffness(self, frequency_hz: Array | float) -> ComplexArray:
        """Return what stiffness over frequency adds to the constant one, shape (..., 3), N/m.

        Parameters
        ----------
        frequency_hz : at least zero, shape (...)
        """
        frequency = np.asarray(frequency_hz, dtype=float)
        moving = (frequency > 0.0)[..., None]
        constant = np.diagonal(self.stiffness)[:3] * (1.0 + 1j * self.loss_factor_ratio * moving)
        if self.over_frequency is None:
            return np.zeros_like(constant)
        return np.asarray(self.over_frequency(frequency) - constant)

    def in_frame(self, matrix: Array) -> Array:
        """A matrix in the bushing's own axes, in those of the frame, shape (6, 6)."""
        turn = np.zeros((6, 6))
        turn[:3, :3] = turn[3:, 3:] = self.axes
        return np.asarray(turn @ matrix @ turn.T)


@dataclass(frozen=True)
class AttachedBodies:
    """Rigid bodies with the bushings that hold them to a machine on its mounts.

    A bushing names the machine's bodies by their ports, `HOUSING` or `BLOCK`.

    Attributes
    ----------
    bodies : each held in all six directions
    bushings : between these and the machine's bodies

    Examples
    --------
    >>> body = va.RigidBody("damper", 0.2, 1e-5 * np.eye(3), (0.1, 0.0, 0.05))
    >>> rubber = va.Bushing("rubber", "damper", va.HOUSING.name, body.centre_of_mass_m,
    ...                     np.diag([1e5, 1e5, 2e4, 50.0, 50.0, 50.0]))
    >>> va.AttachedBodies((body,), (rubber,)).mass_kg
    0.2
    """

    bodies: tuple[RigidBody, ...] = ()
    bushings: tuple[Bushing, ...] = ()

    def __post_init__(self) -> None:
        for body in self.bodies:
            held = np.zeros((6, 6))
            for bushing in self.bushings:
                if body.name not in (bushing.body, bushing.other_body):
                    continue
                motion = motion_at(bushing.position_m, body.centre_of_mass_m)
                held += motion.T @ bushing.in_frame(bushing.stiffness) @ motion
            squares = eigh(held, body.mass_matrix, eigvals_only=True)
            if squares[0] <= FREE * squares[-1]:
                raise ParameterError(
                    f"body {body.name}: its bushings leave it free to move; give stiffness along "
                    "and about all three axes"
                )

    @property
    def mass_kg(self) -> float:
        """Mass of all bodies."""
        return sum(body.mass_kg for body in self.bodies)

    def __add__(self, other: "AttachedBodies") -> "AttachedBodies":
        return AttachedBodies(self.bodies + other.bodies, self.bushings + other.bushings)


NO_BODIES: Final = AttachedBodies()


def check_joined(names: Sequence[str], bushings: Sequence[Bushing]) -> None:
    """Refuse bodies or bushings with one name, and bushings that join no two bodies.

    Parameters
    ----------
    names : names of all bodies
    bushings : between them and the ground

    Raises
    ------
    ParameterError
        Names the body or bushing.
    """
    _check_unique("body", names)
    _check_unique("bushing", [bushing.name for bushing in bushings])
    for bushing in bushings:
        ends = (bushing.body, bushing.other_body)
        for end in ends:
            if end is not None and end not in names:
                raise ParameterError(
                    f"bushing {bushing.name}: no body {end}; there are {', '.join(names)}"
                )
        if ends[0] == ends[1]:
            raise ParameterError(f"bushing {bushing.name}: joins {ends[0]} to itself")


def _check_unique(what: str, names: Sequence[str]) -> None:
    for number, name in enumerate(names):
        if name in names[:number]:
            raise ParameterError(f"{what} {name}: named twice")


def motion_at(point_m: Array, centre_m: Array) -> Array:
    """Displacement and rotation at a point per unit motion of the centre, shape (6, 6).

    Small motion: u = t + r x (p - c).

    Parameters
    ----------
    point_m, centre_m : shape (3,)
    """
    motion = np.eye(6)
    x, y, z = point_m - centre_m
    motion[:3, 3:] = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]
    return motion


def _check_shape(matrix: Array, shape: tuple[int, ...], what: str) -> None:
    if np.shape(matrix) != shape or not np.all(np.isfinite(matrix)):
        raise ParameterError(f"{what}: must be finite and of shape {shape}, got {np.shape(matrix)}")


def _eigenvalues(matrix: Array) -> Array:
    """Eigenvalues of a symmetric matrix, rising; a sampled machine has many diagonal ones."""
    diagonal = np.diagonal(matrix)
    if np.count_nonzero(matrix) == np.count_nonzero(diagonal):
        return np.sort(diagonal)
    return np.asarray(np.linalg.eigvalsh(matrix))


def _check_symmetric(matrix: Array, what: str) -> None:
    if np.max(np.abs(matrix - matrix.T)) > SYMMETRY * np.max(np.abs(matrix)):
        raise ParameterError(f"{what}: must be symmetric")
