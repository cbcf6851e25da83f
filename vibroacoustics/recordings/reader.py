"""Readers of recordings: one a format, by the suffix of the file's name."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from ..base.errors import PluginError
from ..base.plugin_file import plugin_file
from ..base.registry import Registry
from .recorded import Recorded, Request


@dataclass(frozen=True)
class Reader:
    """One format of recordings.

    Attributes
    ----------
    name : name of the format, short
    suffixes : suffixes of the files' names, small letters with the dot
    words : name of the format in words
    read : channels of a file; runs in a process of its own, of limited memory and time
    package : further package that `read` imports, as pip calls it; empty where none

    Examples
    --------
    >>> def read(request):
    ...     stored = np.fromfile(request.path, dtype="<i2")
    ...     return va.Recorded(["sensor"], ["V"], [stored / 3276.8], 25600.0)
    >>> logger = va.register(va.Reader("logger", (".log16",), "logger of the test bench", read))
    """

    name: str
    suffixes: tuple[str, ...]
    words: str
    read: Callable[[Request], Recorded]
    package: str = ""

    def __post_init__(self) -> None:
        if not isinstance(self.suffixes, tuple) or not self.suffixes:
            raise PluginError(f"reader {self.name}: suffixes = {self.suffixes!r}: must be a tuple")
        for suffix in self.suffixes:
            if not suffix.startswith(".") or suffix != suffix.lower():
                raise PluginError(
                    f"reader {self.name}: suffix {suffix!r}: must be a dot and small letters"
                )

    @property
    def plugin(self) -> Path | None:
        """File of the user that brings it; none where it is built in or installed."""
        return plugin_file(getattr(self.read, "__module__", ""))


_EXTRAS: Final = {"asammdf": "mdf"}
"""Extras of packages that are not in `io`."""
READERS: Final[Registry[Reader]] = Registry(
    "reader", Reader, "name", "recordings.readers", "vibroacoustics.readers"
)


def readers_by_suffix() -> dict[str, Reader]:
    """Every reader by each of its suffixes.

    Raises
    ------
    PluginError
        Two readers claim one suffix.
    """
    readers: dict[str, Reader] = {}
    for reader in sorted(
        READERS.values(), key=lambda candidate: READERS.origin(candidate.name) is not None
    ):
        for suffix in reader.suffixes:
            other = readers.setdefault(suffix, reader)
            if other is not reader:
                raise PluginError(
                    f"reader {reader.name}: files {suffix} are read by {other.name} already; "
                    "choose another suffix"
                )
    return readers


def needed(reader: Reader, module: str) -> str:
    """Say what to install where a reader misses a module."""
    if READERS.origin(reader.name) is None:
        extra = _EXTRAS.get(reader.package, "io")
        return f"needs {module}: pip install vibroacoustics[{extra}]"
    return f"needs {module}: pip install {reader.package or module}"
