"""What the sources leave unexplained of the machine's published level."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level, power_of_level
from ..base.errors import ParameterError, SolverError
from ..machine.source import CaseKey
from ..study.study import Study
from .axes import LevelAxes
from .by_source import SourceSound

LEAST_DRAWS: Final = 3
"""Draws that must be left for a band."""


def remainder(
    study: Study, axes: LevelAxes, sound: Mapping[CaseKey, SourceSound], may_be_none: bool
) -> float:
    """Mean square that the model leaves of the published level at its microphone and speed, Pa².

    Parameters
    ----------
    study : with the published level
    axes : with its receiver
    sound : of the case without a balancer at its speed and operating point, and of other cases
    may_be_none : whether none is left where the model alone is louder, as in a draw

    Raises
    ------
    ParameterError
        The model alone is louder.
    """
    published = study.machine.overall_noise
    receiver = list(axes.receivers).index(study.catalogue_receiver)
    alone = sound[study.catalogue_case].total[0, receiver]
    rest = REFERENCE_PRESSURE_PA**2 * power_of_level(published.level_dba) - alone
    if rest <= 0.0 and not may_be_none:
        level = mean_square_level(alone, REFERENCE_PRESSURE_PA)
        raise ParameterError(
            f"machine: overall_noise.level_dba = {published.level_dba:g} dB(A): the model alone "
            f"gives {level:.1f} dB(A) at {study.catalogue_receiver}"
        )
    return float(max(rest, 0.0))


def remainder_by_draw(
    study: Study, axes: LevelAxes, sounds: Sequence[Mapping[CaseKey, SourceSound]]
) -> Array:
    """The same of every draw, shape (draw,), Pa².

    Zero where its model alone is louder, or has no solution.

    Raises
    ------
    SolverError
        Nearly all draws are louder, or have no solution.
    """
    rests = np.array([remainder(study, axes, sound, may_be_none=True) for sound in sounds])
    rests = np.nan_to_num(rests)
    if np.count_nonzero(rests) < LEAST_DRAWS:
        raise SolverError(
            f"uncertainty.random_samples: only {np.count_nonzero(rests)} of {rests.size} draws are "
            f"below the published level, {LEAST_DRAWS} are needed; draw more, or look at the ranges"
        )
    return rests
