"""Results with one input changed: what the headlines read, with an alternative to the study."""

from collections.abc import Mapping
from typing import Final

import xarray as xr

from ..base.vocabulary import HIGH, LOW, SUFFIXES
from .estimates import ENSEMBLE_WEIGHT, has_samples
from .stored_study import (
    at_catalogue,
    catalogue_receiver,
    nearest_speed,
    operating_points,
    quoted_speed,
)

LEAST_EFFECTIVE: Final = 20.0
"""Effective number of samples from which on values are shown: two are then beyond each end of an
80 % interval."""
CHANGES: Final = {"level_total": "change_total", "foot_force": "foot_force_change_1x"}
"""Variable of the change of each quantity."""
_REPLACED: Final = ("level_total", "source_share", "unmodelled_share", *CHANGES.values())
_BESIDE: Final = (
    "increase_probability", "decrease_probability", "largest_foot_force", ENSEMBLE_WEIGHT,
)  # fmt: skip
_PARTS: Final = ("", SUFFIXES[LOW], SUFFIXES[HIGH])


def alternatives(results: xr.Dataset) -> list[str]:
    """Return the names of the alternatives whose changes by options results hold."""
    if not has_samples(results) or "alternative_change" not in results:
        return []
    return [str(name) for name in results["alternative"].values]


def effective_sizes(results: xr.Dataset, alternative: str) -> tuple[float, float]:
    """Return the effective sizes: samples of level and shares, samples of changes by options."""
    here = results.sel(alternative=alternative)
    return float(here["alternative_effective"]), float(here["alternative_change_effective"])


def at_published(results: xr.Dataset) -> bool:
    """Return whether the machine runs at the published point, that of level and shares."""
    runs_at, point = operating_points(results)
    return runs_at == point and nearest_speed(results) == quoted_speed(results)


def headline_variables(results: xr.Dataset) -> xr.Dataset:
    """Return the variables alone that the headlines are made of, and those of alternatives."""
    names = {f"{name}{part}" for name in _REPLACED for part in _PARTS} | {*_BESIDE}
    return results[
        [name for name in results.data_vars if name in names or str(name).startswith("alternative")]
    ]


def with_alternative(results: xr.Dataset, alternative: str) -> xr.Dataset:
    """Return results with level, shares and changes by options of an alternative.

    They are replaced at the published microphone; level and shares at the published point alone.
    What has too few samples stays.

    Parameters
    ----------
    results : headline variables of a run with samples
    alternative : its name
    """
    here = results.sel(alternative=alternative, drop=True)
    of_level, of_changes = effective_sizes(results, alternative)
    replaced: dict[str, xr.DataArray] = {}
    if of_level >= LEAST_EFFECTIVE and at_published(results):
        replaced |= _at_published(results, here)
    if of_changes >= LEAST_EFFECTIVE:
        replaced |= _changes(results, here)
    return results.assign(replaced)


def _at_published(results: xr.Dataset, here: xr.Dataset) -> dict[str, xr.DataArray]:
    """Level and shares of the machine, and the ends of their intervals."""
    point = at_catalogue(results, speed=nearest_speed(results))
    sources = results["sound_source"].values
    replaced: dict[str, xr.DataArray] = {}
    for part in _PARTS:
        share = here[f"alternative_share{part}"].rename(energy_part="sound_source")
        values = {
            "level_total": here[f"alternative_level{part}"],
            "source_share": share.sel(sound_source=sources),
            "unmodelled_share": share.sel(sound_source="unmodelled", drop=True),
        }
        replaced |= {
            f"{name}{part}": _with(results[f"{name}{part}"], value, point)
            for name, value in values.items()
        }
    return replaced


def _changes(results: xr.Dataset, here: xr.Dataset) -> dict[str, xr.DataArray]:
    """Changes by options, the ends of their intervals, and the probabilities of changes."""
    receiver = {"receiver": catalogue_receiver(results)}
    chances = {name: results[f"{name}_probability"] for name in ("increase", "decrease")}
    replaced = {}
    for quantity, name in CHANGES.items():
        of_quantity = here.sel(alternative_quantity=quantity, drop=True)
        for part in _PARTS:
            current = results[f"{name}{part}"]
            labels = receiver if "receiver" in current.dims else {}
            replaced[f"{name}{part}"] = _with(
                current, of_quantity[f"alternative_change{part}"], labels
            )
        for chance, current in chances.items():
            labels = receiver | {"judged_quantity": quantity}
            chances[chance] = _with(current, of_quantity[f"alternative_{chance}"], labels)
    return replaced | {f"{name}_probability": array for name, array in chances.items()}


def _with(array: xr.DataArray, values: xr.DataArray, labels: Mapping[str, object]) -> xr.DataArray:
    """Return an array with other values at some labels."""
    changed = array.copy(deep=True)
    changed.loc[labels] = values.reset_coords(drop=True).transpose(*array.sel(labels).dims)
    return changed
