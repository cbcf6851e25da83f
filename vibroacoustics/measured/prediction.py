"""Sound pressure after changes of mounts, masses and absorbers, with a band, as labelled arrays."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.vocabulary import REFERENCE_OPTION, check, label_coordinates, stamp
from .assembly import Bench, assemble
from .band import TRIED, chosen_truncation, truncation_errors
from .change import changed_response
from .elements import Elements, elements_of, points_of
from .files import attributes, naming_settings
from .scatter import measured_again
from .settings import Prediction, load_prediction
from .variables import line_variables, total_variables

DRAWS_OF_TRUNCATION: Final = 10


def predict(path: str | Path) -> xr.Dataset:
    """Predict levels after changes from measurements alone, with a 90 % band.

    Parameters
    ----------
    path : TOML file with the tables `measured`, `mounts` and `changes`; docs/measured_changes.md

    Returns
    -------
    `predicted_pressure`, `predicted_level` (option, receiver, frequency),
    `predicted_total_level`, `predicted_total_change` (option, receiver, weighting), each level
    with `_low` and `_high`; `truncation` and what it was chosen by. The option `none` is the
    state as measured.

    Raises
    ------
    ParameterError
        Anything in the file or in the files that it names is missing, unknown, or outside its
        range.
    StorageError
        A file cannot be read.
    SolverError
        The changed structure resonates without damping at a frequency.

    Examples
    --------
    >>> predicted = va.predict("bench/bench.toml")
    >>> predicted["predicted_total_change"].sel(option="softer", weighting="A").round(1).values
    array([-3.8, -3.7])
    """
    path = Path(path)
    settings = load_prediction(path)
    with naming_settings(path):
        bench = assemble(settings.measured, points_of(settings), path.parent)
    return _labelled(settings, bench, path)


def _changed(bench: Bench, elements: Elements, truncation: float) -> ComplexArray:
    """Sound pressure after a change, shape (receiver, frequency)."""
    by_line = bench.values.T
    signs = bench.sign
    elongation = elements.elongation * signs
    transfer = by_line[:, bench.transfer] @ elongation.T
    compliance = elongation @ by_line[:, bench.compliance] @ elongation.T
    return changed_response(
        by_line[:, bench.pressure],
        transfer,
        compliance,
        by_line[:, bench.response] @ elongation.T,
        elements.stiffness,
        truncation,
    ).T


def _labelled(settings: Prediction, bench: Bench, path: Path) -> xr.Dataset:
    again = measured_again(bench.values, bench.error, settings.measured.draws)
    draws = [replace(bench, values=values) for values in again]
    measured = bench.values[bench.pressure]
    pressures, drawn = [measured], [np.array([draw.values[draw.pressure] for draw in draws])]
    truncations, errors = [0.0], [[0.0] * len(TRIED)]
    for change in settings.changes.values():
        elements = elements_of(settings, change, bench.frequency_hz)
        truncation, tried = _truncation(settings, bench, draws, elements)
        truncations.append(truncation)
        errors.append(tried.tolist())
        pressures.append(_changed(bench, elements, truncation))
        drawn.append(np.array([_changed(draw, elements, truncation) for draw in draws]))
    lines = {
        "option": [REFERENCE_OPTION, *settings.changes],
        "receiver": list(settings.measured.microphones),
        "frequency": bench.frequency_hz,
    }
    by_sample = np.stack(drawn, axis=1)
    variables = line_variables(np.array(pressures), by_sample, lines)
    variables |= total_variables(np.array(pressures), by_sample, lines)
    tried_at = {"option": lines["option"], "tried_truncation": list(TRIED)}
    variables["truncation"] = stamp("truncation", truncations, {"option": lines["option"]})
    variables["truncation_error"] = stamp("truncation_error", errors, tried_at)
    about = attributes("predict", path, settings.title, settings, settings.measured)
    about["reference_pressure_pa"] = REFERENCE_PRESSURE_PA
    dataset = xr.Dataset(variables, attrs=about)
    return check(label_coordinates(dataset))


def _truncation(
    settings: Prediction, bench: Bench, draws: Sequence[Bench], elements: Elements
) -> tuple[float, Array]:
    """The truncation, given or chosen, and what each tried one makes wrong."""
    tries = [
        lambda share, draw=draw: _changed(draw, elements, share)
        for draw in draws[:DRAWS_OF_TRUNCATION]
    ]
    errors = truncation_errors(_changed(bench, elements, 0.0), tries)
    given = settings.measured.truncation_ratio
    return chosen_truncation(errors) if given is None else given, errors
