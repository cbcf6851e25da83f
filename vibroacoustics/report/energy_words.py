"""Shares of the sound energy by the published data that weigh the samples."""

from typing import Final

import xarray as xr

from .bands import Band, percent
from .study import source_name
from .tables import Table

UNMODELLED: Final = "unmodelled"
"""Part of the energy that no source makes."""


def has_energy_shares(results: xr.Dataset) -> bool:
    """Return whether published data weigh the samples."""
    return "energy_share" in results


def energy_band(results: xr.Dataset, part: str, row: int = 0) -> Band:
    """Band of the share of a source or of unmodelled noise.

    Parameters
    ----------
    results : with energy shares
    part : name of a source, or `UNMODELLED`
    row : of the published data: all of them first, then the level alone
    """
    share = results["energy_share"][row].sel(energy_part=part).transpose("datum_quantile")
    return Band(*share.values.tolist())


def majority(results: xr.Dataset, part: str, row: int = 0) -> float:
    """Probability that a part makes more than half of the energy; parameters as `energy_band`."""
    return float(results["energy_majority"][row].sel(energy_part=part))


def spectrum_sentence(results: xr.Dataset) -> str:
    """Share of the source that the published spectral share changes most; empty without one."""
    if results.sizes.get("evidence", 0) < 2:
        return ""
    middle = results["energy_share"].drop_sel(energy_part=UNMODELLED).sel(datum_quantile=0.5)
    source = str(abs(middle[0] - middle[1]).idxmax().item())
    name = source_name(results, source)
    with_share, alone = (
        f"{energy_band(results, source, row).in_percent()} of the energy, more than "
        f"half of it with a probability of {percent(majority(results, source, row))}"
        for row in (0, 1)
    )
    return (
        f"With the published spectral share {name} make {with_share}; with the level alone "
        f"{alone}. The difference holds only if the modelled spectrum of {name} is right."
    )


def energy_table(results: xr.Dataset) -> Table | None:
    """Shares of the energy by the published data that weigh; None without published data."""
    if not has_energy_shares(results):
        return None
    evidence = list(map(str, results["evidence"].values))
    numbers = range(len(evidence))
    rows = [
        (
            source_name(results, part),
            *(energy_band(results, part, row).in_percent() for row in numbers),
            *(percent(majority(results, part, row)) for row in numbers),
        )
        for part in map(str, results["energy_part"].values)
    ]
    head = ("", *evidence, *(f"more than half, {name}" for name in evidence))
    effective = ", ".join(
        f"{count:.0f} with {name}"
        for name, count in zip(evidence, results["evidence_effective"].values, strict=True)
    )
    caption = f"Shares of the energy by published data; effective samples: {effective}"
    return Table(caption, head, tuple(rows))
