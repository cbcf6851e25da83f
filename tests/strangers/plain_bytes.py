"""A stranger's reader: one channel of bytes at 1 kHz, volts at 128 a volt."""

import sys

import numpy as np

import vibroacoustics
from vibroacoustics import Reader, Recorded, Request


def read(request: Request) -> Recorded:
    """The bytes as they are; tells which process reads, and whether that has labelled arrays."""
    stored = np.frombuffer(request.path.read_bytes(), dtype=np.int8)
    if not stored[0]:
        import no_such_module  # noqa: F401
    name = "plain" if "xarray" not in sys.modules else "in the process of the user"
    return Recorded([name], ["V"], [stored / 128.0], request.sample_rate_hz or 1000.0)


READER = Reader("plain-bytes", (".plain",), "plain bytes", read, package="plain-bytes-of-pip")
vibroacoustics.register(READER)
