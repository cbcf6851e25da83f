"""UFF dataset 55, normal modes, with its nodes (15, 2411) and units (164), through pyuff."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from ..base.errors import ParameterError, StorageError
from .recorded import Request, Samples, check_size
from .uff58 import datasets

NORMAL_MODE: Final = 2
"""Analysis type in record 6, field 2."""
DISPLACEMENT_OR_UNKNOWN: Final = (0, 1, 8)
"""Specific data types of a shape in record 6, field 4."""
REAL: Final = 2
"""Data type in record 6, field 5."""
_NODES: Final = (15, 2411)
_SI: Final = {"length": 1.0, "force": 1.0}
"""Factors of dataset 164: units of the file per SI unit."""

Set = Mapping[str, Any]


def read(request: Request) -> tuple[dict[str, Any], list[Samples]]:
    """Header, and rows of 3 x nodes: the places of the nodes, then the shape of each mode.

    Raises
    ------
    ParameterError
        There is no normal mode or no node, a mode is complex or states no modal mass, or the modes
        differ in their nodes.
    StorageError
        A shape is cut short, the file claims too much, or its lines -1 are not in pairs.
    """
    import pyuff

    with request.path.open("rb") as opened:
        for line in datasets(opened).remarks:  # which pyuff takes for the begin of a dataset
            raise StorageError(f"{line}; add or remove it")
    file = pyuff.UFF(str(request.path))
    kinds = [int(kind) for kind in file.get_set_types()]
    modes = [
        dataset for dataset in _sets(file, kinds, (55,)) if dataset["analysis_type"] == NORMAL_MODE
    ]
    if not modes:
        raise ParameterError("holds no normal mode (dataset 55, analysis type 2)")
    units = (_sets(file, kinds, (164,)) or [_SI])[-1]
    numbers = modes[0]["node_nums"]
    check_size(len(modes), 3 * len(numbers))
    positions = _node_positions(_sets(file, kinds, _NODES), numbers) / float(units["length"])
    shapes = [_shape(mode, numbers) for mode in modes]
    to_kg = float(units["length"]) / float(units["force"])
    header = {
        "names": ["nodes", *(f"mode {mode['mode_n']}" for mode in modes)],
        "samples": 3 * len(numbers),
        "units_stated": 164 in kinds,
        "frequency_hz": [float(mode["freq"]) for mode in modes],
        "modal_mass_kg": [to_kg * float(mode["modal_m"]) for mode in modes],
        "viscous_damping_ratio": [float(mode["modal_damp_vis"]) for mode in modes],
    }
    return header, [row.ravel() for row in (positions, *shapes)]


def _sets(file: Any, kinds: Sequence[int], wanted: Sequence[int]) -> list[Set]:
    return [file.read_sets(index) for index, kind in enumerate(kinds) if kind in wanted]


def _node_positions(node_sets: Sequence[Set], numbers: Samples) -> Samples:
    """Places of the numbered nodes in units of the file, shape (node, 3)."""
    by_number: dict[int, tuple[float, float, float]] = {}
    systems: set[float] = set()
    for nodes in node_sets:
        systems |= set(nodes["disp_cs"])
        positions = zip(nodes["x"], nodes["y"], nodes["z"], strict=True)
        by_number |= {
            int(n): position for n, position in zip(nodes["node_nums"], positions, strict=True)
        }
    missing = [int(number) for number in numbers if int(number) not in by_number]
    if missing:
        raise ParameterError(
            f"states no place of node {missing[0]} and {len(missing) - 1} more: needs dataset 15 "
            "or 2411"
        )
    if len(systems) > 1:
        raise ParameterError(
            "nodes move in several coordinate systems: export the shapes in the global one"
        )
    return np.array([by_number[int(number)] for number in numbers])


def _shape(mode: Set, numbers: Samples) -> Samples:
    """Displacement of the nodes, shape (node, 3)."""
    name = f"mode {mode['mode_n']}"
    if mode["data_type"] != REAL:
        raise ParameterError(f"{name}: is complex: export real normal modes")
    if mode["spec_data_type"] not in DISPLACEMENT_OR_UNKNOWN:
        raise ParameterError(
            f"{name}: specific data type {mode['spec_data_type']}: is no displacement (8)"
        )
    for key, what in (("freq", "frequency"), ("modal_m", "modal mass")):
        if not 0.0 < mode[key] < np.inf:
            raise ParameterError(f"{name}: {what} {mode[key]:g}: must be above zero")
    if not np.array_equal(mode["node_nums"], numbers):
        raise ParameterError(f"{name}: has other nodes than the first mode")
    parts = [mode[key] for key in ("r1", "r2", "r3")]
    if any(len(part) != len(numbers) for part in parts):
        raise StorageError(f"{name}: is cut short")
    shape = np.stack(parts, axis=1)
    if not np.all(np.isfinite(shape)):
        raise ParameterError(f"{name}: holds values that are not finite")
    return shape
