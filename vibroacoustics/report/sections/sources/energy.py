"""Level and shares of the energy with less evidence, and with the second prior."""

from typing import Final

import xarray as xr

from ....base import rounding
from ....results.estimates import estimate
from ....results.stored_study import at_catalogue, nearest_speed, source_name
from ...bands import FINEST_DB, Band, band, written
from ...tables import Table
from .words import UNMODELLED, source_share, unmodelled_share

LEAST: Final = 0.01
"""Smaller shares are in uncertainty.csv."""
_WORDS = {"level alone": "published level alone", "other prior": "second prior"}


def alternatives_table(results: xr.Dataset) -> Table | None:
    """Return level and shares with all data, and with alternatives; None without alternatives."""
    if "alternative" not in results:
        return None
    speed, alternatives = nearest_speed(results), list(map(str, results["alternative"].values))
    rows = [
        (
            "Level of the machine, dB(A)",
            band(results, "level_total", **at_catalogue(results, speed=speed)).middle_and_ends(
                rounding.level
            ),
            *(_level(results, name).middle_and_ends(rounding.level) for name in alternatives),
        )
    ]
    largest = results["alternative_share"].max("alternative")
    for part in map(str, results["energy_part"].where(largest >= LEAST, drop=True).values):
        here = (
            source_share(results, part, speed)
            if part in results["sound_source"].values
            else unmodelled_share(results, speed)
        )
        shares = (_share(results, name, part).in_percent() for name in alternatives)
        name = source_name(results, part) if part in results["sound_source"].values else UNMODELLED
        rows.append((f"Share of {name}", here.in_percent(), *shares))
    effective = ", ".join(
        f"{results['alternative_effective'].sel(alternative=name).item():.0f} with {_WORDS[name]}"
        for name in alternatives
    )
    head = ("", "all data, first prior", *(_WORDS[name] for name in alternatives))
    caption = f"Less evidence or another prior (shares from 1 %); effective sample size {effective}"
    return Table(caption, head, tuple(rows))


def spectrum_sentence(results: xr.Dataset) -> str:
    """Return how far the published spectral share changes shares; empty without one."""
    if "alternative" not in results or "level alone" not in results["alternative"].values:
        return ""
    speed, sources = nearest_speed(results), list(map(str, results["sound_source"].values))

    def change(source: str) -> float:
        alone = _share(results, "level alone", source).middle
        return abs(source_share(results, source, speed).middle - alone)

    source = max(sources, key=change)
    name = source_name(results, source)
    return (
        f"With the published spectral share {name} make "
        f"{source_share(results, source, speed).in_percent()} of the energy, with the level alone "
        f"{_share(results, 'level alone', source).in_percent()}."
    )


def _share(results: xr.Dataset, alternative: str, part: str) -> Band:
    known = estimate(results, "alternative_share", alternative=alternative, energy_part=part)
    return written(known, _effective(results, alternative))


def _level(results: xr.Dataset, alternative: str) -> Band:
    known = estimate(results, "alternative_level", alternative=alternative)
    return written(known, _effective(results, alternative), FINEST_DB)


def _effective(results: xr.Dataset, alternative: str) -> float:
    return float(results["alternative_effective"].sel(alternative=alternative))
