"""The data sheet of an option at an operating point, from the results of a run."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.errors import ParameterError, SchemaError
from ..base.hashing import sha256
from ..results.data_sheet import DataSheet
from ..results.stored_study import parameters, words
from ..study.example import example_sentence
from .facts import mounting, not_available, operating
from .rated_windows import rated_windows
from .sound import sound_power, surfaces_m2
from .tones import not_judged, prominent_tones
from .vibration import WORDS, offsets_m, vibration

Point = tuple[float, float, float]
LARGEST_BATCH_DEVIATION_DB: Final = 10.0


def data_sheet(
    results: xr.Dataset,
    option: str,
    speed_rpm: float | None = None,
    microphones: Sequence[str] | None = None,
    points_m: Mapping[str, Point] | None = None,
    batch_deviation_db: float | None = None,
) -> DataSheet:
    """Predict the data sheet of a machine: sound power, tones, vibration, conditions.

    Parameters
    ----------
    results : results of a run
    option : its balancing option
    speed_rpm : one of its speeds; default: the first
    microphones : from which the sound power comes; default: all
    points_m : named points of the housing besides feet and top: x, y and height above the floor
    batch_deviation_db : assumed standard deviation of the levels of machines of a batch, for which
        L_WA and K_WA then hold; default: they hold for a single machine

    Raises
    ------
    ParameterError
        The results have no such option, speed or microphone, there are walls around the machine,
        or the deviation is out of range.
    SchemaError
        The results are of a version without tones or noise by band.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> sheet = va.data_sheet(results, "none", points_m={"discharge": (0.0, 0.08, 0.35)})
    >>> sheet.vibration[-1].point
    'discharge'
    """
    if not {"noise_band_level", "tone_excess"} <= set(results):
        raise SchemaError("the results have no noise by band or no tones: run the study again")
    _check_deviation(batch_deviation_db)
    speed = float(results["speed"].values[0]) if speed_rpm is None else speed_rpm
    names = [str(name) for name in results["receiver"].values]
    chosen = list(microphones or names)
    _check("option", [option], [str(name) for name in results["option"].values])
    _check("speed_rpm", [speed], results["speed"].values.tolist())
    _check("microphones", chosen, names)
    surface = surfaces_m2(results, chosen)
    case = results.sel(option=option, speed=speed, receiver=chosen)
    study = parameters(results)
    floor = study["radiation"]["surroundings"]["floor"]
    examples = sum(bool(record.get("example")) for record in study["records"])
    return DataSheet(
        example=example_sentence(examples, len(study["records"])),
        title=study["title"],
        machine=study["machine"]["name"],
        option=option,
        speed_rpm=speed,
        operating=operating(case),
        mounting=mounting(case),
        sound_power=sound_power(case, surface, floor, batch_deviation_db),
        tones=prominent_tones(results, option, speed, chosen),
        any_tone_probability=float(case["any_tone_probability"].max()),
        tones_not_judged=not_judged(results, option, speed, chosen),
        audibility_db=float(case["decisive_audibility"].max()),
        tonal_adjustment_db=float(case["tonal_adjustment"].max()),
        windows=rated_windows(case),
        vibration=vibration(case, offsets_m(results, points_m or {})),
        vibration_words=WORDS,
        leaves_out=tuple(words(results)["leaves_out"]),
        not_available=not_available(len(chosen)),
        created_utc=results.attrs["created_utc"],
        software_version=results.attrs["software_version"],
        parameters_sha256=sha256(results.attrs["parameters"].encode()),
    )


def _check_deviation(batch_deviation_db: float | None) -> None:
    if batch_deviation_db is None or 0.0 < batch_deviation_db <= LARGEST_BATCH_DEVIATION_DB:
        return
    raise ParameterError(
        f"batch_deviation_db = {batch_deviation_db:g} dB: must be above 0, to "
        f"{LARGEST_BATCH_DEVIATION_DB:g} dB"
    )


def _check(what: str, values: Sequence[str | float], allowed: Sequence[str | float]) -> None:
    for value in values:
        if value not in allowed:
            unit = " rpm" if isinstance(value, float) else ""
            names = ", ".join(f"{each:g}" if unit else str(each) for each in allowed)
            word = f"{value:g}" if isinstance(value, float) else value
            raise ParameterError(f"{what} = {word}{unit}: must be one of {names}{unit}")
    if len(set(values)) < len(values) or not np.size(values):
        raise ParameterError(f"{what}: must be given, each once")
