"""A third party's source: a table of force along x over crank angle, taken from elsewhere."""

from typing import ClassVar

import numpy as np
from pydantic import Field

import vibroacoustics
from vibroacoustics import Case, Loads, Wrench


@vibroacoustics.register
class ForceTable(vibroacoustics.Source):
    """Forces at uniform crank angles from zero, the same at every speed."""

    kind: ClassVar[str] = "force-table"
    label: ClassVar[str] = "force of the table"
    labels: ClassVar[dict[str, str]] = {"table_peak_n": "Largest force of the table"}
    force_n: tuple[float, ...] = Field(min_length=3)

    def loads(self, case: Case, before: dict) -> Loads:
        """The table through its Fourier series, at the crank angles of the revolution."""
        samples = case.revolution.rotation.crank_angle.size
        spectrum = np.fft.rfft(self.force_n) / len(self.force_n)
        force = np.zeros((3, samples))
        force[0] = np.fft.irfft(spectrum * samples, samples)
        peak = float(np.max(np.abs(self.force_n)))
        return Loads(
            wrenches={"table": Wrench(force, np.zeros((3, samples)))},
            figures={"table_peak_n": peak},
        )
