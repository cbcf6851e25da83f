"""What draws are weighed by: the machine's published level, or nothing where it has none."""

from typing import NamedTuple

import numpy as np

from ..study.study import Study
from .agreement import ALL_ALIKE, Prior, priors_of


class Published(NamedTuple):
    """The published level, as it weighs draws.

    Attributes
    ----------
    level_dba : zero without a published level, over which levels then are what they are
    deviation_db : infinite without one, so that every draw with a solution counts alike
    priors : of the remainder, that of the bands first
    """

    level_dba: float
    deviation_db: float
    priors: tuple[Prior, ...]


def published_of(study: Study) -> Published:
    """The published level of a study's machine."""
    noise = study.machine.overall_noise
    level, deviation = (0.0, np.inf) if noise is None else (noise.level_dba, noise.deviation_db)
    priors = priors_of(study.machine.remainder) if noise or study.baseline else (ALL_ALIKE,)
    return Published(level, deviation, priors)
