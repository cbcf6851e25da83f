"""What the options do to the sound of all sources, with bands."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr

from ....base import rounding
from ....base.arrays import Array
from ....base.remembered import remembered
from ....results.estimates import has_samples
from ....results.stored_study import at_catalogue, balancers, options, speeds
from ...bands import INTERVAL, Band, bands_by_speed, hull
from ...quantities import TOLERANCE_DB, TOTAL
from ...shifts import shift
from ...shown_speeds import many_speeds
from .words import total_of


class SourceChange(NamedTuple):
    """Change of all modelled sources and of the whole machine, a band at every speed."""

    sources: tuple[Band, ...]
    total: tuple[Band, ...]


def source_change(results: xr.Dataset, option: str) -> SourceChange:
    """Changes by an option at the catalogue's microphone."""
    at = at_catalogue(results, option=option)
    return SourceChange(
        *(bands_by_speed(results, name, **at) for name in ("change_modelled", "change_total"))
    )


def changes_sentence(results: xr.Dataset) -> str:
    """Which options change the total by what could be measured, and what the others do."""
    shifts = {option: shift(results, TOTAL, option) for option in balancers(results)}
    louder = [option for option, one in shifts.items() if one.worsens]
    quieter = [option for option, one in shifts.items() if one.improves and not one.worsens]
    rest = [option for option in shifts if option not in louder + quieter]
    of = total_of(results)
    parts = [
        f"{of[0].upper()}{of[1:]} becomes louder with {_named(results, louder)}." if louder else "",
        f"{of[0].upper()}{of[1:]} becomes quieter with {_named(results, quieter)}."
        if quieter
        else "",
    ]
    if rest:
        which = "no other option" if louder or quieter else "no option"
        bands = [band for option in rest for band in source_change(results, option).total]
        sampled = "In most samples " if has_samples(results) else "With nominal values "
        parts.append(
            f"{sampled}{which} changes the level of {of} by what could be "
            f"measured: {', '.join(rest)} by "
            f"{change_words(hull(bands))}."
        )
    return " ".join(filter(None, parts))


def change_sentences(results: xr.Dataset, option: str) -> list[str]:
    """What an option does to all sources and the total, and why."""
    change = source_change(results, option)
    return [
        f"With all sources the modelled level changes by {_by_speed(results, change.sources)} "
        f"({INTERVAL}), the total by {_by_speed(results, change.total)}.",
        *_impacts(results, option),
    ]


def change_words(band: Band) -> str:
    """`+2.2 to +12.2 dB`."""
    if max(abs(band.lowest), abs(band.highest)) < TOLERANCE_DB:
        return f"less than {TOLERANCE_DB:g} dB"
    return f"{band.ends(rounding.signed)} dB"


def _named(results: xr.Dataset, names: Sequence[str]) -> str:
    return " and ".join(
        f"{name} ({_by_speed(results, source_change(results, name).total)})" for name in names
    )


def _by_speed(results: xr.Dataset, bands: tuple[Band, ...]) -> str:
    words = [change_words(band) for band in bands]
    if len(set(words)) == 1:
        return words[0]
    if many_speeds(results):
        return f"{change_words(hull(bands))}, depending on the speed"
    return " and ".join(
        f"{text} at {speed:g} rpm" for text, speed in zip(words, speeds(results), strict=True)
    )


def _impacts(results: xr.Dataset, option: str) -> list[str]:
    """Which keys strike, where they do."""
    texts = []
    for prefix, whose in (("key", "The ring's keys"), ("twin_key", "The second ring's keys")):
        count = key_figure(results, option, f"{prefix}_impacts_per_revolution")
        force = key_figure(results, option, f"{prefix}_force_peak_n")
        if np.nanmax(count, initial=0.0) > 0.0:
            often = rounding.span(count, rounding.fixed)
            texts.append(
                f"{whose} strike {often} times a revolution, with up to "
                f"{rounding.significant(float(np.nanmax(force)))} N on a key."
            )
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
