"""Public names of a package that are imported when they are first asked for."""

from collections.abc import Mapping
from importlib import import_module
from typing import Any


def imported(package: str, home: Mapping[str, str], name: str) -> Any:
    """A public name of a package; for its `__getattr__`.

    Parameters
    ----------
    package : that is asked
    home : module within the package, by name
    name : that is asked for

    Raises
    ------
    AttributeError
        The package has no such name.
    """
    if name not in home:
        raise AttributeError(f"module {package} has no attribute {name}")
    return getattr(import_module(f"{package}.{home[name]}"), name)
