"""Measured functions put to the points and microphones that a file names."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base.arrays import Array, ComplexArray, IndexArray
from ..recordings import Node
from .grouped import signs, unsigned
from .library import Library
from .settings import Measured, Point


@dataclass(frozen=True)
class Bench:
    """Measurements, each function once, and which of them is where.

    Attributes
    ----------
    frequency_hz : shape (frequency,)
    values, error : functions and the RMS of their complex error, shape (function, frequency)
    compliance : function of each pair of points, shape (point, point)
    transfer : response of each microphone by point, shape (receiver, point)
    response : response of each point, shape (point,)
    pressure : pressure of each microphone, shape (receiver,)
    sign : sign of each point's direction, shape (point,)
    faults : a line for each fault that was accepted
    """

    frequency_hz: Array
    values: ComplexArray
    error: Array
    compliance: IndexArray
    transfer: IndexArray
    response: IndexArray
    pressure: IndexArray
    sign: Array
    faults: tuple[str, ...] = ()


def assemble(
    settings: Measured,
    names: Sequence[str],
    folder: Path,
    interfaces: Sequence[Sequence[str]] = (),
    despite: Sequence[str] = (),
) -> Bench:
    """The functions that a change at some points needs.

    Parameters
    ----------
    settings : files and nodes
    names : points of the change
    folder : folder of the files
    interfaces : points at either end of the mounts; the source is beyond one of them
    despite : names of faults that are accepted
    """
    library = Library(settings, folder, despite)
    points = [node_of(settings.points[name]) for name in names]
    nodes = [unsigned(point) for point in points]
    microphones = [node_of(microphone) for microphone in settings.microphones.values()]
    compliance = [[library.response(node, other, "m") for other in nodes] for node in nodes]
    transfer = [
        [library.response(microphone, other, "Pa") for other in nodes] for microphone in microphones
    ]
    response = [library.operating(node, "m") for node in nodes]
    pressure = [library.operating(node, "Pa") for node in microphones]
    values, errors = library.estimates
    sides = [[names.index(name) for name in side] for side in interfaces]
    library.compare_operating(np.array(compliance), np.array(response), nodes, sides)
    return Bench(
        frequency_hz=library.frequency_hz,
        values=values,
        error=errors,
        compliance=np.array(compliance),
        transfer=np.array(transfer),
        response=np.array(response),
        pressure=np.array(pressure),
        sign=signs(points),
        faults=tuple(library.remarks),
    )


def node_of(point: Point) -> Node:
    """Node and direction of a point."""
    return Node(point.node, point.direction)
