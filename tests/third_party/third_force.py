"""A third party's column of the comparison: the force at three times the speed."""

import vibroacoustics
from vibroacoustics import Column

COLUMN = Column(
    "force_3x_n", lambda results: results["force_amplitude"].sel(order=3), head="Force 3×, N"
)
vibroacoustics.register(COLUMN)
