"""Modes of a structure that were measured or computed elsewhere, from a universal file."""

from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError, VibroacousticsError
from .asked import check_file
from .child_process import read_in_child

SUFFIXES: Final = (".uff", ".unv")


@dataclass(frozen=True)
class MeasuredModes:
    """Real normal modes at the nodes of a structure.

    Attributes
    ----------
    frequency_hz : natural frequencies, shape (mode,)
    modal_mass_kg : modal mass of the shapes as they are scaled, shape (mode,)
    viscous_damping_ratio : damping ratio in the file, 0 where it states none, shape (mode,)
    nodes_m : places in the file's coordinate system, shape (node, 3)
    shape : displacements, shape (mode, node, 3)
    source_sha256 : hash of the file
    """

    frequency_hz: Array
    modal_mass_kg: Array
    viscous_damping_ratio: Array
    nodes_m: Array
    shape: Array
    source_sha256: str


def read_modes(path: str | Path, *, file_unit_m: float | None = None) -> MeasuredModes:
    """Read normal modes (dataset 55) and their nodes (15 or 2411) from a universal file.

    The file is read in a process of its own, of limited memory. Modal masses are taken in kg,
    lengths in m, unless dataset 164 states the file's units.

    Parameters
    ----------
    path : UFF file
    file_unit_m : length of the unit of the nodes' places; needed where dataset 164 is missing

    Raises
    ------
    ParameterError
        There is no normal mode or no node, a mode is complex or states no modal mass, the modes
        differ in their nodes, or the unit of length is missing.
    StorageError
        The file is missing, damaged, or larger than the caps.

    Examples
    --------
    >>> modes = va.read_modes("modes.uff")
    >>> modes.shape.shape  # (mode, node, 3)
    (2, 5, 3)
    """
    path = Path(path)
    request = {"path": str(path), "channels": None, "sample_rate_hz": None, "modes": True}
    try:
        check_file(path, SUFFIXES)
        header, rows = read_in_child(request)
        if header["units_stated"] == (file_unit_m is not None):
            raise ParameterError(
                "file_unit_m: the file states its unit of length (dataset 164)"
                if header["units_stated"]
                else "states no unit of length (dataset 164): give file_unit_m"
            )
    except VibroacousticsError as error:
        raise type(error)(f"{path}: {error}") from None
    positions, *shapes = rows.reshape(len(rows), -1, 3)
    return MeasuredModes(
        np.array(header["frequency_hz"]),
        np.array(header["modal_mass_kg"]),
        np.array(header["viscous_damping_ratio"]),
        positions * (file_unit_m or 1.0),
        np.array(shapes),
        header["sha256"],
    )
