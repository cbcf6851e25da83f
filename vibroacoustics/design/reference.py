"""What designs are compared with: the study as given, without an option."""

from collections.abc import Sequence

import numpy as np

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import power_of_level
from ..base.progress import no_progress
from ..base.vocabulary import REFERENCE_OPTION
from ..pipeline.study import run
from ..radiation.given import Radiation
from ..study.selection import at_speeds
from ..study.study import Study
from .engine.runs import seen_of_run
from .engine.seen import Need, Seen
from .engine.sound_way import Ways


def reference_of(study: Study, needs: Sequence[Need], ways: Ways) -> Seen:
    """What is seen of the study as given without an option, shape (1, ...)."""
    speeds = study.operation.speed_rpm
    alone = at_speeds(study, speeds, {REFERENCE_OPTION: study.options[REFERENCE_OPTION]})
    return seen_of_run(alone, REFERENCE_OPTION, needs, ways)


def remainder_of(study: Study, options: Sequence[str], radiation: Radiation) -> Array:
    """What the model leaves of the machine's level as given, by option, Pa².

    Parameters
    ----------
    study : with its published level or measured baseline
    options : of the study
    radiation : gives the transfer vectors

    Returns
    -------
    mean square, shape (option, speed, receiver)

    Raises
    ------
    ParameterError
        The model as given is louder than the published level.
    """
    operation = study.operation.model_copy(update={"stopping": False, "turning_back": False})
    as_given = study.model_copy(update={"ranges": (), "operation": operation})
    results = run(as_given, no_progress, radiation)
    total = results["level_total"].sel(option=list(options))
    modelled = results["level_modelled"].sel(option=list(options), weighting="A")
    left = power_of_level(total) - power_of_level(modelled)
    squares = REFERENCE_PRESSURE_PA**2 * left.transpose("option", "speed", "receiver").values
    return np.maximum(squares, 0.0)
