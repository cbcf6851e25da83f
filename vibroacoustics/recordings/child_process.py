"""The process that reads a file (`child`): what it is asked for and what it hands over."""

import io
import json
import signal
import tempfile
from collections.abc import Mapping
from typing import Any, Final, cast

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError, PluginError, StorageError
from ..base.fault import FaultError
from ..base.process_start import start_module
from .child import MAXIMUM_CPU_S
from .recorded import MissingError, TooLargeError
from .time_axis import UnevenError

_ERRORS: Final = {
    error.__name__: error
    for error in (
        ParameterError,
        MissingError,
        PluginError,
        FaultError,
        StorageError,
        TooLargeError,
        UnevenError,
    )
}


def read_in_child(request: Mapping[str, Any]) -> tuple[dict[str, Any], Array]:
    """Header and samples, shape (channel, time), that the child hands over.

    With `as_stored` among the request the samples are of a smaller type than float64 where all
    channels of the file are.

    Raises
    ------
    ParameterError, StorageError
        What the child found wrong, or that it crashed.
    """
    with (
        tempfile.TemporaryFile() as messages,
        start_module(f"{__package__}.child", [json.dumps(request)], messages) as child,
    ):
        try:
            handed_over = _receive(cast(io.BufferedReader, child.stdout))
        except BaseException:  # a signal: the child may have much to read yet
            child.kill()
            raise
        if handed_over is None:
            messages.seek(0)
            raise StorageError(_end_of(child.wait(), messages.read()))
    return handed_over


def _receive(stream: io.BufferedReader) -> tuple[dict[str, Any], Array] | None:
    """Read what the child writes; None where it ended before all was written."""
    line = stream.readline()
    if not line.endswith(b"\n"):
        return None
    header = json.loads(line)
    if "error" in header:
        raise _ERRORS[header["error"]](header["message"])
    samples = np.empty((len(header["names"]), header["samples"]), header["type"])
    complete = not samples.size or stream.readinto(samples.data.cast("B")) == samples.nbytes
    return (header, samples) if complete else None


def _end_of(code: int, messages: bytes) -> str:
    """Message about a child that ended early."""
    if code == -signal.SIGXCPU:
        return f"was not read after {MAXIMUM_CPU_S} s: the file is damaged or too large"
    if code < 0:
        return f"the parser crashed ({signal.Signals(-code).name}): the file is damaged"
    last = messages.decode("utf-8", "replace").strip().splitlines()[-1:]
    return f"the process that reads it failed: {''.join(last)}"
