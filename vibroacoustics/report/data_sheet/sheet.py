"""The data sheet of an option at an operating point, from the results of a run."""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr

from ...base.errors import ParameterError, SchemaError
from ..study import parameters, words
from .facts import mounting, operating
from .model import DataSheet
from .sound import sound_power, surfaces_m2
from .tones import prominent_tones
from .vibration import WORDS, offsets_m, vibration

Point = tuple[float, float, float]


def data_sheet(
    results: xr.Dataset,
    option: str,
    speed_rpm: float | None = None,
    microphones: Sequence[str] | None = None,
    points_m: Mapping[str, Point] | None = None,
) -> DataSheet:
    """What a maker states of a machine, predicted: sound power, tones, vibration, conditions.

    Parameters
    ----------
    results : of a run
    option : its balancing option
    speed_rpm : one of its speeds; default: the first
    microphones : from which the sound power comes; default: all
    points_m : named points of the housing besides feet and top: x, y and height above the floor

    Raises
    ------
    ParameterError
        The results have no such option, speed or microphone, or walls stand around the machine.
    SchemaError
        The results are of a version that kept no noise by band.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> sheet = va.data_sheet(results, "none", points_m={"discharge": (0.0, 0.08, 0.35)})
    >>> sheet.vibration[-1].point
    'discharge'
    """
    if "noise_band_level" not in results:
        raise SchemaError("the results hold no noise by band: run the study again")
    speed = float(results["speed"].values[0]) if speed_rpm is None else speed_rpm
    names = [str(name) for name in results["receiver"].values]
    chosen = list(microphones or names)
    _check("option", [option], [str(name) for name in results["option"].values])
    _check("speed_rpm", [speed], results["speed"].values.tolist())
    _check("microphones", chosen, names)
    surface = surfaces_m2(results, chosen)
    case = results.sel(option=option, speed=speed, receiver=chosen)
    study = parameters(results)
    tones, not_judged = prominent_tones(results, option, speed, chosen)
    return DataSheet(
        title=study["title"],
        machine=study["machine"]["name"],
        option=option,
        speed_rpm=speed,
        operating=operating(case),
        mounting=mounting(case),
        sound_power=sound_power(case, surface, study["radiation"]["surroundings"]["floor"]),
        tones=tones,
        tones_not_judged=not_judged,
        vibration=vibration(case, offsets_m(results, points_m or {})),
        vibration_words=WORDS,
        leaves_out=tuple(words(results)["leaves_out"]),
        created_utc=results.attrs["created_utc"],
        software_version=results.attrs["software_version"],
        parameters_sha256=results.attrs["parameters_sha256"],
    )


def _check(what: str, given: Sequence[str | float], there: Sequence[str | float]) -> None:
    for one in given:
        if one not in there:
            unit = " rpm" if isinstance(one, float) else ""
            known = ", ".join(f"{each:g}" if unit else str(each) for each in there)
            value = f"{one:g}" if isinstance(one, float) else one
            raise ParameterError(f"{what} = {value}{unit}: must be one of {known}{unit}")
    if len(set(given)) < len(given) or not np.size(given):
        raise ParameterError(f"{what}: must be given, each once")
