"""Sound power of an option from the levels at the study's microphones."""

from typing import Final, Literal

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import SILENCE_DB, level_of_power, power_of_level
from ...base.errors import ParameterError
from ...base.quantiles import weighted_quantiles
from ...base.rounding import LEVEL_FLOOR_DB
from ...levels.by_source import membership
from ...levels.measured_power import BANDS
from ..sampled_words import not_sampled_sentence
from ..study import has_samples, overall_noise, parameters
from .model import BandPower, SoundPower

SHARE_OF_SAMPLES: Final = 0.95
"""Of machines below L_WA + K (ISO 4871)."""
_LEAST_K_DB: Final = 0.05
"""Of samples whose levels differ; less is no uncertainty that could be declared."""
Rest = Literal["baseline", "remainder", "none"]
_DUST: Final = 1e-9
"""Of a band's energy: less is rounding, where the rest is what a total has beside the model."""
_SILENT_DB: Final = SILENCE_DB + 100.0
_BAND_HZ: Final = [band.nominal_hz for band in BANDS]
_REST: Final = {
    "baseline": (
        "measured baseline less what the model has of it, at {}; "
        "in other bands and at other microphones the remainder"
    ),
    "remainder": (
        "the published level less the model, with an assumed spectrum, alike at all microphones"
    ),
    "none": "nothing: no level of the machine is published; L_WA is that of the model alone",
}


def surfaces_m2(results: xr.Dataset, names: list[str]) -> Array:
    """Area of the hemisphere through each microphone about the machine's axis on the floor.

    Without a floor of the sphere about the centre of mass. (microphone,), m².

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
    radius = [np.hypot(np.hypot(at["x_m"], at["y_m"]), at["height_m"] - middle) for at in positions]
    return (2.0 if around["floor"] else 4.0) * np.pi * np.square(radius)


def power_db(level_db: Array, surface_m2: Array) -> Array:
    """LW = 10 lg mean(p²/p0² S/S0): of each microphone p² S, then the mean over them, dB.

    Parameters
    ----------
    level_db : sound pressure levels, shape (..., microphone); not a number stays so
    surface_m2 : of each microphone
    """
    return np.asarray(level_of_power(np.mean(power_of_level(level_db) * surface_m2, axis=-1)))


def sound_power(case: xr.Dataset, surface_m2: Array, floor: bool) -> SoundPower:
    """Of an option at a speed.

    Parameters
    ----------
    case : results at the option, the speed and the microphones
    surface_m2 : of `surfaces_m2`
    floor : whether the machine stands on a hard floor
    """
    modelled = _modelled(case)
    total = _total(case, modelled)
    left = total - modelled
    rest = np.where(left > _DUST * total, left, 0.0)
    shown = [_level(each @ surface_m2 / surface_m2.size) for each in (modelled, rest, total)]
    names = tuple(str(name) for name in np.atleast_1d(case["receiver"].values))
    kind, measured = _kind_of_rest(case)
    nominal = float(power_db(case["level_total"].values, surface_m2))
    level, alone, k_db = _levels(case, surface_m2, nominal)
    edges = [band for band in BANDS if band.nominal_hz in case["band"].values]
    return SoundPower(
        microphones=names,
        surface_m2=float(surface_m2.mean()),
        determined=_determined(len(names), floor),
        level_dba=level,
        modelled_dba=alone if alone > LEVEL_FLOOR_DB else None,
        nominal_dba=nominal,
        uncertainty_k_db=k_db,
        uncertainty_words=_uncertainty_words(case, nominal, k_db),
        model_range_hz=(edges[0].lower_hz, edges[-1].upper_hz) if edges else (0.0, 0.0),
        rest=kind,
        rest_words=_REST[kind].format(measured),
        bands=tuple(
            BandPower(band_hz=band, modelled_db=a, rest_db=b, total_db=c)
            for band, a, b, c in zip(_BAND_HZ, *shown, strict=True)
        ),
    )


def _modelled(case: xr.Dataset) -> Array:
    """Energies of lines, sources added as phasors, and noise, (band, microphone), re 20 µPa."""
    pressure = case["pressure_line"].sum("sound_source").transpose("line", "receiver").values
    hertz = np.nan_to_num(case["tone_frequency"].values)
    square = 0.5 * np.abs(pressure) ** 2 / REFERENCE_PRESSURE_PA**2
    lines = membership(hertz, BANDS).T @ square
    filled = np.isin(_BAND_HZ, case["band"].values)
    return np.where(filled[:, None], lines + _energies(case["noise_band_level"]), 0.0)


def _total(case: xr.Dataset, modelled: Array) -> Array:
    """Energies of model and rest, (band, microphone), re 20 µPa: where one stands, the baseline."""
    remainder = _energies(case["unmodelled_band_level"].expand_dims(receiver=case["receiver"]))
    both = modelled + remainder
    if "baseline_band_level" not in case:
        return both
    measured = case["baseline_band_level"].reindex(baseline_band=_BAND_HZ)
    ordered = measured.transpose("baseline_band", "receiver").values
    return np.where(np.isnan(ordered), both, power_of_level(ordered))


def _energies(level: xr.DataArray) -> Array:
    ordered = level.sel(noise_band=_BAND_HZ).transpose("noise_band", "receiver").values
    return np.where(ordered > _SILENT_DB, power_of_level(ordered), 0.0)


def _level(energy: Array) -> list[float | None]:
    """Levels of the bands; none where what there is lies next to rounding errors."""
    levels = level_of_power(energy).tolist()
    return [one if one > LEVEL_FLOOR_DB else None for one in levels]


def _kind_of_rest(case: xr.Dataset) -> tuple[Rest, str]:
    beside: Rest = "none" if overall_noise(case) is None else "remainder"
    if "baseline_band_level" not in case:
        return beside, ""
    known = case["baseline_band_level"].notnull().any("baseline_band")
    names = [str(name) for name in case["receiver"].values[known.values]]
    return ("baseline", ", ".join(names)) if names else (beside, "")


def _levels(
    case: xr.Dataset, surface_m2: Array, nominal: float
) -> tuple[float, float, float | None]:
    """L_WA, that of the model alone, and K: median and 95 % quantile of the weighted samples, dB.

    Without samples the nominal levels and no K; no K either where the samples do not differ.
    """
    if not has_samples(case):
        modelled = case["level_modelled"].sel(weighting="A").values
        return nominal, float(power_db(modelled, surface_m2)), None
    weight = case["sample_weight"].values[0]
    by_sample = np.stack(
        [
            power_db(case[name].transpose("sample", "receiver").values, surface_m2)
            for name in ("level_total_by_sample", "level_modelled_by_sample")
        ],
        axis=-1,
    )
    (level, alone), (limit, _) = weighted_quantiles(by_sample, weight, (0.5, SHARE_OF_SAMPLES))
    k_db = float(limit - level)
    return float(level), float(alone), k_db if k_db > _LEAST_K_DB else None


def _uncertainty_words(case: xr.Dataset, nominal: float, k_db: float | None) -> str:
    if not has_samples(case):
        why = not_sampled_sentence(case)
        return "nothing was sampled: K is not known" + (f". {why[:-1]}" if why else "")
    weight = case["sample_weight"].values[0]
    none = overall_noise(case) is None and "baseline_band_level" not in case
    how = "equally weighted" if none else "weighted by the published level or the baseline"
    k_words = (
        f"K is the {SHARE_OF_SAMPLES:.0%} quantile less L_WA"
        if k_db is not None
        else "K is not known: the samples do not differ"
    )
    return (
        f"L_WA is the median of {np.count_nonzero(weight)} samples of the uncertain parameters, "
        f"{how}; {k_words}, without the scatter of measuring (ISO 3744: 1.5 dB). Bands and tones "
        f"are those of the nominal values, which give {rounding.fixed(nominal)} dB"
    )


def _determined(count: int, floor: bool) -> str:
    shape = "hemisphere on the floor" if floor else "sphere about the centre of mass"
    few = "" if count >= 10 else "; ISO 3744 asks for ten"
    return (
        f"mean over {count} microphone{'' if count == 1 else 's'} of p² times the area of the "
        f"{shape} through each, as in ISO 3744 without K1 and K2{few}"
    )
