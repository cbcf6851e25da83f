"""Mounts, masses and absorbers as changes of dynamic stiffness between points."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array, ComplexArray
from .change import absorber_stiffness, mass_stiffness
from .settings import Change, Prediction


@dataclass(frozen=True)
class Elements:
    """Elements of a change between points.

    Attributes
    ----------
    elongation : elongation of each element by the points' displacements, shape (element, point)
    stiffness : change of its dynamic stiffness, N/m, shape (frequency, element, element)
    """

    elongation: Array
    stiffness: ComplexArray


def points_of(settings: Prediction) -> list[str]:
    """Points that any change acts on, in the order of the file."""
    used: set[str] = set()
    for change in settings.changes.values():
        used.update(*(settings.mounts[name].ends for name in change.mounts))
        used.update(*(mass.points for mass in change.masses.values()))
        used.update(*(absorber.points for absorber in change.absorbers.values()))
    return [name for name in settings.measured.points if name in used]


def elements_of(settings: Prediction, change: Change, frequency_hz: Array) -> Elements:
    """The elements of a change."""
    points = points_of(settings)
    rows, stiffness = [], []
    for name, new in change.mounts.items():
        old = settings.mounts[name]
        rows.append(_row(points, *old.ends))
        along = settings.measured.points[old.ends[0]].direction
        before, after = (mount.dynamic_stiffness(frequency_hz, along) for mount in (old, new))
        stiffness.append(after - before)
    for mass in change.masses.values():
        rows += [_row(points, point) for point in mass.points]
        stiffness += [mass_stiffness(frequency_hz, mass.mass_kg)] * len(mass.points)
    for absorber in change.absorbers.values():
        rows += [_row(points, point) for point in absorber.points]
        absorber_n_per_m = absorber_stiffness(
            frequency_hz,
            absorber.mass_kg,
            absorber.stiffness_n_per_m,
            absorber.loss_factor_ratio,
        )
        stiffness += [absorber_n_per_m] * len(absorber.points)
    matrices = np.einsum("ef,eg->feg", np.array(stiffness), np.eye(len(rows)))
    return Elements(np.array(rows), matrices)


def _row(points: Sequence[str], first: str, second: str = "") -> Array:
    """Elongation: the first point's displacement less the second's."""
    return np.array([float(name == first) - float(name == second) for name in points])
