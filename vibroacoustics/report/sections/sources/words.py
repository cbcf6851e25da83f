"""Dominant sources of the level, and impacts of keys, in sentences made from numbers."""

from typing import Final

import numpy as np
import xarray as xr

from ....base import rounding
from ....base.arrays import Array
from ....base.remembered import remembered
from ....base.vocabulary import DERIVED_SUPPLY, REFERENCE_OPTION
from ....results.bands import Band, band, percent
from ....results.estimates import has_samples, prior_ensemble, sample_numbers
from ....results.stored_study import (
    at_catalogue,
    first_order_hz,
    nearest_speed,
    operating_points,
    options,
    overall_noise,
    parameters,
    quoted_dba,
    source_name,
    speeds,
)
from ...shown_speeds import many_speeds
from ..unknowns import sampled_sentences

LINE_FIGURE: Final = "foot_force_2x_line_n"
UNMODELLED: Final = "unmodelled noise"
_HALF: Final = 0.5
"""Share of the energy above which a source makes most of it."""


def elsewhere(results: xr.Dataset) -> str:
    """Words for the operating point of the overall noise, where the machine runs at another one."""
    runs_at, point = operating_points(results)
    return "" if point == runs_at else f" at the operating point {point}"


def source_share(results: xr.Dataset, source: str, speed: float) -> Band:
    """Return the share of a source in the energy of the machine without a balancer."""
    coordinates = at_catalogue(results, sound_source=source, speed=speed)
    return band(results, "source_share", **coordinates)


def unmodelled_share(results: xr.Dataset, speed: float) -> Band:
    """Return the share of unmodelled noise in the energy of the machine without a balancer."""
    return band(results, "unmodelled_share", **at_catalogue(results, speed=speed))


def ranked(results: xr.Dataset, speed: float) -> list[str]:
    """Return the sources without a balancer by their share of the energy, the largest first."""
    names = [str(source) for source in results["sound_source"].values]
    return sorted(names, key=lambda name: -source_share(results, name, speed).middle)


def certainty_sentences(results: xr.Dataset) -> list[str]:
    """Return what ranking and intervals depend on."""
    texts = [_ranking(results), samples_sentence(results)]
    texts += sampled_sentences(results) if has_samples(results) else []
    return [*filter(None, [*texts, _up_to(results), _not_an_order(results)])]


def samples_sentence(results: xr.Dataset) -> str:
    """Return the number of samples and how they were weighted."""
    ensemble = prior_ensemble(results)
    if ensemble is None:
        return "No value of the sources has a range: all values are nominal."
    tried, effective, computed = sample_numbers(results)
    if not has_samples(results):
        return _unresolved(results, tried, effective)
    why = ""
    if "baseline_band_level" in results:
        how = "by the likelihood of the measured baseline"
    elif overall_noise(results) is not None:
        how = f"by the likelihood of the published level{elsewhere(results)}"
        how += " and of the measured spectrum" if "spectrum_measured" in results else ""
    else:
        how = "by the hammer test" if "shell_weight" in results else "equally"
        why = ", as no level of the machine is published"
    return (
        f"{tried} samples were weighted {how}{why}: effective sample size {effective:.0f}. "
        f"{computed} of them were computed in all cases."
    )


def _unresolved(results: xr.Dataset, tried: int, effective: float) -> str:
    """Say why there are neither shares nor intervals."""
    first = (
        f"Too few of {tried} samples agree with the data: effective sample size {effective:.1f}."
    )
    if overall_noise(results) is None:
        return f"{first} All values are nominal."
    overall, ensemble = quoted_dba(results), prior_ensemble(results)
    louder = 0.0 if ensemble is None else float((ensemble.level_dba > overall).mean())
    return (
        f"{first} In {percent(louder)} of them the modelled sources exceed the published "
        f"{overall:g} dB(A). All values are nominal."
    )


def dominant_source(results: xr.Dataset) -> tuple[str, bool]:
    """Return the source with the largest share, and whether it makes most of the energy.

    It does where its interval is above one half and above those of all other parts of the sound.
    """
    speed = nearest_speed(results)
    first, *others = ranked(results, speed)
    shares = [source_share(results, name, speed) for name in others]
    highest = [share.highest for share in (*shares, unmodelled_share(results, speed))]
    return first, source_share(results, first, speed).lowest > max(_HALF, *highest)


def _ranking(results: xr.Dataset) -> str:
    if results.sizes["sound_source"] < 2:
        return ""
    source, is_settled = dominant_source(results)
    name, share = (
        source_name(results, source),
        source_share(results, source, nearest_speed(results)),
    )
    if is_settled:
        return f"The dominant source is settled: {name}, {share.in_percent()} of the energy."
    return (
        f"The dominant source is not settled: the interval of {name} is not above one half and "
        "above all others."
    )


def _up_to(results: xr.Dataset) -> str:
    highest = parameters(results)["radiation"]["maximum_frequency_hz"]
    above = "in no level" if overall_noise(results) is None else "part of the unmodelled noise"
    return f"Sources are modelled up to {highest:g} Hz; their sound above is {above}."


def _not_an_order(results: xr.Dataset) -> str:
    """Keep the motor's line apart from 2x."""
    if LINE_FIGURE not in results["figure"].values or "supply_frequency" not in results:
        return ""
    figures = results["reported_figure"].sel(option=REFERENCE_OPTION)
    motor = float(figures.sel(figure=LINE_FIGURE).max())
    return (
        f"Twice the line frequency is not an order of the shaft. It is {_twice_line(results)}. "
        f"{_derived_supply(results)}It is a source of its own; its foot force is at most "
        f"{rounding.significant(motor)} N."
    )


def _twice_line(results: xr.Dataset) -> str:
    """Twice the line frequency beside 2x, by speed."""
    twice = (2.0 * results["supply_frequency"].values).tolist()
    write = "{:.1f}".format if _derived_supply(results) else "{:g}".format
    if many_speeds(results):
        return (
            f"{rounding.span(twice, write)} Hz beside 2× at "
            f"{rounding.span(2.0 * first_order_hz(results), rounding.fixed)} Hz"
        )
    rows = zip(speeds(results), twice, first_order_hz(results), strict=True)
    return ", ".join(
        f"{write(line)} Hz beside 2× at {2.0 * first:.1f} Hz ({speed:g} rpm)"
        for speed, line, first in rows
    )


def _derived_supply(results: xr.Dataset) -> str:
    """Say where the supply's frequency comes from, if the study does not give it."""
    if results["supply_frequency"].attrs["source"] != DERIVED_SUPPLY:
        return ""
    return "The supply's frequency is derived from speed and slip under the mean load. "


def key_impacts(results: xr.Dataset, option: str) -> list[str]:
    """Impacts of keys per revolution and the largest force on a key, where there are impacts."""
    texts = []
    for prefix, whose in (("key", "Keys of the ring"), ("twin_key", "Keys of the second ring")):
        count = key_figure(results, option, f"{prefix}_impacts_per_revolution")
        force = key_figure(results, option, f"{prefix}_force_peak_n")
        if np.nanmax(count, initial=0.0) > 0.0:
            often = rounding.span(count, rounding.fixed)
            most = rounding.significant(float(np.nanmax(force)))
            texts.append(f"{whose}: {often} impacts per revolution, up to {most} N on a key.")
    return texts


def key_figure(results: xr.Dataset, option: str, name: str) -> Array:
    """A figure of the sources at every speed; NaN where the option has none."""
    nothing = np.full(len(speeds(results)), np.nan)
    return np.asarray(_figures(results)[option].get(name, nothing))


@remembered
def _figures(results: xr.Dataset) -> dict[str, dict[str, Array]]:
    """Figures of the sources at every speed, by option and name."""
    figures = results["reported_figure"].transpose("option", "figure", "speed")
    names = figures["figure"].values.tolist()
    of_options = zip(options(results), figures.values, strict=True)
    return {option: dict(zip(names, rows, strict=True)) for option, rows in of_options}
