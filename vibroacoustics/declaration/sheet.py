"""The data sheet of an option at an operating point, from the results of a run."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.decibel import NO_TONE_DB
from ..base.errors import ParameterError, SchemaError
from ..base.plain_bytes import sha256
from ..levels.hearing import hearing_threshold_db
from ..results.data_sheet import DataSheet, RatedWindow, Tone
from ..results.estimates import interval
from ..results.prominent_tones import ProminentTone, listed_tones
from ..results.stored_study import parameters, words
from ..study.example import example_sentence
from .facts import WORDS, mounting, not_available, offsets_m, operating, vibration
from .sound import sound_power, surfaces_m2


def prominent_tones(
    results: xr.Dataset, option: str, speed_rpm: float, microphones: Sequence[str]
) -> tuple[Tone, ...]:
    """Return each prominent tone once, at the microphone with its largest excess.


    Returns
    -------
    tones, rising in frequency
    """
    largest: dict[str, ProminentTone] = {}
    for microphone in microphones:
        for tone in listed_tones(results, option, microphone, speed_rpm):
            before = largest.get(tone.name)
            if before is None or tone.excess_db.value > before.excess_db.value:
                largest[tone.name] = tone
    rising = sorted(largest.values(), key=lambda tone: tone.frequency_hz)
    return tuple(map(_stated, rising))


def not_judged(
    results: xr.Dataset, option: str, speed_rpm: float, microphones: Sequence[str]
) -> int:
    """Return the number of audible tones that are judged at no microphone.

    A tone is not judged where there is no noise in its critical band.
    """
    case = results.sel(option=option, speed=speed_rpm, receiver=list(microphones))
    hertz = case["judged_tone_frequency"].values
    has_frequency = np.isfinite(hertz)
    threshold = np.array([hearing_threshold_db(value) for value in hertz[has_frequency].tolist()])
    level, excess = (
        case[name].transpose("receiver", "judged_tone").values[:, has_frequency]
        for name in ("tone_level", "tone_excess")
    )
    without = (level >= threshold) & (excess <= NO_TONE_DB)
    return int((without.any(axis=0) & (excess <= NO_TONE_DB).all(axis=0)).sum())


def _stated(tone: ProminentTone) -> Tone:
    low = tone.excess_db.low
    return Tone(
        name=tone.name,
        frequency_hz=tone.frequency_hz,
        microphone=tone.microphone,
        level_db=tone.level_db,
        excess_db=tone.excess_db.value,
        excess_low_db=low if low > NO_TONE_DB else None,
        excess_high_db=tone.excess_db.high,
        probability=tone.probability,
    )


def rated_windows(case: xr.Dataset) -> tuple[RatedWindow, ...]:
    """Return the rating levels at all windows; empty without windows.

    Parameters
    ----------
    case : results of an option at a speed
    """
    if "rating_level" not in case:
        return ()
    level = interval(case, "rating_level")
    return tuple(
        RatedWindow(
            window=window,
            rating_level_dba=float(level["value"].sel(rating_window=window)),
            rating_level_low_dba=float(level["low"].sel(rating_window=window)),
            rating_level_high_dba=float(level["high"].sel(rating_window=window)),
            adjustment_db=float(case["rating_adjustment"].sel(rating_window=window)),
            limit_dba=float(case["rating_limit"].sel(rating_window=window)),
            limit_probability=float(case["limit_probability"].sel(rating_window=window)),
        )
        for window in map(str, case["rating_window"].values)
    )


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
