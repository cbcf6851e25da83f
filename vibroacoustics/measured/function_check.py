"""Measured functions of a file for `predict` or `blocked-forces`, tested against physics."""

from pathlib import Path
from typing import NamedTuple

from ..study.toml_files import read_toml
from .band import naming_settings
from .fault import FAULTS
from .in_situ import load_blocked_forces, read_in_situ
from .library import Library
from .prediction import assembled
from .settings import Measured, load_prediction


class CheckedFunctions(NamedTuple):
    """Outcome of the tests of measured functions.

    Attributes
    ----------
    rows : for each point with a hit `point`, `passivity` of its driving point, mean `causality` of
        its hits and `reciprocity_residual` of its worst pair; not a number where not measured
    faults : a line for each fault
    """

    rows: list[dict[str, str | float]]
    faults: tuple[str, ...]


def check_functions(path: str | Path) -> CheckedFunctions:
    """Test measured functions against physics: docs/measured_changes.md, section Faults.

    Parameters
    ----------
    path : TOML file for `predict` or `blocked-forces`

    Raises
    ------
    ParameterError
        The file is wrong, or a function that it needs was not measured.
    StorageError
        A file cannot be read.

    Examples
    --------
    >>> from vibroacoustics.measured.function_check import check_functions
    >>> check_functions("bench/bench.toml").faults
    ()
    """
    path = Path(path)
    is_in_situ = "blocked_forces" in read_toml(path)
    with naming_settings(path):
        measured: Measured
        if is_in_situ:
            interface = load_blocked_forces(path)
            measured, faults = (
                interface.measured,
                read_in_situ(interface, path.parent, FAULTS).faults,
            )
        else:
            prediction = load_prediction(path)
            measured, faults = prediction.measured, assembled(prediction, path, FAULTS).faults
        library = Library(measured, path.parent, FAULTS)
    return CheckedFunctions(library.point_measures(), faults)
