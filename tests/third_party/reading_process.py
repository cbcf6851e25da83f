"""A third party's reader whose channel says which process reads; zeros need a missing package."""

import sys

import numpy as np

import vibroacoustics
from vibroacoustics import Reader, Recorded, Request


def read(request: Request) -> Recorded:
    """The bytes; the name of the channel says whether that process has labelled arrays."""
    stored = np.frombuffer(request.path.read_bytes(), dtype=np.int8)
    if not stored[0]:
        import no_such_module  # noqa: F401
    name = "process of the user" if "xarray" in sys.modules else "process that reads"
    return Recorded([name], ["V"], [stored], 1000.0)


READER = Reader("process", (".process",), "reading process", read, package="process-of-pip")
vibroacoustics.register(READER)
