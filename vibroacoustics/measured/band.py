"""Random errors of measured functions, the bands that they leave, and the files they come from."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray as xr
from scipy.special import chndtr, chndtrinc

from ..base.arrays import Array, ComplexArray
from ..base.decibel import sound_pressure_level
from ..base.errors import ParameterError, VibroacousticsError
from ..base.parameters import Parameters
from ..base.plain_bytes import canonical_json, sha256
from ..results.provenance import software_attributes
from .settings import Measured


@contextmanager
def naming_settings(path: Path) -> Iterator[None]:
    """Put the file of settings before an error that names no file beside it."""
    try:
        yield
    except VibroacousticsError as error:
        folder, lines = str(path.parent), map(str, error.args)
        named = (line if line.startswith(folder) else f"{path}: {line}" for line in lines)
        raise type(error)(*named) from None


def without_bands(results: xr.Dataset, faults: Sequence[str]) -> xr.Dataset:
    """Return results with their accepted faults, whose errors leave no band: its limits are NaN.

    Parameters
    ----------
    results : with limits whose names end in `_low` and `_high`
    faults : a line for each fault that was accepted
    """
    limits = [str(name) for name in results if str(name).endswith(("_low", "_high"))]
    open_bands = {name: results[name].copy() for name in limits if faults}
    for band in open_bands.values():
        band[...] = np.nan
    return results.assign(open_bands).assign_attrs(faults="\n".join(faults))


def attributes(
    command: str, path: Path, title: str, settings: Parameters, measured: Measured
) -> dict[str, Any]:
    """Return the provenance of a result of measured functions: settings, hashes of files,
    software."""
    parameters = canonical_json(settings.model_dump(mode="json"))
    named = (*measured.frequency_responses, *measured.operating)
    files = {name: sha256((path.parent / name).read_bytes()) for name in named}
    return {
        **software_attributes(f"{command} {path.name}"),
        "title": title,
        "parameters": parameters,
        "parameters_sha256": sha256(parameters.encode()),
        "measured_files": canonical_json(files),
        "draws": measured.draws,
    }


RANDOM_STATE: Final = 19
"""Draws are the same in every run."""


def error_of_repeats(repeats: ComplexArray) -> Array:
    """RMS of the complex error of a mean of repeats, shape (frequency,).

    Parameters
    ----------
    repeats : at least two, shape (repeat, frequency)
    """
    deviations = repeats - repeats.mean(axis=0)
    count = len(repeats)
    return np.asarray(np.sqrt(np.sum(np.abs(deviations) ** 2, axis=0) / (count - 1) / count))


def error_of_coherence(values: ComplexArray, coherence: Array, averages: int) -> Array:
    """RMS of the complex random error of a frequency response, shape (frequency,).

    √2 times that of its magnitude, |H| √((1 - γ²) / (2 γ² n)): Bendat and Piersol, Random Data,
    4th edition, section 9.2.3. It holds no bias, such as that of a line wider than a resonance.

    Parameters
    ----------
    values : shape (frequency,)
    coherence : γ², above 0 up to 1, shape (frequency,)
    averages : n, independent

    Raises
    ------
    ParameterError
        A coherence is outside its range.
    """
    outside = (coherence <= 0.0) | (coherence > 1.0 + 1e-6)
    if np.any(outside):
        raise ParameterError(f"coherence {coherence[outside][0]:g}: must be above 0 up to 1")
    noise = np.maximum(1.0 - coherence, 0.0)
    return np.asarray(np.abs(values) * np.sqrt(noise / (coherence * averages)))


def measured_again(values: ComplexArray, error: Array, count: int) -> list[ComplexArray]:
    """Functions with errors drawn anew, of the size that their own have.

    Parameters
    ----------
    values, error : estimates and the RMS of their complex error, any shape
    count : number of samples
    """
    random = np.random.default_rng(RANDOM_STATE)
    shape = values.shape
    return [
        values
        + error
        * (random.standard_normal(shape) + 1j * random.standard_normal(shape))
        / np.sqrt(2.0)
        for _ in range(count)
    ]


SHARE: Final = 0.9
"""Probability of a band."""
TRIED: Final = (0.0, 0.005, 0.01, 0.02, 0.05, 0.1)
"""Truncations of which one is chosen."""
_GOOD_ENOUGH: Final = 1.01
"""The least truncation is taken whose error is within this factor of the least error."""


def amplitude_band(estimate: ComplexArray, sampled: ComplexArray) -> tuple[Array, Array]:
    """Limits of the 90 % confidence interval of an amplitude, 5 % to each side.

    The error of a response is, to first order in errors of measured complex values, complex
    normal and circular, so that the squared amplitude over half the variance is noncentral χ² of
    two degrees of freedom: its limits are those noncentralities that put the estimate at 95 % and
    at 5 % of the distribution. Quantiles of the sampled amplitudes themselves are too high
    where noise exceeds the response. The variance is that of the samples' median, |e|² / ln 2,
    which a few near-singular samples do not move. The estimate itself is always within.

    Parameters
    ----------
    estimate : complex, any shape
    sampled : estimates from sampled measurements, shape (sample, ...)

    Returns
    -------
    lower and upper limits, the shape of the estimate
    """
    variance = np.median(np.abs(sampled - estimate) ** 2, axis=0) / np.log(2.0)
    half = np.maximum(variance, np.finfo(float).tiny) / 2.0
    size = np.abs(estimate) ** 2 / half
    # far above the noise the normal distribution is the limit, and χ² loses its digits
    far = size > 1e6
    bounded = np.where(far, 1.0, size)
    limits = []
    for probability, normal in ((0.5 + SHARE / 2.0, -1.0), (0.5 - SHARE / 2.0, 1.0)):
        inner = chndtr(bounded, 2.0, 0.0) < probability
        power = np.where(inner, 0.0, chndtrinc(np.where(inner, 9.0, bounded), 2.0, probability))
        near = np.sqrt(power * half)
        limits.append(np.where(far, np.abs(estimate) + normal * 1.645 * np.sqrt(half), near))
    return np.minimum(limits[0], np.abs(estimate)), np.maximum(limits[1], np.abs(estimate))


def power_band(estimate: Array, sampled: Array) -> tuple[Array, Array]:
    """Band of a sum of powers, or of a ratio of such sums, not below zero.

    Quantiles of the samples, reflected at the estimate: samples lie above the estimate by the power
    of their noise, and the estimate lies as much above the truth. Basic bootstrap, Davison and
    Hinkley, Bootstrap Methods and their Application, section 5.2.1.

    Parameters
    ----------
    estimate : any shape
    sampled : samples, shape (sample, ...)
    """
    low, high = np.quantile(sampled, [0.5 - SHARE / 2.0, 0.5 + SHARE / 2.0], axis=0)
    return np.maximum(2.0 * estimate - high, 0.0), np.maximum(2.0 * estimate - low, 0.0)


def truncation_errors(
    of_measured: ComplexArray, of_samples: Sequence[Callable[[float], ComplexArray]]
) -> Array:
    """Mean error of a line's level for each of `TRIED`, dB, shape (truncation,).

    The measurements count as the truth, their samples as measured.

    Parameters
    ----------
    of_measured : predicted without truncation, shape (...)
    of_samples : functions of a truncation, each predicts from sampled measurements
    """
    level = sound_pressure_level(of_measured)
    return np.array(
        [
            np.mean(
                [
                    np.abs(sound_pressure_level(of_sample(share)) - level).mean()
                    for of_sample in of_samples
                ]
            )
            for share in TRIED
        ]
    )


def chosen_truncation(errors: Array) -> float:
    """The least truncation that does about as well as the best.

    Parameters
    ----------
    errors : errors of each of `TRIED`, shape (truncation,)
    """
    good = errors <= _GOOD_ENOUGH * errors.min()
    return TRIED[int(np.argmax(good))]
