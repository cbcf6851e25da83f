"""Measured third octaves of the machine as data that weigh samples.

The sums over octaves weigh. Which third octave of an octave a resonance falls into is beyond the
model: its discrepancies are correlated over an octave.
"""

from collections.abc import Mapping
from functools import partial
from typing import NamedTuple

import numpy as np

from ..base.arrays import Array, IndexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import energy_sum, level_of_power
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.source import CaseKey
from ..study.study import Study
from .agreement import Datum
from .bands import Band
from .by_source import GAIN_BANDS, gain_band_number


class SpectrumData(NamedTuple):
    """A measured spectrum at its microphone and case.

    Attributes
    ----------
    receiver : name of the microphone
    case : speed and option
    column : numbers of `GAIN_BANDS` that were measured, shape (band,)
    level_dba : measured, A-weighted, shape (band,)
    deviation_db : standard deviation of a level
    data : sums over octaves
    """

    receiver: str
    case: CaseKey
    column: IndexArray
    level_dba: Array
    deviation_db: float
    data: tuple[Datum, ...]


def spectrum_data(study: Study) -> SpectrumData | None:
    """Return the measured spectrum of a study; None without one."""
    spectrum = study.evidence.spectrum
    if spectrum is None:
        return None
    spectrum = spectrum.within(study.radiation.maximum_frequency_hz)
    at_published = spectrum.operating_point not in (None, study.operation.point)
    case = study.catalogue_case if at_published else (spectrum.speed_rpm, REFERENCE_OPTION)
    column = gain_band_number(np.array(spectrum.band_hz))
    level_dba, deviation = np.array(spectrum.level_dba), spectrum.deviation_db
    data = tuple(
        Datum(
            f"octave {Band(1, octave).nominal_hz:g} Hz",
            float(energy_sum(level_dba[rows], axis=0)),
            deviation,
            partial(_sum_dba, column[rows]),
        )
        for octave, rows in rows_by_octave(column).items()
    )
    return SpectrumData(spectrum.microphone, case, column, level_dba, deviation, data)


def rows_by_octave(column: IndexArray) -> Mapping[int, list[int]]:
    """Return the rows of third octaves by the octave that holds them, from 1 kHz, rising.

    Parameters
    ----------
    column : numbers of `GAIN_BANDS`, shape (band,)
    """
    octave_of = [round(GAIN_BANDS[number].index / 3) for number in column.tolist()]
    return {
        octave: [row for row, of_row in enumerate(octave_of) if of_row == octave]
        for octave in sorted(set(octave_of))
    }


def _sum_dba(columns: IndexArray, bands: Array) -> Array:
    return level_of_power(bands[..., columns].sum(axis=-1) / REFERENCE_PRESSURE_PA**2)
