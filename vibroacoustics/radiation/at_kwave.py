"""Transfer vectors with k-Wave's room at the microphones and frequencies where it is asked for."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from .arrays import Array, ComplexArray
from .box import Box, BoxField
from .exact import box_green
from .kwave import kwave_version
from .room_green import green_difference_db
from .task import Task

Vectors = dict[str, Array | ComplexArray]


def solver(machine_side: str, room_side: str, task: Task) -> str:
    """What computes, in words."""
    return f"{machine_side}, {f'k-wave-python {kwave_version()}' if task.kwave else room_side}"


def closed_greens(box: Box, task: Task) -> Iterator[BoxField]:
    """Green's functions in closed form to the microphones that k-Wave computes."""
    asked = task.kwave_microphones
    for point in asked.points:
        yield box_green(box, point, task.frequency_hz[asked.frequencies], task.scene.walls)


def with_kwave(
    task: Task, closed: Mapping[str, Array | ComplexArray], kwave: Vectors, difference_db: Array
) -> Vectors:
    """Transfer vectors in which k-Wave's take the place of those with the closed form.

    Parameters
    ----------
    task : says at which microphones and frequencies
    closed : `transfer_vector` and its error by name, (receiver, pattern, frequency)
    kwave : the same, of k-Wave's microphones and frequencies alone
    difference_db : of the Green's functions, (microphone of k-Wave, frequency)
    """
    rows, table = task.kwave_rows, task.kwave_table
    joined = {name: values.copy() for name, values in closed.items()}
    for name, values in kwave.items():
        joined[name][rows, :, table] = values
    difference = np.full((len(task.positions), task.tabulated), np.nan)
    difference[rows, table] = difference_db
    return {
        **joined,
        "transfer_vector_closed_form": closed["transfer_vector"],
        "green_difference": difference,
    }


def differences_db(greens: Sequence[BoxField], expected: Iterator[BoxField]) -> Array:
    """Of k-Wave's Green's functions from the closed form, where it is largest on the box."""
    return np.array(list(map(green_difference_db, greens, expected)))
