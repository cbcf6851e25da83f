"""Measured functions by kind and nodes, along positive directions."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError, gathered
from ..recordings import MeasuredFunction, Node
from ..recordings.functions import read_functions

Key = tuple[str, Node, Node | None]


def unsigned(node: Node) -> Node:
    """The node along its positive direction."""
    return node.opposite if node.direction.startswith("-") else node


def signs(nodes: Sequence[Node]) -> Array:
    """Sign of each node's direction."""
    return np.array([-1.0 if node.direction.startswith("-") else 1.0 for node in nodes])


def read_all(
    names: Sequence[str], units: Mapping[str, str], folder: Path = Path()
) -> list[MeasuredFunction]:
    """Functions of some files, of a folder where their names do not show it."""
    return [function for each in read_each(names, units, folder) for function in each]


def read_each(
    names: Sequence[str], units: Mapping[str, str], folder: Path
) -> list[list[MeasuredFunction]]:
    """Functions of each file; errors as of `read_all`."""
    read = partial(read_functions, units=units)
    return gathered(read, [folder / name for name in names])


def by_key(functions: Sequence[MeasuredFunction]) -> dict[Key, list[MeasuredFunction]]:
    """Functions by kind and unsigned nodes, along the positive directions, above 0 Hz."""
    grouped: dict[Key, list[MeasuredFunction]] = {}
    for function in functions:
        nodes = [function.response, *([function.reference] if function.reference else [])]
        has_sign = function.kind not in ("coherence", "auto spectrum")
        sign = float(np.prod(signs(nodes))) if has_sign else 1.0
        response, reference = unsigned(nodes[0]), unsigned(nodes[1]) if nodes[1:] else None
        above = function.frequency_hz > 0.0
        if not np.any(above):
            raise ParameterError(f"{function}: has no frequency above 0 Hz")
        along = replace(
            function,
            frequency_hz=function.frequency_hz[above],
            values=function.values[above] * sign,
            response=response,
            reference=reference,
        )
        grouped.setdefault((function.kind, response, reference), []).append(along)
    return grouped
