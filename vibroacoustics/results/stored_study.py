"""Parameters, names and published level of the study that results keep."""

import json
from functools import lru_cache
from typing import Any, TypeVar

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.remainder import BIAS_DB

Labelled = TypeVar("Labelled", xr.DataArray, xr.Dataset)


def parameters(results: xr.Dataset) -> dict[str, Any]:
    """All parameters of the study, as `Study.parameters` gave them."""
    return dict(_decoded(results.attrs["parameters"]))


def words(results: xr.Dataset) -> dict[str, Any]:
    """Return the words of machine and options, as the run kept them."""
    return dict(_decoded(results.attrs["words"]))


def source_name(results: xr.Dataset, source: str) -> str:
    """Plain words for a source of sound."""
    label = words(results)["sources"].get(source, source.replace("_", " "))
    return str(label)


@lru_cache(maxsize=4)
def _decoded(attribute: str) -> dict[str, Any]:
    """Kept, as a report reads it some thousand times."""
    return dict(json.loads(attribute))


def catalogue_receiver(results: xr.Dataset) -> str:
    """Name of the microphone at which the machine's noise is published, or of the first one."""
    return str(parameters(results)["catalogue_receiver"])


def speeds(results: xr.Dataset) -> list[float]:
    """Shaft speeds in rpm."""
    return [float(speed) for speed in results.variables["speed"].values]


def options(results: xr.Dataset) -> list[str]:
    """Names of all options, the reference among them."""
    return [str(option) for option in results.variables["option"].values]


def balancers(results: xr.Dataset) -> list[str]:
    """Names of the options that are compared to the reference."""
    return [option for option in options(results) if option != REFERENCE_OPTION]


def other_receivers(results: xr.Dataset) -> list[str]:
    """Microphones apart from the catalogue's."""
    names = [str(receiver) for receiver in results.variables["receiver"].values]
    return [name for name in names if name != catalogue_receiver(results)]


def operating_points(results: xr.Dataset) -> tuple[str | None, str | None]:
    """Operating point at which the machine runs, and that of its overall noise; none for no name.

    They are none where the values of the machine's file hold.
    """
    study = parameters(results)
    runs_at = study.get("operation", {}).get("point")
    return runs_at, study.get("catalogue_point") or runs_at


def overall_noise(results: xr.Dataset) -> dict[str, float] | None:
    """Published level of the machine with its speed and distance; none without one."""
    noise: dict[str, float] | None = parameters(results)["machine"].get("overall_noise")
    return noise


def assumed_level(results: xr.Dataset) -> bool:
    """Whether the level of the machine that the study gives is assumed, not published."""
    return any(
        record["field"].endswith("overall_noise.level_dba")
        and str(record["source"]).startswith("assumed")
        for record in parameters(results)["records"]
    )


def quoted_speed(results: xr.Dataset) -> float:
    """The speed at which the overall level is published; the first one where none is."""
    noise = overall_noise(results)
    return speeds(results)[0] if noise is None else noise["speed_rpm"]


def nearest_speed(results: xr.Dataset) -> float:
    """The speed that was run nearest to the published one."""
    quoted = quoted_speed(results)
    return min(speeds(results), key=lambda speed: abs(speed - quoted))


def quoted_dba(results: xr.Dataset) -> float:
    """The published level; where none is, that of all that is modelled, without a balancer."""
    noise = overall_noise(results)
    if noise is not None:
        return noise["level_dba"]
    level = results["level_total"].sel(at_catalogue(results, speed=quoted_speed(results)))
    return float(level.round(1))


def at_catalogue(results: xr.Dataset, **more: Any) -> dict[str, Any]:
    """Selection of the catalogue's microphone without a balancer, with further labels."""
    return {"option": REFERENCE_OPTION, "receiver": catalogue_receiver(results), **more}


def level_kind(results: xr.Dataset) -> str:
    """Word for the level of the machine that the study gives: assumed, published, declared, series.

    Only where there is such a level.
    """
    kind = str((overall_noise(results) or {}).get("kind", "measured"))
    if kind != "measured":
        return kind
    return "assumed" if assumed_level(results) else "published"


def level_bias_db(results: xr.Dataset) -> tuple[float, float]:
    """Mean and standard deviation of the published level less that of the machine, by its kind."""
    return BIAS_DB.get(level_kind(results), (0.0, 0.0))


def a_weighted(level: Labelled) -> Labelled:
    """Return the A-weighted of levels by weighting; other levels are A-weighted already."""
    return level.sel(weighting="A", drop=True) if "weighting" in level.dims else level


def has_sources(results: xr.Dataset) -> bool:
    """Whether more than the moving parts drives the machine."""
    return bool(results.sizes["sound_source"] > 1)


def first_order_hz(results: xr.Dataset) -> Array:
    """Frequency of the 1x line at each speed, Hz."""
    return np.array([shaft_frequency_hz(speed) for speed in speeds(results)])
