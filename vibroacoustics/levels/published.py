"""Published and measured data of a study's machine, which weigh samples."""

from typing import NamedTuple

from ..study.study import Study
from .agreement import ALL_ALIKE, Datum, Prior, data_of, priors_of
from .spectrum_data import SpectrumData, spectrum_data


class Published(NamedTuple):
    """Data of the machine, as they weigh samples.

    Attributes
    ----------
    level_dba : zero without a published level, to which levels then are relative
    data : empty without a published level
    priors : priors of the unmodelled noise; the first one is that of all intervals
    spectrum : measured third octaves; None without any
    """

    level_dba: float
    data: tuple[Datum, ...]
    priors: tuple[Prior, ...]
    spectrum: SpectrumData | None = None


def published_of(study: Study) -> Published:
    """Return the published data of a study's machine."""
    noise = study.machine.overall_noise
    priors = priors_of(study.machine.remainder) if noise or study.baseline else (ALL_ALIKE,)
    level_dba = 0.0 if noise is None else noise.level_dba
    return Published(level_dba, data_of(noise), priors, spectrum_data(study))
