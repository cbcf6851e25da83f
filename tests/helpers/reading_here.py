"""Recordings read in this process, by the code of the process that reads them otherwise."""

import io
import json
import os
import tempfile
import warnings
from collections.abc import Mapping
from typing import Any, cast

from vibroacoustics.base.arrays import Array
from vibroacoustics.recordings import child
from vibroacoustics.recordings.child_process import _receive, read_in_child


def read_here(request: Mapping[str, Any]) -> tuple[dict[str, Any], Array]:
    """Read as `read_in_child` does, through the same bytes, without the start of a process.

    A reader of a plug-in's file is registered for good: it stays in a process of its own.
    """
    if request.get("plugin"):
        return read_in_child(request)
    with tempfile.TemporaryFile() as file:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a process of its own prints them
            asked = json.loads(json.dumps(request))
            answered = child._typed_answer(asked)
            child._write(os.fdopen(os.dup(file.fileno()), "wb"), *answered)
        file.seek(0)
        handed_over = _receive(cast(io.BufferedReader, file))
    assert handed_over is not None
    return handed_over
