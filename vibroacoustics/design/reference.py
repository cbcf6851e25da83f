"""What the model leaves of the level of the nominal machine, with the options as given."""

from collections.abc import Callable
from functools import cache

import numpy as np

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import power_of_level
from ..base.progress import no_progress
from ..pipeline.study import run
from ..radiation.given import Radiation
from ..study.study import Study


def unmodelled_of(study: Study, radiation: Radiation) -> Callable[[str], Array]:
    """Return what gives the mean square beside the modelled sound of an option as given.

    Its result has the shape (1, speed, receiver), in Pa². The study is run at the first call.

    Parameters
    ----------
    study : with its published level or measured baseline
    radiation : gives the transfer vectors

    Raises
    ------
    ParameterError
        The nominal model is louder than the published level.
    """

    @cache
    def of_options() -> dict[str, Array]:
        operation = study.operation.model_copy(update={"stopping": False, "turning_back": False})
        nominal = study.model_copy(update={"ranges": (), "operation": operation})
        results = run(nominal, no_progress, radiation)
        modelled = results["level_modelled"].sel(weighting="A")
        left = power_of_level(results["level_total"]) - power_of_level(modelled)
        squares = REFERENCE_PRESSURE_PA**2 * left.transpose("option", "speed", "receiver").values
        options = results["option"].values.tolist()
        return dict(zip(options, np.maximum(squares, 0.0)[:, None], strict=True))

    return lambda option: of_options()[option]
