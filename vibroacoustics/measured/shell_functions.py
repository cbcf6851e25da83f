"""Hammer tests of a shell: mobilities between the points that a study names."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.errors import ParameterError
from ..recordings import MeasuredFunction, Node
from ..study.measured_shell import Hit, MeasuredShell
from ..transfer.wall_mobility import ShellMobilities
from .grouped import by_key, read_all, unsigned
from .library import SAME_FREQUENCY

LEAST_LINES: Final = 3
"""Least number of lines that make a peak."""


def read_shell_mobilities(settings: MeasuredShell, highest_hz: float) -> ShellMobilities:
    """Frequency responses between named points, as mobilities.

    Raises
    ------
    ParameterError
        A file holds none, or in a wrong unit, or they differ in their frequencies.
    StorageError
        A file cannot be read.
    """
    functions = [
        function
        for function in read_all(settings.frequency_responses, settings.units)
        if function.kind == "frequency response"
    ]
    wall, every = _nodes(settings.wall), _nodes({**settings.wall, **settings.parts})
    groups = by_key(functions)
    pairs = [(response, reference) for _, response, reference in groups
             if response in wall and reference in every]  # fmt: skip
    if not pairs:
        raise ParameterError(
            "measured.shell: no frequency response has its response at a node of the wall and its "
            f"reference at a named one; the files hold {', '.join(map(str, functions[:4]))} …"
        )
    frequency, kept = _lines(settings, groups["frequency response", *pairs[0]][0], highest_hz)
    rows = [_mean(groups["frequency response", *pair], frequency, kept) for pair in pairs]
    signs = [wall[name][1] * every[other][1] for name, other in pairs if other is not None]
    return ShellMobilities(
        frequency[kept],
        np.array(rows) * np.array(signs)[:, None],
        tuple(wall[name][0] for name, _ in pairs),
        tuple(every[other][0] for _, other in pairs if other is not None),
        len(groups) - len(pairs),
    )


def _nodes(points: Mapping[str, Hit]) -> dict[Node | None, tuple[str, float]]:
    """Name and sign of each point by its node along the positive direction."""
    nodes = {name: Node(point.node, point.direction) for name, point in points.items()}
    return {
        unsigned(node): (name, -1.0 if node.direction.startswith("-") else 1.0)
        for name, node in nodes.items()
    }


def _lines(
    settings: MeasuredShell, function: MeasuredFunction, highest_hz: float
) -> tuple[Array, IndexArray]:
    frequency = function.frequency_hz
    highest = min(settings.highest_frequency_hz, highest_hz)
    kept = np.flatnonzero(
        (frequency >= settings.lowest_frequency_hz) & (frequency <= highest) & (frequency > 0.0)
    )
    if kept.size < LEAST_LINES:
        raise ParameterError(
            f"measured.shell: {function}: fewer than {LEAST_LINES} lines from "
            f"{settings.lowest_frequency_hz:g} to {highest:g} Hz"
        )
    return frequency, kept


def _mean(functions: list[MeasuredFunction], frequency_hz: Array, kept: IndexArray) -> ComplexArray:
    for function in functions:
        same = function.frequency_hz.shape == frequency_hz.shape
        if not same or not np.allclose(function.frequency_hz, frequency_hz, rtol=SAME_FREQUENCY):
            raise ParameterError(
                f"measured.shell: {function}: has other frequencies than the first"
            )
        if function.reference_unit != "N":
            raise ParameterError(
                f"measured.shell: {function}: reference in {function.reference_unit}: "
                "must be a force, N"
            )
    mobilities = [function.with_response_in("m/s").values[kept] for function in functions]
    return np.asarray(np.mean(mobilities, axis=0))
