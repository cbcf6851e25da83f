"""What the options do to the sound of all sources, with bands."""

from typing import NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from .bands import Band, band_words, bands_by_speed
from .quantities import HEARD_DB, TOLERANCE_DB
from .study import balancers, catalogue_receiver, many_speeds, overall_noise, speeds


class SourceChange(NamedTuple):
    """Change of all modelled sources and of the whole machine, a band at every speed."""

    sources: tuple[Band, ...]
    total: tuple[Band, ...]


def source_change(results: xr.Dataset, option: str) -> SourceChange:
    """Changes by an option at the catalogue's microphone."""
    at = {"option": option, "receiver": catalogue_receiver(results)}
    return SourceChange(
        *(bands_by_speed(results, name, **at) for name in ("change_modelled", "change_total"))
    )


def changes_sentence(results: xr.Dataset) -> str:
    """Which options are heard in the total, for sure or perhaps, and what the others do."""
    changes = {option: source_change(results, option) for option in balancers(results)}
    louder = {o: c for o, c in changes.items() if _surely_louder(c)}
    quieter = {o: c for o, c in changes.items() if _surely_quieter(c)}
    rest = [option for option in changes if option not in louder and option not in quieter]
    at = f"At {catalogue_receiver(results)}"
    parts = [
        f"{at} the whole machine becomes louder with {_named(results, louder)}." if louder else "",
        f"{at} it becomes quieter with {_named(results, quieter)}." if quieter else "",
    ]
    if rest:
        ends = [end for option in rest for band in changes[option].total for end in band]
        assumed = results["change_total"].sel(option=rest, receiver=catalogue_receiver(results))
        largest = float(np.abs([*ends, *assumed.values.ravel()]).max())
        bound = 0.1 * max(np.ceil(10.0 * largest), 1.0)
        which = "No other option changes" if louder or quieter else "No option changes"
        audibility = "" if largest >= HEARD_DB else ", which can hardly be heard"
        parts.append(
            f"{which} the total of {overall_noise(results)['level_dba']:g} dB(A) by more than "
            f"{rounding.fixed(bound)} dB{audibility}."
        )
    return " ".join(filter(None, parts))


def change_sentences(results: xr.Dataset, option: str) -> list[str]:
    """What an option does to all sources and the total, and why."""
    change = source_change(results, option)
    return [
        f"With all sources the modelled level changes by {_by_speed(results, change.sources)} "
        f"({band_words(results)} of the draws), the total by {_by_speed(results, change.total)}.",
        *_impacts(results, option),
    ]


def change_words(band: Band) -> str:
    """`+2.2 to +12.2 dB`."""
    if max(abs(band.lowest), abs(band.highest)) < TOLERANCE_DB:
        return f"less than {TOLERANCE_DB:g} dB"
    return f"{band.ends(rounding.signed)} dB"


def _surely_louder(change: SourceChange) -> bool:
    return any(band.lowest >= HEARD_DB for band in change.total)


def _surely_quieter(change: SourceChange) -> bool:
    return any(band.highest <= -HEARD_DB for band in change.total) and not _surely_louder(change)


def _named(results: xr.Dataset, changes: dict[str, SourceChange]) -> str:
    return " and ".join(
        f"{option} ({_by_speed(results, change.total)})" for option, change in changes.items()
    )


def _by_speed(results: xr.Dataset, bands: tuple[Band, ...]) -> str:
    words = [change_words(band) for band in bands]
    if len(set(words)) == 1:
        return words[0]
    if many_speeds(results):
        lowest, highest = min(band.lowest for band in bands), max(band.highest for band in bands)
        return f"{change_words(Band(lowest, lowest, highest))}, depending on the speed"
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
                f"{rounding.significant(float(np.nanmax(force)))} N on a key (values as assumed)."
            )
    return texts


def key_figure(results: xr.Dataset, option: str, name: str) -> Array:
    """A figure of the sources at every speed; NaN where the option has none."""
    figures = results["reported_figure"]
    if name not in figures["figure"].values:
        return np.full(len(speeds(results)), np.nan)
    return np.asarray(figures.sel(option=option, figure=name).values)
