"""A file that may be a study or a machine alone."""

from pathlib import Path

from ..machine.machine import Machine
from .loading import load_machine, load_study
from .study import Study
from .toml_files import read_toml


def load_study_or_machine(path: str | Path) -> Study | Machine:
    """Read a study; or, of a file that names a kind of machine by itself, that machine.

    Raises
    ------
    ParameterError
        As `load_study` and `load_machine`.
    """
    is_machine = "kind" in read_toml(Path(path))
    return load_machine(path) if is_machine else load_study(path)
