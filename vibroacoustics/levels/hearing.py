"""Threshold of hearing (ECMA-74)."""

from typing import Final

import numpy as np

_THRESHOLD: Final = (
    (305.0, 167.5, 87.3212, (1.415532, -2.451068, 1.498869, -6.983224, 8.621226)),
    (2230.0, 1157.5, 488.582, (0.397994, -0.891839, -0.815138, -1.221319, -7.600754)),
    (14000.0, 7250.0, 3033.25, (1.584978, -2.766599, -6.9061912, 10.138553, -3.149339)),
)


def hearing_threshold_db(frequency_hz: float) -> float:
    """Lower threshold of hearing, dB: a polynomial of fourth degree a range (ECMA-74, D.7.1).

    Parameters
    ----------
    frequency_hz : 20 Hz to 14 kHz
    """
    _, mean, deviation, constants = next(
        part for part in _THRESHOLD if frequency_hz < part[0] or part is _THRESHOLD[-1]
    )
    return float(np.polyval(constants, (frequency_hz - mean) / deviation))
