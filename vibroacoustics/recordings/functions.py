"""Functions of frequency from a file, whatever its format."""

from collections.abc import Mapping
from pathlib import Path
from typing import Final

from ..base.errors import ParameterError, StorageError
from .asked import check_file, naming_file
from .csv_functions import read_csv
from .measured_function import MeasuredFunction
from .quantities import QUANTITIES, quantity
from .uff_functions import read_uff

MAXIMUM_BYTES: Final = 2**28
"""Size of a file, which is read as a whole."""


def read_functions(
    path: str | Path, *, units: Mapping[str, str] | None = None
) -> list[MeasuredFunction]:
    """Read frequency responses, spectra and coherences; docs/measured_changes.md has the layouts.

    Parameters
    ----------
    path : UFF file with datasets 58 or 58b, or a CSV table
    units : unit by quantity, `acceleration`, `velocity`, `displacement`, `force` or
        `sound pressure`, where datasets 58 state the quantity alone

    Returns
    -------
    in the order of the file, in SI units

    Raises
    ------
    ParameterError
        The file holds none, or a unit, node or direction is missing or wrong.
    StorageError
        The file is missing, damaged, or larger than the cap.

    Examples
    --------
    >>> function = va.MeasuredFunction(
    ...     "spectrum", np.array([50.0, 100.0]), np.array([0.1, 0.2j]), va.Node(101), None, "Pa")
    >>> file = va.export_functions([function], "running.csv")
    >>> va.read_functions(file)[0].values
    array([0.1+0.j , 0. +0.2j])
    """
    path = Path(path)
    readers = {".uff": read_uff, ".unv": read_uff, ".csv": read_csv, ".txt": read_csv}
    with naming_file(path):
        check_file(path, list(readers))
        if path.stat().st_size > MAXIMUM_BYTES:
            raise StorageError(f"has more than {MAXIMUM_BYTES / 2**20:g} MiB: take it apart")
        unit_of_kind = dict(units or {})
        kinds = {measured.kind for measured in QUANTITIES.values()}
        for kind, unit in unit_of_kind.items():
            if kind not in kinds or quantity(unit).kind != kind:
                raise ParameterError(f"units: {kind} = {unit!r}: is no quantity with its unit")
        return readers[path.suffix.lower()](path, unit_of_kind)
