"""Python files of third parties that the user names: what they register becomes known."""

import os
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Final

from .errors import PluginError, VibroacousticsError
from .fault import Owner
from .fence import fence
from .regular_file import opened

MAXIMUM_BYTES: Final = 10_000_000

_FILES: Final[dict[str, Path]] = {}
"""Files by the name of the module that each became."""


def plugin_file(module: str) -> Path | None:
    """File that a module was loaded from by `load_plugin`; None for another module."""
    return _FILES.get(module)


def load_plugin(path: str | Path) -> None:
    """Run a Python file, which registers what it brings; a file that is known already, not again.

    Parameters
    ----------
    path : file; its code runs with all rights of the user

    Raises
    ------
    PluginError
        It is missing, or fails, or registers what cannot be registered.

    Examples
    --------
    >>> from pathlib import Path
    >>> code = "import vibroacoustics; vibroacoustics.register(vibroacoustics.Unit({}))"
    >>> size = Path("own_unit.py").write_text(code.format("'ell', 'ell', 'm', 1.1"))
    >>> va.load_plugin("own_unit.py")
    """
    file = Path(os.path.realpath(path))  # `resolve` raises another error where links are a circle
    name = f"plugin_{file.stem}_{abs(hash(file)):x}"
    if name in sys.modules:
        return
    _check(file, path)
    spec = spec_from_file_location(name, file)
    if spec is None or spec.loader is None:
        raise PluginError(f"{path}: is no Python file (.py)")
    module = module_from_spec(spec)
    sys.modules[name] = module  # its classes are looked up there
    try:
        with fence(Owner("plug-in", str(path), file.name), (VibroacousticsError,)):
            spec.loader.exec_module(module)
        _FILES[name] = file
    except BaseException:
        del sys.modules[name]
        raise


def _check(file: Path, named: str | Path) -> None:
    """Refuse what is no regular file, or too large for a module."""
    try:
        with opened(file, MAXIMUM_BYTES):
            return
    except FileNotFoundError:
        raise PluginError(f"{named}: no such file") from None
    except OSError as error:
        raise PluginError(f"{named}: cannot be read: {error.strerror}") from None
