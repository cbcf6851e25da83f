"""Sound power of an option from the levels at the study's microphones."""

from typing import Final, Literal, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import SILENCE_DB, level_of_power, power_of_level
from ..base.errors import ParameterError
from ..base.quantiles import weighted_quantiles
from ..base.rounding import LEVEL_FLOOR_DB
from ..levels.by_source import LOWEST_BAND_HZ
from ..levels.declared_level import (
    MEASUREMENT_DEVIATION_DB,
    SHARE,
    combined_deviation_db,
    upper_limit_db,
)
from ..levels.measured_power import BANDS
from ..results.data_sheet import BandPower, SoundPower
from ..results.estimates import has_samples, in_samples, nominal, sample_numbers, weighted_estimate
from ..results.sample_words import not_sampled_sentence, prior_words
from ..results.stored_study import overall_noise, parameters

_LEAST_SPREAD_DB: Final = 0.05
"""Smallest spread of samples whose levels differ; less is no uncertainty of the model."""
Rest = Literal["baseline", "unmodelled noise", "none"]
_ROUNDING: Final = 1e-9
"""Part of a band's energy that is a rounding error, in a difference of total and model."""
_SILENT_DB: Final = SILENCE_DB + 100.0
_BAND_HZ: Final = [band.nominal_hz for band in BANDS]
_REST: Final = {
    "baseline": (
        "the measured baseline less the modelled sources, at {}; "
        "in other bands and at other microphones unmodelled noise"
    ),
    "unmodelled noise": "unmodelled noise with an assumed spectrum, spread as from a point source",
    "none": "nothing: no level of the machine is published; L_WA is that of the modelled sources",
}


class _Levels(NamedTuple):
    """L_WA of the machine and of the modelled sources, its limit and the part of the model, dB."""

    level: float
    modelled: float
    k: float | None = None
    spread: float | None = None


def surfaces_m2(results: xr.Dataset, names: list[str]) -> Array:
    """Return the area of the hemisphere through each microphone about the axis on the floor.

    Without a floor that of the sphere about the centre of mass. (microphone,), m².

    Raises
    ------
    ParameterError
        Walls or a cabinet stand around the machine.
    """
    study = parameters(results)
    around = study["radiation"]["surroundings"]
    if around["walls"] or around["cabinet"]:
        raise ParameterError(
            "data sheet: sound power holds over a hard floor alone; the study has walls or a "
            "cabinet around the machine"
        )
    positions = [study["receivers"][name] for name in names]
    shell = study["machine"]["shell"]
    centre = shell["centre_of_mass_height_m"] + shell["floor_clearance_m"]
    middle = 0.0 if around["floor"] else centre
    radius = [
        np.hypot(np.hypot(point["x_m"], point["y_m"]), point["height_m"] - middle)
        for point in positions
    ]
    return (2.0 if around["floor"] else 4.0) * np.pi * np.square(radius)


def power_db(level_db: Array, surface_m2: Array) -> Array:
    """Return LW = 10 lg mean(p²/p0² S/S0), the mean over the microphones, dB.

    Parameters
    ----------
    level_db : sound pressure levels, shape (..., microphone); not a number stays so
    surface_m2 : surface of each microphone, shape (microphone,)
    """
    return np.asarray(level_of_power(np.mean(power_of_level(level_db) * surface_m2, axis=-1)))


def sound_power(
    case: xr.Dataset, surface_m2: Array, floor: bool, batch_deviation_db: float | None = None
) -> SoundPower:
    """Return the sound power of an option at a speed.

    Parameters
    ----------
    case : results at the option, the speed and the microphones
    surface_m2 : see `surfaces_m2`
    floor : whether the machine is on a hard floor
    batch_deviation_db : assumed standard deviation of the machines of a batch; none for one machine
    """
    names = tuple(str(name) for name in np.atleast_1d(case["receiver"].values))
    kind, measured = _kind_of_rest(case)
    of_nominal = float(power_db(nominal(case, "level_total").values, surface_m2))
    highest_hz = float(parameters(case)["radiation"]["maximum_frequency_hz"])
    levels = _levels(case, surface_m2, combined_deviation_db(batch_deviation_db))
    return SoundPower(
        microphones=names,
        surface_m2=float(surface_m2.mean()),
        determined=_determined(len(names), floor),
        level_dba=levels.level,
        modelled_dba=levels.modelled if levels.modelled > LEVEL_FLOOR_DB else None,
        nominal_dba=of_nominal,
        uncertainty_k_db=levels.k,
        model_spread_db=levels.spread,
        measurement_deviation_db=MEASUREMENT_DEVIATION_DB,
        batch_deviation_db=batch_deviation_db,
        uncertainty_words=_uncertainty_words(case, of_nominal, levels, batch_deviation_db),
        prior=_prior(case),
        model_range_hz=(LOWEST_BAND_HZ, highest_hz),
        unmodelled_kind=kind,
        unmodelled_words=_REST[kind].format(measured),
        bands=_bands(case, surface_m2, highest_hz),
    )


def _bands(case: xr.Dataset, surface_m2: Array, highest_hz: float) -> tuple[BandPower, ...]:
    is_covered = [band.lower_hz < highest_hz for band in BANDS]
    modelled = _energies(case["sources_band_level"])
    unmodelled = _energies(case["unmodelled_band_level"])
    total = _energies(case["total_band_level"]) if _is_whole(case) else modelled + unmodelled
    if "baseline_band_level" in case:
        total = _with_baseline(case, total)
        beside = total - modelled
        unmodelled = np.where(beside > _ROUNDING * total, beside, 0.0)
    parts = [_level(part @ surface_m2 / surface_m2.size) for part in (modelled, unmodelled, total)]
    return tuple(
        BandPower(
            band_hz=band,
            modelled_db=of_model,
            modelled_below_db=LEVEL_FLOOR_DB if covered and of_model is None else None,
            unmodelled_db=of_noise,
            total_db=of_machine,
        )
        for band, covered, of_model, of_noise, of_machine in zip(
            _BAND_HZ, is_covered, *parts, strict=True
        )
    )


def _is_whole(case: xr.Dataset) -> bool:
    """Return whether the results have levels of the machine by third octave."""
    return "total_band_level" in case and "baseline_band_level" not in case


def _with_baseline(case: xr.Dataset, total: Array) -> Array:
    """Energies of the machine, (band, microphone), re 20 µPa: where measured, the baseline."""
    measured = case["baseline_band_level"].reindex(baseline_band=_BAND_HZ)
    ordered = measured.transpose("baseline_band", "receiver").values
    return np.where(np.isnan(ordered), total, power_of_level(ordered))


def _energies(level: xr.DataArray) -> Array:
    """Energies of levels in the bands of the sheet, (band, microphone), re 20 µPa."""
    if not np.isin(_BAND_HZ, level["noise_band"]).all():
        raise ParameterError("noise_band: third octaves of the sheet are missing in the results")
    ordered = level.sel(noise_band=_BAND_HZ).transpose("noise_band", "receiver").values
    return np.where(ordered > _SILENT_DB, power_of_level(ordered), 0.0)


def _level(energy: Array) -> list[float | None]:
    """Levels of the bands; none of those below the floor of levels."""
    levels = level_of_power(energy).tolist()
    return [level_db if level_db > LEVEL_FLOOR_DB else None for level_db in levels]


def _kind_of_rest(case: xr.Dataset) -> tuple[Rest, str]:
    beside: Rest = "none" if overall_noise(case) is None else "unmodelled noise"
    if "baseline_band_level" not in case:
        return beside, ""
    is_measured = case["baseline_band_level"].notnull().any("baseline_band")
    names = [str(name) for name in case["receiver"].values[is_measured.values]]
    return ("baseline", ", ".join(names)) if names else (beside, "")


def _levels(case: xr.Dataset, surface_m2: Array, deviation_db: float) -> _Levels:
    """Return L_WA and K_WA from the sound power in each sample; without samples nominal levels."""
    if not has_samples(case):
        alone = case["level_modelled"].sel(weighting="A")
        total = float(power_db(case["level_total"].values, surface_m2))
        return _Levels(total, float(power_db(alone.values, surface_m2)))
    machine, modelled = (in_samples(case, name) for name in ("level_total", "level_modelled"))
    level_db = power_db(machine.values.values, surface_m2)
    of_model = weighted_estimate(
        power_db(modelled.values.values, surface_m2), modelled.weight
    ).value
    level, high = weighted_quantiles(level_db, machine.weight, (0.5, SHARE)).tolist()
    if high - level <= _LEAST_SPREAD_DB:
        return _Levels(level, of_model)
    limit = upper_limit_db(level_db, machine.weight, deviation_db)
    return _Levels(level, of_model, limit - level, high - level)


def _uncertainty_words(
    case: xr.Dataset, of_nominal: float, levels: _Levels, batch_deviation_db: float | None
) -> str:
    if not has_samples(case):
        why = not_sampled_sentence(case)
        return "nothing was sampled: K_WA is not known" + (f". {why[:-1]}" if why else "")
    count = sample_numbers(case).computed
    none = overall_noise(case) is None and "baseline_band_level" not in case
    how = "equally" if none else "by the likelihood of the published level or the baseline"
    median = f"L_WA is the median of {count} samples, weighted {how}"
    with_nominal = f"with the nominal values it is {rounding.fixed(of_nominal)} dB"
    if levels.spread is None:
        return f"{median}; {with_nominal}; K_WA is not known: the samples do not differ"
    return f"{median}; {with_nominal}. {_k_words(levels.spread, batch_deviation_db)}"


def _k_words(spread_db: float, batch_deviation_db: float | None) -> str:
    """Return what K_WA holds, with the deviations."""
    is_single = batch_deviation_db is None
    batch = "" if is_single else f"; production, an assumed deviation of {batch_deviation_db:g} dB"
    whose = "the machine" if is_single else "a machine of the batch"
    return (
        f"{SHARE:.0%} of measurements of {whose} are below L_WA + K_WA. K_WA holds the model, "
        f"{rounding.fixed(spread_db)} dB alone; measurement by ISO 3744, grade 2, a deviation of "
        f"{MEASUREMENT_DEVIATION_DB:g} dB{batch}"
    )


def _prior(case: xr.Dataset) -> str:
    """Return the prior of the unmodelled noise in words."""
    if overall_noise(case) is None and "baseline_band_level" not in case:
        return "no unmodelled noise: no level of the machine is published"
    if not has_samples(case):
        return "none: nothing was sampled"
    return f"unmodelled noise {prior_words(case)[0]}"


def _determined(count: int, floor: bool) -> str:
    shape = "hemisphere on the floor" if floor else "sphere about the centre of mass"
    few = "" if count >= 10 else "; ISO 3744 asks for ten"
    return (
        f"mean over {count} microphone{'' if count == 1 else 's'} of p² times the area of the "
        f"{shape} through each, as in ISO 3744 without K1 and K2{few}"
    )
