"""Evidence of the user's measured third octaves on the sources, and where the model differs."""

from typing import Any, Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...results.bands import INTERVAL, Band, written
from ...results.estimates import Estimate, effective_samples, has_samples
from ...results.stored_study import nearest_speed, parameters, source_name
from ..blocks import Block, Text
from ..tables import DataTable, Table, long_table
from . import Section
from .sources.content import LEAST, alternative_share
from .sources.words import UNMODELLED, source_share, unmodelled_share

LEVEL_ALONE: Final = "level alone"
WITHOUT: Final = "without the spectrum"
DEVIATIONS: Final = 2.0
"""A third octave differs by more than so many standard deviations."""


def settled_sentence(results: xr.Dataset) -> str:
    """Return the share whose interval the spectrum shortened most, before and after."""
    part = min(_parts(results), key=lambda name: _ratio(results, name))
    alone, here = alternative_share(results, LEVEL_ALONE, part), _share(results, part)
    name = _name(results, part)
    return (
        f"The measured third octaves settle the share of {name} best: {here.in_percent()} of the "
        f"energy, with the published level alone {alone.in_percent()}. The {INTERVAL} is "
        f"{rounding.significant(_ratio(results, part), 2)} times as wide."
    )


def settled_table(results: xr.Dataset) -> Table:
    """Return shares of the energy without and with the spectrum, from 1 %."""
    less = [name for name in (LEVEL_ALONE, WITHOUT) if name in results["alternative"].values]
    rows = []
    for part in _parts(results):
        shares = [alternative_share(results, name, part) for name in less]
        texts = (share.in_percent() for share in (*shares, _share(results, part)))
        rows.append(
            (
                _name(results, part).capitalize(),
                *texts,
                rounding.significant(_ratio(results, part), 2),
            )
        )
    words = {LEVEL_ALONE: "Published level alone", WITHOUT: "All published data"}
    head = (
        "Source", *(words[name] for name in less), "With the spectrum",
        "Ratio of widths to the level alone",
    )  # fmt: skip
    return Table(f"Shares of the energy, mean ({INTERVAL})", head, tuple(rows))


def differing_sentence(results: xr.Dataset) -> str:
    """Return the third octaves that the weighted model still misses."""
    allowed = DEVIATIONS * _settings(results)["deviation_db"]
    differing = [f"{band:g}" for band in _differing(results, allowed)]
    limit = f"{allowed:g} dB"
    if not differing:
        return f"The weighted model agrees with every third octave within {limit}."
    bands = "third octave" if len(differing) == 1 else "third octaves"
    return (
        f"The weighted model still differs by more than {limit} from the measured {bands} "
        f"{', '.join(differing)} Hz."
    )


def band_table(results: xr.Dataset) -> Table:
    """Return measured third octaves beside the model before and after they weigh."""
    differing = _differing(results, DEVIATIONS * _settings(results)["deviation_db"])
    effective, rows = effective_samples(results), []
    for band in results["spectrum_band"].values.tolist():
        here = results.sel(spectrum_band=band)
        before, after = (
            written(Estimate(*_quantiles(here, name)), effective, 0.1)
            for name in ("spectrum_before", "spectrum_after")
        )
        rows.append(
            (
                f"{band:g}",
                rounding.fixed(float(here["spectrum_measured"])),
                before.middle_and_ends(rounding.fixed),
                after.middle_and_ends(rounding.fixed),
                "differs" if band in differing else "agrees",
            )
        )
    head = ("Third octave, Hz", "Measured", "Expected by the model", "Weighted", "")
    where = _settings(results)
    caption = (
        f"A-weighted levels at {where['microphone']}, {where['speed_rpm']:g} rpm, dB(A), median "
        f"({INTERVAL}); expected without discrepancy"
    )
    return Table(caption, head, tuple(rows), frozenset({0, 4}))


def _settings(results: xr.Dataset) -> dict[str, Any]:
    return dict(parameters(results)["evidence"]["spectrum"])


def _quantiles(results: xr.Dataset, name: str) -> list[float]:
    return [float(value) for value in results[name].transpose("datum_quantile", ...).values]


def _differing(results: xr.Dataset, allowed_db: float) -> list[float]:
    after = results["spectrum_after"].sel(datum_quantile=0.5)
    off = np.abs((after - results["spectrum_measured"]).values) > allowed_db
    return [float(band) for band in results["spectrum_band"].values[off]]


def _parts(results: xr.Dataset) -> list[str]:
    """Return sources and unmodelled noise with a share of 1 % at least, without or with it."""
    names = map(str, results["energy_part"].values)
    return [
        name
        for name in names
        if max(alternative_share(results, LEVEL_ALONE, name).middle, _share(results, name).middle)
        >= LEAST
    ]


def _share(results: xr.Dataset, part: str) -> Band:
    speed = nearest_speed(results)
    if part in results["sound_source"].values:
        return source_share(results, part, speed)
    return unmodelled_share(results, speed)


def _name(results: xr.Dataset, part: str) -> str:
    return source_name(results, part) if part in results["sound_source"].values else UNMODELLED


def _ratio(results: xr.Dataset, part: str) -> float:
    alone, here = alternative_share(results, LEVEL_ALONE, part), _share(results, part)
    width = alone.highest - alone.lowest
    return (here.highest - here.lowest) / width if width > 0.0 else 1.0


def _blocks(results: xr.Dataset) -> list[Block]:
    deviation = _settings(results)["deviation_db"]
    return [
        Text(settled_sentence(results), "strong"),
        settled_table(results),
        Text(differing_sentence(results)),
        band_table(results),
        Text(
            f"Sums over octaves weigh, with a standard deviation of {deviation:g} dB, together "
            "with the published data. Discrepancies of the model are correlated over an octave. "
            "Spectra of sources and of unmodelled noise deviate by them.",
            "note",
        ),
    ]


def _applies(results: xr.Dataset) -> bool:
    return has_samples(results) and "spectrum_after" in results


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    names = ("spectrum_measured", "spectrum_before", "spectrum_after")
    return {"measured_spectrum.csv": long_table(results, names)}


register(
    Section(
        "measured-spectrum",
        "Measured spectrum as evidence",
        _blocks,
        _applies,
        31.0,
        tables=_data,
    )
)
