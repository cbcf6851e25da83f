"""A third party's reader: two channels of signed bytes in turn, 128 a volt, at 1 kHz."""

import numpy as np

import vibroacoustics
from vibroacoustics import Reader, Recorded, Request

NAMES = ("front", "rear")
LIMITS_V = (-1.0, 127.0 / 128.0)


def read(request: Request) -> Recorded:
    """The requested channels in volts."""
    stored = np.fromfile(request.path, dtype=np.int8).reshape(-1, len(NAMES))
    columns = request.chosen(NAMES)
    return Recorded(
        names=[NAMES[column] for column in columns],
        units=["V" for _ in columns],
        samples=[stored[:, column] / 128.0 for column in columns],
        sample_rate_hz=request.sample_rate_hz or 1000.0,
        limits=[LIMITS_V for _ in columns],
    )


READER = Reader("plain-bytes", (".plain",), "plain bytes", read)
vibroacoustics.register(READER)
