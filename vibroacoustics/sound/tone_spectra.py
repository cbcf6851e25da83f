"""Lines and noise of all cases, in which tones are judged; also where some were measured."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import SILENCE_DB, power_of_level
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import stamped
from ..levels.by_source import membership
from ..levels.measured_points import BASELINE_BANDS, MIDDLE_HZ
from .audibility import tonal_adjustment_db
from .ingredients import ROUNDING_SHARE
from .predicted_audibility import predicted_audibility
from .prominence import judged_tones

_ORDER = "order "


class ToneSpectra(NamedTuple):
    """Lines and noise of all cases.

    Attributes
    ----------
    frequency_hz : frequency of the lines, not a number where there is none, shape (speed, line)
    square : mean squares of the lines, shape (..., speed, option, receiver, line), Pa²
    noise : mean square of the noise in `BASELINE_BANDS`, shape (..., speed, option, receiver,
        band), Pa²
    """

    frequency_hz: Array
    square: Array
    noise: Array

    def in_bands(self) -> Array:
        """Return the mean squares of the lines in `BASELINE_BANDS`, (..., receiver, band), Pa²."""
        in_band = np.stack([membership(hertz, BASELINE_BANDS) for hertz in self.frequency_hz])
        return np.asarray(self.square @ in_band[:, None])

    def with_measured(
        self, names: Sequence[str], orders: Sequence[float], order_db: Array, band_db: Array
    ) -> "ToneSpectra":
        """Return the spectra with measured orders and bands in place of the modelled ones.

        Noise of a measured band is what its lines leave of it.

        Parameters
        ----------
        names : names of the lines, all orders that were measured among them
        orders : that were measured
        order_db : their levels, not a number where not measured, shape (..., speed, option,
            receiver, order)
        band_db : levels of the bands, likewise shape (..., speed, option, receiver, band)
        """
        square = self.square.copy()
        columns = [list(names).index(order_name(order)) for order in orders]
        square[..., columns] = np.where(
            np.isnan(order_db), square[..., columns], band_square(order_db)
        )
        measured = band_square(band_db)
        replaced = self._replace(square=square)
        noise = measured - replaced.in_bands()
        noise = np.where(noise > ROUNDING_SHARE * measured, noise, 0.0)
        return ToneSpectra(
            self.frequency_hz, square, np.where(np.isnan(band_db), self.noise, noise)
        )


def order_name(order: float) -> str:
    """Return the name of the line of a shaft order."""
    return f"{_ORDER}{order:g}"


def noise_square(noise_db: Array, unmodelled_db: Array) -> Array:
    """Add noise of the sources and unmodelled noise, (..., speed, option, receiver, band), Pa².

    Parameters
    ----------
    noise_db : levels of the sources' noise, shape (..., speed, option, receiver, band)
    unmodelled_db : level of unmodelled noise, the same shape
    """
    return np.asarray(band_square(noise_db) + band_square(unmodelled_db))


def tone_levels(spectra: ToneSpectra) -> dict[str, Array]:
    """Judge the tones of spectra.

    Returns
    -------
    variables of the vocabulary, shape (..., speed, option, receiver), those of each tone with
    line
    """
    judged, rated = [], []
    for speed, hertz in enumerate(spectra.frequency_hz):
        case = (..., speed, slice(None), slice(None), slice(None))
        sound = hertz, spectra.square[case], spectra.noise[case], MIDDLE_HZ
        judged.append(judged_tones(*sound))
        rated.append(predicted_audibility(*sound))
    level, excess = (np.stack(part, axis=-4) for part in zip(*judged, strict=True))
    decisive = np.stack([rating.decisive_db for rating in rated], axis=-3)
    return {
        "tone_level": level,
        "tone_excess": excess,
        "largest_tone_excess": excess.max(axis=-1),
        "tone_audibility": np.stack([rating.tone_db for rating in rated], axis=-4),
        "decisive_audibility": decisive,
        "tonal_adjustment": tonal_adjustment_db(decisive),
    }


def tone_probabilities(excess_db: Array) -> dict[str, Array]:
    """Return 1 for tones that are audible and prominent, else 0, and whether any tone is so.

    Parameters
    ----------
    excess_db : excess of tones, shape (..., line)

    Returns
    -------
    `tone_probability`, shape (..., line), and `any_tone_probability`, shape (...)
    """
    is_prominent = excess_db >= 0.0
    return {
        "tone_probability": is_prominent.astype(float),
        "any_tone_probability": is_prominent.any(axis=-1).astype(float),
    }


def tone_variables(results: xr.Dataset) -> xr.Dataset:
    """Judge and label the tones of a run with the nominal values.

    Parameters
    ----------
    results : lines by source, noise, unmodelled noise and a baseline, if there is one
    """
    spectra, names = nominal_spectra(results)
    values = tone_levels(spectra)
    values |= tone_probabilities(values["tone_excess"])
    coords = {name: results[name].values for name in ("speed", "option", "receiver")}
    labelled = stamped(values, {**coords, "judged_tone": names})
    frequency = ("speed", "judged_tone"), spectra.frequency_hz
    return labelled.assign_coords(judged_tone_frequency=frequency)


def nominal_spectra(results: xr.Dataset) -> tuple[ToneSpectra, list[str]]:
    """Return the spectra of a run with the nominal values, and the names of their lines."""
    dims = ("speed", "option", "receiver")
    pressure = results["pressure_line"].sum("sound_source").transpose(*dims, "line").values
    noise = noise_square(
        results["noise_band_level"].transpose(*dims, "noise_band").values,
        results["unmodelled_band_level"].transpose(*dims, "noise_band").values,
    )
    hertz, names = results["tone_frequency"].values, results["line"].values.tolist()
    sounding = np.where(hertz > 0.0, hertz, np.nan)
    square = 0.5 * np.abs(pressure) ** 2 * np.isfinite(sounding)[:, None, None]
    spectra = ToneSpectra(sounding, square, noise)
    if "baseline_band_level" not in results:
        return spectra, names
    return _with_baseline(spectra, names, results)


def _with_baseline(
    spectra: ToneSpectra, names: list[str], results: xr.Dataset
) -> tuple[ToneSpectra, list[str]]:
    has_orders = "baseline_order_level" in results
    orders = results["baseline_order"].values.tolist() if has_orders else []
    further = [order for order in orders if order_name(order) not in names]
    shaft = [shaft_frequency_hz(speed) for speed in results["speed"].values.tolist()]
    hertz = np.outer(shaft, further)
    added = np.zeros((*spectra.square.shape[:-1], len(further)))
    wider = ToneSpectra(
        np.concatenate([spectra.frequency_hz, hertz], axis=1),
        np.concatenate([spectra.square, added], axis=-1),
        spectra.noise,
    )
    every = [*names, *map(order_name, further)]
    dims = ("speed", "option", "receiver")
    band_db = results["baseline_band_level"].transpose(*dims, "baseline_band").values
    order_db = np.zeros((*band_db.shape[:-1], 0))
    if orders:
        order_db = results["baseline_order_level"].transpose(*dims, "baseline_order").values
    return wider.with_measured(every, orders, order_db, band_db), every


def band_square(level_db: Array) -> Array:
    """Return the mean squares of levels, the same shape, Pa²; zero of those that are silence.

    Parameters
    ----------
    level_db : any shape, dB
    """
    square = REFERENCE_PRESSURE_PA**2 * power_of_level(level_db)
    return np.where(level_db > SILENCE_DB + 100.0, square, 0.0)
