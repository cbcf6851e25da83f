"""Transfer vectors with k-Wave's room at the microphones and frequencies where it is asked for."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

import numpy as np

from .arrays import Array, ComplexArray
from .box import Box, BoxField
from .exact import box_green
from .kwave import kwave_version
from .receiver_methods import closed_form, machine_side
from .room_green import green_difference_db
from .task import Task

_SILENT: Final = 1e-5
"""Share of the loudest motion's pressure below which k-Wave's error, some 1e-4 of it, is larger."""
Vectors = dict[str, Array | ComplexArray]


def solver(task: Task) -> str:
    """Name the solver in words."""
    room = f"k-wave-python {kwave_version()}" if task.kwave else closed_form(task.settings)
    return f"{machine_side(task.settings)}, {room}"


def closed_greens(box: Box, task: Task) -> Iterator[BoxField]:
    """Green's functions in closed form to the microphones that k-Wave computes."""
    microphones = task.kwave_microphones
    for point in microphones.points:
        yield box_green(box, point, task.frequency_hz[microphones.frequencies], task.scene.walls)


def with_kwave(
    task: Task, closed: Mapping[str, Array | ComplexArray], kwave: Vectors, difference_db: Array
) -> Vectors:
    """Transfer vectors in which k-Wave's take the place of those with the closed form.

    A motion that the closed form has silent at a microphone, as by symmetry, stays silent: k-Wave's
    grid is not symmetric, and its error would sound in its place.

    Parameters
    ----------
    task : says at which microphones and frequencies
    closed : `transfer_vector` and its error by name, (receiver, pattern, frequency)
    kwave : Green's functions of k-Wave's microphones and frequencies alone
    difference_db : difference of the Green's functions, shape (microphone of k-Wave,
        frequency)
    """
    rows, table = task.kwave_rows, task.kwave_table
    joined = {name: values.copy() for name, values in closed.items()}
    size = np.abs(closed["transfer_vector"][rows, :, table])
    silent = size <= _SILENT * size.max(axis=1, keepdims=True)
    for name, values in kwave.items():
        joined[name][rows, :, table] = np.where(silent, joined[name][rows, :, table], values)
    difference = np.full((len(task.positions), task.tabulated), np.nan)
    difference[rows, table] = difference_db
    return {
        **joined,
        "transfer_vector_closed_form": closed["transfer_vector"],
        "green_difference": difference,
    }


def differences_db(greens: Sequence[BoxField], expected: Iterator[BoxField]) -> Array:
    """Difference of k-Wave's Green's functions from the closed form, where it is largest on the
    box."""
    return np.array(list(map(green_difference_db, greens, expected)))
